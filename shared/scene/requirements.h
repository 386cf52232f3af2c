// SPDX-License-Identifier: MIT
// The features that a scene needs rendered. A feature that is false here costs nothing in either path.
#pragma once

#include "shared/scene/model/scene.h"
#include "shared/scene/motion/pose.h"

#include <cstdint>
#include <string>
#include <vector>

namespace diptych {

// Taken over the materials that a drawn triangle uses, unless stated otherwise.
struct Requirements {
    bool normal_maps = false, alpha_mask = false, alpha_blend = false, double_sided = false;
    bool vertex_colors = false, second_texcoord = false, texture_transform = false;
    bool occlusion = false;            // an occlusion texture of non-zero strength
    bool unlit = false;                // KHR_materials_unlit: the surface emits its base colour
    bool emission = false;             // of unlit materials too
    bool lightmap = false;             // a lightmap of non-zero intensity
    float max_lightmap = 0;            // the largest component of any lightmap, W/(sr m^2)
    bool dielectric_specular = false;  // KHR_materials_specular or _ior differs from its default, or unlit
    float max_emission = 0;  // largest component of any emissive factor (textures only darken it), W/(sr m^2)
    float min_emission = 0;  // smallest of the non-zero factors' largest components, W/(sr m^2)
    std::uint32_t materials = 0;  // all of the scene's, used or not: material ids are below this
    std::uint32_t textures = 0;   // those that the used materials read
    std::uint32_t directional_lights = 0, point_lights = 0, spot_lights = 0;
    std::uint32_t rect_lights = 0, disc_lights = 0, tube_lights = 0;
    std::uint32_t sun_discs = 0;                           // directional lights with an angle
    std::string environment;                               // the environment's name; empty: there is none
    std::uint32_t skinned = 0, morphed = 0;                // nodes whose vertices skins or morph targets move
    std::uint64_t deformed_vertices = 0;                   // of these; counted once for each instance
    std::uint64_t joints = 0;                              // of the skins that move them
    std::uint32_t animations = 0;                          // that play
    std::uint64_t draws = 0, triangles = 0, vertices = 0;  // counted once for each instance

    std::uint32_t areaLights() const { return rect_lights + disc_lights + tube_lights; }
    std::uint32_t lights() const { return directional_lights + point_lights + spot_lights + areaLights(); }
    std::string areaLightsInWords() const;  // "2 area lights (1 rect, 1 tube)"
    std::string deformedInWords()
        const;  // "1 skinned mesh, 2 morphed: 96 vertices by 5 joints"; empty if there are none

    // Lines of text for users: what is rendered and for what reason, what is left out and why.
    struct Line {
        bool modelled;
        std::string what, why;
    };
    std::vector<Line> lines() const;
};

// `lights` are all lights of the picture; without that argument, the pose's own.
Requirements requirements(const Scene& scene, const Pose& pose, const std::vector<Light>& lights);
inline Requirements requirements(const Scene& scene, const Pose& pose) {
    return requirements(scene, pose, pose.lights);
}

}  // namespace diptych
