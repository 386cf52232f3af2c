// SPDX-License-Identifier: MIT
#include "compare/viewer/interface/interface_state.h"

#include "compare/run/command_text.h"
#include "shared/frame/debug_modes.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace diptych::viewer {
namespace {

void push(std::deque<float>& values, double value) {
    values.push_back(static_cast<float>(value));
    if (values.size() > History::longest) values.pop_front();
}

}  // namespace

void History::add(const PathProperties& properties) {
    if (properties.ms <= 0 || properties.measurement == measurement) return;
    measurement = properties.measurement;
    push(total, properties.ms);
    for (const PassTime& pass : properties.passes) push(passes[pass.name], pass.ms);
}

std::array<int, barWidths.size()> barRows(int width, double scale) {
    std::array<int, barWidths.size()> rows{};
    double x = barEdge;
    int row = 0;
    for (std::size_t i = 0; i < barWidths.size(); ++i) {
        if (i > 0 && (x + barWidths.at(i) + barEdge) * scale > width) {
            ++row;
            x = barEdge;
        }
        rows.at(i) = row;
        x += barWidths.at(i) + barGap;
    }
    return rows;
}

CanvasRect canvasOf(const InterfaceState& state, int width, int height, double scale) {
    const int rows = barRows(width, scale).back();
    const int top = static_cast<int>((barHeight + barRow * rows) * scale),
              bottom = static_cast<int>(footHeight * scale);
    // A narrow window keeps half of its width for images.
    const double beside = state.panels ? sideWidth : state.information ? timesWidth : 0;
    const int side = std::min(static_cast<int>(beside * scale), width / 2);
    return {0, top, std::max(1, width - side), std::max(1, height - top - bottom)};
}

std::string valueText(const Image& image, int x, int y) {
    std::string words;
    if (x < 0 || y < 0 || x >= image.width || y >= image.height) return words;
    for (int c = 0; c < image.components; ++c)
        words += fmt::format("{}{}", c > 0 ? " " : "", image.at(x, y, c));
    return words;
}

std::string belowText(const Contents& contents) {
    if (!contents.under || !contents.shown) return "no pixel under the cursor";
    const DrawnView& shown = *contents.shown;
    const Size& full = shown.request.subject.settings.size;
    const auto [x, y] = contents.under->pixel;
    std::string words = fmt::format("{},{}", x, y);
    for (const Panel& panel : shown.panels)
        if (!panel.values.empty())
            words += fmt::format("  {}: {}", panel.name,
                                 valueText(panel.values, x * panel.values.width / full.width,
                                           y * panel.values.height / full.height));
    if (shown.difference && !shown.difference->values.empty()) {
        const Image& values = shown.difference->values;
        words += fmt::format("  difference: {}", valueText(values, x * values.width / full.width,
                                                           y * values.height / full.height));
    }
    return words;
}

std::vector<PanelRect> panelRectsOf(const CanvasRect& canvas, const InterfaceState& state) {
    return panelRectsOf(canvas, state.subject.settings.size, state.canvas,
                        state.view_options.difference != Difference::none);
}

const std::string& sceneOf(const InterfaceState& state) {
    return state.loaded.empty() ? state.subject.scene : state.loaded;
}

std::string titleOf(const InterfaceState& state, const Contents& contents) {
    return fmt::format("Diptych - {} - {}",
                       contents.properties ? contents.properties->name : state.subject.scene,
                       debugMode(state.view_options.channel()).name);
}

std::string renderCommand(const InterfaceState& state) {
    std::vector<std::string> words =
        commandArguments("render", sceneOf(state),
                         state.subject.sides.of(state.subject.settings, state.subject.settings.path));
    if (state.view_options.channel() != Channel::lit)
        words = withOption(std::move(words), "--debug",
                           std::string(debugMode(state.view_options.channel()).name));
    if (state.view_options.exposure)
        words = withOption(std::move(words), "--exposure", fmt::format("{}", *state.view_options.exposure));
    if (state.view_options.ev100)
        words = withOption(std::move(words), "--ev100", fmt::format("{}", *state.view_options.ev100));
    if (!state.view_options.tonemap) words = withArguments(std::move(words), {"--no-tonemap"});
    return shellLine(words);
}

std::string compareCommand(const InterfaceState& state) {
    std::vector<std::string> words = commandArguments("compare", sceneOf(state), state.subject.settings);
    if (state.view_options.against == Against::reference)
        words = withOption(std::move(words), "--baseline", "reference");
    if (state.view_options.against == Against::file)
        words = withOption(std::move(words), "--baseline", state.view_options.file.string());
    return shellLine(withArguments(std::move(words), state.counted));
}

void setOption(InterfaceState& state, const std::string& option, const std::string& word) {
    if (state.subject.sides.names(option)) {
        state.problem = fmt::format("--deferred or --forward-plus sets {} for each path", option);
        return;
    }
    try {
        state.edited.set(option, word);
        state.problem.clear();
    } catch (const std::runtime_error& error) {
        state.problem = error.what();
        return;
    }
    if (std::ranges::count(drawn_paths, state.edited.path) == 0) {
        state.problem = "the right panel always shows a path; press T to show the reference on the left";
        state.edited.path = state.subject.settings.path;
        return;
    }
    for (const Path path : drawn_paths) {
        const Settings settings = state.subject.sides.of(withoutReference(state.edited), path);
        if (const auto problem = settings.problem()) {
            state.problem = *problem;
            return;
        }
    }
    if (option == "size") state.follow = false;
    state.subject.settings = state.edited;
}

}  // namespace diptych::viewer
