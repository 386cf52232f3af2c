// SPDX-License-Identifier: MIT
// Built-in scenes: they need no file, and are computed, the same on every machine.
#pragma once

#include "shared/scene/model/scene.h"

#include <string>
#include <vector>

namespace diptych {

struct BuiltinName {
    std::string name;       // without "builtin:"
    std::string parameter;  // "lights=256": the parameter and its default, several with & between them; empty
                            // if it takes none
    std::string shows;      // one line that describes it
    bool for_tests;         // made to test one way in which two paths may differ, not to be looked at
};

// In the order of the list that users see: pictures first.
std::vector<BuiltinName> builtinNames();

// `name` is what follows "builtin:", e.g. "gallery" or "spheres?lights=64". The name of the returned scene
// includes the prefix. Throws std::runtime_error: one line that names what is unknown and lists what there
// is.
Scene makeBuiltin(const std::string& name);

}  // namespace diptych
