// SPDX-License-Identifier: MIT
// Style and script of the choice page, embedded at build time from this folder.
#pragma once

namespace diptych::choose {

extern const char* const choiceStyle;
extern const char* const choiceScript;

}  // namespace diptych::choose
