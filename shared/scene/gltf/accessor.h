// SPDX-License-Identifier: MIT
// The only place that turns a file's offsets and counts into memory that is read: index, bufferView, stride,
// count and every product of them are checked first. Offsets need no alignment. All functions throw
// std::runtime_error: "accessor 3: ..." or, if an accessor does not suit its use, "WHO: accessor 3 ...".
#pragma once

#include <glm/ext/vector_uint4_sized.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tinygltf {
class Model;
}

namespace diptych::gltf {

// The bytes of bufferView `index` that its buffer holds, which is an error where they are none; `who` names
// the caller in errors. Exporters count padding that they do not write.
std::span<const unsigned char> viewBytes(const tinygltf::Model& model, int index, const std::string& who);
// Why these are fewer than the bufferView names: "bufferView 3: 40 bytes from 0 on end past buffer 0 (38
// bytes)". Empty: they are all.
std::string cutOf(const tinygltf::Model& model, int index);

// The number of elements of an accessor, after checking that all of them, sparse ones too, lie inside their
// bufferViews. `noun` is what errors call an element. `width`: the number of components that an element must
// have; 0: any.
std::size_t soundCount(const tinygltf::Model& model, int accessor, const std::string& who,
                       const char* noun = "elements", std::size_t width = 0);

// The elements to read: ascending, below soundCount(). No value: all.
using Selection = std::optional<std::span<const std::uint32_t>>;

// Reads an accessor of glm::vec2, vec3 or vec4, of floats or of 8 or 16 bit integers (converted to 0..1 or
// -1..1 if `normalized`), sparse or not. `who` names the caller, e.g. "mesh 0, primitive 1: POSITION".
template <class Vec>
std::vector<Vec> readVectors(const tinygltf::Model& model, int accessor, const std::string& who,
                             const Selection& which = {});

// Reads COLOR_0 of three or four components; with three, alpha is 1. Integers must be normalized.
std::vector<glm::vec4> readColors(const tinygltf::Model& model, int accessor, const std::string& who,
                                  const Selection& which = {});

// The number of components of an element of an accessor that soundCount() has passed.
std::size_t componentsOf(const tinygltf::Model& model, int accessor);

// Reads JOINTS_n: VEC4 of unsigned 8 or 16 bit integers.
std::vector<glm::u16vec4> readJoints(const tinygltf::Model& model, int accessor, const std::string& who,
                                     const Selection& which = {});

// Reads indices: SCALAR of unsigned integers. The largest value of the type is an error: it would be
// primitive restart, which glTF forbids.
std::vector<std::uint32_t> readIndices(const tinygltf::Model& model, int accessor, const std::string& who);

// Elements of any shape as consecutive floats, matrices column by column.
struct Numbers {
    std::vector<float> values;  // count * width
    std::size_t count = 0, width = 0;
    int component_type = 0;  // TINYGLTF_COMPONENT_TYPE_*
    bool normalized = false;
};
Numbers readNumbers(const tinygltf::Model& model, int accessor, const std::string& who);

}  // namespace diptych::gltf
