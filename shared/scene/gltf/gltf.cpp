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
#include "shared/scene/gltf/texture.h"
#include "shared/scene/gltf/value.h"
#include "shared/scene/motion/instances.h"
#include "shared/scene/motion/pose.h"
#include "shared/text/counted.h"
#include "shared/text/fail.h"
#include "shared/text/named.h"

#include <fmt/format.h>

#include <atomic>
#include <cstdint>
#include <mutex>
#include <stdexcept>

namespace diptych {

namespace {

// Reads the encoded bytes of the images that materials use.
void fetchImages(gltf::Document& document, const std::vector<int>& imageOf,
                 std::vector<std::string>& sceneNotes) {
    std::atomic<std::uint64_t> held = 0;
    std::vector<std::vector<std::string>> notes(imageOf.size());
    gltf::forEachInParallel(imageOf.size(), [&](std::size_t i) {
        tinygltf::Image& image = document.model.images[static_cast<std::size_t>(imageOf[i])];
        const std::string who = fmt::format("image {}", imageOf[i]);
        if (image.uri.empty() && image.bufferView < 0) fail(who, "has no uri or bufferView");
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
                fail(fmt::format("the image files together exceed the limit of {} bytes",
                                 gltf::MAX_ENCODED_IMAGE_BYTES));
        } catch (const std::runtime_error& e) {
            fail(who, e.what());
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

Scene readScene(std::vector<unsigned char> bytes, const std::filesystem::path& folder,
                const std::string& choice, const std::string& variant, const LoadProgress& progress) {
    std::uint64_t held = bytes.size();
    gltf::Document document = gltf::open(std::move(bytes), folder, variant);
    Scene scene;
    gltf::NoteList unsupported("extensions");
    for (const std::string& name : document.ignored_extensions)
        unsupported.add(
            fmt::format("{}: left out, not supported{}", name,
                        name == "KHR_lights_image_based" ? "; --env FILE sets an environment" : ""));
    unsupported.moveTo(scene.notes);
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
    std::atomic<std::size_t> done = 0;
    const auto tally = [&] {
        const std::size_t now = ++done;
        if (progress) progress(static_cast<double>(now) / static_cast<double>(pieces), "images and meshes");
    };
    std::vector<std::string> meshNotes, imageNotes;
    const std::vector<bool> lightmaps = gltf::lightmapsAlone(scene);
    gltf::forEachInParallel(2, [&](std::size_t i) {
        if (i == 0)
            scene.meshes = gltf::readMeshes(model, scene, document.broken_meshes, meshNotes, tally);
        else
            claims = gltf::readImages(model, imageOf, lightmaps, scene.images, imageNotes, tally);
    });
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
        return readScene(firstBytesOf(path, gltf::MAX_FILE_BYTES),
                         path.has_parent_path() ? path.parent_path() : ".", scene, variant, progress);
    });
}

void checkGltf(const std::string& file, const std::string& variant) {
    named(file, [&] { gltf::checkHeader(firstBytesOf(file, gltf::MAX_FILE_BYTES), variant); });
}

Scene parseGltf(std::vector<unsigned char> bytes, const std::string& name,
                const std::filesystem::path& folder) {
    return named(name, [&] { return readScene(std::move(bytes), folder, "", "", {}); });
}

}  // namespace diptych
