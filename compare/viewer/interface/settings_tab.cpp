// SPDX-License-Identifier: MIT
#include "compare/viewer/interface/tabs.h"

#include "compare/viewer/interface/widgets.h"
#include "shared/frame/settings.h"

#include <fmt/format.h>
#include <imgui.h>

#include <array>
#include <cstring>
#include <string>
#include <vector>

namespace diptych::viewer {
namespace {

std::vector<std::string> wordsOf(const std::string& accepted) {
    std::vector<std::string> words;
    std::size_t from = 0;
    for (std::size_t bar = 0; bar != accepted.npos; from = bar + 1) {
        bar = accepted.find('|', from);
        words.push_back(accepted.substr(from, bar == accepted.npos ? bar : bar - from));
    }
    return words;
}

void textInput(InterfaceState& state, const std::string& option, const std::string& value,
               const std::string& accepted) {
    const std::string label = "##" + option;
    std::array<char, 512> text{};
    const auto typed = state.typed.find(option);
    const std::string& now = typed == state.typed.end() ? value : typed->second;
    std::strncpy(text.data(), now.c_str(), text.size() - 1);
    if (ImGui::InputTextWithHint(label.c_str(), accepted.c_str(), text.data(), text.size(),
                                 ImGuiInputTextFlags_EnterReturnsTrue)) {
        setOption(state, option, text.data());
        state.typed.erase(option);
    } else if (ImGui::IsItemActive()) {
        state.typed[option] = text.data();
    } else if (typed != state.typed.end()) {
        // Esc discards the typed text.
        if (typed->second != value && !ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape)))
            setOption(state, option, typed->second);
        state.typed.erase(option);
    }
}

void settingRow(InterfaceState& state, const Field& field) {
    const std::string option(field.option), value = state.edited.valueOf(option),
                                            accepted = acceptedValues(option);
    const bool standard = value == Settings().valueOf(option);
    std::string unread;
    for (const Path path : drawn_paths) {
        const Settings settings = state.subject.sides.of(state.edited, path);
        if (const std::string_view why = ignoredBecause(settings, option); !why.empty())
            unread += fmt::format("{}{} does not read it: {}", unread.empty() ? "" : "; ", nameOf(path), why);
    }
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::AlignTextToFramePadding();
    ImGui::TextColored(standard ? ImVec4{0.8f, 0.8f, 0.82f, 1} : ImVec4{1, 0.85f, 0.4f, 1}, "%s",
                       option.c_str());
    if (ImGui::IsItemHovered()) {
        ImGui::BeginTooltip();
        ImGui::PushTextWrapPos(32 * ImGui::GetFontSize());
        ImGui::TextUnformatted(std::string(field.help).c_str());
        ImGui::TextColored(faint, "--%s %s; default: %s", option.c_str(), accepted.c_str(),
                           Settings().valueOf(option).empty() ? "empty" : Settings().valueOf(option).c_str());
        if (!unread.empty()) ImGui::TextColored(faint, "%s", unread.c_str());
        if (state.subject.sides.names(option))
            for (const Path path : drawn_paths)
                ImGui::TextColored(faint, "%s uses %s", std::string(nameOf(path)).c_str(),
                                   state.subject.sides.of(state.edited, path).valueOf(option).c_str());
        ImGui::PopTextWrapPos();
        ImGui::EndTooltip();
    }
    ImGui::TableNextColumn();
    ImGui::SetNextItemWidth(-1);
    if (accepted.find('|') == accepted.npos) return textInput(state, option, value, accepted);
    if (!ImGui::BeginCombo(("##" + option).c_str(), value.c_str())) return;
    for (const std::string& word : wordsOf(accepted))
        if (!(option == "path" && word == nameOf(Path::reference)) &&
            ImGui::Selectable(word.c_str(), word == value))
            setOption(state, option, word);
    ImGui::EndCombo();
}

}  // namespace

void settingsTab(InterfaceState& state) {
    if (!state.problem.empty()) wrapped("not drawn: " + state.problem, &bad);
    ImGui::SetNextItemWidth(12 * ImGui::GetFontSize());
    ImGui::InputTextWithHint("##filter", "filter by name", state.filter.data(), state.filter.size());
    ImGui::SameLine();
    if (ImGui::SmallButton("reset to defaults")) {
        Settings settings;
        settings.size = state.subject.settings.size;
        settings.camera = state.subject.settings.camera;
        settings.path = state.subject.settings.path;
        state.edited = state.subject.settings = settings;
        state.problem.clear();
        state.typed.clear();
    }
    ImGui::SameLine();
    bool follow = state.follow;
    if (ImGui::Checkbox("follow the window's size", &follow)) state.follow = follow;
    const std::string filter = state.filter.data();
    if (!ImGui::BeginTable("settings", 2, ImGuiTableFlags_SizingStretchProp)) return;
    ImGui::TableSetupColumn("setting", 0, 0.45f);
    ImGui::TableSetupColumn("value", 0, 0.55f);
    for (const Field& field : settingFields())
        if (filter.empty() || std::string(field.option).find(filter) != std::string::npos)
            settingRow(state, field);
    ImGui::EndTable();
}

}  // namespace diptych::viewer
