// SPDX-License-Identifier: MIT
// Built-in scenes: computed, need no file, and are identical on every machine.
#pragma once

#include "shared/scene/model/scene.h"

#include <cstdint>
#include <string>
#include <vector>

namespace diptych {

struct BuiltinName {
    std::string name;       // without "builtin:"
    std::string parameter;  // "lights=256": parameters and defaults, joined by &; empty if none
    std::string shows;      // one line
    bool for_tests;         // tests one difference between the paths; not made to look good
};

// In the order of the list for users: display scenes first.
std::vector<BuiltinName> builtinNames();

// `name` follows "builtin:", such as "gallery" or "spheres?lights=64". The scene's name includes the
// prefix. Throws std::runtime_error: one line with the unknown name or parameter and the valid ones, or if
// builtinBytes() are not free.
Scene makeBuiltin(const std::string& name);

// Estimated memory that the parameters ask for; 0 if the scene has none.
std::uint64_t builtinBytes(const std::string& name);

}  // namespace diptych
