// SPDX-License-Identifier: MIT
// The style and scripts of this folder, which every index.html contains; embedded at build time.
#pragma once

namespace diptych::page {

extern const char* const style;
extern const char* const tables;   // for pages with a table or plot; before other scripts
extern const char* const copying;  // for pages with command lines; before other scripts
extern const char* const script;   // for a report's page

}  // namespace diptych::page
