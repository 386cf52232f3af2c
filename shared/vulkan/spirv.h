// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace diptych {

// The embedded module of an entry point by its file's name in shaders/pass, e.g. "depth.vert"; empty where
// there is none.
std::span<const std::uint32_t> findSpirv(std::string_view name);

// The names of all embedded modules: "depth.vert", "gbuffer.frag.3.inputs0", ...
std::span<const std::string_view> spirvModules();

}  // namespace diptych
