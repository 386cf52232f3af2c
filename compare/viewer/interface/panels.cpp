// SPDX-License-Identifier: MIT
#include "compare/viewer/interface/panels.h"

#include "compare/viewer/interface/fonts.h"
#include "compare/viewer/interface/tabs.h"
#include "compare/viewer/interface/widgets.h"
#include "shared/text/counted.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace diptych::viewer {
namespace {

// ---- pixel --------------------------------------------------------------------------------------------

void pixelTab(InterfaceState& state, const Contents& contents) {
    if (!state.pixel) {
        wrapped(
            "Right-click a picture to inspect a pixel: both surfaces, each light's term in both paths and "
            "the reference, the first step that differs, and the tolerance with its reason.",
            &faint);
        return;
    }
    ImGui::Text("pixel %d,%d", state.pixel->x, state.pixel->y);
    ImGui::SameLine();
    if (ImGui::SmallButton("copy as diptych compare --pixel"))
        state.requests.copy =
            fmt::format("{} --pixel {},{}", compareCommand(state), state.pixel->x, state.pixel->y);
    const bool here = contents.breakdown && contents.breakdown->pixel == *state.pixel &&
                      contents.breakdown->subject == ofBothPaths(state.subject);
    if (!here) wrapped("drawing: each light alone in both paths, and the reference", &faint);
    if (!contents.breakdown) return;
    ImGui::BeginChild("breakdown", {0, 0}, false, ImGuiWindowFlags_HorizontalScrollbar);
    ImGui::PushFont(evenFont());
    if (!here) ImGui::PushStyleColor(ImGuiCol_Text, faint);
    ImGui::TextUnformatted(contents.breakdown->text.c_str());
    if (!here) ImGui::PopStyleColor();
    ImGui::PopFont();
    ImGui::EndChild();
}

// ---- cost ---------------------------------------------------------------------------------------------

void passTable(const PathProperties& properties, const History& history, float scale) {
    double sum = 0;
    for (const PassTime& pass : properties.passes) sum += pass.ms;
    if (!beginTable(properties.name.c_str(), {"pass", "ms", "share", "last frames"}, 0)) return;
    for (const PassTime& pass : properties.passes) {
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        wrapped(pass.name);
        ImGui::TableNextColumn();
        ImGui::Text("%.3f", pass.ms);
        ImGui::TableNextColumn();
        ImGui::Text("%.0f %%", sum > 0 ? 100 * pass.ms / sum : 0);
        ImGui::TableNextColumn();
        const auto found = history.passes.find(pass.name);
        if (found == history.passes.end() || found->second.empty()) continue;
        const std::vector<float> flat(found->second.begin(), found->second.end());
        ImGui::PlotLines(("##" + properties.name + pass.name).c_str(), flat.data(),
                         static_cast<int>(flat.size()), 0, nullptr, 0, 1.2f * *std::ranges::max_element(flat),
                         {120 * scale, 18 * scale});
    }
    ImGui::EndTable();
}

void costTab(const Contents& contents, float scale) {
    wrapped(fmt::format("rendering device: {}; window device: {}", contents.drawn_by, contents.shown_by),
            &faint);
    if (!contents.shown || !contents.history) return;
    for (std::size_t i = 0; i < 2; ++i) {
        const PathProperties& properties = contents.shown->paths.at(i);
        if (properties.name.empty()) continue;
        ImGui::Separator();
        ImGui::Text("%s: %.2f ms per frame", properties.name.c_str(), properties.ms);
        constexpr double mib = 1 << 20;
        ImGui::TextWrapped("images %.2f MiB, buffers %.2f MiB; geometry buffers %llu bytes per pixel",
                           static_cast<double>(properties.bytes.images) / mib,
                           static_cast<double>(properties.bytes.buffers) / mib,
                           static_cast<unsigned long long>(properties.bytes.gbuffer_per_pixel));
        passTable(properties, contents.history->at(i), scale);
    }
}

// ---- times --------------------------------------------------------------------------------------------

// The lines below the paths' times.
std::vector<std::pair<std::string, ImVec4>> timesLines(const Contents& contents) {
    const PathProperties& properties = contents.shown->paths[1];
    const ImVec4 standard = ImGui::GetStyleColorVec4(ImGuiCol_Text);
    std::vector<std::pair<std::string, ImVec4>> lines{
        {counted(properties.counters.lights, "light"), standard}};
    if (properties.mean_lights)
        lines[0].first += fmt::format("; a pixel evaluates {:.1f} on average, at most {:.0f}",
                                      *properties.mean_lights, *properties.max_lights);
    if (properties.counters.overflowed_lists > 0)
        lines.emplace_back(counted(properties.counters.overflowed_lists, "light list") + " overflowed",
                           ImVec4{1, 0.6f, 0.3f, 1});
    if (properties.counters.nonfinite_pixels > 0)
        lines.emplace_back(counted(properties.counters.nonfinite_pixels, "pixel") + " NaN or infinite",
                           ImVec4{1, 0.4f, 1, 1});
    if (contents.interface_ms > 0)
        lines.emplace_back(
            fmt::format("99 % of the window's own frames take less than {:.1f} ms", contents.interface_ms),
            faint);
    return lines;
}

float timesHeight(const Contents& contents) {
    const auto rows = static_cast<float>(timesLines(contents).size()) + 4;  // a title, both paths, an edge
    return rows * ImGui::GetTextLineHeightWithSpacing();
}

// Times and memory of both paths.
void times(const Contents& contents) {
    const DrawnView& shown = *contents.shown;
    ImGui::Separator();
    const bool small = shown.size.width != shown.request.subject.settings.size.width;
    ImGui::Text("%dx%d%s", shown.size.width, shown.size.height, small ? ", reduced while moving" : "");
    if (ImGui::BeginTable("times", 4, ImGuiTableFlags_SizingFixedFit)) {
        for (const char* column : {"path", "time", "memory"}) ImGui::TableSetupColumn(column);
        ImGui::TableSetupColumn("last frames", ImGuiTableColumnFlags_WidthStretch);
        for (std::size_t i = 0; i < 2; ++i) {
            const PathProperties& properties = shown.paths.at(i);
            if (properties.name.empty()) continue;
            ImGui::TableNextRow();
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(properties.name.c_str());
            ImGui::TableNextColumn();
            ImGui::Text("%.2f ms", properties.ms);
            ImGui::TableNextColumn();
            ImGui::Text("%.1f MiB",
                        static_cast<double>(properties.bytes.images + properties.bytes.buffers) / (1 << 20));
            ImGui::TableNextColumn();
            if (!contents.history || contents.history->at(i).total.empty()) continue;
            const std::deque<float>& total = contents.history->at(i).total;
            const std::vector<float> flat(total.begin(), total.end());
            const float max = 1.2f * *std::ranges::max_element(flat);
            ImGui::PlotLines(fmt::format("##total{}", i).c_str(), flat.data(), static_cast<int>(flat.size()),
                             0, nullptr, 0, max,
                             {ImGui::GetContentRegionAvail().x, ImGui::GetTextLineHeight()});
            if (ImGui::IsItemHovered()) ImGui::SetTooltip("from 0 to %.3g ms", double{max});
        }
        ImGui::EndTable();
    }
    for (const auto& [line, color] : timesLines(contents)) wrapped(line, &color);
}

}  // namespace

void drawPanels(InterfaceState& state, const Contents& contents, const CanvasRect& rect, float scale) {
    ImGui::SetNextWindowPos({static_cast<float>(rect.x), static_cast<float>(rect.y)});
    ImGui::SetNextWindowSize({static_cast<float>(rect.width), static_cast<float>(rect.height)});
    ImGui::Begin("panels", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoBringToFrontOnFocus);
    const std::optional<Tab> open = std::exchange(state.open, std::nullopt);
    const auto tab = [&](Tab which, const char* name, const auto& draw) {
        if (!ImGui::BeginTabItem(name, nullptr, open == which ? ImGuiTabItemFlags_SetSelected : 0)) return;
        ImGui::BeginChild(name, {0, 0}, false);
        draw();
        ImGui::EndChild();
        ImGui::EndTabItem();
    };
    const bool timed = state.information && contents.shown;
    ImGui::BeginChild("above the times", {0, timed ? -timesHeight(contents) : 0});
    if (state.panels && ImGui::BeginTabBar("tabs")) {
        tab(Tab::verdict, "Verdict", [&] { verdictTab(state, contents); });
        tab(Tab::settings, "Settings", [&] { settingsTab(state); });
        tab(Tab::scene, "Scene", [&] { sceneTab(state, contents); });
        tab(Tab::pixel, "Pixel", [&] { pixelTab(state, contents); });
        tab(Tab::cost, "Cost", [&] { costTab(contents, scale); });
        ImGui::EndTabBar();
    }
    ImGui::EndChild();
    if (timed) times(contents);
    ImGui::End();
}

}  // namespace diptych::viewer
