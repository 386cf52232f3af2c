// SPDX-License-Identifier: MIT
// Keyframes at a time, in double (glTF 2.0, 3.11 and appendix C).
#pragma once

#include "shared/scene/model/scene.h"

#include <map>
#include <vector>

namespace diptych {

// `keyframes.width` values at `seconds`; before the first key those of the first, after the last those of the
// last. A rotation (x, y, z, w) is unit and takes the shorter way round.
std::vector<double> sampled(const Keyframes& keyframes, AnimatedPart part, double seconds);

// What the scene's animations make of its nodes. All of them play at once; where two move the same part of a
// node, the later one has it.
struct NodeMotion {
    std::vector<glm::dmat4> parent_from_node;  // of every node, moved or not
    std::map<int, std::vector<double>>
        weights;  // by node: of the morph targets, where an animation moves them
};
NodeMotion motionAt(const Scene& scene, double seconds);

}  // namespace diptych
