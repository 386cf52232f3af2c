// SPDX-License-Identifier: MIT
// The one table of keys: the window obeys it, its help and the README print it.
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
    int key;                // GLFW_KEY_*, which stands for a place on a US keyboard
    std::string_view name;  // as the key is called
    std::string_view does;
    bool held = false;     // acts as long as it is down
    int last = 0;          // of a row of keys: the last one; 0: one key
    bool control = false;  // with Ctrl
};

std::span<const KeyBinding> keyBindings();

struct KeyPress {
    Action action;
    int number = 0;  // of the key in its row
};
// What a key that goes down does; nothing: none of ours. `control`: Ctrl is down as well.
std::optional<KeyPress> actionOf(int key, bool control);
// Whether one of the keys of an action that is held is down, by a function that tells of each key.
bool isHeld(Action action, bool (*isDown)(int key, void* of), void* of);

// The table in Markdown, as the README has it, and in columns, as --help prints it. Ends in a newline.
std::string keyTable();
std::string keyColumns();

}  // namespace diptych::viewer
