// SPDX-License-Identifier: MIT
// All stress parameters that an audit can vary.
#pragma once

#include "compare/audit/quantity.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace diptych::audit {

std::span<const Quantity> quantities();

// Quantities with these names, or all if there are none, in the order of quantities(). Throws
// std::runtime_error with `option` and the unknown name.
std::vector<const Quantity*> quantitiesOf(std::span<const std::string> names,
                                          std::string_view option = "--quantity");

}  // namespace diptych::audit
