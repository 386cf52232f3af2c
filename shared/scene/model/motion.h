// SPDX-License-Identifier: MIT
// Animation data as glTF 2.0 defines it (3.7.2.2, 3.7.3, 3.11): keyframes, skins and morph targets. The
// loader has checked all of it: indices are valid, numbers are finite, arrays that belong together have
// equal lengths.
#pragma once

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

// A node's transform in the three parts that animations replace; applied as scale, rotation, translation.
struct Transform {
    glm::dvec3 translation{0, 0, 0};
    glm::dquat rotation{1, 0, 0, 0};  // w, x, y, z; unit
    glm::dvec3 scale{1, 1, 1};
};

// Four more joints for every vertex. A vertex's weights are >= 0 and add up to 1 over all of its sets; the
// joint of an entry with weight 0 is stored as 0.
struct JointSet {
    std::vector<glm::u16vec4> joints;  // into Skin::joints; valid for every skin that the mesh is drawn with
    std::vector<glm::vec4> weights;
};

// What a target adds to a vertex at weight 1. Each array is either empty (adds nothing) or as long as
// positions.
struct MorphTarget {
    std::vector<glm::vec3> positions;  // object, m
    std::vector<glm::vec3> normals;
    std::vector<glm::vec3> tangents;  // the sign of the bitangent is not morphed
    std::vector<glm::vec2> texcoords[2]{};
    std::vector<glm::vec4> colors{};  // a morphed colour is clamped to 0..1
};

// Which corners of triangles share a tangent, of a primitive whose tangents follow from its morphed vertices.
// A group's vertices have the same position, normal and texture coordinates in every pose. Triangles that
// have no derivatives of position by texture coordinates in any pose are not among its corners; others may
// have none in one pose, and then add nothing.
struct TangentGroups {
    std::vector<std::uint32_t> of_vertex;  // its group; count(): none, and the tangent is any
    std::vector<std::uint32_t> first;      // where each group begins in `corners`, and where the last ends
    std::vector<std::uint32_t> corners;    // into Primitive::indices
    bool empty() const { return of_vertex.empty(); }
    std::uint32_t count() const { return first.empty() ? 0 : static_cast<std::uint32_t>(first.size()) - 1; }
};

// A box that holds no point until one is added.
struct VertexBox {
    glm::vec3 min{std::numeric_limits<float>::infinity()}, max{-std::numeric_limits<float>::infinity()};
};

// What bounds the posed vertices of a primitive without a visit to each (motion/deformation_bounds.h).
// Vertices that are near each other and mostly follow one joint are a cluster.
struct DeformationBounds {
    struct Influence {               // of a joint on a cluster
        std::uint32_t joint = 0;     // into Skin::joints
        double least = 0, most = 0;  // its share in a vertex of the cluster
        VertexBox box;               // of the cluster's vertices that have a share of it
    };
    struct Cluster {
        VertexBox box;
        std::uint32_t joint = 0;          // that has the largest share
        double others = 0;                // the largest sum of the shares of all other joints
        std::uint32_t end_influence = 0;  // into `influences`, where this cluster's end
    };
    std::vector<Cluster> clusters;
    std::vector<Influence> influences;   // cluster by cluster; none without joints
    std::vector<std::uint32_t> targets;  // those that move positions
    std::vector<VertexBox> deltas;       // of each cluster, for each of `targets`
    std::uint32_t main_joint = 0;        // whose shares in all vertices add up to most; 0 without joints
    bool empty() const { return clusters.empty(); }
};

// A vertex of a skinned mesh is at the sum over its joints of weight * worldFromNode[joints[j]] *
// joint_from_mesh[j] * position. The transform of the mesh's own node has no effect.
struct Skin {
    std::string name;
    std::vector<int> joints;                 // into Scene::nodes; at least one
    std::vector<glm::mat4> joint_from_mesh;  // the inverse bind matrices; as many as joints, affine
    int skeleton = -1;                       // into Scene::nodes; -1: the file gives none
};

enum class Interpolation { step, linear, cubic_spline };
// What a channel moves. The order tells nodes, meshes, lights, cameras and materials apart: see animated.h,
// which has widths and valid ranges.
enum class AnimatedPart {
    translation,
    rotation,
    scale,
    weights,       // of all morph targets of a node
    weight,        // of one of them
    mesh_weights,  // of a mesh's morph targets, for its nodes that have no weights of their own
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
    base_color,
    metallic,
    roughness,
    emissive,  // the factor, without its strength
    emissive_strength,
    normal_scale,
    occlusion_strength,
    alpha_cutoff,
    ior,
    specular,
    specular_color,
    transmission,
    texture_offset,  // KHR_texture_transform of one slot
    texture_rotation,
    texture_scale
};

// Keyframes that several channels may share. A key has `width` values: 3 for a translation (m) or a scale, 4
// for a rotation (x, y, z, w: unit, except that a cubic spline's are as in the file), one for each morph
// target for weights, otherwise those of factsOf(). With a cubic spline each key has in-tangent, value and
// out-tangent, in this order.
struct Keyframes {
    Interpolation interpolation = Interpolation::linear;
    std::vector<float> times;   // s, >= 0, not decreasing; at least one. Of equal ones the last counts
    std::vector<float> values;  // times.size() * width * (cubic_spline ? 3 : 1)
    std::size_t width = 0;
};

struct AnimationChannel {
    int node = -1;       // into Scene::nodes; that node has Node::transform, or a mesh with morph targets
    int keyframes = -1;  // into Animation::keyframes
    AnimatedPart part = AnimatedPart::translation;
    int object =
        -1;  // what else than a node it moves: into Scene::meshes or materials, Light or Camera::source
    int element = 0;  // of one weight: the morph target; of a texture transform: the slot (SLOT_*)
};

struct Animation {
    std::string name;
    std::vector<Keyframes> keyframes;
    std::vector<AnimationChannel> channels;  // no two move the same thing
};

// False of an animation that moves nothing of the scene; it is there so that the others keep their indices.
inline bool movesAnything(const Animation& animation) {
    return !animation.channels.empty();
}

}  // namespace diptych
