// SPDX-License-Identifier: MIT
// The only place that turns a file's offsets and counts into memory that is read: index, bufferView, stride,
// count and every product are checked first. Offsets need no alignment. All throw std::runtime_error:
// "accessor 3: ..." or, where an accessor does not suit the one who asks, "WHO: accessor 3 ...".
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

// What bufferView `index` covers, inside its buffer; `who` asks.
std::span<const unsigned char> viewBytes(const tinygltf::Model& model, int index, const std::string& who);

// How many elements an accessor has, all of them inside their bufferViews, the sparse ones too. `noun` is
// what a line calls them. `width`: of how many components they must be; 0: any.
std::size_t soundCount(const tinygltf::Model& model, int accessor, const std::string& who,
                       const char* noun = "elements", std::size_t width = 0);

// Which elements to read: ascending, below soundCount. None named: all.
using Selection = std::optional<std::span<const std::uint32_t>>;

// An accessor of glm::vec2, vec3 or vec4, of floats or of 8 or 16 bit integers, normalized to 0..1 or -1..1
// if it says so, sparse or not. `who` asks, e.g. "mesh 0, primitive 1: POSITION".
template <class Vec>
std::vector<Vec> readVectors(const tinygltf::Model& model, int accessor, const std::string& who,
                             const Selection& which = {});

// COLOR_0 of three or four components; alpha 1 where there are three. Integers must be normalized.
std::vector<glm::vec4> readColors(const tinygltf::Model& model, int accessor, const std::string& who,
                                  const Selection& which = {});

// JOINTS_n: VEC4 of unsigned 8 or 16 bit integers.
std::vector<glm::u16vec4> readJoints(const tinygltf::Model& model, int accessor, const std::string& who,
                                     const Selection& which = {});

// SCALAR of unsigned integers. The largest of its type would restart the primitive, which glTF forbids.
std::vector<std::uint32_t> readIndices(const tinygltf::Model& model, int accessor, const std::string& who);

// Elements of any shape as floats side by side, matrices column by column.
struct Numbers {
    std::vector<float> values;  // count * width
    std::size_t count = 0, width = 0;
    int component_type = 0;  // TINYGLTF_COMPONENT_TYPE_*
    bool normalized = false;
};
Numbers readNumbers(const tinygltf::Model& model, int accessor, const std::string& who);

}  // namespace diptych::gltf
