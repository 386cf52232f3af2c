// SPDX-License-Identifier: MIT
// Channels (debug modes) of shared/contract/debug_mode.h as C++ data.
#pragma once

#include "shared/contract/material.h"
#include "shared/frame/channel.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace diptych {

enum class ErrorKind { relative, absolute, angular, axial, exact };
constexpr bool isAngle(ErrorKind errorKind) {  // in degrees
    return errorKind == ErrorKind::angular || errorKind == ErrorKind::axial;
}
enum class ChannelKind { color, vector, scalar, id };
// Valid range of the values: unit vectors, these or 0, 0 to 1, 0 or more, or any.
enum class Domain { unit, unit_or_zero, ratio, positive, any };
enum class SupportedBy { both, forward_only, deferred_only, paths_only };
// Columns of DEBUG_MODES, which explains their values.
enum class ChannelStage { id, position, facet, surface, list, map, visibility, light, unshadowed, haze };
enum class FieldCode { exact, unorm, root, octahedral, line, radiance, index, half };
enum class MaterialPart {
    none,
    emission,
    lightmap,
    dielectric,
    clearcoat,
    anisotropy,
    sheen,
    iridescence,
    transmission,
    diffuse_transmission,
    transmitted,  // either of these two
};
enum class TexelUse { none, number, color, scaled_color, thickness, length, direction, line };

// How packed G-buffers store a channel; bits of each component.
struct ChannelCode {
    FieldCode code = FieldCode::exact;
    unsigned standard = 0, compact = 0;
};

// How a channel is shown as an image; by_metric: by its kind and error kind.
enum class ShownAs { by_metric, radiance, display, normalised };

struct DebugMode {
    Channel channel;
    std::string_view name;
    int width;  // number of components
    ErrorKind error_kind;
    ChannelKind kind;
    Domain domain;
    SupportedBy supported_by;
    std::string_view shows;
    int step = 0;  // ascends in the order of computation
    ChannelCode stored{};
    TexelUse texels = TexelUse::none;
    int related = 0;  // index among the channels that relations compare; 0: none
    ShownAs shown = ShownAs::by_metric;
};

std::span<const DebugMode> debugModes();                       // in ascending order of index
const DebugMode* findDebugMode(std::string_view nameOrIndex);  // nullptr: unknown
const DebugMode& debugMode(Channel channel);                   // throws std::out_of_range
std::string_view nameOf(ErrorKind errorKind);

// The stage that makes a channel, and the part of a material without which it is not stored.
#define DIPTYCH_DEBUG_PROPERTY(number, name, width, errorKind, kind, domain, supported_by, shows, stage, \
                               step, code, standard, compact, part, texels, related)                     \
    case Channel::name:                                                                                  \
        return {ChannelStage::stage, MaterialPart::part};
struct ChannelSource {
    ChannelStage stage = ChannelStage::surface;
    MaterialPart part = MaterialPart::none;
};
constexpr ChannelSource sourceOf(Channel channel) {
    switch (channel) { DEBUG_MODES(DIPTYCH_DEBUG_PROPERTY) }
    return {};
}
#undef DIPTYCH_DEBUG_PROPERTY

// Channels of lighting: those that depend on the surface and on the light it receives.
constexpr bool isLit(Channel mode) {
    const ChannelStage stage = sourceOf(mode).stage;
    return stage == ChannelStage::light || stage == ChannelStage::unshadowed;
}

// Channels of the medium between surface and camera; they depend on the position alone.
constexpr bool isOfHaze(Channel mode) {
    return sourceOf(mode).stage == ChannelStage::haze;
}

// Channels that shading computes: all of the above, and light visibility.
constexpr bool isShaded(Channel mode) {
    return isLit(mode) || isOfHaze(mode) || sourceOf(mode).stage == ChannelStage::visibility;
}

// Every channel, and those for which isLit(), in ascending order of index.
#define DIPTYCH_DEBUG_LISTED(number, name, width, errorKind, kind, domain, supported_by, shows, stage, step, \
                             code, standard, compact, part, texels, related)                                 \
    Channel::name,
inline constexpr std::array allChannels{DEBUG_MODES(DIPTYCH_DEBUG_LISTED)};
#undef DIPTYCH_DEBUG_LISTED
inline constexpr auto litModes = [] {
    std::array<Channel, std::ranges::count_if(allChannels, isLit)> lit{};
    std::ranges::copy_if(allChannels, lit.begin(), isLit);
    return lit;
}();

// A sum of LAYER_* of contract/material.h, without all of which the channel is 0 everywhere; 0: none.
constexpr gpu::uint layerOf(Channel mode) {
    switch (sourceOf(mode).part) {
        case MaterialPart::clearcoat:
            return gpu::LAYER_CLEARCOAT;
        case MaterialPart::anisotropy:
            return gpu::LAYER_ANISOTROPY;
        case MaterialPart::sheen:
            return gpu::LAYER_SHEEN;
        case MaterialPart::iridescence:
            return gpu::LAYER_IRIDESCENCE;
        case MaterialPart::transmission:
            return gpu::LAYER_TRANSMISSION;
        case MaterialPart::diffuse_transmission:
            return gpu::LAYER_DIFFUSE_TRANSMISSION;
        case MaterialPart::transmitted:
            return gpu::LAYER_TRANSMISSION | gpu::LAYER_DIFFUSE_TRANSMISSION;
        default:
            return 0;
    }
}

// Whether a channel may differ from 0 if the scene's materials have these layers.
constexpr bool mayShow(Channel mode, gpu::uint layers) {
    return layerOf(mode) == 0 || (layerOf(mode) & layers) != 0;
}

// EXR channel names: R, G, B for lit, Z for depth, and for example "albedo.R", "normals.X", "roughness.Y".
std::vector<std::string> exrChannels(const DebugMode& mode);

}  // namespace diptych
