// SPDX-License-Identifier: MIT
// Constant folding of SPIR-V operations.
#pragma once

#include <cstdint>
#include <optional>

namespace diptych {

// Result of an operation on one or two 32-bit integers or bools, if its known operands determine it; `b`
// is empty for one operand. Division by zero and shifts by 32 or more are undefined and left to the device.
std::optional<std::uint32_t> folded(std::uint32_t operation, std::optional<std::uint32_t> a,
                                    std::optional<std::uint32_t> b);

}  // namespace diptych
