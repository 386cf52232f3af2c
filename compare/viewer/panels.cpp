// SPDX-License-Identifier: MIT
#include "compare/viewer/panels.h"

#include "compare/render/frame_facts.h"
#include "compare/report/titles.h"
#include "compare/viewer/fonts.h"
#include "shared/frame/settings.h"
#include "shared/scene/lights/lights_json.h"
#include "shared/text/counted.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

namespace diptych::viewer {
namespace {

const ImVec4 bad{1, 0.42f, 0.38f, 1}, good{0.5f, 0.9f, 0.5f, 1}, faint{0.62f, 0.62f, 0.65f, 1};

void wrapped(const std::string& text, const ImVec4* color = nullptr) {
    if (color) ImGui::PushStyleColor(ImGuiCol_Text, *color);
    ImGui::PushTextWrapPos(0);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    if (color) ImGui::PopStyleColor();
}

// A table whose columns fit their contents, except column `wraps`, which takes the rest and wraps its
// text.
bool beginTable(const char* id, std::initializer_list<const char*> heads, int wraps,
                ImGuiTableFlags flags = 0, const ImVec2& size = {0, 0}) {
    if (!ImGui::BeginTable(id, static_cast<int>(heads.size()),
                           ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_RowBg | flags, size))
        return false;
    for (int column = 0; const char* head : heads)
        ImGui::TableSetupColumn(head, column++ == wraps ? ImGuiTableColumnFlags_WidthStretch : 0);
    ImGui::TableHeadersRow();
    return true;
}

// ---- verdict ------------------------------------------------------------------------------------------

std::string figure(double value) {
    return value == 0 ? "0" : std::isfinite(value) ? fmt::format("{:.3g}", value) : "infinite";
}

// Shows the comparison's images in the panels.
void showComparison(InterfaceState& state, const Report& report, const Comparison& comparison) {
    const Frame &baseline = report.baseline(comparison), &test = report.test(comparison);
    for (Settings* settings : {&state.subject.settings, &state.edited}) settings->path = test.settings.path;
    state.look.against = !baseline.origin.file.empty() ? Against::file
                         : isReferenceFrame(baseline)  ? Against::reference
                                                       : Against::paths;
    state.look.file = state.look.against == Against::file ? state.stored : std::filesystem::path();
}

bool isShown(const InterfaceState& state, const Report& report, const Comparison& comparison) {
    return report.test(comparison).settings.path == state.subject.settings.path &&
           isReferenceFrame(report.baseline(comparison)) == (state.look.against == Against::reference);
}

void channelRow(InterfaceState& state, const Report& report, const Comparison& comparison,
                const ChannelDiff& channel) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    const bool compared = isCompared(channel.verdict);
    const std::string name(channel.mode->name);
    if (ImGui::Selectable(name.c_str(),
                          channel.mode->number == state.look.mode && isShown(state, report, comparison),
                          ImGuiSelectableFlags_SpanAllColumns)) {
        state.look.mode = channel.mode->number;
        showComparison(state, report, comparison);
        if (compared && channel.stats.worst_x >= 0)
            state.requests.worst = {channel.mode->number, {channel.stats.worst_x, channel.stats.worst_y}};
        if (compared && state.look.difference == Difference::none)
            state.look.difference = Difference::absolute;
    }
    if (ImGui::IsItemHovered()) {
        ImGui::BeginTooltip();
        ImGui::PushTextWrapPos(32 * ImGui::GetFontSize());
        ImGui::TextUnformatted(std::string(channel.mode->shows).c_str());
        if (compared) {
            ImGui::Text("largest error %s, %s", figure(channel.stats.max).c_str(),
                        std::string(nameOf(channel.mode->metric)).c_str());
            ImGui::TextUnformatted(
                ("tolerance " + figure(channel.tolerance.max) + ": " + channel.tolerance.because).c_str());
        }
        if (!channel.reason.empty()) ImGui::TextColored(bad, "%s", channel.reason.c_str());
        ImGui::PopTextWrapPos();
        ImGui::EndTooltip();
    }
    // The criterion, as on the terminal and the page.
    const auto& decided = channel.criterion;
    ImGui::TableNextColumn();
    wrapped(decided ? decided->figure : "");
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(decided ? figure(decided->measured).c_str() : "");
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(decided ? ((decided->least ? ">= " : "") + figure(decided->limit)).c_str() : "");
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

void verdictTab(InterfaceState& state, const Contents& contents) {
    if (!contents.judged) {
        wrapped("Both paths are compared, channel by channel, once the view stands still.", &faint);
        return;
    }
    if (contents.judged->subject != ofBothPaths(state.subject))
        wrapped("This is the verdict of the previous view; the new one is compared once it stands still.",
                &faint);
    else
        wrapped(
            "Click a channel to show its difference at its worst pixel; hover over it for its tolerance and "
            "the reason.",
            &faint);
    std::size_t index = 0;
    for (const Comparison& comparison : contents.judged->report.comparisons)
        comparisonTable(state, contents.judged->report, comparison, index++);
    if (ImGui::SmallButton("copy as diptych compare")) state.requests.copy = compareCommand(state);
}

// ---- settings -----------------------------------------------------------------------------------------

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

// ---- scene --------------------------------------------------------------------------------------------

void animationRows(InterfaceState& state, const SceneFacts& facts) {
    if (facts.animations.empty()) return;
    ImGui::Separator();
    auto time = static_cast<float>(state.subject.settings.time);
    ImGui::SetNextItemWidth(17 * ImGui::GetFontSize());
    if (ImGui::SliderFloat("time, s", &time, 0, static_cast<float>(std::max(facts.duration, 1e-3)), "%.3f"))
        setOption(state, "time", fmt::format("{}", time));
    ImGui::SameLine();
    if (ImGui::SmallButton(state.playing ? "stop (K)" : "play (K)")) state.playing = !state.playing;
}

const char* unitOf(LightKind kind) {
    if (kind == LightKind::directional) return "lx";
    return kind == LightKind::point || kind == LightKind::spot ? "cd" : "W/(sr m^2)";
}

void lightRows(InterfaceState& state, const Contents& contents) {
    ImGui::Separator();
    bool own = state.subject.settings.scene_lights;
    if (ImGui::Checkbox("the scene's own lights (L)", &own))
        setOption(state, "scene-lights", own ? "on" : "off");
    bool rig = !state.subject.settings.lights.empty();
    const std::string named = rig ? state.subject.settings.lights : state.rig;
    if (!named.empty() && ImGui::Checkbox(fmt::format("lights {} (J)", named).c_str(), &rig)) {
        if (!rig) state.rig = named;
        setOption(state, "lights", rig ? named : "none");
    }
    ImGui::Checkbox("show positions and ranges (Q)", &state.light_debug);
    if (!contents.shown) return;
    if (!beginTable("lights", {"light", "type", "intensity", "range, m"}, 0, ImGuiTableFlags_ScrollY,
                    {0, ImGui::GetFontSize() *
                            std::min(14.0f, 2 * static_cast<float>(contents.shown->lights.size() + 1))}))
        return;
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(contents.shown->lights.size()));
    while (clipper.Step())
        for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
            const Light& light = contents.shown->lights[static_cast<std::size_t>(i)];
            ImGui::TableNextRow();
            ImGui::TableNextColumn();
            ImGui::Text("%d %s", i, light.name.c_str());  // one line: a clipper needs rows of equal height
            if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", light.name.c_str());
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(std::string(nameOf(light.kind)).c_str());
            ImGui::TableNextColumn();
            ImGui::Text("%.4g %s", double{light.intensity}, unitOf(light.kind));
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(std::isfinite(light.range) ? fmt::format("{:.4g}", light.range).c_str()
                                                              : "none");
        }
    ImGui::EndTable();
}

void planRows(const Contents& contents) {
    if (!contents.shown || contents.shown->plan.empty()) return;
    for (const bool modelled : {true, false}) {
        if (!ImGui::CollapsingHeader(modelled ? "Modelled for this scene" : "Left out, and why",
                                     modelled ? 0 : ImGuiTreeNodeFlags_DefaultOpen))
            continue;
        for (const Requirements::Line& line : contents.shown->plan)
            if (line.modelled == modelled) wrapped(fmt::format("{}: {}", line.what, line.why));
    }
}

void sceneTab(InterfaceState& state, const Contents& contents) {
    wrapped(sceneOf(state));
    if (sceneOf(state) != state.subject.scene)
        wrapped(contents.status.loading ? "reading: " + state.subject.scene
                                        : "cannot read: " + state.subject.scene,
                contents.status.loading ? &faint : &bad);
    if (ImGui::SmallButton("read again (R)")) state.requests.reload = true;
    ImGui::SameLine();
    if (ImGui::SmallButton("copy as diptych render (Y)")) state.requests.copy = renderCommand(state);
    if (!contents.facts) return;
    const SceneFacts& facts = *contents.facts;
    ImGui::Separator();
    const std::string& camera = state.subject.settings.camera;
    ImGui::SetNextItemWidth(20 * ImGui::GetFontSize());
    if (ImGui::BeginCombo("camera (N)", camera.empty() ? "the scene's first, or the default view"
                                        : camera.find('=') != camera.npos ? "free"
                                                                          : camera.c_str())) {
        if (ImGui::Selectable("the scene's first, or the default view", camera.empty()))
            state.requests.camera = "";
        for (std::size_t i = 0; i < facts.cameras.size(); ++i)
            if (ImGui::Selectable(fmt::format("{} {}", i, facts.cameras[i]).c_str(),
                                  camera == std::to_string(i)))
                state.requests.camera = std::to_string(i);
        ImGui::EndCombo();
    }
    animationRows(state, facts);
    lightRows(state, contents);
    ImGui::Separator();
    wrapped("environment: " + state.subject.settings.env);
    if (ImGui::CollapsingHeader("Notes", ImGuiTreeNodeFlags_DefaultOpen)) {
        std::vector<std::string> notes = facts.notes;
        if (contents.shown)
            for (const PathFacts& path : contents.shown->paths)
                for (const std::string& note : path.notes)
                    if (std::ranges::find(notes, note) == notes.end()) notes.push_back(note);
        for (const std::string& note : notes) wrapped(note);
        if (notes.empty()) wrapped("none", &faint);
    }
    planRows(contents);
}

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
    ImGui::TextUnformatted(contents.breakdown->words.c_str());
    if (!here) ImGui::PopStyleColor();
    ImGui::PopFont();
    ImGui::EndChild();
}

// ---- cost ---------------------------------------------------------------------------------------------

void passTable(const PathFacts& facts, const History& history, float scale) {
    double sum = 0;
    for (const PassTime& pass : facts.passes) sum += pass.ms;
    if (!beginTable(facts.name.c_str(), {"pass", "ms", "share", "last frames"}, 0)) return;
    for (const PassTime& pass : facts.passes) {
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
        ImGui::PlotLines(("##" + facts.name + pass.name).c_str(), flat.data(), static_cast<int>(flat.size()),
                         0, nullptr, 0, 1.2f * *std::ranges::max_element(flat), {120 * scale, 18 * scale});
    }
    ImGui::EndTable();
}

void costTab(const Contents& contents, float scale) {
    wrapped(fmt::format("rendering device: {}; window device: {}", contents.drawn_by, contents.shown_by),
            &faint);
    if (!contents.shown || !contents.history) return;
    for (std::size_t i = 0; i < 2; ++i) {
        const PathFacts& facts = contents.shown->paths.at(i);
        if (facts.name.empty()) continue;
        ImGui::Separator();
        ImGui::Text("%s: %.2f ms per frame", facts.name.c_str(), facts.ms);
        constexpr double mib = 1 << 20;
        ImGui::TextWrapped("images %.2f MiB, buffers %.2f MiB; geometry buffers %llu bytes per pixel",
                           static_cast<double>(facts.bytes.images) / mib,
                           static_cast<double>(facts.bytes.buffers) / mib,
                           static_cast<unsigned long long>(facts.bytes.gbuffer_per_pixel));
        passTable(facts, contents.history->at(i), scale);
    }
}

}  // namespace

namespace {

// ---- times --------------------------------------------------------------------------------------------

// The lines below the paths' times.
std::vector<std::pair<std::string, ImVec4>> timesLines(const Contents& contents) {
    const PathFacts& facts = contents.shown->paths[1];
    const ImVec4 standard = ImGui::GetStyleColorVec4(ImGuiCol_Text);
    std::vector<std::pair<std::string, ImVec4>> lines{{counted(facts.counters.lights, "light"), standard}};
    if (facts.mean_lights)
        lines[0].first += fmt::format("; a pixel evaluates {:.1f} on average, at most {:.0f}",
                                      *facts.mean_lights, *facts.most_lights);
    if (facts.counters.overflowed_lists > 0)
        lines.emplace_back(counted(facts.counters.overflowed_lists, "light list") + " overflowed",
                           ImVec4{1, 0.6f, 0.3f, 1});
    if (facts.counters.nonfinite_pixels > 0)
        lines.emplace_back(counted(facts.counters.nonfinite_pixels, "pixel") + " NaN or infinite",
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
    const Shown& shown = *contents.shown;
    ImGui::Separator();
    const bool small = shown.size.width != shown.order.subject.settings.size.width;
    ImGui::Text("%dx%d%s", shown.size.width, shown.size.height, small ? ", reduced while moving" : "");
    if (ImGui::BeginTable("times", 4, ImGuiTableFlags_SizingFixedFit)) {
        for (const char* column : {"path", "time", "memory"}) ImGui::TableSetupColumn(column);
        ImGui::TableSetupColumn("last frames", ImGuiTableColumnFlags_WidthStretch);
        for (std::size_t i = 0; i < 2; ++i) {
            const PathFacts& facts = shown.paths.at(i);
            if (facts.name.empty()) continue;
            ImGui::TableNextRow();
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(facts.name.c_str());
            ImGui::TableNextColumn();
            ImGui::Text("%.2f ms", facts.ms);
            ImGui::TableNextColumn();
            ImGui::Text("%.1f MiB",
                        static_cast<double>(facts.bytes.images + facts.bytes.buffers) / (1 << 20));
            ImGui::TableNextColumn();
            if (!contents.history || contents.history->at(i).total.empty()) continue;
            const std::deque<float>& total = contents.history->at(i).total;
            const std::vector<float> flat(total.begin(), total.end());
            const float most = 1.2f * *std::ranges::max_element(flat);
            ImGui::PlotLines(fmt::format("##total{}", i).c_str(), flat.data(), static_cast<int>(flat.size()),
                             0, nullptr, 0, most,
                             {ImGui::GetContentRegionAvail().x, ImGui::GetTextLineHeight()});
            if (ImGui::IsItemHovered()) ImGui::SetTooltip("from 0 to %.3g ms", double{most});
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
