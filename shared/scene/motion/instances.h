// SPDX-License-Identifier: MIT
// What a scene consists of at one time: world transforms of instances, lights and cameras.
#pragma once

#include "shared/scene/model/scene.h"

#include <glm/glm.hpp>

#include <string>
#include <vector>

namespace diptych {

// A primitive of a mesh, placed by the node tree. If joints or morph targets move its vertices, or its
// tangents are made anew, posed.h computes them; world_from_object is then the transform of the undeformed
// primitive: that of the joint of its skin that moves most of it.
struct Instance {
    int mesh = 0, primitive = 0, node = 0;
    int copy = 0;  // of its node's: into Scene::copies[...]; 0 where the mesh is drawn once
    glm::dmat4 world_from_object{1.0};
    int skin = -1;            // into Pose::skins
    int weights = -1;         // into Pose::weights; -1: no morph target applies
    int box = -1;             // into Pose::boxes; of deformed ones
    bool map_turned = false;  // tangents are made anew for a normal map that an animation has turned
    bool deformed() const { return skin >= 0 || weights >= 0 || map_turned; }
    bool operator==(const Instance&) const = default;
};

// Where the vertices of a deformed instance are.
struct PosedBox {
    glm::dvec3 origin{0};       // world, m; posed vertices are stored from here, so that float32 suffices
    glm::dvec3 min{0}, max{0};  // world axes from the origin, m: no posed vertex lies outside
    std::uint64_t first_vertex = 0;  // among those of all deformed instances
    bool operator==(const PosedBox&) const = default;
};

// The scene at one time, in world space.
struct Pose {
    std::vector<Instance> instances;  // in node order, primitives in order, copies in order
    std::vector<Light> lights;        // node = -1, world position and direction; directional lights first
    std::vector<Camera> cameras;      // node = -1
    double seconds = 0;
    std::string animation = {};                  // the one that plays, as it was asked for; empty: all
    std::vector<std::vector<glm::dmat4>> skins;  // as Scene::skins; for each joint the matrix world from mesh
    std::vector<std::vector<double>> weights;    // of morph targets; entries that are all 0 are left out
    std::vector<PosedBox> boxes;                 // of deformed instances
    std::vector<Material> materials;             // as Scene::materials; empty: no animation moves any
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
