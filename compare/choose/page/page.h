// SPDX-License-Identifier: MIT
// The style and the script in this folder, which the page of a choice contains; embedded at build time.
#pragma once

namespace diptych::choose {

extern const char* const choiceStyle;
extern const char* const choiceScript;

}  // namespace diptych::choose
