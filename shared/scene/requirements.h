// SPDX-License-Identifier: MIT
// The features that a scene needs. A feature that is false costs nothing in either path.
#pragma once

#include "shared/scene/model/scene.h"
#include "shared/scene/motion/pose.h"

#include <array>
#include <cstdint>
#include <numeric>
#include <string>
#include <vector>

namespace diptych {

// Covers the materials of drawn triangles, unless stated otherwise.
struct Requirements {
    bool normal_maps = false, alpha_mask = false, alpha_blend = false, double_sided = false;
    bool vertex_colors = false, second_texcoord = false, texture_transform = false;
    bool occlusion = false;            // an occlusion texture of non-zero strength
    bool unlit = false;                // KHR_materials_unlit: the surface emits its base colour
    bool emission = false;             // includes unlit materials
    std::uint32_t layers = 0;          // a sum of LAYER_* of contract/material.h
    std::uint32_t surface_layers = 0;  // layers of opaque surfaces, which a G-buffer stores
    bool volume = false;               // KHR_materials_volume: glass has a thickness
    bool dispersion = false;           // KHR_materials_dispersion, of a volume
    bool rough_glass = false;          // glass has a roughness above 0
    // Largest difference between the thicknesses of a film among which a texture chooses, nm.
    float film_thickness_range = 0;
    // Largest thickness of a volume that a texture scales, m, world.
    float volume_thickness_range = 0;
    bool lightmap = false;   // a lightmap of non-zero intensity
    float max_lightmap = 0;  // the largest component of any lightmap, W/(sr m^2)
    // KHR_materials_specular or _ior differs from its default, specular-glossiness, or unlit.
    bool dielectric_specular = false;
    bool specular_glossiness = false;  // KHR_materials_pbrSpecularGlossiness
    // Largest component of any emissive factor, W/(sr m^2); textures only darken it.
    float max_emission = 0;
    float min_emission = 0;       // smallest of the non-zero factors' largest components, W/(sr m^2)
    std::uint32_t materials = 0;  // all of the scene's, used or not; bounds material ids
    std::uint32_t textures = 0;   // textures of used materials
    std::array<std::uint32_t, indexOf(areaKinds.back()) + 1> light_counts{};  // by LightKind
    std::uint32_t sun_discs = 0;                           // directional lights with an angular diameter
    std::string environment;                               // name; empty: none
    std::uint32_t skinned = 0, morphed = 0;                // nodes
    std::uint64_t deformed_vertices = 0;                   // of skinned and morphed nodes, per instance
    std::uint64_t joints = 0;                              // of the skins of drawn meshes
    std::uint32_t animations = 0;                          // playing
    std::uint64_t draws = 0, triangles = 0, vertices = 0;  // per instance

    std::uint32_t lights(LightKind kind) const { return light_counts[indexOf(kind)]; }
    std::uint32_t lights() const { return std::reduce(light_counts.begin(), light_counts.end()); }
    std::uint32_t areaLights() const {
        return std::reduce(light_counts.begin() + indexOf(areaKinds.front()), light_counts.end());
    }
    std::string areaLightsText() const;  // "2 area lights (1 rect, 1 tube)"
    // "1 skinned mesh, 2 morphed: 96 vertices by 5 joints"; empty if nothing is deformed
    std::string deformedText() const;

    // Lines for users: which features are rendered or omitted, and why.
    struct Line {
        bool modelled;
        std::string what, why;
    };
    std::vector<Line> lines() const;

private:
    void addMaterialLines(std::vector<Line>& lines) const;
    void addLayerLines(std::vector<Line>& lines) const;
    void addMotionAndLightLines(std::vector<Line>& lines) const;
};

// `lights` are all lights of the view; without that argument, only the pose's.
Requirements requirements(const Scene& scene, const Pose& pose, const std::vector<Light>& lights);
inline Requirements requirements(const Scene& scene, const Pose& pose) {
    return requirements(scene, pose, pose.lights);
}

}  // namespace diptych
