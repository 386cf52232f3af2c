// SPDX-License-Identifier: MIT
// Channels (debug modes) of shared/contract/debug_mode.h as C++ data.
#pragma once

#include "shared/contract/debug_mode.h"
#include "shared/contract/material.h"

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace diptych {

enum class Metric { relative, absolute, angular, axial, exact };
constexpr bool isAngle(Metric metric) {  // in degrees
    return metric == Metric::angular || metric == Metric::axial;
}
enum class ChannelKind { color, vector, scalar, id };
// Valid range of the values: unit vectors, these or 0, 0 to 1, 0 or more, or any.
enum class Domain { unit, unit_or_zero, share, positive, any };
enum class MadeBy { both, forward_only, deferred_only, paths_only };

// How a channel is shown as an image; by_metric: by its kind and metric.
enum class Shown { by_metric, radiance, display, normalised };

struct DebugMode {
    int number;
    std::string_view name;
    int width;  // number of components
    Metric metric;
    ChannelKind kind;
    Domain domain;
    MadeBy maker;
    std::string_view shows;
    Shown shown = Shown::by_metric;
};

std::span<const DebugMode> debugModes();                        // in ascending order of number
const DebugMode* findDebugMode(std::string_view nameOrNumber);  // nullptr: unknown
const DebugMode& debugMode(int number);                         // throws std::out_of_range
std::string_view nameOf(Metric metric);

// Channels of lighting: those that depend on the surface and on the light it receives.
inline constexpr std::array litModes{static_cast<int>(gpu::DEBUG_lit),
                                     static_cast<int>(gpu::DEBUG_lit_diffuse),
                                     static_cast<int>(gpu::DEBUG_lit_specular),
                                     static_cast<int>(gpu::DEBUG_lit_ambient),
                                     static_cast<int>(gpu::DEBUG_lit_environment),
                                     static_cast<int>(gpu::DEBUG_lit_clearcoat),
                                     static_cast<int>(gpu::DEBUG_lit_sheen)};
constexpr bool isLit(int mode) {
    return std::ranges::find(litModes, mode) != litModes.end();
}

// Channels of the medium between surface and camera; they depend on the position alone.
constexpr bool isOfHaze(int mode) {
    return mode == static_cast<int>(gpu::DEBUG_lit_haze) ||
           mode == static_cast<int>(gpu::DEBUG_transmittance);
}

// Channels that shading computes: all of the above, and light visibility.
constexpr bool isShaded(int mode) {
    return isLit(mode) || isOfHaze(mode) || mode == static_cast<int>(gpu::DEBUG_shadow_visibility) ||
           mode == static_cast<int>(gpu::DEBUG_local_visibility);
}

// LAYER_* of contract/material.h without which the channel is 0 everywhere; 0: none.
constexpr gpu::uint layerOf(int mode) {
    if (mode == static_cast<int>(gpu::DEBUG_lit_clearcoat)) return gpu::LAYER_CLEARCOAT;
    if (mode >= static_cast<int>(gpu::DEBUG_clearcoat) &&
        mode <= static_cast<int>(gpu::DEBUG_clearcoat_normal))
        return gpu::LAYER_CLEARCOAT;
    if (mode == static_cast<int>(gpu::DEBUG_anisotropy) ||
        mode == static_cast<int>(gpu::DEBUG_anisotropy_direction))
        return gpu::LAYER_ANISOTROPY;
    if (mode == static_cast<int>(gpu::DEBUG_lit_sheen) || mode == static_cast<int>(gpu::DEBUG_sheen_color) ||
        mode == static_cast<int>(gpu::DEBUG_sheen_roughness))
        return gpu::LAYER_SHEEN;
    if (mode >= static_cast<int>(gpu::DEBUG_iridescence) &&
        mode <= static_cast<int>(gpu::DEBUG_iridescence_thickness))
        return gpu::LAYER_IRIDESCENCE;
    return 0;
}

// 0 in a scene without ambient light and lightmaps.
constexpr bool isAmbient(int mode) {
    return mode == static_cast<int>(gpu::DEBUG_lit_ambient);
}

// 0 without an environment. Neither this nor ambient light includes shadow-casting lights.
constexpr bool isOfEnvironment(int mode) {
    return mode == static_cast<int>(gpu::DEBUG_lit_environment);
}

// EXR channel names: R, G, B for lit, Z for depth, and for example "albedo.R", "normals.X", "roughness.Y".
std::vector<std::string> exrChannels(const DebugMode& mode);

}  // namespace diptych
