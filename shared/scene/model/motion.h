// SPDX-License-Identifier: MIT
// Animation data as in glTF 2.0 (3.7.2.2, 3.7.3, 3.11): keyframes, skins and morph targets. The loader has
// validated all of it: indices are valid, numbers finite, and array lengths agree.
#pragma once

#include "shared/contract/material.h"

#include <glm/ext/quaternion_double.hpp>
#include <glm/ext/vector_uint4_sized.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace diptych {

// A node's transform in the parts that animations replace; applied in the order scale, rotation,
// translation.
struct Transform {
    glm::dvec3 translation{0, 0, 0};
    glm::dquat rotation{1, 0, 0, 0};  // w, x, y, z; unit
    glm::dvec3 scale{1, 1, 1};
};

// Four more joints for every vertex. A vertex's weights are >= 0 and add up to 1 over all of its sets. An
// entry of weight 0 has joint 0.
struct JointSet {
    std::vector<glm::u16vec4> joints;  // into Skin::joints; valid for every skin that a mesh is drawn with
    std::vector<glm::vec4> weights;
};

// Offsets that a target of weight 1 adds to the vertices. Each array is empty (no offset) or as long as
// positions.
struct MorphTarget {
    std::vector<glm::vec3> positions;  // object, m
    std::vector<glm::vec3> normals;
    std::vector<glm::vec3> tangents;  // the bitangent's sign is not morphed
    std::vector<glm::vec2> texcoords[2]{};
    std::vector<glm::vec4> colors{};  // a morphed colour is clamped to 0..1
};

// Corners of triangles that share a tangent, for primitives whose tangents are recomputed from morphed
// vertices. The vertices of a group have the same position, normal and texture coordinates in every pose.
// Triangles without derivatives of position by UV in every pose are omitted. Others may lack them in one
// pose, and then add nothing.
struct TangentGroups {
    std::vector<std::uint32_t> of_vertex;  // group of each vertex; count(): none, any tangent serves
    std::vector<std::uint32_t> first;      // start of each group in `corners`, then the end of the last
    std::vector<std::uint32_t> corners;    // into Primitive::indices
    bool empty() const { return of_vertex.empty(); }
    std::uint32_t count() const { return first.empty() ? 0 : static_cast<std::uint32_t>(first.size()) - 1; }
};

// An empty box until a point is added.
struct VertexBox {
    glm::vec3 min{std::numeric_limits<float>::infinity()}, max{-std::numeric_limits<float>::infinity()};
};

// Bounds of the posed vertices that need not visit each vertex (motion/deformation_bounds.h). A cluster
// has nearby vertices that mostly follow one joint.
struct DeformationBounds {
    struct Influence {            // of one joint on a cluster
        std::uint32_t joint = 0;  // into Skin::joints
        double min = 0, max = 0;  // range of its weight among the cluster's vertices
        VertexBox box;            // of the cluster's vertices that it moves
    };
    struct Cluster {
        VertexBox box;
        std::uint32_t joint = 0;          // the joint of the largest weight
        double others = 0;                // largest sum of the weights of all other joints
        std::uint32_t end_influence = 0;  // end of this cluster's range in `influences`
    };
    std::vector<Cluster> clusters;
    std::vector<Influence> influences;   // by cluster; empty without joints
    std::vector<std::uint32_t> targets;  // indices of the targets that move positions
    std::vector<VertexBox> deltas;       // by cluster, for each of `targets`
    std::uint32_t main_joint = 0;        // the joint with the largest total weight; 0 without joints
    bool empty() const { return clusters.empty(); }
};

// The position of a skinned vertex is the sum over its joints of weight * worldFromNode[joints[j]] *
// joint_from_mesh[j] * position. The transform of the mesh's own node has no effect.
struct Skin {
    std::string name;
    std::vector<int> joints;                 // into Scene::nodes; at least one
    std::vector<glm::mat4> joint_from_mesh;  // inverse bind matrices, affine; one per joint
    int skeleton = -1;                       // into Scene::nodes; -1: not given
};

enum class Interpolation { step, linear, cubic_spline };
// The target of a channel. The order separates nodes, meshes, lights, cameras and materials; see
// animated.h for component counts and valid ranges.
enum class AnimatedPart {
    translation,
    rotation,
    scale,
    weights,       // of a node, all morph targets
    weight,        // of a node, one morph target
    mesh_weights,  // of a mesh, for its nodes without weights of their own
    mesh_weight,
    light_color,
    light_intensity,
    light_range,
    light_inner_cone,
    light_outer_cone,
    camera_yfov,
    camera_aspect,
    camera_ymag,
    camera_xmag,
    camera_near,
    camera_far,
// clang-format off
#define DIPTYCH_PART(type, name, ...) name,
    MATERIAL_FACTORS(DIPTYCH_PART)
#undef DIPTYCH_PART
    emissive,  // factor without the strength
    // clang-format on
    emissive_strength,
    specular_color,
    specular_f0,  // KHR_materials_pbrSpecularGlossiness: specularFactor
    glossiness,
    anisotropy_rotation,
    texture_offset,  // KHR_texture_transform of one slot
    texture_rotation,
    texture_scale
};

// Keyframes that several channels may share. A key has `width` values: 3 for translation (m) or scale, 4
// for rotation, one per morph target for weights, otherwise as in propertiesOf(). Rotations are x, y, z, w
// and of unit length, except that a cubic spline's are as in the file. A key of a cubic spline has
// in-tangent, value and out-tangent, in this order.
struct Keyframes {
    Interpolation interpolation = Interpolation::linear;
    std::vector<float> times;   // s, >= 0, not decreasing, at least one; the last of equal times counts
    std::vector<float> values;  // times.size() * width * (cubic_spline ? 3 : 1)
    std::size_t width = 0;
};

struct AnimationChannel {
    int node = -1;       // into Scene::nodes; the node has Node::transform, or a mesh with morph targets
    int keyframes = -1;  // into Animation::keyframes
    AnimatedPart part = AnimatedPart::translation;
    // The target if it is not a node: into Scene::meshes or materials, or Light::source or Camera::source.
    int object = -1;
    int element = 0;  // for one weight: the morph target; for a texture transform: the slot (SLOT_*)
};

struct Animation {
    std::string name;
    std::vector<Keyframes> keyframes;
    std::vector<AnimationChannel> channels;  // each has another target
};

// False for animations that do not affect the scene. They are kept so that indices match the file.
inline bool movesAnything(const Animation& animation) {
    return !animation.channels.empty();
}

}  // namespace diptych
