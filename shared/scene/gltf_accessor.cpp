// SPDX-License-Identifier: MIT
#include "shared/scene/gltf_accessor.h"

#include "shared/scene/gltf_value.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <type_traits>

namespace diptych::gltf {

namespace {

// More elements than this from an accessor without a bufferView (all zeros, but for its sparse ones) cost
// the file nothing and the reader gigabytes.
constexpr std::size_t maxZeros = std::size_t(1) << 24;

[[noreturn]] void fail(const std::string& who, const std::string& why) {
    throw std::runtime_error(who + ": " + why);
}

std::size_t componentBytes(int type) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return 1;
        case TINYGLTF_COMPONENT_TYPE_SHORT:
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return 2;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        case TINYGLTF_COMPONENT_TYPE_FLOAT:
            return 4;
        default:
            return 0;
    }
}

std::size_t componentsOf(int type) {
    switch (type) {
        case TINYGLTF_TYPE_SCALAR:
            return 1;
        case TINYGLTF_TYPE_VEC2:
            return 2;
        case TINYGLTF_TYPE_VEC3:
            return 3;
        case TINYGLTF_TYPE_VEC4:
            return 4;
        default:
            return 0;
    }
}

struct Elements {
    const unsigned char* first;
    std::size_t stride, count;
};

// `count` elements of `size` bytes from `offset` in a bufferView on; `stride` 0 is side by side.
Elements locate(const tinygltf::Model& model, int view, std::size_t offset, std::size_t count,
                std::size_t size, std::size_t stride, const std::string& who, const char* noun) {
    const std::span<const unsigned char> bytes = viewBytes(model, view, who);
    if (stride == 0) stride = size;
    if (stride < size)
        fail(who,
             fmt::format("{} of {} bytes, but bufferView {} has a stride of {}", noun, size, view, stride));
    if (count == 0) return {bytes.data(), stride, 0};
    if (offset > bytes.size() || size > bytes.size() - offset ||
        count - 1 > (bytes.size() - offset - size) / stride) {
        const bool countable = offset <= std::numeric_limits<std::size_t>::max() / 4 &&
                               count - 1 < std::numeric_limits<std::size_t>::max() / 4 / stride;
        fail(who, fmt::format("{} {} of {} bytes end at {}, past bufferView {} ({} bytes)", count, noun, size,
                              countable ? fmt::format("{}", offset + (count - 1) * stride + size)
                                        : "a number too large",
                              view, bytes.size()));
    }
    return {bytes.data() + offset, stride, count};
}

template <class T>
T load(const unsigned char* at) {
    T value;
    std::memcpy(&value, at, sizeof value);
    return value;
}

// Calls use(T{}) with the component type's C++ type.
template <class Use>
void withType(int type, const Use& use) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return use(std::int8_t{});
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return use(std::uint8_t{});
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return use(std::int16_t{});
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return use(std::uint16_t{});
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return use(std::uint32_t{});
        default:
            return use(float{});
    }
}

template <class Vec>
void copyVectors(const Elements& from, int type, bool normalized, const auto& destination) {
    withType(type, [&](auto sample) {
        using T = decltype(sample);
        for (std::size_t i = 0; i < from.count; ++i) {
            Vec& out = destination(i);
            for (int c = 0; c < Vec::length(); ++c) {
                const T value =
                    load<T>(from.first + i * from.stride + static_cast<std::size_t>(c) * sizeof(T));
                if constexpr (std::is_integral_v<T>)
                    out[c] = normalized ? std::max(static_cast<float>(value) /
                                                       static_cast<float>(std::numeric_limits<T>::max()),
                                                   -1.0f)
                                        : static_cast<float>(value);
                else
                    out[c] = value;
            }
        }
    });
}

std::vector<std::uint32_t> copyIndices(const Elements& from, int type) {
    std::vector<std::uint32_t> result(from.count);
    withType(type, [&](auto sample) {
        using T = decltype(sample);
        if constexpr (std::is_unsigned_v<T>)
            for (std::size_t i = 0; i < from.count; ++i) result[i] = load<T>(from.first + i * from.stride);
    });
    return result;
}

bool isIndexType(int type) {
    return type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
           type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

const tinygltf::Accessor& accessorAt(const tinygltf::Model& model, int index, const std::string& who) {
    if (checkedIndex(index, model.accessors.size(), who, "accessor") < 0) fail(who, "names no accessor");
    return model.accessors[static_cast<std::size_t>(index)];
}

std::size_t strideOf(const tinygltf::Model& model, int view) {
    if (view < 0 || static_cast<std::size_t>(view) >= model.bufferViews.size())
        return 0;  // viewBytes refuses it
    return model.bufferViews[static_cast<std::size_t>(view)].byteStride;
}

template <class Vec>
void replaceSparse(const tinygltf::Model& model, const tinygltf::Accessor& a, std::vector<Vec>& result,
                   const std::string& who) {
    const auto& sparse = a.sparse;
    if (sparse.count < 0 || sparse.indices.byteOffset < 0 || sparse.values.byteOffset < 0)
        fail(who, "its sparse count or an offset is negative");
    if (!isIndexType(sparse.indices.componentType)) fail(who, "its sparse indices are of no index type");
    const auto count = static_cast<std::size_t>(sparse.count);
    const std::size_t bytes = componentBytes(a.componentType) * componentsOf(a.type);
    const std::vector<std::uint32_t> indices = copyIndices(
        locate(model, sparse.indices.bufferView, static_cast<std::size_t>(sparse.indices.byteOffset), count,
               componentBytes(sparse.indices.componentType), 0, who, "sparse indices"),
        sparse.indices.componentType);
    const Elements values =
        locate(model, sparse.values.bufferView, static_cast<std::size_t>(sparse.values.byteOffset), count,
               bytes, 0, who, "sparse values");
    for (const std::uint32_t index : indices)
        if (index >= result.size())
            fail(who, fmt::format("sparse index {} of {} elements", index, result.size()));
    copyVectors<Vec>(values, a.componentType, a.normalized,
                     [&](std::size_t i) -> Vec& { return result[indices[i]]; });
}

}  // namespace

std::span<const unsigned char> viewBytes(const tinygltf::Model& model, int index, const std::string& who) {
    if (checkedIndex(index, model.bufferViews.size(), who, "bufferView") < 0)
        fail(who, "names no bufferView");
    const tinygltf::BufferView& view = model.bufferViews[static_cast<std::size_t>(index)];
    const std::string name = fmt::format("bufferView {}", index);
    if (checkedIndex(view.buffer, model.buffers.size(), name, "buffer") < 0) fail(name, "names no buffer");
    const std::vector<unsigned char>& data = model.buffers[static_cast<std::size_t>(view.buffer)].data;
    if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset)
        fail(name, fmt::format("{} bytes from {} on end past buffer {} ({} bytes)", view.byteLength,
                               view.byteOffset, view.buffer, data.size()));
    return std::span(data).subspan(view.byteOffset, view.byteLength);
}

template <class Vec>
std::vector<Vec> readVectors(const tinygltf::Model& model, int index, const std::string& asks) {
    const tinygltf::Accessor& a = accessorAt(model, index, asks);
    const std::string who = fmt::format("accessor {}", index);
    const std::size_t bytes = componentBytes(a.componentType) * componentsOf(a.type);
    if (componentsOf(a.type) != static_cast<std::size_t>(Vec::length()))
        fail(asks, fmt::format("accessor {} is not VEC{}", index, Vec::length()));
    if (bytes == 0 || a.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)
        fail(asks, fmt::format("accessor {} has component type {}, which no attribute may have", index,
                               a.componentType));

    std::vector<Vec> result;
    if (a.bufferView >= 0) {
        const Elements elements = locate(model, a.bufferView, a.byteOffset, a.count, bytes,
                                         strideOf(model, a.bufferView), who, "vertices");
        result.resize(elements.count);
        copyVectors<Vec>(elements, a.componentType, a.normalized,
                         [&](std::size_t i) -> Vec& { return result[i]; });
    } else {
        if (a.count > maxZeros)
            fail(who, fmt::format("{} vertices without a bufferView: at most {}", a.count, maxZeros));
        result.assign(a.count, Vec(0));
    }
    if (a.sparse.isSparse) replaceSparse(model, a, result, who);
    return result;
}

template std::vector<glm::vec2> readVectors(const tinygltf::Model&, int, const std::string&);
template std::vector<glm::vec3> readVectors(const tinygltf::Model&, int, const std::string&);
template std::vector<glm::vec4> readVectors(const tinygltf::Model&, int, const std::string&);

std::vector<glm::vec4> readColors(const tinygltf::Model& model, int accessor, const std::string& who) {
    if (accessorAt(model, accessor, who).type != TINYGLTF_TYPE_VEC3)
        return readVectors<glm::vec4>(model, accessor, who);
    std::vector<glm::vec4> result;
    for (const glm::vec3& color : readVectors<glm::vec3>(model, accessor, who))
        result.emplace_back(color, 1.0f);
    return result;
}

std::vector<std::uint32_t> readIndices(const tinygltf::Model& model, int index, const std::string& asks) {
    const tinygltf::Accessor& a = accessorAt(model, index, asks);
    if (a.type != TINYGLTF_TYPE_SCALAR || !isIndexType(a.componentType))
        fail(asks, fmt::format("accessor {} is not SCALAR of unsigned integers", index));
    if (a.sparse.isSparse) fail(asks, fmt::format("accessor {} is sparse, which indices may not be", index));
    return copyIndices(locate(model, a.bufferView, a.byteOffset, a.count, componentBytes(a.componentType),
                              strideOf(model, a.bufferView), fmt::format("accessor {}", index), "indices"),
                       a.componentType);
}

}  // namespace diptych::gltf
