// SPDX-License-Identifier: MIT
#include "compare/viewer/interface/widgets.h"

namespace diptych::viewer {

void wrapped(const std::string& text, const ImVec4* color) {
    if (color) ImGui::PushStyleColor(ImGuiCol_Text, *color);
    ImGui::PushTextWrapPos(0);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    if (color) ImGui::PopStyleColor();
}

bool beginTable(const char* id, std::initializer_list<const char*> heads, int wraps, ImGuiTableFlags flags,
                const ImVec2& size) {
    if (!ImGui::BeginTable(id, static_cast<int>(heads.size()),
                           ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_RowBg | flags, size))
        return false;
    for (int column = 0; const char* head : heads)
        ImGui::TableSetupColumn(head, column++ == wraps ? ImGuiTableColumnFlags_WidthStretch : 0);
    ImGui::TableHeadersRow();
    return true;
}

}  // namespace diptych::viewer
