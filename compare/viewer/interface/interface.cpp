// SPDX-License-Identifier: MIT
#include "compare/viewer/interface/interface.h"

#include "compare/viewer/drawing/images.h"
#include "compare/viewer/interface/keys.h"
#include "compare/viewer/interface/overlays.h"
#include "compare/viewer/interface/panels.h"
#include "shared/frame/debug_modes.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

namespace diptych::viewer {
namespace {

// ---- the bar ------------------------------------------------------------------------------------------

template <class Value, class Name>
void combo(const char* label, float width, Value& value, std::initializer_list<Value> values,
           const Name& name) {
    ImGui::SetNextItemWidth(width);
    if (!ImGui::BeginCombo(label, std::string(name(value)).c_str())) return;
    for (const Value each : values)
        if (ImGui::Selectable(std::string(name(each)).c_str(), each == value)) value = each;
    ImGui::EndCombo();
}

std::string_view nameOf(Layout layout) {
    switch (layout) {
        case Layout::wipe:
            return "wipe";
        case Layout::side_by_side:
            return "side by side";
        case Layout::single:
            return "one panel";
    }
    return {};
}

void channelCombo(InterfaceState& state, float width) {
    const DebugMode& now = debugMode(state.view_options.mode);
    ImGui::SetNextItemWidth(width);
    if (!ImGui::BeginCombo("##channel", fmt::format("{} {}", channelIndex(now.channel), now.name).c_str(),
                           ImGuiComboFlags_HeightLarge))
        return;
    for (const DebugMode& mode : debugModes()) {
        if (ImGui::Selectable(fmt::format("{} {}", channelIndex(mode.channel), mode.name).c_str(),
                              mode.channel == state.view_options.mode))
            state.view_options.mode = mode.channel;
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", std::string(mode.shows).c_str());
    }
    ImGui::EndCombo();
}

void exposureInput(InterfaceState& state, const Contents& contents, float width) {
    bool automatic = !state.view_options.exposure && !state.view_options.ev100;
    if (ImGui::Checkbox("auto", &automatic)) {
        state.view_options.exposure.reset();
        state.view_options.ev100.reset();
        if (!automatic) state.view_options.exposure = 1;
    }
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("exposure: %s", contents.shown ? contents.shown->scale.c_str() : "automatic");
    if (!state.view_options.exposure) return;
    ImGui::SameLine();
    ImGui::SetNextItemWidth(width);
    auto factor = static_cast<float>(*state.view_options.exposure);
    if (ImGui::DragFloat("##exposure", &factor, 0.01f * factor, 1e-12f, 1e12f, "x %.4g") && factor > 0)
        state.view_options.exposure = double{factor};
}

void bar(InterfaceState& state, const Contents& contents, int width, float scale) {
    ImGui::SetNextWindowPos({0, 0});
    const auto rows = barRows(width, double{scale});
    ImGui::SetNextWindowSize(
        {static_cast<float>(width), static_cast<float>(barHeight + barRow * rows.back()) * scale});
    ImGui::Begin("bar", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoBringToFrontOnFocus);
    auto next = [&, at = std::size_t{0}]() mutable {
        ++at;
        if (rows.at(at) == rows.at(at - 1)) ImGui::SameLine(0, static_cast<float>(barGap) * scale);
        ImGui::AlignTextToFramePadding();
    };
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted("channel");
    ImGui::SameLine();
    channelCombo(state, 180 * scale);
    next();
    ImGui::Checkbox("heat map", &state.view_options.heat);
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("how many lights each pixel evaluates (E)");
    next();
    ImGui::TextUnformatted("panels");
    ImGui::SameLine();
    combo("##layout", 115 * scale, state.canvas.layout, {Layout::wipe, Layout::side_by_side, Layout::single},
          [](Layout l) { return nameOf(l); });
    next();
    ImGui::TextUnformatted("against");
    ImGui::SameLine();
    Against against = state.view_options.against;
    combo("##against", 134 * scale, against,
          state.stored.empty()
              ? std::initializer_list<Against>{Against::paths, Against::reference}
              : std::initializer_list<Against>{Against::paths, Against::reference, Against::file},
          [](Against a) { return viewer::nameOf(a); });
    if (against != state.view_options.against) {
        state.view_options.against = against;
        state.view_options.file = against == Against::file ? state.stored : std::filesystem::path();
    }
    next();
    ImGui::TextUnformatted("difference");
    ImGui::SameLine();
    combo("##difference", 92 * scale, state.view_options.difference,
          {Difference::none, Difference::signed_difference, Difference::absolute, Difference::relative,
           Difference::flip},
          [](Difference d) { return viewer::nameOf(d); });
    next();
    exposureInput(state, contents, 90 * scale);
    next();
    if (ImGui::SmallButton("keys: H")) state.help = !state.help;
    ImGui::End();
}

// ---- the footer ---------------------------------------------------------------------------------------

void foot(InterfaceState& state, const Contents& contents, const std::vector<PanelRect>& panel_rects,
          int width, int height, float scale) {
    const float tall = static_cast<float>(footHeight) * scale;
    ImGui::SetNextWindowPos({0, static_cast<float>(height) - tall});
    ImGui::SetNextWindowSize({static_cast<float>(width), tall});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {8 * scale, 4 * scale});
    ImGui::Begin("foot", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoBringToFrontOnFocus);
    std::string doing = contents.status.doing.empty() ? (contents.idle ? "done" : "drawing")
                                                      : fmt::format("{} {:.0f} %", contents.status.doing,
                                                                    100 * contents.status.fraction);
    if (!panel_rects.empty())
        doing = fmt::format("{}{:.3g} %   {}", state.canvas.zoom > 0 ? "zoom " : "fit, ",
                            100 * panel_rects.front().placement.scale, doing);
    const float room = ImGui::CalcTextSize(doing.c_str()).x + 24 * scale;
    const bool is_error = !contents.status.error.empty(), is_message = ImGui::GetTime() < state.message_until;
    const std::string sentence = is_error     ? contents.status.error
                                 : is_message ? state.message
                                              : belowText(contents);
    const ImVec4 color = is_error     ? ImVec4{1, 0.45f, 0.4f, 1}
                         : is_message ? ImVec4{0.6f, 0.9f, 0.6f, 1}
                                      : ImGui::GetStyleColorVec4(ImGuiCol_Text);
    // A long line is clipped before the status; the tooltip shows all of it.
    ImGui::BeginChild("words", {std::max(1.0f, static_cast<float>(width) - room), ImGui::GetTextLineHeight()},
                      false, ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
    ImGui::PushStyleColor(ImGuiCol_Text, color);
    ImGui::TextUnformatted(sentence.c_str());
    ImGui::PopStyleColor();
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", sentence.c_str());
    ImGui::EndChild();
    ImGui::SameLine(std::max(0.0f, static_cast<float>(width) - room + 12 * scale));
    ImGui::TextUnformatted(doing.c_str());
    ImGui::End();
    ImGui::PopStyleVar();
}

void help(InterfaceState& state, int width, int height, float scale) {
    if (!state.help) return;
    ImGui::SetNextWindowPos({0.5f * static_cast<float>(width), 0.5f * static_cast<float>(height)},
                            ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSizeConstraints(
        {0, 0}, {static_cast<float>(width), std::max(60.0f, static_cast<float>(height) - 80 * scale)});
    if (ImGui::Begin("Keys", &state.help,
                     ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings |
                         ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoMove)) {
        if (ImGui::BeginTable("keys", 2, ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_RowBg)) {
            for (const KeyBinding& binding : keyBindings()) {
                ImGui::TableNextRow();
                ImGui::TableNextColumn();
                ImGui::TextColored({1, 0.9f, 0.4f, 1}, "%s", std::string(binding.name).c_str());
                ImGui::TableNextColumn();
                ImGui::TextUnformatted(std::string(binding.does).c_str());
            }
            for (const auto& [name, does] :
                 {std::pair{"left drag",
                            "looks around; in zoom moves the picture; on the wipe's line moves the line"},
                  std::pair{"right click", "inspects a pixel: both surfaces, its lights, the tolerance"},
                  std::pair{"wheel", "changes the camera's speed; in zoom, the size of pixels"},
                  std::pair{
                      "drop a file",
                      "opens a scene, an environment (.hdr, .exr) or a stored image (.exr by Diptych)"}}) {
                ImGui::TableNextRow();
                ImGui::TableNextColumn();
                ImGui::TextColored({1, 0.9f, 0.4f, 1}, "%s", name);
                ImGui::TableNextColumn();
                ImGui::TextUnformatted(does);
            }
            ImGui::EndTable();
        }
    }
    ImGui::End();
}

// Progress of reading the scene, while there is nothing to show yet.
void loading(const Contents& contents, const CanvasRect& canvas, float scale) {
    if (contents.shown && !contents.status.loading) return;
    const float width = std::min(420 * scale, 0.8f * static_cast<float>(canvas.width));
    ImGui::SetNextWindowPos({static_cast<float>(canvas.x) + 0.5f * static_cast<float>(canvas.width),
                             static_cast<float>(canvas.y) + 0.5f * static_cast<float>(canvas.height)},
                            ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({width, 0});
    if (ImGui::Begin(
            "loading", nullptr,
            ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoSavedSettings)) {
        ImGui::TextUnformatted(contents.status.doing.empty() ? "waiting" : contents.status.doing.c_str());
        ImGui::ProgressBar(static_cast<float>(contents.status.fraction));
    }
    ImGui::End();
}

}  // namespace

void drawInterface(InterfaceState& state, const Contents& contents, const CanvasRect& canvas,
                   const std::vector<PanelRect>& panel_rects, double scale) {
    const auto s = static_cast<float>(scale);
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const int width = static_cast<int>(display.x), height = static_cast<int>(display.y);
    if (contents.shown) drawOverlays(state, contents, canvas, panel_rects, s);
    bar(state, contents, width, s);
    foot(state, contents, panel_rects, width, height, s);
    if (state.panels || state.information)
        drawPanels(state, contents,
                   {canvas.x + canvas.width, canvas.y, width - canvas.x - canvas.width, canvas.height}, s);
    loading(contents, canvas, s);
    help(state, width, height, s);
}

}  // namespace diptych::viewer
