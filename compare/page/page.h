// SPDX-License-Identifier: MIT
// The style and scripts of this folder, which every index.html contains; embedded at build time.
#pragma once

namespace diptych::page {

extern const char* const style;
extern const char* const tables;  // tables, plots, commands; before other scripts
extern const char* const script;  // for a report's page

}  // namespace diptych::page
