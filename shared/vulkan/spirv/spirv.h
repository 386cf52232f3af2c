// SPDX-License-Identifier: MIT
// Shaders of shaders/pass as embedded SPIR-V modules.
#pragma once

#include "shader_names.h"  // made from the files of shaders/pass: enum class Shader

#include <cstdint>
#include <span>
#include <string_view>

namespace diptych {

// All variation of a module is in specialization constants (shared/contract/features.h).
struct ShaderModule {
    std::string_view name;  // file name: "gbuffer.frag"
    std::span<const std::uint32_t> words;
};

std::span<const ShaderModule> shaderModules();    // in the order of Shader
const ShaderModule& shaderModule(Shader shader);  // except Shader::none

}  // namespace diptych
