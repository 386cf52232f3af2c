// SPDX-License-Identifier: MIT
// Evaluates a scene at one time: world transforms of instances, lights and cameras under the node tree,
// animations, skins and morph targets.
#pragma once

#include "shared/scene/motion/instances.h"

#include <string>

namespace diptych {

// Plays all animations from 0 s on, or the one whose index or name is `animation`. Throws
// std::runtime_error that lists the animations if there is no such one. Omits instances (with a note), lights
// and cameras whose transform is not finite or exceeds maxCoordinate.
Pose poseAt(const Scene& scene, double seconds, const std::string& animation = {});

// Whether any node has something to draw.
bool hasTriangles(const Scene& scene);

// Whether any triangle at rest has an area in the world. Every animated or deformed one counts as having it.
bool hasArea(const Scene& scene);

// Removes everything beyond maxCoordinate at rest (meshes from their nodes, lights, cameras), each with a
// note. Throws std::runtime_error if that leaves nothing to draw.
void leaveOutWhatIsBeyond(Scene& scene);

}  // namespace diptych
