// SPDX-License-Identifier: MIT
// The window's fonts.
#pragma once

struct ImFont;

namespace diptych::viewer {

// DejaVu Sans from Debian's fonts-dejavu-core, or Dear ImGui's built-in font if that is not installed.
void loadFonts(double scale);

// Monospaced, for text in columns.
ImFont* evenFont();

}  // namespace diptych::viewer
