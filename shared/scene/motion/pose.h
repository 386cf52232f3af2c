// SPDX-License-Identifier: MIT
// A scene at one time: the world transforms of instances, lights and cameras under the node tree,
// animations, skins and morph targets.
#pragma once

#include "shared/scene/motion/instances.h"

#include <string>

namespace diptych {

// Animations play from 0 s on, as described in animation.h: all of the scene's, or the one that `animation`
// names, by its index or its name; std::runtime_error says which there are where it names none. Instances,
// lights and cameras whose transform is not finite or reaches beyond maxCoordinate are left out.
Pose poseAt(const Scene& scene, double seconds, const std::string& animation = {});

// Removes from the scene what is beyond maxCoordinate at rest (meshes from their nodes, lights and cameras),
// each with a note.
void leaveOutWhatIsBeyond(Scene& scene);

}  // namespace diptych
