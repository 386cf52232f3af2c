// SPDX-License-Identifier: MIT
// The style and the script in this folder, which the page of a sweep contains; embedded at build time.
#pragma once

namespace diptych::tradeoff {

extern const char* const tradeoffStyle;
extern const char* const tradeoffScript;

}  // namespace diptych::tradeoff
