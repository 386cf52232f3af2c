// SPDX-License-Identifier: MIT
#include "shared/scene/gltf/compression.h"

#include "shared/scene/gltf/draco.h"
#include "shared/scene/gltf/meshopt.h"
#include "shared/scene/gltf/model.h"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

namespace diptych::gltf {

namespace {

// Limits the decoded size to 64 bytes per byte of the buffers plus 128 MiB. 64 is the best ratio of
// EXT_meshopt_compression (16 equal bytes take 2 bits); Draco's ratio is unbounded. A larger file has
// objects that share a stream, or a stream with a false size.
constexpr std::size_t freeBytes = std::size_t(128) << 20;
constexpr std::size_t bytesPerByte = 64;

}  // namespace

void decompress(Model& model, const std::vector<bool>& drawn, std::map<std::size_t, std::string>& broken,
                std::vector<std::string>& notes) {
    const std::size_t held = model.dataBytes();
    const std::size_t limit = freeBytes + bytesPerByte * held;

    std::map<std::size_t, std::string> undecoded;
    std::vector<MeshoptView> views = findMeshopt(model);
    const std::vector<DracoPrimitive> primitives = findDraco(model, drawn, undecoded);
    double claimed = 0;  // double, because the sum may exceed 64 bits
    for (const MeshoptView& view : views) claimed += static_cast<double>(view.count * view.stride);
    for (const DracoPrimitive& primitive : primitives) claimed += dracoCost(model, primitive);
    if (claimed > static_cast<double>(limit))
        throw std::runtime_error(fmt::format(
            "its compressed geometry claims {0:.0f} bytes; the limit for buffers of {2} bytes is {1}",
            claimed, limit, held));
    NoteList found("compressed bufferViews");
    decodeMeshopt(model, std::move(views), found);
    found.moveTo(notes);
    decodeDraco(model, primitives, limit, undecoded);
    NoteList omitted("compressed meshes");
    for (const auto& [mesh, line] : undecoded) omitted.add(line + ": the mesh is left out");
    omitted.moveTo(notes);
    broken.merge(undecoded);
}

}  // namespace diptych::gltf
