// SPDX-License-Identifier: MIT
#include "shared/vulkan/spirv/spirv.h"

#include <cstddef>
#include <stdexcept>

namespace diptych {

const ShaderModule& shaderModule(Shader shader) {
    if (shader == Shader::none) throw std::logic_error("Shader::none has no module");
    return shaderModules()[static_cast<std::size_t>(shader) - 1];
}

}  // namespace diptych
