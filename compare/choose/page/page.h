// SPDX-License-Identifier: MIT
// Style of the choice page, embedded at build time from this folder.
#pragma once

namespace diptych::choose {

extern const char* const choiceStyle;

}  // namespace diptych::choose
