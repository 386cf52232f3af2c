// SPDX-License-Identifier: MIT
#include "tests/fuzz/valid_scene.h"

#include "shared/scene/model/animated.h"
#include "shared/scene/model/material_parts.h"
#include "shared/scene/motion/pose.h"
#include "shared/scene/motion/posed.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/valid_light.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <ranges>

namespace diptych::fuzz {
namespace {

template <class Array>
bool within(int index, const Array& array) {
    return index >= 0 && static_cast<std::size_t>(index) < array.size();
}
template <class Array>
bool withinOrNone(int index, const Array& array) {
    return index == -1 || within(index, array);
}

template <class Vector>
bool finite(const Vector& vector) {
    for (int c = 0; c < vector.length(); ++c)
        if (!std::isfinite(vector[c])) return false;
    return true;
}
bool finite(const glm::dmat4& matrix) {
    return finite(matrix[0]) && finite(matrix[1]) && finite(matrix[2]) && finite(matrix[3]);
}
template <class Array>
bool allFinite(const Array& array) {
    return std::ranges::all_of(array, [](const auto& value) { return finite(value); });
}

// Empty or as long as positions.
template <class Array>
bool fits(const Array& array, const Primitive& primitive) {
    return array.empty() || array.size() == primitive.positions.size();
}

// 1e-3 is generous for float rounding, and small compared with any unnormalized vector.
template <class Vector>
bool unit(const Vector& vector) {
    return std::abs(glm::length(vector) - 1) < 1e-3f;
}

void requireSound(const Primitive& p, const Scene& scene) {
    require(within(p.material, scene.materials), "a primitive's material is there");
    require(p.normals.size() == p.positions.size(), "every vertex has a normal");
    require(p.tangents.size() == p.positions.size(), "every vertex has a tangent");
    require(p.indices.size() % 3 == 0, "indices are of triangles");
    for (const std::uint32_t index : p.indices)
        require(index < p.positions.size(), "an index names a vertex");
    require(allFinite(p.positions), "positions are finite");
    for (const glm::vec3& normal : p.normals) require(unit(normal), "normals are of unit length");
    for (const glm::vec4& tangent : p.tangents) {
        require(unit(glm::vec3(tangent)), "tangents are of unit length");
        require(std::abs(tangent.w) == 1, "a bitangent has a sign");
    }
    for (const auto& texcoords : p.texcoords)
        require(fits(texcoords, p) && allFinite(texcoords), "every vertex has its coordinates or none has");
    require(fits(p.colors, p) && allFinite(p.colors), "every vertex has its colour or none has");
    for (const JointSet& set : p.joint_sets)
        require(set.joints.size() == p.positions.size() && set.weights.size() == p.positions.size() &&
                    allFinite(set.weights),
                "every vertex has joints and weights");
    for (const MorphTarget& target : p.targets) {
        require(fits(target.positions, p) && fits(target.normals, p) && fits(target.tangents, p),
                "a target moves every vertex or none");
        require(allFinite(target.positions) && allFinite(target.normals) && allFinite(target.tangents),
                "a target's movement is finite");
    }
}

// A factor as float32. 0 is also an infinite attenuation distance.
bool isIn(AnimatedPart part, double value) {
    const PartProperties properties = propertiesOf(part);
    return (value >= double{static_cast<float>(properties.min)} &&
            value <= double{static_cast<float>(properties.max)}) ||
           (part == AnimatedPart::attenuation_distance && value == 0);
}

void requireSound(const Material& material, const Scene& scene) {
    for (const MaterialSlot& member : materialSlots) {
        const TextureSlot& slot = material.*member.texture;
        require(withinOrNone(slot.texture, scene.textures), "a slot's texture is there");
        require(slot.texcoord == 0 || slot.texcoord == 1, "a slot reads one of two sets");
        require(finite(slot.u) && finite(slot.v), "a texture's transform is finite");
    }
#define IN_RANGE(type, name, ...)                                   \
    for (const double value : partOf(material, AnimatedPart::name)) \
        require(isIn(AnimatedPart::name, value), "a material's " #name " is in its range");
    MATERIAL_FACTORS(IN_RANGE)
#undef IN_RANGE
    require(finite(material.emissive) && finite(material.specular_color) &&
                std::isfinite(material.anisotropy_rotation),
            "a material's factors are finite");
}

void requireTrees(const Scene& scene) {
    for (const Node& node : scene.nodes) {
        require(withinOrNone(node.parent, scene.nodes), "a node's parent is there");
        require(withinOrNone(node.mesh, scene.meshes), "a node's mesh is there");
        require(withinOrNone(node.skin, scene.skins), "a node's skin is there");
        require(withinOrNone(node.transform, scene.transforms), "a node's transform is there");
        require(withinOrNone(node.weights, scene.weights), "a node's weights are there");
        require(withinOrNone(node.copies, scene.copies), "a node's copies are there");
        require(finite(node.parent_from_node), "a node's matrix is finite");
        if (node.skin < 0 || node.mesh < 0) continue;
        const std::size_t joints = scene.skins[static_cast<std::size_t>(node.skin)].joints.size();
        for (const Primitive& p : scene.meshes[static_cast<std::size_t>(node.mesh)].primitives)
            for (const JointSet& set : p.joint_sets)
                for (const auto& four : set.joints)
                    for (int c = 0; c < 4; ++c) require(four[c] < joints, "a vertex's joint is in the skin");
    }
    // Each node is visited once. Reaching a node of the current walk again means a cycle of parents.
    std::vector<int> walk(scene.nodes.size(), -1);
    for (int from = 0; from < static_cast<int>(scene.nodes.size()); ++from)
        for (int node = from; node != -1; node = scene.nodes[static_cast<std::size_t>(node)].parent) {
            int& seen = walk[static_cast<std::size_t>(node)];
            require(seen != from, "nodes are trees");
            if (seen != -1) break;
            seen = from;
        }
}

void requireSoundMotion(const Scene& scene) {
    for (const Skin& skin : scene.skins) {
        require(!skin.joints.empty() && skin.joint_from_mesh.size() == skin.joints.size(),
                "a skin has its joints");
        for (const int joint : skin.joints) require(within(joint, scene.nodes), "a joint is a node");
        require(withinOrNone(skin.skeleton, scene.nodes), "a skeleton is a node");
        for (const glm::mat4& matrix : skin.joint_from_mesh)
            require(finite(glm::dmat4(matrix)), "a bind is finite");
    }
    for (const Animation& animation : scene.animations) {
        for (const Keyframes& keys : animation.keyframes) {
            const std::size_t each = keys.width * (keys.interpolation == Interpolation::cubic_spline ? 3 : 1);
            require(!keys.times.empty() && keys.values.size() == keys.times.size() * each,
                    "a key has its values");
            require(keys.times.front() >= 0 && std::isfinite(keys.times.back()), "keys are at finite times");
            require(std::ranges::adjacent_find(keys.times, std::greater()) == keys.times.end(),
                    "keys follow each other");
            require(std::ranges::all_of(keys.values, [](float v) { return std::isfinite(v); }),
                    "keys are finite");
        }
        for (const AnimationChannel& channel : animation.channels) {
            require(within(channel.keyframes, animation.keyframes), "a channel has keys");
            require(isNodePart(channel.part)       ? within(channel.node, scene.nodes)
                    : isMeshPart(channel.part)     ? within(channel.object, scene.meshes)
                    : isMaterialPart(channel.part) ? within(channel.object, scene.materials)
                                                   : channel.object >= 0,
                    "a channel moves what is there");
        }
    }
}

void requireSoundPose(const Scene& scene, const Pose& pose) {
    require(pose.materials.empty() || pose.materials.size() == scene.materials.size(),
            "all materials are posed or none is");
    for (const Material& material : pose.materials) requireSound(material, scene);
    for (const Camera& camera : pose.cameras)
        require(camera.far > camera.near && camera.near >= 0, "a camera sees what lies between its planes");
    for (const Light& light : pose.lights) fuzz::requireSound(light);
    for (const Instance& instance : pose.instances) {
        require(within(instance.mesh, scene.meshes), "an instance's mesh is there");
        require(within(instance.primitive, scene.meshes[static_cast<std::size_t>(instance.mesh)].primitives),
                "an instance's primitive is there");
        require(finite(instance.world_from_object), "an instance has a place");
        require(instance.skin < 0 || within(instance.skin, pose.skins), "an instance's joints are there");
        require(instance.weights < 0 || within(instance.weights, pose.weights),
                "an instance's weights are there");
        if (!instance.deformed()) continue;
        for (const glm::dvec3& p : posedPositions(scene, pose, instance))
            require(std::isnan(p.x) || glm::length(p) <= 2 * maxCoordinate,
                    "a posed vertex has a place or none");
    }
}

}  // namespace

void requireSound(const Scene& scene) {
    requireTrees(scene);
    requireSoundMotion(scene);
    for (const Mesh& mesh : scene.meshes)
        for (const Primitive& primitive : mesh.primitives) {
            requireSound(primitive, scene);
            require(primitive.targets.size() == mesh.primitives[0].targets.size() &&
                        primitive.targets.size() == mesh.weights.size(),
                    "a mesh's primitives share its targets");
        }
    for (const Material& material : scene.materials) requireSound(material, scene);
    for (const Texture& texture : scene.textures)
        require(withinOrNone(texture.image, scene.images), "a texture's image is there");
    for (const TextureImage& image : scene.images)
        require(image.rgba.empty() + image.rgba16.empty() + image.rgba32.empty() == 2 &&
                    image.components() ==
                        4 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height),
                "an image has its pixels");
    for (const Light& light : scene.lights) {
        require(withinOrNone(light.node, scene.nodes), "a light's node is there");
        requireSound(light);
    }
    for (const Camera& camera : scene.cameras) {
        require(withinOrNone(camera.node, scene.nodes), "a camera's node is there");
        require(std::isfinite(camera.yfov) && std::isfinite(camera.ymag) && std::isfinite(camera.near) &&
                    camera.aspect >= 0 && camera.xmag >= 0 && camera.far > camera.near,
                "a camera sees something");
    }
    // At the start, between keys and after the last key.
    for (const double seconds : {0.0, 0.37, 1e9}) requireSoundPose(scene, poseAt(scene, seconds));
}

}  // namespace diptych::fuzz
