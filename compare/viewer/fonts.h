// SPDX-License-Identifier: MIT
// The window's fonts.
#pragma once

struct ImFont;

namespace diptych::viewer {

// Text in DejaVu Sans, of Debian's fonts-dejavu-core; in Dear ImGui's own font where that is not installed.
void loadFonts(double scale);

// All letters equally wide, for text that stands in columns.
ImFont* evenFont();

}  // namespace diptych::viewer
