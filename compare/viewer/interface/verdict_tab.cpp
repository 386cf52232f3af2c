// SPDX-License-Identifier: MIT
#include "compare/viewer/interface/tabs.h"

#include "compare/frames/frame_properties.h"
#include "compare/output/writers.h"
#include "compare/report/document.h"
#include "compare/report/titles.h"
#include "compare/viewer/interface/widgets.h"

#include <fmt/format.h>
#include <imgui.h>

#include <cmath>
#include <string>

namespace diptych::viewer {
namespace {

std::string metric(double value) {
    return value == 0 ? "0" : std::isfinite(value) ? fmt::format("{:.3g}", value) : "infinite";
}

// Shows the comparison's images in the panels.
void showComparison(InterfaceState& state, const Report& report, const Comparison& comparison) {
    const Frame &baseline = report.baseline(comparison), &test = report.test(comparison);
    for (Settings* settings : {&state.subject.settings, &state.edited}) settings->path = test.settings.path;
    state.view_options.against = !baseline.origin.file.empty() ? Against::file
                                 : isReferenceFrame(baseline)  ? Against::reference
                                                               : Against::paths;
    state.view_options.file =
        state.view_options.against == Against::file ? state.stored : std::filesystem::path();
}

bool isShown(const InterfaceState& state, const Report& report, const Comparison& comparison) {
    return report.test(comparison).settings.path == state.subject.settings.path &&
           isReferenceFrame(report.baseline(comparison)) ==
               (state.view_options.against == Against::reference);
}

void channelRow(InterfaceState& state, const Report& report, const Comparison& comparison,
                const ChannelDiff& channel) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    const bool compared = isCompared(channel.verdict);
    const std::string name(channel.mode->name);
    if (ImGui::Selectable(
            name.c_str(),
            channel.mode->channel == state.view_options.mode && isShown(state, report, comparison),
            ImGuiSelectableFlags_SpanAllColumns)) {
        state.view_options.mode = channel.mode->channel;
        showComparison(state, report, comparison);
        if (compared && channel.stats.worst_x >= 0)
            state.requests.flight = {{channel.stats.worst_x, channel.stats.worst_y}};
        if (compared && state.view_options.difference == Difference::none)
            state.view_options.difference = Difference::absolute;
    }
    if (ImGui::IsItemHovered()) {
        ImGui::BeginTooltip();
        ImGui::PushTextWrapPos(32 * ImGui::GetFontSize());
        ImGui::TextUnformatted(std::string(channel.mode->shows).c_str());
        if (compared) {
            const output::Paragraph finding{findingOf(channel, "")};
            ImGui::TextUnformatted(output::inText({finding}).c_str());
        }
        ImGui::PopTextWrapPos();
        ImGui::EndTooltip();
    }
    // The criterion, as on the terminal and the page.
    const auto& decided = channel.criterion;
    ImGui::TableNextColumn();
    wrapped(decided ? decided->metric : "");
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(decided ? metric(decided->measured).c_str() : "");
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(decided ? ((decided->min ? ">= " : "") + metric(decided->limit)).c_str() : "");
    ImGui::TableNextColumn();
    const bool failed = channel.verdict == Verdict::fail;
    ImGui::TextColored(failed     ? bad
                       : compared ? good
                                  : faint,
                       "%s", std::string(nameOf(channel.verdict)).c_str());
}

void comparisonTable(InterfaceState& state, const Report& report, const Comparison& comparison,
                     std::size_t index) {
    const std::string title =
        fmt::format("{}: {}", pairTitle(report, comparison), comparison.passed() ? "pass" : "FAIL");
    ImGui::TextColored(comparison.passed() ? good : bad, "%s", title.c_str());
    for (const std::string& failure : comparison.failures) wrapped(failure, &bad);
    const std::string id = fmt::format("channels{}", index);
    ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, {3, 2});  // so that all five columns fit
    if (!beginTable(id.c_str(), {"channel", "metric", "measured", "limit", "verdict"}, 1))
        return ImGui::PopStyleVar();
    for (const ChannelDiff* channel : failuresFirst(comparison))
        channelRow(state, report, comparison, *channel);
    ImGui::EndTable();
    ImGui::PopStyleVar();
}

}  // namespace

void verdictTab(InterfaceState& state, const Contents& contents) {
    if (!contents.evaluated) {
        wrapped("Both paths are compared, channel by channel, once the view stands still.", &faint);
        return;
    }
    if (contents.evaluated->subject != ofBothPaths(state.subject))
        wrapped("This is the verdict of the previous view; the new one is compared once it stands still.",
                &faint);
    else
        wrapped(
            "Click a channel to show its difference at its worst pixel; hover over it for its tolerance and "
            "the reason.",
            &faint);
    std::size_t index = 0;
    for (const Comparison& comparison : contents.evaluated->report.comparisons)
        comparisonTable(state, contents.evaluated->report, comparison, index++);
    if (ImGui::SmallButton("copy as diptych compare")) state.requests.copy = compareCommand(state);
}

}  // namespace diptych::viewer
