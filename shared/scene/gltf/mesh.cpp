// SPDX-License-Identifier: MIT
#include "shared/scene/gltf/mesh.h"

#include "shared/scene/gltf/limits.h"
#include "shared/scene/gltf/model.h"
#include "shared/scene/gltf/primitive.h"
#include "shared/scene/gltf/tally.h"
#include "shared/scene/gltf/value.h"
#include "shared/scene/model/animated.h"
#include "shared/text/counted.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <stdexcept>

namespace diptych::gltf {

namespace {

// How the scene's nodes use a mesh.
struct MeshUse {
    bool drawn = false;
    std::size_t joints = 0;  // of the smallest skin that uses it; 0: not skinned
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
    std::string fault = {};  // why it cannot be drawn; empty if it can
    std::vector<std::string> notes = {};
    std::string who() const { return fmt::format("mesh {}, primitive {}", mesh, primitive); }
};

const tinygltf::Primitive& fileOf(const Model& model, const Task& task) {
    return model.meshes[task.mesh].primitives[task.primitive];
}

// Calls `read`. If it throws, the primitive is omitted with a note.
template <class Read>
void attempt(Task& task, const Read& read) {
    if (!task.fault.empty()) return;
    try {
        read();
    } catch (const std::runtime_error& e) {
        task.fault = e.what();
        const std::string who = task.who();
        task.notes = {task.fault.starts_with(who)
                          ? task.fault + ": left out"
                          : fmt::format("{}: left out, it needs {}", who, task.fault)};
    }
}

// Checks the decoded size from counts, before decoding.
void checkSize(const Model& model, std::vector<Task>& tasks) {
    std::size_t decoded = 0;
    const std::size_t encoded = model.dataBytes();
    const std::size_t most = FREE_DECODED_BYTES + encoded * DECODED_BYTES_PER_BYTE;
    for (Task& task : tasks) {
        attempt(task, [&] { decoded += decodedBytes(model, fileOf(model, task), task.who()); });
        if (decoded > most)
            throw std::runtime_error(
                fmt::format("{}: {} bytes of geometry so far from {} bytes of buffers; the limit is {}",
                            task.who(), decoded, encoded, most));
    }
}

std::vector<float> readWeights(const tinygltf::Mesh& mesh, std::size_t targets, const std::string& who) {
    if (mesh.weights.empty()) return std::vector<float>(targets, 0.0f);
    if (mesh.weights.size() != targets)
        throw std::runtime_error(fmt::format("{}: {} for {}", who, counted(mesh.weights.size(), "weight"),
                                             counted(targets, "morph target")));
    return {mesh.weights.begin(), mesh.weights.end()};
}

}  // namespace

std::vector<Mesh> readMeshes(const Model& model, const Scene& scene,
                             const std::map<std::size_t, std::string>& broken,
                             std::vector<std::string>& notes, Tally& tally) {
    const std::vector<MeshUse> uses = usesOf(model.meshes.size(), scene);
    std::vector<Mesh> meshes(model.meshes.size());
    std::vector<Task> tasks;
    std::map<std::size_t, std::string> faults;  // the first fault of each drawn mesh
    const std::size_t before = notes.size();
    for (std::size_t m = 0; m < meshes.size(); ++m) {
        const tinygltf::Mesh& file = model.meshes[m];
        meshes[m].name = file.name;
        if (!uses[m].drawn) continue;
        if (const auto fault = broken.find(m); fault != broken.end()) {
            faults.insert(*fault);
            continue;
        }
        if (file.primitives.empty()) continue;
        const std::size_t targets = file.primitives[0].targets.size();
        try {
            meshes[m].weights = readWeights(file, targets, fmt::format("mesh {}", m));
        } catch (const std::runtime_error& e) {
            notes.push_back(fmt::format("{}: left out", faults.emplace(m, e.what()).first->second));
            continue;
        }
        meshes[m].primitives.resize(file.primitives.size());
        for (std::size_t p = 0; p < file.primitives.size(); ++p) tasks.push_back({m, p});
    }
    checkSize(model, tasks);

    const std::vector<bool> anisotropic = materialsWithAnisotropy(scene),
                            baseMapsThatTurn = tangentMapsThatTurn(scene),
                            layerMaps = layerMapsThatTurn(scene);
    forEachInParallel(tasks.size(), [&](std::size_t i) {
        Task& task = tasks[i];
        const PrimitiveUse use{scene.materials,        anisotropic,
                               baseMapsThatTurn,       layerMaps,
                               uses[task.mesh].joints, meshes[task.mesh].weights.size()};
        attempt(task, [&] {
            meshes[task.mesh].primitives[task.primitive] =
                readPrimitive(model, fileOf(model, task), task.who(), use, task.notes);
        });
        tally.oneMore();
    });
    bool any = false;
    for (Mesh& mesh : meshes) {
        std::erase_if(mesh.primitives, [](const Primitive& p) { return p.indices.empty(); });
        any = any || !mesh.primitives.empty();
    }
    for (Task& task : tasks) {
        if (!task.fault.empty()) faults.emplace(task.mesh, task.fault);
        std::ranges::move(task.notes, std::back_inserter(notes));
    }
    if (!any && !faults.empty()) throw std::runtime_error(faults.begin()->second);
    limitNotes(notes, before, "meshes");
    return meshes;
}

}  // namespace diptych::gltf
