// SPDX-License-Identifier: MIT
// The shaders of compare/probe/shaders as the build embeds them.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace diptych::probe {

struct EmbeddedModule {
    std::string_view name;  // "brdf.comp"
    std::span<const std::uint32_t> words;
};

std::span<const EmbeddedModule> embeddedModules();

}  // namespace diptych::probe
