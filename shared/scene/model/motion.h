// SPDX-License-Identifier: MIT
// How a scene's nodes and vertices move, as glTF 2.0 says it (3.7.2.2, 3.7.3, 3.11): keyframes, skins and
// morph targets. Everything here has been checked when a scene has been loaded: indices lead somewhere,
// numbers are finite, arrays are as long as each other asks.
#pragma once

#include <glm/ext/quaternion_double.hpp>
#include <glm/ext/vector_uint4_sized.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace diptych {

// A node's transform in the parts that keyframes replace: scale first, then rotation, then translation.
struct Transform {
    glm::dvec3 translation{0, 0, 0};
    glm::dquat rotation{1, 0, 0, 0};  // w, x, y, z; unit
    glm::dvec3 scale{1, 1, 1};
};

// Four more joints of every vertex. A vertex's weights are >= 0 and add up to 1 over all of its sets; a
// joint of weight 0 is joint 0.
struct JointSet {
    std::vector<glm::u16vec4> joints;  // into Skin::joints, of every skin that the mesh is drawn with
    std::vector<glm::vec4> weights;
};

// What a target adds to a vertex at weight 1. Each array is empty (adds nothing) or as long as positions.
struct MorphTarget {
    std::vector<glm::vec3> positions;  // object, m
    std::vector<glm::vec3> normals;
    std::vector<glm::vec3> tangents;  // the sign of the bitangent stays
};

// A vertex of a skinned mesh stands at the sum over its joints of
// weight * worldFromNode[joints[j]] * joint_from_mesh[j] * position: its own node's transform counts nothing.
struct Skin {
    std::string name;
    std::vector<int> joints;                 // into Scene::nodes; at least one
    std::vector<glm::mat4> joint_from_mesh;  // the inverse bind matrices; as many as joints, affine
    int skeleton = -1;                       // into Scene::nodes; -1: the file names none
};

enum class Interpolation { step, linear, cubic_spline };
enum class AnimatedPart { translation, rotation, scale, weights };

// Keyframes that channels share. A key has `width` values: 3 of a translation (m) or a scale, 4 of a
// rotation (x, y, z, w: unit, but of a cubic spline as the file gives them), one a morph target of weights.
// A cubic spline has in-tangent, value and out-tangent a key, in this order.
struct Keyframes {
    Interpolation interpolation = Interpolation::linear;
    std::vector<float> times;   // s, >= 0, strictly increasing; at least one
    std::vector<float> values;  // times.size() * width * (cubic_spline ? 3 : 1)
    std::size_t width = 0;
};

struct AnimationChannel {
    int node = -1;       // into Scene::nodes; it has a transform, or a mesh with targets
    int keyframes = -1;  // into Animation::keyframes
    AnimatedPart part = AnimatedPart::translation;
};

struct Animation {
    std::string name;
    std::vector<Keyframes> keyframes;
    std::vector<AnimationChannel> channels;  // no two move the same part of a node
};

}  // namespace diptych
