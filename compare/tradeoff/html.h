// SPDX-License-Identifier: MIT
#pragma once

#include "compare/tradeoff/tradeoff.h"

#include <string>
#include <string_view>

namespace diptych::tradeoff {

// index.html of a sweep: one page without external resources, works from file://.
std::string tradeoffHtml(const Tradeoff& tradeoff);

// Throws std::runtime_error unless tradeoffHtml() may have written the page.
void checkTradeoffHtml(std::string_view page);

}  // namespace diptych::tradeoff
