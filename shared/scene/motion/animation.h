// SPDX-License-Identifier: MIT
// Keyframe interpolation, in double (glTF 2.0, 3.11 and appendix C).
#pragma once

#include "shared/scene/model/scene.h"

#include <map>
#include <span>
#include <string>
#include <vector>

namespace diptych {

// translation * rotation * scale
glm::dmat4 matrixOf(const Transform& transform);

// Evaluates `keyframes.width` values at `seconds`, clamped to the first and last key. A rotation (x, y, z,
// w) has unit length; interpolation takes the shorter way.
std::vector<double> sampled(const Keyframes& keyframes, AnimatedPart part, double seconds);

// The playing animations: all of the scene's, or the one whose index or name is `choice`. Throws
// std::runtime_error that names --animation and lists the animations if there is no such one, or several.
std::span<const Animation> animationsOf(const Scene& scene, const std::string& choice);

// Node transforms and weights under animationsOf(scene, choice). All play at once; if several target the
// same property, the last one wins.
struct NodeMotion {
    std::vector<glm::dmat4> parent_from_node;  // of every node, animated or not
    // Morph target weights by node, for nodes whose weights are animated.
    std::map<int, std::vector<double>> weights;
    std::map<int, std::vector<double>> mesh_weights;  // by mesh, likewise
};
NodeMotion motionAt(const Scene& scene, double seconds, const std::string& choice = {});

}  // namespace diptych
