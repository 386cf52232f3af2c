// SPDX-License-Identifier: MIT
// compare/report/page/page.css and page.js, as they stand in every index.html; embedded at build time.
#pragma once

namespace diptych {

extern const char* const pageStyle;
extern const char* const pageScript;

}  // namespace diptych
