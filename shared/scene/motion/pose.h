// SPDX-License-Identifier: MIT
// A scene at one time: where the node tree, animations, skins and morph targets put its instances, lights and
// cameras.
#pragma once

#include "shared/scene/model/scene.h"

#include <glm/glm.hpp>

#include <vector>

namespace diptych {

// A mesh's primitive where the node tree puts it. Where joints or morph targets move its vertices, posed.h
// has them; world_from_object is then where it stands undeformed: where its skin's first joint puts it.
struct Instance {
    int mesh = 0, primitive = 0, node = 0;
    glm::dmat4 world_from_object{1.0};
    int skin = -1;     // into Pose::skins
    int weights = -1;  // into Pose::weights; -1: no target adds anything
    bool deformed() const { return skin >= 0 || weights >= 0; }
};

// The scene at one time: everything in world space.
struct Pose {
    std::vector<Instance> instances;  // in node order, primitives in order
    std::vector<Light> lights;        // node = -1, world position and direction, directional ones first
    std::vector<Camera> cameras;      // node = -1
    double seconds = 0;
    std::vector<std::vector<glm::dmat4>> skins;  // as Scene::skins: world from mesh, by each joint
    std::vector<std::vector<double>> weights;    // of morph targets, not all 0
};

// Animations play from 0 s on, as animation.h says. What has no place (a transform that is not finite or
// reaches beyond maxCoordinate) is not in the pose.
Pose poseAt(const Scene& scene, double seconds);

// What is beyond maxCoordinate at rest is taken from its node, lights and cameras from the scene, with a
// note.
void leaveOutWhatIsBeyond(Scene& scene);

}  // namespace diptych
