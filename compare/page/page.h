// SPDX-License-Identifier: MIT
// The style and the scripts beside this file, as they stand in every index.html; embedded at build time.
#pragma once

namespace diptych {

extern const char* const pageStyle;
extern const char* const pageScript;

}  // namespace diptych
