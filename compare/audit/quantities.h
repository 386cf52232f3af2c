// SPDX-License-Identifier: MIT
// All quantities that an audit knows.
#pragma once

#include "compare/audit/quantity.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace diptych::audit {

std::span<const Quantity> quantities();

// Those of these names, all without any, in the order of quantities(). Throws std::runtime_error naming
// `option` and the one that there is not.
std::vector<const Quantity*> quantitiesOf(std::span<const std::string> names,
                                          std::string_view option = "--quantity");

}  // namespace diptych::audit
