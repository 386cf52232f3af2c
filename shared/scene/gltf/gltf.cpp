// SPDX-License-Identifier: MIT
#include "shared/scene/gltf/gltf.h"

#include "shared/image/claims.h"
#include "shared/image/file_bytes.h"
#include "shared/scene/gltf/compression.h"
#include "shared/scene/gltf/file.h"
#include "shared/scene/gltf/limits.h"
#include "shared/scene/gltf/material.h"
#include "shared/scene/gltf/mesh.h"
#include "shared/scene/gltf/motion.h"
#include "shared/scene/gltf/node.h"
#include "shared/scene/gltf/note_list.h"
#include "shared/scene/gltf/schema.h"
#include "shared/scene/gltf/tally.h"
#include "shared/scene/gltf/texture.h"
#include "shared/scene/gltf/value.h"
#include "shared/scene/motion/instances.h"
#include "shared/scene/motion/pose.h"
#include "shared/text/counted.h"
#include "shared/text/named.h"

#include <fmt/format.h>
#include <tbb/parallel_invoke.h>

#include <atomic>
#include <cstdint>
#include <mutex>
#include <stdexcept>

namespace diptych {

namespace {

void noteWhatIsLeftOut(const gltf::Document& document, std::vector<std::string>& notes) {
    for (const std::string& name : document.left_out)
        notes.push_back(
            fmt::format("{}: left out, not supported{}", name,
                        name == "KHR_lights_image_based" ? "; --env FILE sets an environment" : ""));
    gltf::limitNotes(notes, 0, "extensions");
}

// Reads the encoded bytes of the images that materials use.
void fetchImages(gltf::Document& document, const std::vector<int>& imageOf,
                 std::vector<std::string>& sceneNotes) {
    std::atomic<std::uint64_t> held = 0;
    std::vector<std::vector<std::string>> notes(imageOf.size());
    gltf::forEachInParallel(imageOf.size(), [&](std::size_t i) {
        tinygltf::Image& image = document.model.images[static_cast<std::size_t>(imageOf[i])];
        if (image.uri.empty() && image.bufferView < 0)
            throw std::runtime_error(fmt::format("image {}: has no uri or bufferView", imageOf[i]));
        if (image.uri.empty()) return;
        const std::string uri = std::move(image.uri);
        image.uri = gltf::uriName(uri);
        if (image.bufferView >= 0) return;
        try {
            const std::uint64_t left =
                gltf::MAX_ENCODED_IMAGE_BYTES - std::min(held.load(), gltf::MAX_ENCODED_IMAGE_BYTES);
            // One byte more than allowed, to detect files that are too long.
            image.image = document.resources.read(uri, left + 1, notes[i]);
            if ((held += image.image.size()) > gltf::MAX_ENCODED_IMAGE_BYTES)
                throw std::runtime_error(fmt::format("the image files together exceed the limit of {} bytes",
                                                     gltf::MAX_ENCODED_IMAGE_BYTES));
        } catch (const std::runtime_error& e) {
            throw std::runtime_error(fmt::format("image {}: {}", imageOf[i], e.what()));
        }
    });
    gltf::NoteList list("images");
    for (std::size_t i = 0; i < notes.size(); ++i)
        for (const std::string& note : notes[i]) list.add(fmt::format("image {}: {}", imageOf[i], note));
    list.moveTo(sceneNotes);
}

std::vector<bool> drawnMeshes(const Scene& scene, std::size_t count) {
    std::vector<bool> drawn(count, false);
    for (const Node& node : scene.nodes)
        if (node.mesh >= 0) drawn[static_cast<std::size_t>(node.mesh)] = true;
    return drawn;
}

// A few nodes and primitives may have many instances, each with a transform.
Claim claimInstances(const Scene& scene, const gltf::Model& model, std::uint64_t held) {
    std::uint64_t instances = 0;
    for (const Node& node : scene.nodes)
        if (node.mesh >= 0)
            instances += model.meshes[static_cast<std::size_t>(node.mesh)].primitives.size() *
                         (node.copies >= 0 ? scene.copies[static_cast<std::size_t>(node.copies)].size() : 1);
    return claimMemory(instances * sizeof(Instance), held, counted(instances, "instance"));
}

// Keeps the claims of the scene in use; another may be read meanwhile.
void keepClaims(std::vector<Claim> claims) {
    static std::mutex mutex;
    static std::vector<Claim> kept;
    const std::lock_guard lock(mutex);
    kept = std::move(claims);
}

// `held`: bytes of the file.
Scene readScene(gltf::Document document, const std::string& choice, const LoadProgress& progress,
                std::uint64_t held) {
    Scene scene;
    noteWhatIsLeftOut(document, scene.notes);
    scene.notes.insert(scene.notes.end(), document.notes.begin(), document.notes.end());
    scene.variants = std::move(document.variants.names);
    scene.variant = document.variants.chosen;
    if (progress) progress(0, "geometry");
    const int chosen = gltf::chooseScene(document.model, choice, scene.notes);
    const std::vector<int> sceneNode = gltf::readNodes(document.model, chosen, scene);
    if (chosen >= 0)
        scene.environment = gltf::readImageLight(document.image_lights, static_cast<std::size_t>(chosen),
                                                 document.model, document.resources, scene.notes);
    gltf::decompress(document.model, drawnMeshes(scene, document.model.meshes.size()), document.broken_meshes,
                     scene.notes);
    gltf::readMotion(document.model, sceneNode, scene);
    held += document.model.dataBytes();
    std::vector<Claim> claims;
    const Claim claimOfInstances = claimInstances(scene, document.model, held);
    std::vector<int> imageOf;
    gltf::readMaterials(document.model, scene, imageOf);
    fetchImages(document, imageOf, scene.notes);

    // Images and meshes are decoded concurrently. Exceptions are rethrown after both have ended, the
    // meshes' first.
    const gltf::Model& model = document.model;
    std::size_t pieces = imageOf.size();
    for (const tinygltf::Mesh& mesh : model.meshes) pieces += mesh.primitives.size();
    gltf::Tally tally(pieces, "images and meshes", progress);
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
    const auto meshes = [&] {
        scene.meshes = gltf::readMeshes(model, scene, document.broken_meshes, meshNotes, tally);
    };
    const std::vector<bool> lightmaps = gltf::lightmapsAlone(scene);
    const auto images = [&] {
        claims = gltf::readImages(model, imageOf, lightmaps, scene.images, imageNotes, tally);
    };
    tbb::parallel_invoke(guarded(meshFailure, meshes), guarded(imageFailure, images));
    for (const std::exception_ptr& failure : {meshFailure, imageFailure})
        if (failure) std::rethrow_exception(failure);
    for (const std::vector<std::string>* notes : {&imageNotes, &meshNotes})
        scene.notes.insert(scene.notes.end(), notes->begin(), notes->end());
    leaveOutWhatIsBeyond(scene);
    claims.push_back(claimOfInstances);
    keepClaims(std::move(claims));
    return scene;
}

}  // namespace

Scene loadGltf(const std::string& file, const std::string& scene, const std::string& variant,
               const LoadProgress& progress) {
    return named(file, [&] {
        const std::filesystem::path path(file);
        const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
        std::vector<unsigned char> bytes = firstBytesOf(path, gltf::MAX_FILE_BYTES);
        const std::uint64_t held = bytes.size();
        return readScene(gltf::open(std::move(bytes), folder, variant), scene, progress, held);
    });
}

void checkGltf(const std::string& file, const std::string& variant) {
    named(file, [&] { gltf::checkHeader(firstBytesOf(file, gltf::MAX_FILE_BYTES), variant); });
}

Scene parseGltf(std::vector<unsigned char> bytes, const std::string& name,
                const std::filesystem::path& folder) {
    const std::uint64_t held = bytes.size();
    return named(name, [&] { return readScene(gltf::open(std::move(bytes), folder, ""), "", {}, held); });
}

}  // namespace diptych
