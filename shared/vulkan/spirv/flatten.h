// SPDX-License-Identifier: MIT
// Converts small branches of a SPIR-V module to OpSelect instructions, for drivers whose compile time doubles
// with every branch inside a loop (DeviceProfile::flattens_branches).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace diptych {

// `module`: a result of specialized(). If both sides of a branch only compute from values, both are
// computed and their results selected, innermost branches first. Computations stay bit for bit the same.
// Memory accesses, images and derivatives stay conditional.
std::vector<std::uint32_t> flattened(std::span<const std::uint32_t> module);

}  // namespace diptych
