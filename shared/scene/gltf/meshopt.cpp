// SPDX-License-Identifier: MIT
#include "shared/scene/gltf/meshopt.h"

#include "shared/text/fail.h"
#include "shared/text/one_line.h"

#include <fmt/format.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <stdexcept>

namespace diptych::gltf {

namespace {

using Mode = MeshoptView::Mode;
using Filter = MeshoptView::Filter;
using Bytes = std::vector<unsigned char>;

constexpr const char* meshoptName = "EXT_meshopt_compression";

std::string viewName(std::size_t view) {
    return fmt::format("bufferView {}: {}", view, meshoptName);
}

[[noreturn]] void failView(std::size_t view, const std::string& why) {
    fail(viewName(view), why);
}

// ---- the extension's rules ---------------------------------------------------------------------------

// Index of a member's text among the allowed words; `fallback` if absent.
template <class Enum, std::size_t n>
Enum choice(const tinygltf::Value& object, const char* key, const char* const (&words)[n],
            const char* fallback, std::size_t view) {
    const std::string word = !object.Has(key)              ? fallback
                             : !object.Get(key).IsString() ? ""
                                                           : object.Get(key).Get<std::string>();
    const auto at = std::find(std::begin(words), std::end(words), word);
    if (at == std::end(words)) failView(view, fmt::format("\"{}\" is not a {}", oneLine(word), key));
    return static_cast<Enum>(at - words);
}

// Bytes of the stream, which must lie inside their buffer.
std::span<const unsigned char> streamOf(const tinygltf::Model& model, const tinygltf::Value& e,
                                        std::size_t view) {
    const std::string who = viewName(view);
    const int index = checkedIndex(indexIn(e, "buffer", -1, who), model.buffers.size(), who, "buffer");
    if (index < 0) failView(view, "names no buffer");
    const tinygltf::Buffer& buffer = model.buffers[static_cast<std::size_t>(index)];
    if (buffer.data.empty() && !missing(buffer).empty()) failView(view, missing(buffer));
    const auto offset = static_cast<std::size_t>(indexIn(e, "byteOffset", 0, who));
    const auto length = static_cast<std::size_t>(indexIn(e, "byteLength", 0, who));
    if (offset > buffer.data.size() || length > buffer.data.size() - offset)
        failView(view, fmt::format("{} bytes at offset {} end past buffer {} ({} bytes)", length, offset,
                                   index, buffer.data.size()));
    return std::span(buffer.data).subspan(offset, length);
}

// Smallest possible stream: a header, the minimum for equal elements, and a tail. Source:
// EXT_meshopt_compression, appendix A.
std::size_t shortestStream(const MeshoptView& v) {
    switch (v.mode) {
        case Mode::triangles:
            return 1 + v.count / 3 + 16;
        case Mode::indices:
            return 1 + v.count + 4;
        case Mode::attributes:
            break;
    }
    const std::size_t perBlock = std::min<std::size_t>((8192 / v.stride) & ~std::size_t(15), 256);
    const auto headers = [](std::size_t elements) { return ((elements + 15) / 16 + 3) / 4; };  // bytes
    const std::size_t all = v.count / perBlock * headers(perBlock) + headers(v.count % perBlock);
    return 1 + all * v.stride + std::max<std::size_t>(v.stride, 32);
}

void checkRules(const MeshoptView& v, const tinygltf::BufferView& parent) {
    const auto require = [&](bool holds, const std::string& rule) {
        if (!holds) failView(v.view, rule);
    };
    const auto stride = [&](const char* rule) {
        return fmt::format("byteStride {}, not {}", v.stride, rule);
    };
    if (v.mode == Mode::attributes) {
        require(v.stride > 0 && v.stride % 4 == 0 && v.stride <= 256, stride("a multiple of 4 up to 256"));
    } else {
        require(v.stride == 2 || v.stride == 4, stride("2 or 4"));
        require(v.filter == Filter::none, "indices must not have a filter");
    }
    if (v.mode == Mode::triangles)
        require(v.count % 3 == 0, fmt::format("{} indices are not a multiple of 3", v.count));
    if (v.filter == Filter::octahedral) require(v.stride == 4 || v.stride == 8, stride("4 or 8"));
    if (v.filter == Filter::quaternion) require(v.stride == 8, stride("8"));
    require(v.count > 0, "has no elements");
    require(parent.byteStride == 0 || parent.byteStride == v.stride,
            fmt::format("byteStride {}, but the bufferView's is {}", v.stride, parent.byteStride));
    // Cannot overflow: a 31-bit count times a 9-bit stride.
    require(v.count * v.stride == parent.byteLength,
            fmt::format("{} elements of {} bytes, but the bufferView has {} bytes", v.count, v.stride,
                        parent.byteLength));
    require(v.stream.size() >= shortestStream(v),
            fmt::format("{} bytes are too few for {} elements", v.stream.size(), v.count));
}

// ---- decoding ----------------------------------------------------------------------------------------

Bytes decoded(const MeshoptView& v) {
    Bytes bytes(v.count * v.stride);
    const unsigned char* stream = v.stream.data();
    const std::size_t size = v.stream.size();
    const int result = v.mode == Mode::attributes
                           ? meshopt_decodeVertexBuffer(bytes.data(), v.count, v.stride, stream, size)
                       : v.mode == Mode::triangles
                           ? meshopt_decodeIndexBuffer(bytes.data(), v.count, v.stride, stream, size)
                           : meshopt_decodeIndexSequence(bytes.data(), v.count, v.stride, stream, size);
    // Error codes of the library.
    if (result == -1) failView(v.view, "its data has another mode");
    if (result == -2) failView(v.view, "its data is too short for its elements");
    if (result != 0) failView(v.view, "its data has the wrong length for its elements");

    switch (v.filter) {
        case Filter::none:
            break;
        case Filter::octahedral:
            meshopt_decodeFilterOct(bytes.data(), v.count, v.stride);
            break;
        case Filter::quaternion:
            meshopt_decodeFilterQuat(bytes.data(), v.count, v.stride);
            break;
        case Filter::exponential:
            meshopt_decodeFilterExp(bytes.data(), v.count, v.stride);
            break;
    }
    return bytes;
}

MeshoptView viewOf(const tinygltf::Model& model, const tinygltf::Value& e, std::size_t i) {
    static constexpr const char* modes[] = {"ATTRIBUTES", "TRIANGLES", "INDICES"};
    static constexpr const char* filters[] = {"NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL"};
    MeshoptView v{i,
                  streamOf(model, e, i),
                  static_cast<std::size_t>(indexIn(e, "count", 0, viewName(i))),
                  static_cast<std::size_t>(indexIn(e, "byteStride", 0, viewName(i))),
                  choice<Mode>(e, "mode", modes, "", i),
                  choice<Filter>(e, "filter", filters, "NONE", i)};
    checkRules(v, model.bufferViews[i]);
    return v;
}

// Gives the view its own buffer: decoded bytes, or an error that is thrown on reading.
void give(tinygltf::Model& model, std::size_t view, Bytes bytes, std::string line) {
    tinygltf::BufferView& file = model.bufferViews[view];
    file.buffer = static_cast<int>(model.buffers.size());
    file.byteOffset = 0;
    file.extensions.erase(meshoptName);
    tinygltf::Buffer& buffer = model.buffers.emplace_back();
    buffer.data = std::move(bytes);
    setMissing(buffer, std::move(line));
}

}  // namespace

std::vector<MeshoptView> findMeshopt(const tinygltf::Model& model) {
    std::vector<MeshoptView> views;
    for (std::size_t i = 0; i < model.bufferViews.size(); ++i) {
        const tinygltf::Value* e = extension(model.bufferViews[i].extensions, meshoptName);
        if (!e) continue;
        try {
            views.push_back(viewOf(model, *e, i));
        } catch (const std::runtime_error& error) {
            views.push_back({.view = i, .fault = error.what()});
        }
    }
    return views;
}

void decodeMeshopt(tinygltf::Model& model, std::vector<MeshoptView> views, NoteList& notes) {
    std::vector<Bytes> results(views.size());
    forEachInParallel(views.size(), [&](std::size_t i) {
        if (!views[i].fault.empty()) return;
        try {
            results[i] = decoded(views[i]);
        } catch (const std::runtime_error& e) {
            views[i].fault = e.what();
        }
    });
    for (std::size_t i = 0; i < views.size(); ++i) {
        if (!views[i].fault.empty()) notes.add(views[i].fault + ": the scene does not use it");
        give(model, views[i].view, std::move(results[i]), std::move(views[i].fault));
    }
}

}  // namespace diptych::gltf
