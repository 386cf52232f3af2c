// SPDX-License-Identifier: MIT
#include "compare/viewer/interface/actions.h"

#include "compare/files/diptych_files.h"
#include "shared/frame/debug_modes.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <filesystem>
#include <initializer_list>
#include <utility>
#include <vector>

namespace diptych::viewer {
namespace {

template <class Value>
void cycle(Value& value, std::initializer_list<Value> values) {
    const auto* const at = std::ranges::find(values, value);
    value = at == values.end() || at + 1 == values.end() ? *values.begin() : *(at + 1);
}

// Steps through the channels above 9, by index.
void nextChannel(ViewOptions& view_options, int step) {
    std::vector<Channel> beyond;
    for (const DebugMode& mode : debugModes())
        if (channelIndex(mode.channel) > 9) beyond.push_back(mode.channel);
    const auto count = static_cast<std::ptrdiff_t>(beyond.size());
    std::ptrdiff_t at = std::ranges::find(beyond, view_options.mode) - beyond.begin();
    at = at == count ? (step > 0 ? 0 : count - 1) : (at + step + count) % count;
    view_options.mode = beyond[static_cast<std::size_t>(at)];
}

void nextLeftPanel(const std::filesystem::path& stored, ViewOptions& view_options) {
    if (stored.empty())
        cycle(view_options.against, {Against::paths, Against::reference});
    else
        cycle(view_options.against, {Against::paths, Against::reference, Against::file});
    view_options.file = view_options.against == Against::file ? stored : std::filesystem::path();
}

// Switches the lights of --lights; false if there are none.
bool switchRig(InterfaceState& state) {
    const std::string& lights = state.subject.settings.lights;
    if (state.rig.empty() && lights.empty()) return false;
    if (lights.empty()) {
        setOption(state, "lights", state.rig);
    } else {
        state.rig = lights;
        setOption(state, "lights", "none");
    }
    return true;
}

}  // namespace

// One case an action, so longer than a function should be.
std::optional<std::string> actOnState(const KeyPress& pressed, bool shift, const Contents& contents,
                                      InterfaceState& state) {
    switch (pressed.action) {
        case Action::orbit:
            state.orbiting = !state.orbiting;
            return state.orbiting ? "dragging orbits what is under the cursor" : "dragging looks around";
        case Action::wipe:
            // A difference has no panels to arrange.
            if (std::exchange(state.view_options.difference, Difference::none) == Difference::none)
                cycle(state.canvas.layout, {Layout::wipe, Layout::side_by_side, Layout::single});
            break;
        case Action::difference:
            cycle(state.view_options.difference,
                  {Difference::none, Difference::signed_difference, Difference::absolute,
                   Difference::relative, Difference::flip});
            break;
        case Action::against:
            nextLeftPanel(state.stored, state.view_options);
            break;
        case Action::swap:
            for (Settings* s : {&state.subject.settings, &state.edited})
                s->path = s->path == drawn_paths[0] ? drawn_paths[1] : drawn_paths[0];
            break;
        case Action::channel:
            state.view_options.mode = channelOfIndex(pressed.index).value();
            break;
        case Action::next_channel:
            nextChannel(state.view_options, shift ? -1 : 1);
            break;
        case Action::light_debug:
            state.light_debug = !state.light_debug;
            break;
        case Action::light_visibility:
            state.view_options.heat = !state.view_options.heat;
            break;
        case Action::information:
            state.information = !state.information;
            break;
        case Action::play:
            if (!contents.properties || !(contents.properties->duration > 0))
                return "this scene has no animation";
            state.playing = !state.playing;
            break;
        case Action::scene_lights:
            setOption(state, "scene-lights", state.subject.settings.scene_lights ? "off" : "on");
            break;
        case Action::rig:
            if (!switchRig(state))
                return "no lights from --lights: add some in the settings panel, such as point:32";
            break;
        case Action::panels:
            state.panels = !state.panels;
            break;
        case Action::help:
            state.help = !state.help;
            break;
        default:
            return std::nullopt;
    }
    return std::string();
}

std::optional<std::string> openDropped(const std::filesystem::path& file, InterfaceState& state) {
    std::string ending = file.extension().string();
    std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
    if (ending == ".gltf" || ending == ".glb") return std::nullopt;
    if (ending == ".exr" && isDiptychImage(file)) {
        state.stored = state.view_options.file = file;
        state.view_options.against = Against::file;
        return "left: " + file.string();
    }
    if (ending == ".hdr" || ending == ".exr") {
        for (Settings* s : {&state.subject.settings, &state.edited}) s->env = file.string();
        return "environment: " + file.string();
    }
    return file.string() + ": not a .gltf, .glb, .exr or .hdr file";
}

}  // namespace diptych::viewer
