// SPDX-License-Identifier: MIT
// The shaders of shaders/pass as the build embeds them, each as one SPIR-V module.
#pragma once

#include "shader_names.h"  // made from the files of shaders/pass: enum class Shader

#include <cstdint>
#include <span>
#include <string_view>

namespace diptych {

// All that varies in a module is a specialization constant (shared/contract/features.h).
struct ShaderModule {
    std::string_view name;  // the file's: "gbuffer.frag"
    std::span<const std::uint32_t> words;
};

std::span<const ShaderModule> shaderModules();    // in the order of Shader
const ShaderModule& shaderModule(Shader shader);  // of any but Shader::none

}  // namespace diptych
