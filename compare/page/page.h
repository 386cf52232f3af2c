// SPDX-License-Identifier: MIT
// The style and the scripts beside this file, as they stand in every index.html; embedded at build time.
#pragma once

namespace diptych::page {

extern const char* const style;
extern const char* const script;

}  // namespace diptych::page
