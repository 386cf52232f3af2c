// SPDX-License-Identifier: MIT
// A SPIR-V module whose small branches are selections: for drivers whose compilers take time that doubles
// with every branch inside a loop (DeviceProfile::flattens_branches).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace diptych {

// `module` as specialized() leaves it. Where both ways of a branch do nothing but compute, from values alone,
// both are computed and each result is selected, from the innermost branch outwards. A computation does
// not change by a bit. Memory, images and derivatives stay behind their conditions.
std::vector<std::uint32_t> flattened(std::span<const std::uint32_t> module);

}  // namespace diptych
