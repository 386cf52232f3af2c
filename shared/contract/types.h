// SPDX-License-Identifier: MIT
// The words that both languages share. A contract header is included unchanged by C++ and by GLSL, and
// uses only 4-byte scalars, vectors, matrices of them and nested structs: in scalar block layout those
// have the same offsets in both (proved at build time from the compiled SPIR-V).
// CONTRACT_LANE and CONTRACT_TEXELS state, for a struct that shaders read as texels of four lanes, where each
// member begins and how many texels there are; C++ proves it. Beside them stands the macro by which GLSL
// makes the struct. Never define GLM_FORCE_DEFAULT_ALIGNED_GENTYPES: it would move every member.
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

// Whether a member begins at a lane (x, y, z, w: 0 to 3) of a texel of four floats.
constexpr bool beginsAt(std::size_t offset, std::size_t texel, std::size_t lane) {
    return offset == 16 * texel + 4 * lane;
}
}  // namespace diptych::gpu

#define CONTRACT_BEGIN namespace diptych::gpu {
#define CONTRACT_END }
#define CONTRACT_CONST(type, name, value) inline constexpr type name = value
#define CONTRACT_LANE(type, member, texel, lane) static_assert(beginsAt(offsetof(type, member), texel, lane))
#define CONTRACT_TEXELS(type, texels) static_assert(sizeof(type) == 16 * (texels))

#else

#define CONTRACT_BEGIN
#define CONTRACT_END
#define CONTRACT_CONST(type, name, value) const type name = value
#define CONTRACT_LANE(type, member, texel, lane)
#define CONTRACT_TEXELS(type, texels)

#endif
#endif
