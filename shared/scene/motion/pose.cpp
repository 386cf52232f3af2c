// SPDX-License-Identifier: MIT
#include "shared/scene/motion/pose.h"
#include "shared/scene/model/axes.h"
#include "shared/scene/model/material_slots.h"
#include "shared/scene/model/scene.h"
#include "shared/scene/motion/animation.h"
#include "shared/scene/motion/deformation_bounds.h"
#include "shared/scene/motion/morphed_tangents.h"
#include "shared/scene/motion/properties.h"
#include "shared/text/counted.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <span>

namespace diptych {

namespace {

// World transforms of all nodes. Parents may come later and chains have any length, so unresolved
// ancestors wait on a stack.
std::vector<glm::dmat4> worldFromNode(const std::vector<Node>& nodes,
                                      const std::vector<glm::dmat4>& parentFromNode) {
    std::vector<glm::dmat4> world(nodes.size());
    std::vector<bool> known(nodes.size(), false);
    std::vector<std::size_t> waiting;
    for (std::size_t start = 0; start < nodes.size(); ++start) {
        for (std::size_t n = start; !known[n];) {
            waiting.push_back(n);
            if (nodes[n].parent < 0) break;
            n = static_cast<std::size_t>(nodes[n].parent);
        }
        for (; !waiting.empty(); waiting.pop_back()) {
            const std::size_t n = waiting.back();
            const Node& node = nodes[n];
            world[n] = node.parent < 0 ? parentFromNode[n]
                                       : world[static_cast<std::size_t>(node.parent)] * parentFromNode[n];
            known[n] = true;
        }
    }
    return world;
}

std::vector<glm::dmat4> worldFromNodeAtRest(const std::vector<Node>& nodes) {
    std::vector<glm::dmat4> parentFromNode;
    for (const Node& node : nodes) parentFromNode.push_back(node.parent_from_node);
    return worldFromNode(nodes, parentFromNode);
}

// A light uses only its node's position and orientation, not the scale. If the node's scale collapses the
// light's direction, the light shines along -Z.
Light inWorld(const Light& light, const std::vector<glm::dmat4>& world) {
    Light result = light;
    if (light.node < 0) return result;
    const glm::dmat4& worldFromLight = world[static_cast<std::size_t>(light.node)];
    result.position = glm::dvec3(worldFromLight * glm::dvec4(light.position, 1));
    result.direction = unitOr(glm::dmat3(worldFromLight) * light.direction, {0, 0, -1});
    // The axes of a sheared node are not perpendicular. If they are nearly parallel, the projected axis is
    // only rounding error, and the default is used.
    const glm::dvec3 axis = unitOr(glm::dmat3(worldFromLight) * light.axis, {1, 0, 0});
    const glm::dvec3 across = axis - glm::dot(axis, result.direction) * result.direction;
    result.axis = isClosed(light.kind)         ? axis
                  : glm::length(across) > 1e-6 ? glm::normalize(across)
                                               : perpendicularTo(result.direction);
    result.node = -1;
    return result;
}

// Whether all coordinates within +-extent of the object's origin are at most maxCoordinate.
bool isWithin(const glm::dmat4& worldFromObject, const glm::dvec3& extent) {
    for (int row = 0; row < 3; ++row) {
        double reach = std::abs(worldFromObject[3][row]);
        for (int column = 0; column < 3; ++column) {
            const double axis = std::abs(worldFromObject[column][row]);
            if (!(axis <= maxCoordinate)) return false;
            reach += axis * extent[column];
        }
        if (!(reach <= maxCoordinate)) return false;
    }
    return true;
}
bool isWithin(const glm::dmat4& worldFromObject) {
    return isWithin(worldFromObject, glm::dvec3(0));
}

bool hasPosition(const Light& light, const std::vector<glm::dmat4>& world) {
    return light.node < 0 || isWithin(world[static_cast<std::size_t>(light.node)], glm::abs(light.position));
}
bool hasPosition(const Camera& camera, const std::vector<glm::dmat4>& world) {
    return camera.node < 0 || isWithin(world[static_cast<std::size_t>(camera.node)]);
}

// In bind pose all joints move a vertex alike. Otherwise the joint with the largest total weight
// determines the front side, because a joint of little weight may mirror. The transform of a skinned
// mesh's own node has no effect (glTF 2.0, 3.7.3.3). It is used only if that joint's is not finite or
// collapses the mesh to a plane.
glm::dmat4 worldFromPrimitive(const Scene& scene, const std::vector<glm::dmat4>& world, std::size_t node,
                              const Primitive& primitive) {
    const int index = scene.nodes[node].skin;
    if (index < 0 || primitive.joint_sets.empty()) return world[node];
    const Skin& skin = scene.skins[static_cast<std::size_t>(index)];
    const std::size_t joint =
        primitive.deformation_bounds.empty() ? mainJoint(primitive) : primitive.deformation_bounds.main_joint;
    const glm::dmat4 bound =
        world[static_cast<std::size_t>(skin.joints[joint])] * glm::dmat4(skin.joint_from_mesh[joint]);
    return isWithin(bound) && glm::determinant(glm::dmat3(bound)) != 0 ? bound : world[node];
}

const std::vector<Primitive>& primitivesOf(const Scene& scene, const Node& node) {
    static const std::vector<Primitive> no_primitives;
    return node.mesh < 0 ? no_primitives : scene.meshes[static_cast<std::size_t>(node.mesh)].primitives;
}

// Node from mesh, for each copy of the node's mesh.
std::span<const glm::dmat4> copiesOf(const Scene& scene, const Node& node) {
    static const glm::dmat4 once(1.0);
    if (node.copies < 0) return {&once, 1};
    return scene.copies[static_cast<std::size_t>(node.copies)];
}

glm::dvec3 extentOf(const Primitive& primitive) {
    glm::vec3 extent(0);
    for (const glm::vec3& p : primitive.positions) extent = glm::max(extent, glm::abs(p));
    return glm::dvec3(extent);
}

std::vector<glm::dmat4> worldFromMesh(const Skin& skin, const std::vector<glm::dmat4>& world) {
    std::vector<glm::dmat4> result;
    for (std::size_t j = 0; j < skin.joints.size(); ++j)
        result.push_back(world[static_cast<std::size_t>(skin.joints[j])] *
                         glm::dmat4(skin.joint_from_mesh[j]));
    return result;
}

// Morph target weights by node. Nodes that use their mesh's weights share one entry.
class Weights {
public:
    Weights(const Scene& scene, NodeMotion& motion, Pose& pose)
        : scene_(scene), motion_(motion), pose_(pose), index_of_mesh_(scene.meshes.size(), unknown) {}

    // Index of the node's weights in Pose::weights; -1 if all are 0.
    int indexOf(int index) {
        const Node& node = scene_.nodes[static_cast<std::size_t>(index)];
        if (const auto moved = motion_.weights.find(index); moved != motion_.weights.end())
            return add(std::move(moved->second));
        if (node.weights >= 0) return addCopy(scene_.weights[static_cast<std::size_t>(node.weights)]);
        int& slot = index_of_mesh_[static_cast<std::size_t>(node.mesh)];
        if (slot != unknown) return slot;
        const auto moved = motion_.mesh_weights.find(node.mesh);
        return slot = moved != motion_.mesh_weights.end()
                          ? add(std::move(moved->second))
                          : addCopy(scene_.meshes[static_cast<std::size_t>(node.mesh)].weights);
    }

private:
    static constexpr int unknown = -2;

    int addCopy(const std::vector<float>& weights) { return add({weights.begin(), weights.end()}); }
    int add(std::vector<double> weights) {
        if (std::ranges::all_of(weights, [](double w) { return w == 0; })) return -1;
        pose_.weights.push_back(std::move(weights));
        return static_cast<int>(pose_.weights.size()) - 1;
    }

    const Scene& scene_;
    NodeMotion& motion_;
    Pose& pose_;
    std::vector<int> index_of_mesh_;
};

PosedBox boxOf(const Scene& scene, const Pose& pose, const Instance& instance) {
    const Primitive& primitive = primitiveOf(scene, instance);
    const Deformation deformation{
        .world_from_object = instance.world_from_object,
        .world_from_mesh = instance.skin < 0 ? nullptr : &pose.skins[static_cast<std::size_t>(instance.skin)],
        .weights =
            instance.weights < 0 ? nullptr : &pose.weights[static_cast<std::size_t>(instance.weights)]};
    const WorldBox box = primitive.deformation_bounds.empty()
                             ? boundsOf(deformationBounds(primitive), deformation)
                             : boundsOf(primitive.deformation_bounds, deformation);
    const glm::dvec3 origin = (box.min + box.max) / 2.0;
    return {origin, box.min - origin, box.max - origin};
}

bool hasRotatedMap(const Scene& scene, const Pose& pose, const Primitive& primitive) {
    if (primitive.tangent_groups.empty() || pose.materials.empty()) return false;
    const auto m = static_cast<std::size_t>(primitive.material);
    return isRotated(tangentMap(scene.materials[m]), tangentMap(pose.materials[m]));
}

// Whether any triangle has an area in the world. Stops at the first.
bool hasArea(const Primitive& p, const glm::dmat3& worldFromObject) {
    for (std::size_t i = 0; i + 2 < p.indices.size(); i += 3) {
        const glm::dvec3 a(p.positions[p.indices[i]]), b(p.positions[p.indices[i + 1]]),
            c(p.positions[p.indices[i + 2]]);
        if (glm::cross(worldFromObject * (b - a), worldFromObject * (c - a)) != glm::dvec3(0)) return true;
    }
    return false;
}

void noteBeyond(std::vector<std::string>& notes, std::size_t count, const char* what,
                const std::string& when = {}) {
    if (count)
        notes.push_back(fmt::format("{} {} not finite or beyond {:g} m{}: left out", counted(count, what),
                                    count == 1 ? "is" : "are", maxCoordinate, when));
}

}  // namespace

Pose poseAt(const Scene& scene, double seconds, const std::string& animation) {
    NodeMotion motion = motionAt(scene, seconds, animation);
    const std::vector<glm::dmat4> world = worldFromNode(scene.nodes, motion.parent_from_node);
    Pose pose;
    pose.seconds = seconds;
    pose.animation = animation;
    for (const Skin& skin : scene.skins) pose.skins.push_back(worldFromMesh(skin, world));
    PropertyMotion properties = propertiesAt(scene, seconds, animation);
    pose.materials = std::move(properties.materials);
    Weights weights(scene, motion, pose);
    std::size_t beyond = 0;
    for (std::size_t n = 0; n < scene.nodes.size(); ++n) {
        const Node& node = scene.nodes[n];
        const std::vector<Primitive>& primitives = primitivesOf(scene, node);
        const int weightsIndex = primitives.empty() ? -1 : weights.indexOf(static_cast<int>(n));
        for (std::size_t p = 0; p < primitives.size(); ++p) {
            const glm::dmat4 worldFromNode = worldFromPrimitive(scene, world, n, primitives[p]);
            // At rest, leaveOutWhatIsBeyond() has checked all vertices.
            const glm::dvec3 extent = scene.animations.empty() ? glm::dvec3(0) : extentOf(primitives[p]);
            const bool mapRotated = hasRotatedMap(scene, pose, primitives[p]);
            const std::span<const glm::dmat4> copies = copiesOf(scene, node);
            for (std::size_t c = 0; c < copies.size(); ++c) {
                const glm::dmat4 worldFromObject = worldFromNode * copies[c];
                if (!isWithin(worldFromObject, extent)) {
                    ++beyond;
                    continue;
                }
                pose.instances.push_back({.mesh = node.mesh,
                                          .primitive = static_cast<int>(p),
                                          .node = static_cast<int>(n),
                                          .copy = static_cast<int>(c),
                                          .world_from_object = worldFromObject,
                                          .skin = primitives[p].joint_sets.empty() ? -1 : node.skin,
                                          .weights = weightsIndex,
                                          .map_rotated = mapRotated});
            }
        }
    }
    noteBeyond(pose.notes, beyond, "drawn instance", fmt::format(" at {:g} s", seconds));
    std::uint64_t vertices = 0;
    for (Instance& instance : pose.instances) {
        if (!instance.deformed()) continue;
        instance.box = static_cast<int>(pose.boxes.size());
        pose.boxes.push_back(boxOf(scene, pose, instance));
        pose.boxes.back().first_vertex = vertices;
        vertices += primitiveOf(scene, instance).positions.size();
    }
    for (const Light& light : properties.lights)
        if (hasPosition(light, world)) pose.lights.push_back(inWorld(light, world));
    std::stable_partition(pose.lights.begin(), pose.lights.end(),
                          [](const Light& light) { return light.kind == LightKind::directional; });
    for (Camera camera : properties.cameras) {
        if (!hasPosition(camera, world)) continue;
        if (camera.node >= 0) camera.world_from_camera = world[static_cast<std::size_t>(camera.node)];
        camera.node = -1;
        pose.cameras.push_back(camera);
    }
    return pose;
}

bool hasTriangles(const Scene& scene) {
    return std::ranges::any_of(scene.nodes, [&](const Node& node) {
        return !copiesOf(scene, node).empty() && !primitivesOf(scene, node).empty();
    });
}

bool hasArea(const Scene& scene) {
    if (!scene.animations.empty()) return hasTriangles(scene);
    const std::vector<glm::dmat4> world = worldFromNodeAtRest(scene.nodes);
    for (std::size_t n = 0; n < scene.nodes.size(); ++n)
        for (const Primitive& p : primitivesOf(scene, scene.nodes[n]))
            for (const glm::dmat4& copy : copiesOf(scene, scene.nodes[n]))
                if (!p.joint_sets.empty() || !p.targets.empty() ||
                    hasArea(p, glm::dmat3(worldFromPrimitive(scene, world, n, p) * copy)))
                    return true;
    return false;
}

void leaveOutWhatIsBeyond(Scene& scene) {
    const std::vector<glm::dmat4> world = worldFromNodeAtRest(scene.nodes);
    std::vector<std::vector<glm::dvec3>> extents;
    for (const Mesh& mesh : scene.meshes) {
        extents.emplace_back();
        for (const Primitive& p : mesh.primitives) extents.back().push_back(extentOf(p));
    }
    const auto note = [&](std::size_t count, const char* what) { noteBeyond(scene.notes, count, what); };
    std::size_t beyond = 0, copiesBeyond = 0;
    for (std::size_t n = 0; n < scene.nodes.size(); ++n) {
        Node& node = scene.nodes[n];
        const std::vector<Primitive>& primitives = primitivesOf(scene, node);
        for (std::size_t p = 0; p < primitives.size(); ++p)
            if (!isWithin(worldFromPrimitive(scene, world, n, primitives[p]),
                          extents[static_cast<std::size_t>(node.mesh)][p])) {
                node.mesh = -1;
                ++beyond;
                break;
            }
    }
    for (std::size_t n = 0; n < scene.nodes.size(); ++n) {
        const Node& node = scene.nodes[n];
        if (node.copies < 0) continue;
        const auto isBeyond = [&](const glm::dmat4& nodeFromMesh) {
            const std::vector<Primitive>& primitives = primitivesOf(scene, node);
            for (std::size_t p = 0; p < primitives.size(); ++p)
                if (!isWithin(worldFromPrimitive(scene, world, n, primitives[p]) * nodeFromMesh,
                              extents[static_cast<std::size_t>(node.mesh)][p]))
                    return true;
            return false;
        };
        copiesBeyond += std::erase_if(scene.copies[static_cast<std::size_t>(node.copies)], isBeyond);
    }
    note(beyond, "drawn node");
    note(copiesBeyond, "instance");
    if (beyond + copiesBeyond > 0 && !hasTriangles(scene))
        throw std::runtime_error("nothing is left to draw: " + scene.notes.back());
    note(std::erase_if(scene.lights, [&](const Light& light) { return !hasPosition(light, world); }),
         "light");
    note(std::erase_if(scene.cameras, [&](const Camera& camera) { return !hasPosition(camera, world); }),
         "camera");
}

}  // namespace diptych
