// SPDX-License-Identifier: MIT
// Types that both languages share. C++ and GLSL include contract headers unchanged. The headers use only
// 4-byte scalars, vectors, matrices and nested structs, whose offsets in scalar block layout are the same
// in both languages; the build proves it from the compiled SPIR-V.
// CONTRACT_LANE and CONTRACT_TEXELS declare, for structs that shaders read as texels, the texel and
// component of a member and the number of texels; C++ asserts them. The macro beside them constructs the
// struct in GLSL. CONTRACT_WORD: C++ asserts that a word holds so many bits. Never define
// GLM_FORCE_DEFAULT_ALIGNED_GENTYPES: it changes the offsets.
#ifndef DIPTYCH_CONTRACT_TYPES_H
#define DIPTYCH_CONTRACT_TYPES_H

#ifdef __cplusplus

#include <cstddef>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/mat4x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace diptych::gpu {
using uint = std::uint32_t;
using glm::mat3;
using glm::mat4;
using glm::mat4x3;
using glm::uvec2;
using glm::uvec4;
using glm::vec2;
using glm::vec3;
using glm::vec4;

// Whether a member begins at a component (x, y, z, w: 0 to 3) of a texel of four floats.
constexpr bool beginsAt(std::size_t offset, std::size_t texel, std::size_t lane) {
    return offset == 16 * texel + 4 * lane;
}
}  // namespace diptych::gpu

#define CONTRACT_BEGIN namespace diptych::gpu {
#define CONTRACT_END }
#define CONTRACT_CONST(type, name, value) inline constexpr type name = value
#define CONTRACT_LANE(type, member, texel, lane) static_assert(beginsAt(offsetof(type, member), texel, lane))
#define CONTRACT_TEXELS(type, texels) static_assert(sizeof(type) == 16 * (texels))
#define CONTRACT_WORD(word, bits) static_assert((bits) <= 32, "the word " #word " has more than 32 bits")

#else

#define CONTRACT_BEGIN
#define CONTRACT_END
#define CONTRACT_CONST(type, name, value) const type name = value
#define CONTRACT_LANE(type, member, texel, lane)
#define CONTRACT_TEXELS(type, texels)
#define CONTRACT_WORD(word, bits)

#endif

// BINDING_<name> of a row of a table of descriptors (bindings.h).
#define CONTRACT_BINDING(number, name, kind, what) CONTRACT_CONST(uint, BINDING_##name, number);

#endif
