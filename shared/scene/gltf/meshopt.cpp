// SPDX-License-Identifier: MIT
#include "shared/scene/gltf/meshopt.h"

#include "shared/scene/gltf/model.h"
#include "shared/scene/gltf/value.h"
#include "shared/text/fail.h"

#include <fmt/format.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <map>

namespace diptych::gltf {

namespace {

using Mode = MeshoptView::Mode;
using Filter = MeshoptView::Filter;
using Bytes = std::vector<unsigned char>;
using Json = nlohmann::json;

constexpr const char* meshoptName = "EXT_meshopt_compression";

[[noreturn]] void failView(std::size_t view, const std::string& why) {
    fail(fmt::format("bufferView {}: {}", view, meshoptName), why);
}

// ---- the extension's rules ---------------------------------------------------------------------------

// Bytes of the stream, which must lie inside their buffer.
std::span<const unsigned char> streamOf(const Model& model, const Json& e, std::size_t view) {
    const auto index = e["buffer"].get<std::size_t>();
    const tinygltf::Buffer& buffer = model.buffers[index];
    if (buffer.data.empty() && !missing(buffer).empty()) failView(view, missing(buffer));
    const auto offset = e.value("byteOffset", std::size_t(0)), length = e["byteLength"].get<std::size_t>();
    if (offset > buffer.data.size() || length > buffer.data.size() - offset)
        failView(view, fmt::format("{} bytes at offset {} end past buffer {} ({} bytes)", length, offset,
                                   index, buffer.data.size()));
    return std::span(buffer.data).subspan(offset, length);
}

// Smallest possible stream: a header, the minimum for equal elements, and a tail. Source:
// EXT_meshopt_compression, appendix A.
std::size_t shortestStream(const MeshoptView& v) {
    if (v.mode == Mode::triangles) return 1 + v.count / 3 + 16;
    if (v.mode == Mode::indices) return 1 + v.count + 4;
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

    if (v.filter == Filter::octahedral) meshopt_decodeFilterOct(bytes.data(), v.count, v.stride);
    if (v.filter == Filter::quaternion) meshopt_decodeFilterQuat(bytes.data(), v.count, v.stride);
    if (v.filter == Filter::exponential) meshopt_decodeFilterExp(bytes.data(), v.count, v.stride);
    return bytes;
}

MeshoptView viewOf(const Model& model, const Json& e, std::size_t i) {
    static const std::map<std::string, Mode> modes{
        {"ATTRIBUTES", Mode::attributes}, {"TRIANGLES", Mode::triangles}, {"INDICES", Mode::indices}};
    static const std::map<std::string, Filter> filters{{"NONE", Filter::none},
                                                       {"OCTAHEDRAL", Filter::octahedral},
                                                       {"QUATERNION", Filter::quaternion},
                                                       {"EXPONENTIAL", Filter::exponential}};
    MeshoptView v{i,
                  streamOf(model, e, i),
                  e["count"].get<std::size_t>(),
                  e["byteStride"].get<std::size_t>(),
                  modes.at(e["mode"]),
                  filters.at(e.value("filter", "NONE"))};
    checkRules(v, model.bufferViews[i]);
    return v;
}

}  // namespace

std::vector<MeshoptView> findMeshopt(const Model& model) {
    std::vector<MeshoptView> views;
    const Json& files = arrayAt(model.rest, "/bufferViews");
    for (std::size_t i = 0; i < files.size(); ++i) {
        const Json* e = extension(files[i], meshoptName);
        if (!e) continue;
        MeshoptView& view = views.emplace_back(MeshoptView{.view = i});
        if (const std::string fault = faultOf([&] { view = viewOf(model, *e, i); }); !fault.empty())
            view.fault = fault;
    }
    return views;
}

void decodeMeshopt(Model& model, std::vector<MeshoptView> views, NoteList& notes) {
    std::vector<Bytes> results(views.size());
    forEachInParallel(views.size(), [&](std::size_t i) {
        if (views[i].fault.empty()) views[i].fault = faultOf([&] { results[i] = decoded(views[i]); });
    });
    for (std::size_t i = 0; i < views.size(); ++i) {
        if (!views[i].fault.empty()) notes.add(views[i].fault + ": the scene does not use it");
        model.decoded_views[static_cast<int>(views[i].view)] = {std::move(results[i]),
                                                                std::move(views[i].fault)};
    }
}

}  // namespace diptych::gltf
