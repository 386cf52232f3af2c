// SPDX-License-Identifier: MIT
// The style and the scripts in this folder, which every index.html contains; embedded at build time.
#pragma once

namespace diptych::page {

extern const char* const style;
extern const char* const script;

}  // namespace diptych::page
