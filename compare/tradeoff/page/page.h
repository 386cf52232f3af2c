// SPDX-License-Identifier: MIT
// The files beside this one, as they stand in the page of a sweep; embedded at build time.
#pragma once

namespace diptych::tradeoff {

extern const char* const tradeoffStyle;
extern const char* const tradeoffScript;

}  // namespace diptych::tradeoff
