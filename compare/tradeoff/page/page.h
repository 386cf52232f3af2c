// SPDX-License-Identifier: MIT
// Style and script of a sweep's page, embedded at build time from this folder.
#pragma once

namespace diptych::tradeoff {

extern const char* const tradeoffStyle;
extern const char* const tradeoffScript;

}  // namespace diptych::tradeoff
