// SPDX-License-Identifier: MIT
#include "shared/scene/gltf.h"

#include "shared/scene/gltf_file.h"
#include "shared/scene/gltf_material.h"
#include "shared/scene/gltf_mesh.h"
#include "shared/scene/gltf_node.h"
#include "shared/scene/gltf_value.h"

#include <fmt/format.h>
#include <tbb/parallel_invoke.h>

#include <stdexcept>

namespace diptych {

namespace {

void noteWhatIsLeftOut(const tinygltf::Model& model, std::vector<std::string>& notes) {
    for (const std::string& name : model.extensionsUsed)
        if (!gltf::isBuilt(name)) notes.push_back(fmt::format("{}: left out, it is not built", name));
    if (!model.animations.empty())
        notes.push_back(fmt::format("{} animation{}: left out, animation is not built yet",
                                    model.animations.size(), model.animations.size() == 1 ? "" : "s"));
}

Scene readScene(const std::string& file) {
    const tinygltf::Model model = gltf::openFile(file);
    Scene scene;
    scene.name = file;
    noteWhatIsLeftOut(model, scene.notes);
    gltf::readNodes(model, scene);
    std::vector<int> imageOf;
    gltf::readMaterials(model, scene, imageOf);

    // Pixels and vertices know nothing of each other; each fails only after the other has ended, meshes
    // first.
    std::exception_ptr meshFailure, imageFailure;
    std::vector<std::string> meshNotes, imageNotes;
    const auto guarded = [](std::exception_ptr& failure, const auto& run) {
        return [&failure, &run] {
            try {
                run();
            } catch (...) {
                failure = std::current_exception();
            }
        };
    };
    const auto meshes = [&] { scene.meshes = gltf::readMeshes(model, scene.materials, meshNotes); };
    const auto images = [&] { gltf::readImages(model, imageOf, scene.images, imageNotes); };
    tbb::parallel_invoke(guarded(meshFailure, meshes), guarded(imageFailure, images));
    for (const std::exception_ptr& failure : {meshFailure, imageFailure})
        if (failure) std::rethrow_exception(failure);
    scene.notes.insert(scene.notes.end(), meshNotes.begin(), meshNotes.end());
    scene.notes.insert(scene.notes.end(), imageNotes.begin(), imageNotes.end());
    return scene;
}

}  // namespace

Scene loadGltf(const std::string& file) {
    try {
        return readScene(file);
    } catch (const std::bad_alloc&) {
        throw std::runtime_error(file + ": does not fit in memory");
    } catch (const std::exception& e) {
        throw std::runtime_error(file + ": " + e.what());
    }
}

}  // namespace diptych
