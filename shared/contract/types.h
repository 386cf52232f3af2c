// SPDX-License-Identifier: MIT
// The words that both languages share. A contract header is included unchanged by C++ and by GLSL, and
// uses only 4-byte scalars, vectors, matrices of them and nested structs: in scalar block layout those
// have the same offsets in both (proved at build time from the compiled SPIR-V).
// Never define GLM_FORCE_DEFAULT_ALIGNED_GENTYPES: it would move every member.
#ifndef DIPTYCH_CONTRACT_TYPES_H
#define DIPTYCH_CONTRACT_TYPES_H

#ifdef __cplusplus

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
}  // namespace diptych::gpu

#define CONTRACT_BEGIN namespace diptych::gpu {
#define CONTRACT_END }
#define CONTRACT_CONST(type, name, value) inline constexpr type name = value

#else

#define CONTRACT_BEGIN
#define CONTRACT_END
#define CONTRACT_CONST(type, name, value) const type name = value

#endif
#endif
