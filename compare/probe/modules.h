// SPDX-License-Identifier: MIT
// The shaders of compare/probe/shaders as the build embeds them.
#pragma once

#include "shared/vulkan/spirv/spirv.h"

#include <span>

namespace diptych::probe {

std::span<const ShaderModule> shaderModules();

}  // namespace diptych::probe
