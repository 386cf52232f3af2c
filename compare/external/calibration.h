// SPDX-License-Identifier: MIT
// How a renderer of others means what it is told: what it shows of charts (builtin:calibration) whose answer
// is known, under no lamp, under one of each kind, and under a sky.
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

// What lights the charts in one picture.
enum class Lamp { none, directional, point, spot, area, environment };
inline constexpr Lamp lamps[] = {Lamp::none, Lamp::directional, Lamp::point,
                                 Lamp::spot, Lamp::area,        Lamp::environment};
std::string_view nameOf(Lamp lamp);  // "no light", "directional", ...

// The charts with that lamp alone.
Scene chartsUnder(const Scene& charts, Lamp lamp);
// Of all these pictures: 384x216, without shadows.
Settings chartSettings(Lamp lamp);

// The charts as they must be shown: lit, and material_id; by the reference. Under a sky lit is without it.
struct ChartTruth {
    Image lit, ids;
};
ChartTruth truthUnder(const Scene& charts, Lamp lamp);

// A picture of the charts, or why there is none.
struct Shown {
    Lamp lamp = Lamp::none;
    ChartTruth truth;
    Image picture;  // empty: there is none
    std::string problem{};
};

// One way in which a renderer does not mean what it is told. `name`, by where it shows:
//   centroids of eight marks  upside_down, mirrored, fov, aspect, shift, unrecognised
//   a ramp of emitters        srgb_output, tone_curve, cut_off, exposure, primaries
//   textured charts           colour_textures_linear, colour_textures_twice, data_textures_srgb
//   a white face per light    light_factor, point_factor, ..., no_point_lights, ...
//   five faces                environment_rotation, environment_mirrored, ldr_environment,
//                             environment_factor, no_environment
// `grant`: what of "granted" in its file would make up for it, empty where nothing does.
struct Deviation {
    std::string name, words;
    nlohmann::ordered_json grant = nlohmann::ordered_json::object();
};

// Of pictures under every lamp, Lamp::none first. Nothing: it means what it is told, as far as the charts
// show: a field of view to 0.15 degrees, places to 0.2 pixels, intensities to 12 %.
std::vector<Deviation> deviationsOf(const Scene& charts, std::span<const Shown> pictures);

}  // namespace diptych::external
