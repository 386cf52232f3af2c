// SPDX-License-Identifier: MIT
#pragma once

#include "compare/tradeoff/tradeoff.h"

#include <string>

namespace diptych::tradeoff {

// index.html of a sweep: one page without external resources, works from file://.
std::string tradeoffHtml(const Tradeoff& tradeoff);

}  // namespace diptych::tradeoff
