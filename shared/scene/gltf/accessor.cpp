// SPDX-License-Identifier: MIT
#include "shared/scene/gltf/accessor.h"

#include "shared/scene/gltf/limits.h"
#include "shared/scene/gltf/model.h"
#include "shared/text/fail.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <type_traits>

namespace diptych::gltf {

namespace {

// ---- shapes ------------------------------------------------------------------------------------------

std::size_t componentBytes(int type) {
    return static_cast<std::size_t>(tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(type)));
}

// Matrix columns are aligned to 4 bytes (glTF 2.0, 3.6.2.4). A vector is one column.
struct Shape {
    std::size_t columns = 0, rows = 0, component_bytes = 0;
    std::size_t width() const { return columns * rows; }
    std::size_t columnStride() const {
        const std::size_t bytes = rows * component_bytes;
        return columns > 1 ? (bytes + 3) / 4 * 4 : bytes;
    }
    std::size_t bytes() const { return (columns - 1) * columnStride() + rows * component_bytes; }
    std::size_t at(std::size_t i) const {  // byte offset of component i
        return i / rows * columnStride() + i % rows * component_bytes;
    }
};

Shape shapeOf(const tinygltf::Accessor& a) {
    const bool matrix =
        a.type == TINYGLTF_TYPE_MAT2 || a.type == TINYGLTF_TYPE_MAT3 || a.type == TINYGLTF_TYPE_MAT4;
    const auto width =
        static_cast<std::size_t>(tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(a.type)));
    const std::size_t columns = !matrix ? 1 : width == 4 ? 2 : width == 9 ? 3 : 4;
    return {columns, width / columns, componentBytes(a.componentType)};
}

bool isIndexType(int type) {
    return type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
           type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

// ---- where elements are ------------------------------------------------------------------------------

struct Elements {
    const unsigned char* first = nullptr;
    std::size_t stride = 0, count = 0;
    const unsigned char* at(std::size_t i) const { return first + i * stride; }
};

// Elements in a bufferView, bytes.
struct ElementLayout {
    std::size_t offset, count, size, stride;
};

// The bytes that contain a bufferView.
struct ViewSource {
    std::span<const unsigned char> data;
    std::size_t offset;
    const std::string& fault;  // why bytes are missing
};
ViewSource sourceOf(const Model& model, int index) {
    const auto decoded = model.decoded_views.find(index);
    if (decoded != model.decoded_views.end()) return {decoded->second.bytes, 0, decoded->second.fault};
    const tinygltf::BufferView& view = model.bufferViews[static_cast<std::size_t>(index)];
    const tinygltf::Buffer& buffer = model.buffers[static_cast<std::size_t>(view.buffer)];
    return {buffer.data, view.byteOffset, missing(buffer)};
}

// Checks that the elements lie inside a bufferView.
Elements locate(const Model& model, int view, const ElementLayout& e, const std::string& who,
                const char* noun) {
    const std::span<const unsigned char> bytes = viewBytes(model, view);
    if (e.stride < e.size)
        fail(who, fmt::format("{} of {} bytes, but bufferView {} has a stride of {}", noun, e.size, view,
                              e.stride));
    if (e.count == 0) return {bytes.data(), e.stride, 0};
    if (e.offset > bytes.size() || e.size > bytes.size() - e.offset ||
        e.count - 1 > (bytes.size() - e.offset - e.size) / e.stride) {
        if (const std::string cut = cutOf(model, view); !cut.empty()) throw std::runtime_error(cut);
        const bool countable = e.offset <= std::numeric_limits<std::size_t>::max() / 4 &&
                               e.count - 1 < std::numeric_limits<std::size_t>::max() / 4 / e.stride;
        fail(who,
             fmt::format("{} {} of {} bytes end at {}, past bufferView {} ({} bytes)", e.count, noun, e.size,
                         countable ? fmt::format("{}", e.offset + (e.count - 1) * e.stride + e.size)
                                   : "a number too large",
                         view, bytes.size()));
    }
    return {bytes.data() + e.offset, e.stride, e.count};
}

template <class T>
T load(const unsigned char* at) {
    T value;
    std::memcpy(&value, at, sizeof value);
    return value;
}

// Calls use(T{}) with the C++ type T of the component type.
template <class Use>
auto withType(int type, const Use& use) {
    if (type == TINYGLTF_COMPONENT_TYPE_BYTE) return use(std::int8_t{});
    if (type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE) return use(std::uint8_t{});
    if (type == TINYGLTF_COMPONENT_TYPE_SHORT) return use(std::int16_t{});
    if (type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT) return use(std::uint16_t{});
    if (type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT) return use(std::uint32_t{});
    return use(float{});
}

// glTF 2.0, 3.11: the most negative integer maps to -1, too.
template <class T>
float number(const unsigned char* at, bool normalized) {
    const T value = load<T>(at);
    if constexpr (std::is_integral_v<T>)
        if (normalized)
            return std::max(static_cast<float>(value) / static_cast<float>(std::numeric_limits<T>::max()),
                            -1.0f);
    return static_cast<float>(value);
}

// An accessor whose elements have all been checked to lie inside their bufferViews.
class SoundAccessor {
public:
    // `width`: required number of components; 0: any.
    SoundAccessor(const Model& model, int index, const std::string& asks, const char* noun,
                  std::size_t width = 0)
        : file_(model.accessors[static_cast<std::size_t>(index)]),
          who_(fmt::format("accessor {}", index)),
          shape_(shapeOf(file_)) {
        if (width && (shape_.columns != 1 || shape_.rows != width))
            fail(asks,
                 fmt::format("{} is not {}", who_, width == 1 ? "SCALAR" : fmt::format("VEC{}", width)));
        if (const auto decoded = model.decoded_accessors.find(index);
            decoded != model.decoded_accessors.end()) {
            if (decoded->second.size() / shape_.bytes() < file_.count)
                fail(who_, fmt::format("{} bytes are decoded for {} {} of {} bytes", decoded->second.size(),
                                       file_.count, noun, shape_.bytes()));
            own_ = {decoded->second.data(), shape_.bytes(), file_.count};
        } else if (file_.bufferView >= 0) {
            const std::size_t stride =
                model.bufferViews[static_cast<std::size_t>(file_.bufferView)].byteStride;
            own_ = locate(model, file_.bufferView,
                          {file_.byteOffset, file_.count, shape_.bytes(),
                           stride ? stride : shape_.columns * shape_.columnStride()},
                          who_, noun);
        } else if (file_.count > MAX_ZERO_ELEMENTS) {
            fail(who_, fmt::format("{} {} without a bufferView; the limit is {}", file_.count, noun,
                                   MAX_ZERO_ELEMENTS));
        }
        if (file_.sparse.isSparse) locateSparse(model);
    }

    const tinygltf::Accessor& file() const { return file_; }
    const Shape& shape() const { return shape_; }
    std::size_t size(const Selection& which) const { return which ? which->size() : file_.count; }

    // Calls put(i, bytes of element which[i]) for each element, sparse elements last. Elements without
    // bytes are 0 and are skipped.
    template <class Put>
    void visit(const Selection& which, const Put& put) const {
        if (own_.first)
            for (std::size_t i = 0; i < size(which); ++i) put(i, own_.at(which ? (*which)[i] : i));
        for (std::size_t s = 0; s < sparse_values_.count; ++s) {
            const std::uint32_t index = sparseIndex(s);
            if (!which) {
                put(index, sparse_values_.at(s));
                continue;
            }
            const auto at = std::lower_bound(which->begin(), which->end(), index);
            if (at != which->end() && *at == index)
                put(static_cast<std::size_t>(at - which->begin()), sparse_values_.at(s));
        }
    }

private:
    const tinygltf::Accessor& file_;
    std::string who_;
    Shape shape_;
    Elements own_, sparse_indices_, sparse_values_;

    void locateSparse(const Model& model) {
        const auto& sparse = file_.sparse;
        if (!isIndexType(sparse.indices.componentType)) fail(who_, "its sparse indices have no index type");
        const auto count = static_cast<std::size_t>(sparse.count);
        const std::size_t indexBytes = componentBytes(sparse.indices.componentType);
        sparse_indices_ =
            locate(model, sparse.indices.bufferView,
                   {static_cast<std::size_t>(sparse.indices.byteOffset), count, indexBytes, indexBytes}, who_,
                   "sparse indices");
        sparse_values_ = locate(model, sparse.values.bufferView,
                                {static_cast<std::size_t>(sparse.values.byteOffset), count, shape_.bytes(),
                                 shape_.columns * shape_.columnStride()},
                                who_, "sparse values");
        // Sparse indices must be strictly ascending (glTF 2.0, 3.6.2.3), so each element is visited at
        // most twice.
        for (std::size_t s = 0; s < count; ++s) {
            if (sparseIndex(s) >= file_.count)
                fail(who_,
                     fmt::format("sparse index {} is past its {} elements", sparseIndex(s), file_.count));
            if (s > 0 && sparseIndex(s) <= sparseIndex(s - 1))
                fail(who_, fmt::format("sparse index {} does not ascend: {} after {}", s, sparseIndex(s),
                                       sparseIndex(s - 1)));
        }
    }

    std::uint32_t sparseIndex(std::size_t s) const {
        return withType(file_.sparse.indices.componentType, [&](auto sample) {
            return static_cast<std::uint32_t>(load<decltype(sample)>(sparse_indices_.at(s)));
        });
    }
};

}  // namespace

// ---- what is read ------------------------------------------------------------------------------------

std::span<const unsigned char> viewBytes(const Model& model, int index) {
    const ViewSource source = sourceOf(model, index);
    const std::string cut = cutOf(model, index);
    if (cut.empty())
        return source.data.subspan(source.offset,
                                   model.bufferViews[static_cast<std::size_t>(index)].byteLength);
    if (source.offset >= source.data.size()) throw std::runtime_error(cut);
    return source.data.subspan(source.offset);
}

std::string cutOf(const Model& model, int index) {
    const tinygltf::BufferView& view = model.bufferViews[static_cast<std::size_t>(index)];
    const ViewSource source = sourceOf(model, index);
    const std::size_t held = source.data.size();
    if (source.offset <= held && view.byteLength <= held - source.offset) return {};
    if (!source.fault.empty()) return source.fault;
    return fmt::format("bufferView {}: {} bytes at offset {} end past buffer {} ({} bytes)", index,
                       view.byteLength, view.byteOffset, view.buffer, held);
}

std::size_t soundCount(const Model& model, int accessor, const std::string& who, const char* noun,
                       std::size_t width) {
    return SoundAccessor(model, accessor, who, noun, width).file().count;
}

template <class Vec>
std::vector<Vec> readVectors(const Model& model, int index, const std::string& asks, const Selection& which) {
    constexpr auto width = static_cast<std::size_t>(Vec::length());
    const SoundAccessor a(model, index, asks, "vertices", width);
    if (a.file().componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)
        fail(asks, fmt::format("accessor {} has component type {}, which is not allowed for attributes",
                               index, a.file().componentType));
    std::vector<Vec> result(a.size(which), Vec(0));
    withType(a.file().componentType, [&](auto sample) {
        using T = decltype(sample);
        a.visit(which, [&](std::size_t i, const unsigned char* at) {
            for (std::size_t c = 0; c < width; ++c)
                result[i][static_cast<int>(c)] = number<T>(at + c * sizeof(T), a.file().normalized);
        });
    });
    return result;
}

template std::vector<glm::vec2> readVectors(const Model&, int, const std::string&, const Selection&);
template std::vector<glm::vec3> readVectors(const Model&, int, const std::string&, const Selection&);
template std::vector<glm::vec4> readVectors(const Model&, int, const std::string&, const Selection&);

std::vector<glm::vec4> readColors(const Model& model, int accessor, const std::string& who,
                                  const Selection& which) {
    const SoundAccessor a(model, accessor, who, "vertices");
    if (a.file().componentType != TINYGLTF_COMPONENT_TYPE_FLOAT && !a.file().normalized)
        fail(who, fmt::format("accessor {} has integers that are not normalized", accessor));
    if (a.file().type != TINYGLTF_TYPE_VEC3) return readVectors<glm::vec4>(model, accessor, who, which);
    std::vector<glm::vec4> result;
    result.reserve(a.size(which));
    for (const glm::vec3& color : readVectors<glm::vec3>(model, accessor, who, which))
        result.emplace_back(color, 1.0f);
    return result;
}

std::vector<glm::u16vec4> readJoints(const Model& model, int index, const std::string& asks,
                                     const Selection& which) {
    const SoundAccessor a(model, index, asks, "vertices");
    const bool bytes = a.file().componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE;
    if (a.file().type != TINYGLTF_TYPE_VEC4 ||
        !(bytes || a.file().componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT))
        fail(asks, fmt::format("accessor {} is not VEC4 of unsigned bytes or shorts", index));
    std::vector<glm::u16vec4> result(a.size(which), glm::u16vec4(0));
    a.visit(which, [&](std::size_t i, const unsigned char* at) {
        for (int c = 0; c < 4; ++c) result[i][c] = bytes ? at[c] : load<std::uint16_t>(at + 2 * c);
    });
    return result;
}

std::vector<std::uint32_t> readIndices(const Model& model, int index, const std::string& asks) {
    const SoundAccessor a(model, index, asks, "indices");
    if (a.file().type != TINYGLTF_TYPE_SCALAR || !isIndexType(a.file().componentType))
        fail(asks, fmt::format("accessor {} is not SCALAR of unsigned integers", index));
    std::vector<std::uint32_t> result(a.file().count, 0);
    withType(a.file().componentType, [&](auto sample) {
        using T = decltype(sample);
        if constexpr (std::is_unsigned_v<T>) {
            a.visit({}, [&](std::size_t i, const unsigned char* at) { result[i] = load<T>(at); });
            const auto restart =
                std::find(result.begin(), result.end(), std::uint32_t(std::numeric_limits<T>::max()));
            if (restart != result.end())
                fail(asks, fmt::format("index {} is {}, the primitive restart value, which glTF forbids",
                                       restart - result.begin(), *restart));
        }
    });
    return result;
}

Numbers readNumbers(const Model& model, int index, const std::string& asks) {
    const SoundAccessor a(model, index, asks, "elements");
    Numbers result{{}, a.file().count, a.shape().width(), a.file().componentType, a.file().normalized};
    result.values.assign(result.count * result.width, 0.0f);
    withType(result.component_type, [&](auto sample) {
        a.visit({}, [&](std::size_t i, const unsigned char* at) {
            for (std::size_t c = 0; c < result.width; ++c)
                result.values[i * result.width + c] =
                    number<decltype(sample)>(at + a.shape().at(c), result.normalized);
        });
    });
    return result;
}

}  // namespace diptych::gltf
