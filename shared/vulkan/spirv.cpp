// SPDX-License-Identifier: MIT
#include "shared/vulkan/spirv.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace diptych {

std::span<const ShaderModule> shaderModules(Shader shader) {
    const auto all = shaderModules();
    const auto [first, last] = std::ranges::equal_range(all, shader, {}, &ShaderModule::shader);
    return {first, last};
}

const ShaderModule& plainModule(Shader shader, std::uint32_t number) {
    for (const std::uint32_t wanted : {number, 0u})
        for (const ShaderModule& module : shaderModules(shader))
            if (module.number == wanted && module.lights && !module.area_lights && module.inputs == 3)
                return module;
    throw std::logic_error(
        fmt::format("shader {} has no module of number {}", static_cast<int>(shader), number));
}

}  // namespace diptych
