// SPDX-License-Identifier: MIT
// Detects how another renderer interprets its inputs. Renders charts with known radiance
// (builtin:calibration) without light, under one lamp of each type, and under an environment.
#pragma once

#include "compare/external/renderer_file.h"
#include "shared/frame/settings.h"
#include "shared/image/image.h"
#include "shared/scene/model/scene.h"

#include <nlohmann/json.hpp>

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace diptych::external {

// The light source of one calibration image.
enum class Lamp { none, directional, point, spot, area, environment };
inline constexpr Lamp lamps[] = {Lamp::none, Lamp::directional, Lamp::point,
                                 Lamp::spot, Lamp::area,        Lamp::environment};
std::string_view nameOf(Lamp lamp);  // "no light", "directional", ...

// The charts with this lamp only.
Scene chartsUnder(const Scene& charts, Lamp lamp);
// 384x216, without shadows.
Settings chartSettings(Lamp lamp);

// Expected lit and material_id, by the reference. lit excludes the environment's light.
struct ChartReference {
    Image lit, ids;
};
ChartReference referenceUnder(const Scene& charts, Lamp lamp);

// An image of the charts, or the reason for its absence.
struct LampFrame {
    Lamp lamp = Lamp::none;
    ChartReference truth;
    Image image;  // empty: missing
    std::string problem{};
};

// One deviation from the requested inputs. `name`, by the chart that shows it:
//   centroids of eight marks  upside_down, mirrored, fov, aspect, shift, unrecognised
//   a ramp of emitters        srgb_output, tone_curve, cut_off, exposure, primaries
//   textured charts           colour_textures_linear, colour_textures_twice, data_textures_srgb
//   a white face per light    light_factor, point_factor, ..., no_point_lights, ...
//   five faces                environment_rotation, environment_mirrored, ldr_environment,
//                             environment_factor, no_environment
// `correction`: members of "granted" that correct it; empty if nothing does.
struct Deviation {
    std::string name, text;
    nlohmann::ordered_json correction = nlohmann::ordered_json::object();
};

// `images`: one per lamp, Lamp::none required. Detects deviations above 0.15 degrees of field of view,
// 0.2 pixels of position and 12 % of intensity. Empty if there are none. Throws std::invalid_argument
// without the image for Lamp::none.
std::vector<Deviation> deviationsOf(const Scene& charts, std::span<const LampFrame> images);

// The result, for a terminal and for scripts.
std::string describe(const ExternalRenderer& renderer, std::span<const Deviation> deviations);
nlohmann::ordered_json toJson(const ExternalRenderer& renderer, std::span<const Deviation> deviations);

}  // namespace diptych::external
