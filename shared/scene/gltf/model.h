// SPDX-License-Identifier: MIT
#pragma once

#include <tiny_gltf.h>
#include <nlohmann/json.hpp>

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace diptych::gltf {

// A checked file. tinygltf loads the members of the base class, without extensions, extras, materials,
// samplers, textures and lights: these are in `rest`.
struct Model : tinygltf::Model {
    // The members of the checked document that tinygltf does not load, each in its place.
    nlohmann::json rest;

    // Decoded data by the index of its bufferView (EXT_meshopt_compression) or accessor
    // (KHR_draco_mesh_compression). `fault`: why there is none.
    struct DecodedView {
        std::vector<unsigned char> bytes;
        std::string fault;
    };
    std::map<int, DecodedView> decoded_views;
    std::map<int, std::vector<unsigned char>> decoded_accessors;

    // Bytes of the buffers and of decoded data.
    std::size_t dataBytes() const {
        std::size_t bytes = 0;
        for (const tinygltf::Buffer& buffer : buffers) bytes += buffer.data.size();
        for (const auto& [index, view] : decoded_views) bytes += view.bytes.size();
        for (const auto& [index, accessor] : decoded_accessors) bytes += accessor.size();
        return bytes;
    }
};

// Why a buffer's bytes are missing or incomplete, for errors on reading: "buffer 1: a.bin: no such file".
// Empty if complete. Loading is over, so the uri member can store the reason.
inline void setMissing(tinygltf::Buffer& buffer, std::string line) {
    buffer.uri = std::move(line);
}
inline const std::string& missing(const tinygltf::Buffer& buffer) {
    return buffer.uri;
}

}  // namespace diptych::gltf
