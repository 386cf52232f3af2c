// SPDX-License-Identifier: MIT
#include "compare/viewer/interface/keys.h"

#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <algorithm>

namespace diptych::viewer {
namespace {

constexpr KeyBinding bindings[] = {
    {Action::forward, GLFW_KEY_W, "W", "moves forward", true},
    {Action::left, GLFW_KEY_A, "A", "moves left", true},
    {Action::back, GLFW_KEY_S, "S", "moves back", true},
    {Action::right, GLFW_KEY_D, "D", "moves right", true},
    {Action::rise, GLFW_KEY_SPACE, "Space", "rises", true},
    {Action::sink, GLFW_KEY_LEFT_CONTROL, "Ctrl", "sinks", true},
    {Action::orbit, GLFW_KEY_O, "O",
     "switches dragging between orbiting the point under the cursor and looking around"},
    {Action::wipe, GLFW_KEY_V, "V", "switches between wipe, side by side and one panel"},
    {Action::difference, GLFW_KEY_X, "X", "switches the difference: signed, absolute, relative, FLIP, none"},
    {Action::against, GLFW_KEY_T, "T",
     "switches the left panel: the other path, the reference, the stored image"},
    {Action::flicker, GLFW_KEY_B, "B",
     "shows the other panel while held down; over a difference, the right panel", true},
    {Action::swap, GLFW_KEY_TAB, "Tab", "swaps the paths"},
    {Action::channel, GLFW_KEY_0, "0 to 9", "shows this channel: 0 lit, 1 albedo, 2 normals, ...", false,
     GLFW_KEY_9},
    {Action::next_channel, GLFW_KEY_C, "C", "shows the next channel beyond 9; with Shift, the one before"},
    {Action::light_debug, GLFW_KEY_Q, "Q", "shows the positions and ranges of the lights"},
    {Action::light_visibility, GLFW_KEY_E, "E",
     "shows how many lights each pixel evaluates, as a heat map, for any channel"},
    {Action::information, GLFW_KEY_I, "I", "shows times and memory of both paths"},
    {Action::zoom, GLFW_KEY_Z, "Z", "zooms to the pixels under the cursor, with their values"},
    {Action::worst_pixel, GLFW_KEY_G, "G", "zooms to the channel's worst pixel"},
    {Action::next_camera, GLFW_KEY_N, "N", "moves to the scene's next camera"},
    {Action::play, GLFW_KEY_K, "K", "plays the animations, or stops them"},
    {Action::scene_lights, GLFW_KEY_L, "L", "switches the scene's own lights off and on"},
    {Action::rig, GLFW_KEY_J, "J", "switches the lights of --lights off and on"},
    {Action::screenshot, GLFW_KEY_P, "P", "writes both paths: this channel as PNG, all channels as EXR"},
    {Action::reload, GLFW_KEY_R, "R", "reads the scene again"},
    {Action::copy_command, GLFW_KEY_Y, "Y", "copies the command line that draws this view"},
    {Action::panels, GLFW_KEY_U, "U", "hides or shows the panels at the side"},
    {Action::full_screen, GLFW_KEY_F, "F", "full screen"},
    {Action::help, GLFW_KEY_H, "H", "shows these keys"},
    {Action::help, GLFW_KEY_SLASH, "?", "shows these keys"},
    {Action::leave, GLFW_KEY_ESCAPE, "Esc",
     "leaves help, zoom, the chosen pixel, full screen or a text field"},
    {Action::quit, GLFW_KEY_Q, "Ctrl+Q", "ends the program", false, 0, true},
};

bool isOf(const KeyBinding& binding, int key) {
    return key == binding.key || (binding.last != 0 && key >= binding.key && key <= binding.last);
}

}  // namespace

std::span<const KeyBinding> keyBindings() {
    return bindings;
}

std::optional<KeyPress> actionOf(int key, bool control) {
    // The digits of the number pad count as digits.
    if (key >= GLFW_KEY_KP_0 && key <= GLFW_KEY_KP_9) key += GLFW_KEY_0 - GLFW_KEY_KP_0;
    // Ctrl is also a key that moves down. While it is pressed, only bindings with `control` and held keys
    // act.
    for (const KeyBinding& binding : bindings)
        if (isOf(binding, key) && binding.control == control && !(control && binding.held))
            return KeyPress{binding.action, key - binding.key};
    return std::nullopt;
}

bool isHeld(Action action, bool (*isDown)(int key, void* of), void* of) {
    return std::ranges::any_of(bindings, [&](const KeyBinding& binding) {
        return binding.action == action && binding.held && isDown(binding.key, of);
    });
}

std::string keyTable() {
    std::string table = "| key | |\n|---|---|\n";
    for (const KeyBinding& binding : bindings)
        table += fmt::format("| {} | {} |\n", binding.name, binding.does);
    return table;
}

std::string keyColumns() {
    std::string columns;
    for (const KeyBinding& binding : keyBindings())
        columns += fmt::format("  {:<8}{}\n", binding.name, binding.does);
    return columns;
}

}  // namespace diptych::viewer
