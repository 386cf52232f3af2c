// SPDX-License-Identifier: MIT
// The style and the scripts in this folder, which every index.html contains; embedded at build time.
#pragma once

namespace diptych::page {

extern const char* const style;
extern const char* const tables;   // of every page that has a table or a plot; before its other scripts
extern const char* const copying;  // of every page that has command lines; before its other scripts
extern const char* const script;   // of a report's page

}  // namespace diptych::page
