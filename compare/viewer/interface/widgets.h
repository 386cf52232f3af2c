// SPDX-License-Identifier: MIT
// Texts, colours and tables of the panels.
#pragma once

#include <imgui.h>

#include <initializer_list>
#include <string>

namespace diptych::viewer {

inline const ImVec4 bad{1, 0.42f, 0.38f, 1}, good{0.5f, 0.9f, 0.5f, 1}, faint{0.62f, 0.62f, 0.65f, 1};

void wrapped(const std::string& text, const ImVec4* color = nullptr);

// A table whose columns fit their contents, except column `wraps`, which takes the rest and wraps its
// text.
bool beginTable(const char* id, std::initializer_list<const char*> heads, int wraps,
                ImGuiTableFlags flags = 0, const ImVec2& size = {0, 0});

}  // namespace diptych::viewer
