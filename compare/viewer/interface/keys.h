// SPDX-License-Identifier: MIT
// The table of keys, used by the window, the help and the README.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace diptych::viewer {

enum class Action {
    forward,
    left,
    back,
    right,
    rise,
    sink,
    orbit,
    wipe,
    difference,
    against,
    flicker,
    swap,
    channel,
    next_channel,
    light_debug,
    light_visibility,
    information,
    zoom,
    worst_pixel,
    next_camera,
    play,
    scene_lights,
    rig,
    screenshot,
    reload,
    copy_command,
    panels,
    full_screen,
    help,
    leave,
    quit
};

struct KeyBinding {
    Action action;
    int key;                // GLFW_KEY_*: a position on a US keyboard
    std::string_view name;  // displayed name
    std::string_view does;
    bool held = false;     // acts while it is down
    int last = 0;          // last key of a row of keys; 0: one key
    bool control = false;  // with Ctrl
};

std::span<const KeyBinding> keyBindings();

struct KeyPress {
    Action action;
    int index = 0;  // index of the key in its row
};
// The action of a pressed key; empty for other keys. `control`: Ctrl is down too.
std::optional<KeyPress> actionOf(int key, bool control);
// Whether a key of a held action is down; isDown(key, of) tells the state of a key.
bool isHeld(Action action, bool (*isDown)(int key, void* of), void* of);

// The table as Markdown for the README, and in columns for --help. Ends in a newline.
std::string keyTable();
std::string keyColumns();

}  // namespace diptych::viewer
