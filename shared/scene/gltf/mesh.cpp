// SPDX-License-Identifier: MIT
#include "shared/scene/gltf/mesh.h"

#include "shared/scene/gltf/limits.h"
#include "shared/scene/gltf/primitive.h"
#include "shared/scene/gltf/tally.h"
#include "shared/scene/gltf/value.h"
#include "shared/scene/model/animated.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace diptych::gltf {

namespace {

// How the scene's nodes use a mesh.
struct MeshUse {
    bool drawn = false;
    std::size_t joints = 0;  // of the smallest skin that moves it; 0: not skinned
};

std::vector<MeshUse> usesOf(std::size_t meshes, const Scene& scene) {
    std::vector<MeshUse> uses(meshes);
    for (const Node& node : scene.nodes) {
        if (node.mesh < 0) continue;
        MeshUse& use = uses[static_cast<std::size_t>(node.mesh)];
        use.drawn = true;
        if (node.skin < 0) continue;
        const std::size_t joints = scene.skins[static_cast<std::size_t>(node.skin)].joints.size();
        use.joints = use.joints ? std::min(use.joints, joints) : joints;
    }
    return uses;
}

struct Task {
    std::size_t mesh, primitive;
    std::string who() const { return fmt::format("mesh {}, primitive {}", mesh, primitive); }
};

const tinygltf::Primitive& fileOf(const tinygltf::Model& model, const Task& task) {
    return model.meshes[task.mesh].primitives[task.primitive];
}

// Checks the decoded size from counts alone, before anything is decoded.
void checkSize(const tinygltf::Model& model, const std::vector<Task>& tasks) {
    std::size_t encoded = 0, decoded = 0;
    for (const tinygltf::Buffer& buffer : model.buffers) encoded += buffer.data.size();
    const std::size_t most = FREE_DECODED_BYTES + encoded * DECODED_BYTES_PER_BYTE;
    for (const Task& task : tasks) {
        decoded += decodedBytes(model, fileOf(model, task), task.who());
        if (decoded > most)
            throw std::runtime_error(fmt::format(
                "{}: {} bytes of geometry up to here from {} bytes of buffers: at most {} are read",
                task.who(), decoded, encoded, most));
    }
}

std::vector<float> readWeights(const tinygltf::Mesh& mesh, std::size_t targets, const std::string& who) {
    if (mesh.weights.empty()) return std::vector<float>(targets, 0.0f);
    if (mesh.weights.size() != targets)
        throw std::runtime_error(fmt::format("{}: {} weights for {} morph target{}", who, mesh.weights.size(),
                                             targets, targets == 1 ? "" : "s"));
    std::vector<float> weights;
    for (const double w : mesh.weights) {
        weights.push_back(static_cast<float>(w));
        if (!std::isfinite(weights.back())) throw std::runtime_error(who + ": a weight is not finite");
    }
    return weights;
}

}  // namespace

std::vector<Mesh> readMeshes(const tinygltf::Model& model, const Scene& scene,
                             std::vector<std::string>& notes, Tally& tally) {
    const std::vector<MeshUse> uses = usesOf(model.meshes.size(), scene);
    std::vector<Mesh> meshes(model.meshes.size());
    std::vector<Task> tasks;
    for (std::size_t m = 0; m < meshes.size(); ++m) {
        const tinygltf::Mesh& file = model.meshes[m];
        meshes[m].name = file.name;
        if (!uses[m].drawn || file.primitives.empty()) continue;
        const std::size_t targets = file.primitives[0].targets.size();
        meshes[m].weights = readWeights(file, targets, fmt::format("mesh {}", m));
        for (std::size_t p = 0; p < file.primitives.size(); ++p) tasks.push_back({m, p});
    }
    checkSize(model, tasks);

    for (std::size_t m = 0; m < meshes.size(); ++m)
        if (uses[m].drawn) meshes[m].primitives.resize(model.meshes[m].primitives.size());
    std::vector<std::vector<std::string>> found(tasks.size());
    const std::vector<bool> mapsThatTurn = normalMapsThatTurn(scene);
    forEachInParallel(tasks.size(), [&](std::size_t i) {
        const Task& task = tasks[i];
        const PrimitiveUse use{scene.materials, mapsThatTurn, uses[task.mesh].joints,
                               meshes[task.mesh].weights.size()};
        meshes[task.mesh].primitives[task.primitive] =
            readPrimitive(model, fileOf(model, task), task.who(), use, found[i]);
        tally.oneMore();
    });
    for (Mesh& mesh : meshes)
        std::erase_if(mesh.primitives, [](const Primitive& p) { return p.indices.empty(); });
    const std::size_t before = notes.size();
    for (std::vector<std::string>& some : found) std::ranges::move(some, std::back_inserter(notes));
    limitNotes(notes, before, "meshes");
    return meshes;
}

}  // namespace diptych::gltf
