// SPDX-License-Identifier: MIT
// The contents of a scene at one time: world transforms of instances, lights and cameras.
#pragma once

#include "shared/scene/model/scene.h"

#include <glm/glm.hpp>

#include <cmath>
#include <string>
#include <vector>

namespace diptych {

// A primitive of a mesh, placed by the node tree. If it is deformed or its tangents are recomputed,
// posed.h computes its vertices. world_from_object is then the transform of the undeformed primitive by
// the skin's joint with the largest total weight.
struct Instance {
    int mesh = 0, primitive = 0, node = 0;
    int copy = 0;  // into its Scene::copies[...]; 0 without instancing
    glm::dmat4 world_from_object{1.0};
    int skin = -1;             // into Pose::skins
    int weights = -1;          // into Pose::weights; -1: no morph target applies
    int box = -1;              // into Pose::boxes, for deformed instances
    bool map_rotated = false;  // tangents are recomputed because an animation rotated their map
    bool deformed() const { return skin >= 0 || weights >= 0 || map_rotated; }
    bool operator==(const Instance&) const = default;
};

// World units per unit of the mesh, by which its nodes scale a volume's thickness: the cube root of their
// |determinant|. 1 for a skinned mesh, whose joints place its vertices.
inline double lengthScale(const Instance& instance) {
    return instance.skin >= 0 ? 1
                              : std::cbrt(std::abs(glm::determinant(glm::dmat3(instance.world_from_object))));
}

// Bounds and storage of a deformed instance's vertices.
struct PosedBox {
    glm::dvec3 origin{0};            // world, m; vertices are stored relative to it, so float32 suffices
    glm::dvec3 min{0}, max{0};       // world axes, relative to origin, m; contains all posed vertices
    std::uint64_t first_vertex = 0;  // index among those of all deformed instances
    bool operator==(const PosedBox&) const = default;
};

// The scene at one time, in world space.
struct Pose {
    std::vector<Instance> instances;  // ordered by node, primitive, copy
    std::vector<Light> lights;        // node = -1, world position and direction; directional lights first
    std::vector<Camera> cameras;      // node = -1
    double seconds = 0;
    std::string animation = {};                  // as requested; empty: all play
    std::vector<std::vector<glm::dmat4>> skins;  // as Scene::skins; world from mesh, by joint
    std::vector<std::vector<double>> weights;    // of morph targets; entries of only zeros are omitted
    std::vector<PosedBox> boxes;                 // for deformed instances
    std::vector<Material> materials;             // as Scene::materials; empty if not animated
    std::vector<std::string> notes{};            // a line for users on omitted instances
};

inline const Primitive& primitiveOf(const Scene& scene, const Instance& instance) {
    return scene.meshes[static_cast<std::size_t>(instance.mesh)]
        .primitives[static_cast<std::size_t>(instance.primitive)];
}

// The scene's materials at the pose's time.
inline const std::vector<Material>& materialsOf(const Scene& scene, const Pose& pose) {
    return pose.materials.empty() ? scene.materials : pose.materials;
}

}  // namespace diptych
