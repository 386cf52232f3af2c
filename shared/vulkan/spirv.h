// SPDX-License-Identifier: MIT
// The shaders of shaders/pass as the build embeds them, each as one or several SPIR-V modules.
#pragma once

#include "shader_names.h"  // made from the files of shaders/pass: enum class Shader

#include <cstdint>
#include <span>
#include <string_view>

namespace diptych {

// What cannot be specialised in SPIR-V is compiled several times: shaders/README.md.
struct ShaderModule {
    std::string_view name;  // the file's, and which it is: "gbuffer.frag.3.inputs0"
    Shader shader;          // its file
    std::uint32_t number;   // of attachments that it draws to, or of MULTISAMPLED; 0 where there is one alone
    bool lights;            // false: without the code of lighting, of shaders that have it
    bool area_lights;       // with the code of area lights, of shaders that have it
    bool samples;           // of G-buffers of several samples a pixel, of shaders that read them
    bool coverage;          // whose alpha masks choose samples, of shaders that have such masks
    bool half;              // with floats of 16 bits, of shaders that shade
    int inputs;             // the set of inputs between its stage and the other, 3 being all
    std::span<const std::uint32_t> words;
};

// By shader, number, lights, area_lights, samples, coverage, half and inputs.
std::span<const ShaderModule> shaderModules();
std::span<const ShaderModule> shaderModules(Shader shader);

// The module with all inputs, with lights, without area lights, for one sample a pixel and without coverage,
// that has this number, or of a shader without numbers the one that there is. Throws std::logic_error for a
// number that a shader with numbers does not have.
const ShaderModule& plainModule(Shader shader, std::uint32_t number = 0);

}  // namespace diptych
