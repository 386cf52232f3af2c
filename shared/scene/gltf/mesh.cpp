// SPDX-License-Identifier: MIT
#include "shared/scene/gltf/mesh.h"

#include "shared/scene/gltf/limits.h"
#include "shared/scene/gltf/motion.h"
#include "shared/scene/gltf/primitive.h"
#include "shared/scene/gltf/value.h"
#include "shared/scene/model/animated.h"
#include "shared/text/fail.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

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

// Checks the decoded size from counts, before decoding.
void checkSize(const Model& model, std::vector<Task>& tasks) {
    std::size_t decoded = 0;
    const std::size_t encoded = model.dataBytes();
    const std::size_t max = FREE_DECODED_BYTES + encoded * DECODED_BYTES_PER_BYTE;
    for (Task& task : tasks) {
        task.fault = faultOf([&] { decoded += decodedBytes(model, fileOf(model, task), task.who()); });
        if (decoded > max)
            fail(task.who(),
                 fmt::format("{} bytes of geometry so far from {} bytes of buffers; the limit is {}", decoded,
                             encoded, max));
    }
}

// Appends the notes of all tasks, and keeps the first fault of each mesh.
void collectFaults(std::vector<Task>& tasks, std::map<std::size_t, std::string>& faults,
                   std::vector<std::string>& notes) {
    for (Task& task : tasks) {
        if (task.fault.empty()) {
            std::ranges::move(task.notes, std::back_inserter(notes));
            continue;
        }
        faults.emplace(task.mesh, task.fault);
        notes.push_back(task.fault.starts_with(task.who())
                            ? task.fault + ": left out"
                            : fmt::format("{}: left out, it needs {}", task.who(), task.fault));
    }
}

}  // namespace

std::vector<Mesh> readMeshes(const Model& model, const Scene& scene,
                             const std::map<std::size_t, std::string>& broken,
                             std::vector<std::string>& notes, const std::function<void()>& tally) {
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
        const std::vector<double> none(targetsOf(file));
        const std::string fault = faultOf([&] {
            meshes[m].weights = targetWeights(file.weights.empty() ? none : file.weights, none.size(),
                                              fmt::format("mesh {}", m));
        });
        if (!fault.empty()) {
            faults.emplace(m, fault);
            notes.push_back(fault + ": left out");
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
        if (task.fault.empty())
            task.fault = faultOf([&] {
                meshes[task.mesh].primitives[task.primitive] =
                    readPrimitive(model, fileOf(model, task), task.who(), use, task.notes);
            });
        tally();
    });
    bool any = false;
    for (Mesh& mesh : meshes) {
        std::erase_if(mesh.primitives, [](const Primitive& p) { return p.indices.empty(); });
        any = any || !mesh.primitives.empty();
    }
    collectFaults(tasks, faults, notes);
    if (!any && !faults.empty()) fail(faults.begin()->second);
    limitNotes(notes, before, "meshes");
    return meshes;
}

}  // namespace diptych::gltf
