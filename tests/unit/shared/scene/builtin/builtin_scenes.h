// SPDX-License-Identifier: MIT
// Built-in scenes, each made once.
#pragma once

#include "shared/scene/builtin/builtin.h"

#include <map>
#include <string>

namespace diptych {

inline const Scene& builtinScene(const std::string& name) {
    static std::map<std::string, Scene> made;
    const auto [found, isNew] = made.try_emplace(name);
    if (isNew) found->second = makeBuiltin(name);
    return found->second;
}

}  // namespace diptych
