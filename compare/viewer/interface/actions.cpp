// SPDX-License-Identifier: MIT
#include "compare/viewer/interface/actions.h"

#include "compare/files/diptych_files.h"
#include "shared/frame/debug_modes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <cstdlib>
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

// The next of the scene's cameras, by number; from a moved one the first. Returns a message.
std::string nextCamera(const Contents& contents, InterfaceState& state) {
    const std::size_t count = contents.properties ? contents.properties->cameras.size() : 0;
    if (count == 0) {
        state.requests.camera = "";
        return "the default view: this scene has no camera";
    }
    const std::string& now = state.subject.settings.camera;
    std::size_t next = 0;
    if (now.empty() && count > 1)
        next = 1;  // the first is the current one
    else if (!now.empty() && now.find('=') == now.npos)
        next = (static_cast<std::size_t>(std::atoi(now.c_str())) + 1) % count;
    state.requests.camera = std::to_string(next);
    return fmt::format("camera {} {}", next, contents.properties->cameras[next]);
}

// Returns a message; an empty one if there is a pixel to fly to.
std::string worstPixel(const Contents& contents, InterfaceState& state) {
    if (!contents.evaluated || contents.evaluated->subject != ofBothPaths(state.subject))
        return "no verdict for this view yet";
    const Channel shown = state.view_options.channel();
    for (const Comparison& comparison : contents.evaluated->report.comparisons)
        for (const ChannelDiff& channel : comparison.channels)
            if (channel.mode->channel == shown && channel.stats.worst_x >= 0) {
                state.requests.flight = {{channel.stats.worst_x, channel.stats.worst_y}, surroundingsZoom};
                return {};
            }
    return fmt::format("no pixel of {} differs", debugMode(shown).name);
}

// To the pixel under the cursor or in the middle, and back.
void switchZoom(const Contents& contents, InterfaceState& state) {
    const Size& size = state.subject.settings.size;
    if (state.canvas.zoom > 0)
        state.canvas.zoom = 0;
    else
        state.requests.flight = {
            contents.under ? contents.under->pixel : PixelPosition{size.width / 2, size.height / 2},
            digitsZoom};
}

// Leaves the help, the zoom or the inspected pixel; false if there is none of them.
bool leaveInnermost(InterfaceState& state) {
    if (state.help)
        state.help = false;
    else if (state.canvas.zoom > 0)
        state.canvas.zoom = 0;
    else if (state.pixel)
        state.pixel.reset();
    else
        return false;
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
        case Action::zoom:
            switchZoom(contents, state);
            break;
        case Action::worst_pixel:
            return worstPixel(contents, state);
        case Action::next_camera:
            return nextCamera(contents, state);
        case Action::reload:
            state.requests.reload = true;
            break;
        case Action::copy_command:
            state.requests.copy = renderCommand(state);
            break;
        case Action::leave:
            if (!leaveInnermost(state)) return std::nullopt;
            break;
        default:
            return std::nullopt;
    }
    return std::string();
}

std::string openDropped(const std::filesystem::path& file, InterfaceState& state) {
    std::string ending = file.extension().string();
    std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
    if (ending == ".gltf" || ending == ".glb") {
        state.subject.scene = file.string();
        for (Settings* s : {&state.subject.settings, &state.edited}) {
            s->camera.clear();
            s->time = 0;
            s->animation.clear();
            s->variant.clear();
        }
        state.pixel.reset();
        state.canvas.zoom = 0;
        state.requests.camera = "";
        state.requests.reload = true;
        return {};
    }
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

bool fitToCanvas(const CanvasRect& canvas, InterfaceState& state) {
    Settings& settings = state.subject.settings;
    const Size before = settings.size;
    if (state.follow) {
        const bool halves =
            state.canvas.layout == Layout::side_by_side && state.view_options.difference == Difference::none;
        settings.size = {std::max(1, halves ? (canvas.width - 2) / 2 : canvas.width),
                         std::max(1, canvas.height)};
        if (settings.size != before) state.edited.size = settings.size;
    }
    if (state.pixel && (state.pixel->x >= settings.size.width || state.pixel->y >= settings.size.height))
        state.pixel.reset();
    return settings.size != before;
}

}  // namespace diptych::viewer
