// SPDX-License-Identifier: MIT
// What a scene needs modelled; whatever is false here costs nothing in either path.
#pragma once

#include "shared/scene/model/scene.h"
#include "shared/scene/motion/pose.h"

#include <cstdint>
#include <string>
#include <vector>

namespace diptych {

// Over the materials that a drawn triangle uses, unless said otherwise.
struct Requirements {
    bool normal_maps = false, alpha_mask = false, alpha_blend = false, double_sided = false;
    bool vertex_colors = false, second_texcoord = false, texture_transform = false;
    bool occlusion = false;            // an occlusion texture of non-zero strength
    bool unlit = false;                // KHR_materials_unlit: emits its base colour
    bool emission = false;             // of unlit materials too
    bool lightmap = false;             // a lightmap of non-zero intensity
    float max_lightmap = 0;            // the largest component of any, W/(sr m^2)
    bool dielectric_specular = false;  // KHR_materials_specular or _ior differs from its default, or unlit
    float max_emission = 0;       // largest component over all factors (textures only darken), W/(sr m^2)
    float min_emission = 0;       // smallest non-zero largest-component of a factor
    std::uint32_t materials = 0;  // all of the scene's, used or not: ids run below this
    std::uint32_t textures = 0;   // that the used materials read
    std::uint32_t directional_lights = 0, point_lights = 0, spot_lights = 0;
    std::uint32_t rect_lights = 0, disc_lights = 0, tube_lights = 0;
    std::uint32_t sun_discs = 0;             // directional lights with an angle
    std::string environment;                 // its name; empty: none
    std::uint32_t skinned = 0, morphed = 0;  // nodes whose vertices that moves
    std::uint32_t animations = 0;
    std::uint64_t draws = 0, triangles = 0, vertices = 0;  // as instanced

    std::uint32_t areaLights() const { return rect_lights + disc_lights + tube_lights; }
    std::uint32_t lights() const { return directional_lights + point_lights + spot_lights + areaLights(); }
    std::string areaLightsInWords() const;  // "2 area lights (1 rect, 1 tube)"
    std::string deformedInWords() const;    // "1 skinned mesh, 2 morphed"; empty: none

    // For people: what is modelled and for what, what is left out and why.
    struct Line {
        bool modelled;
        std::string what, why;
    };
    std::vector<Line> lines() const;
};

// `lights` are all that the scene is lit by; without them the pose's own.
Requirements requirements(const Scene& scene, const Pose& pose, const std::vector<Light>& lights);
inline Requirements requirements(const Scene& scene, const Pose& pose) {
    return requirements(scene, pose, pose.lights);
}

}  // namespace diptych
