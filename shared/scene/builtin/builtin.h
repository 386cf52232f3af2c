// SPDX-License-Identifier: MIT
// Scenes that need no file: the same on every machine, made from numbers.
#pragma once

#include "shared/scene/model/scene.h"

#include <string>
#include <vector>

namespace diptych {

struct BuiltinName {
    std::string name;       // without "builtin:"
    std::string parameter;  // "lights=256": the parameter and its default; empty where there is none
    std::string shows;      // one line
    bool for_tests;         // made to catch one way in which two paths differ, not to be looked at
};

// In the order in which a reader wants them: pictures first.
std::vector<BuiltinName> builtinNames();

// `name` is what follows "builtin:", e.g. "gallery" or "spheres?lights=64". The scene's own name gets the
// prefix back. Throws std::runtime_error: one line that names what is unknown and lists what there is.
Scene makeBuiltin(const std::string& name);

}  // namespace diptych
