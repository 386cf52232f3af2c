// SPDX-License-Identifier: MIT
#include "shared/scene/scene.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <cmath>

namespace diptych {

namespace {

// Every node's transform, parents in any order, chains of any length: each unresolved ancestor waits on a
// stack until its own parent is known.
std::vector<glm::dmat4> worldFromNode(const std::vector<Node>& nodes) {
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
            world[n] = node.parent < 0 ? node.parent_from_node
                                       : world[static_cast<std::size_t>(node.parent)] * node.parent_from_node;
            known[n] = true;
        }
    }
    return world;
}

// A light ignores its node's scale: only where it stands and where it points counts. A node that is
// squashed along its axis points nowhere; its light keeps -Z.
Light inWorld(const Light& light, const std::vector<glm::dmat4>& world) {
    Light result = light;
    if (light.node < 0) return result;
    const glm::dmat4& worldFromLight = world[static_cast<std::size_t>(light.node)];
    const glm::dvec3 axis = -glm::dvec3(worldFromLight[2]);
    const double length = glm::length(axis);
    result.position = glm::dvec3(worldFromLight[3]);
    result.direction = length > 0 && std::isfinite(length) ? axis / length : glm::dvec3(0, 0, -1);
    result.node = -1;
    return result;
}

}  // namespace

double Bounds::radius() const {
    return empty() ? 0.0 : glm::length(max - min) * 0.5;
}

Pose poseAt(const Scene& scene, double /*seconds*/) {
    const std::vector<glm::dmat4> world = worldFromNode(scene.nodes);
    Pose pose;
    for (std::size_t n = 0; n < scene.nodes.size(); ++n) {
        const int mesh = scene.nodes[n].mesh;
        if (mesh < 0) continue;
        const std::size_t primitives = scene.meshes[static_cast<std::size_t>(mesh)].primitives.size();
        for (std::size_t p = 0; p < primitives; ++p)
            pose.instances.push_back({mesh, static_cast<int>(p), static_cast<int>(n), world[n]});
    }
    for (const Light& light : scene.lights) pose.lights.push_back(inWorld(light, world));
    std::stable_partition(pose.lights.begin(), pose.lights.end(),
                          [](const Light& light) { return light.kind == LightKind::directional; });
    for (Camera camera : scene.cameras) {
        if (camera.node >= 0) camera.world_from_camera = world[static_cast<std::size_t>(camera.node)];
        camera.node = -1;
        pose.cameras.push_back(camera);
    }
    return pose;
}

Bounds worldBounds(const Scene& scene, const Pose& pose) {
    Bounds bounds;
    for (const Instance& instance : pose.instances) {
        const Mesh& mesh = scene.meshes[static_cast<std::size_t>(instance.mesh)];
        for (const glm::vec3& p : mesh.primitives[static_cast<std::size_t>(instance.primitive)].positions) {
            const glm::dvec3 q(instance.world_from_object * glm::dvec4(p, 1.0));
            bounds.min = glm::min(bounds.min, q);
            bounds.max = glm::max(bounds.max, q);
        }
    }
    return bounds;
}

}  // namespace diptych
