// SPDX-License-Identifier: MIT
// Keyframe interpolation, in double (glTF 2.0, 3.11 and appendix C).
#pragma once

#include "shared/scene/model/scene.h"

#include <map>
#include <span>
#include <string>
#include <vector>

namespace diptych {

// The `keyframes.width` values at `seconds`: before the first key those of the first, after the last those
// of the last. A rotation (x, y, z, w) is unit; interpolation takes the shorter way round.
std::vector<double> sampled(const Keyframes& keyframes, AnimatedPart part, double seconds);

// The animations that play: all of the scene's, or the one whose index or (the first) whose name `choice` is.
// Throws std::runtime_error naming --animation, and the animations there are, if that is none.
std::span<const Animation> animationsOf(const Scene& scene, const std::string& choice);

// The nodes' transforms and weights under animationsOf(scene, choice). They play at once; where two move the
// same part of a node, the later one applies.
struct NodeMotion {
    std::vector<glm::dmat4> parent_from_node;  // of every node, animated or not
    std::map<int, std::vector<double>>
        weights;  // by node: weights of the morph targets, for nodes whose weights an animation moves
    std::map<int, std::vector<double>> mesh_weights;  // by mesh, likewise
};
NodeMotion motionAt(const Scene& scene, double seconds, const std::string& choice = {});

}  // namespace diptych
