// SPDX-License-Identifier: MIT
// All reads of buffer memory go through here: stride, count and all their products are checked first. Indices
// are those of a checked document. Offsets may be unaligned. All functions throw std::runtime_error:
// "accessor 3: ...", or "WHO: accessor 3 ..." if an accessor does not suit its use.
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

namespace diptych::gltf {

struct Model;

// The bytes of bufferView `index` that exist in its buffer; throws if there are none. The result may be
// shorter than byteLength, because exporters count padding that they do not write.
std::span<const unsigned char> viewBytes(const Model& model, int index);
// Why viewBytes() is shorter than byteLength: "bufferView 3: 40 bytes from 0 on end past buffer 0 (38
// bytes)". Empty if it is not.
std::string cutOf(const Model& model, int index);

// Number of elements of an accessor. Checks that all of them, including sparse ones, lie inside their
// bufferViews. `noun` names an element in errors. `width`: required number of components; 0: any.
std::size_t soundCount(const Model& model, int accessor, const std::string& who,
                       const char* noun = "elements", std::size_t width = 0);

// Elements to read, ascending, below soundCount(). nullopt: all.
using Selection = std::optional<std::span<const std::uint32_t>>;

// Reads glm::vec2, vec3 or vec4 from floats or from 8- or 16-bit integers, which become 0 to 1 or -1 to 1
// if `normalized`. `who` names the caller, as in "mesh 0, primitive 1: POSITION".
template <class Vec>
std::vector<Vec> readVectors(const Model& model, int accessor, const std::string& who,
                             const Selection& which = {});

// Reads COLOR_0 with three or four components; the default alpha is 1. Integers must be normalized.
std::vector<glm::vec4> readColors(const Model& model, int accessor, const std::string& who,
                                  const Selection& which = {});

// Reads JOINTS_n: VEC4 of unsigned 8- or 16-bit integers.
std::vector<glm::u16vec4> readJoints(const Model& model, int accessor, const std::string& who,
                                     const Selection& which = {});

// Reads indices: SCALAR of unsigned integers. Throws for the type's largest value, which means primitive
// restart and is forbidden in glTF.
std::vector<std::uint32_t> readIndices(const Model& model, int accessor, const std::string& who);

// Elements of any shape as consecutive floats; matrices are column-major.
struct Numbers {
    std::vector<float> values;  // count * width
    std::size_t count = 0, width = 0;
    int component_type = 0;  // TINYGLTF_COMPONENT_TYPE_*
    bool normalized = false;
};
Numbers readNumbers(const Model& model, int accessor, const std::string& who);

}  // namespace diptych::gltf
