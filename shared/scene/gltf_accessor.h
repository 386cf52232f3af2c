// SPDX-License-Identifier: MIT
// The only place that turns a file's offsets and counts into memory that is read: index, bufferView, stride,
// count and every product are checked first. Throws std::runtime_error: "accessor 3: ...".
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace tinygltf {
class Model;
}

namespace diptych::gltf {

// What bufferView `index` covers, inside its buffer; `who` asks.
std::span<const unsigned char> viewBytes(const tinygltf::Model& model, int index, const std::string& who);

// An accessor of glm::vec2, vec3 or vec4, of floats or of 8 or 16 bit integers, normalized to 0..1 or -1..1
// if it says so, sparse or not. `who` asks, e.g. "mesh 0, primitive 1: POSITION".
template <class Vec>
std::vector<Vec> readVectors(const tinygltf::Model& model, int accessor, const std::string& who);

// COLOR_0 of three or four components; alpha 1 where there are three.
std::vector<glm::vec4> readColors(const tinygltf::Model& model, int accessor, const std::string& who);

std::vector<std::uint32_t> readIndices(const tinygltf::Model& model, int accessor, const std::string& who);

}  // namespace diptych::gltf
