// SPDX-License-Identifier: MIT
// Built-in scenes whose textures have one pixel: fast to copy, to write and to read.
#pragma once

#include "shared/scene/builtin/builtin.h"

#include <algorithm>
#include <map>
#include <string>

namespace diptych {

// Made once for each name, without "builtin:".
inline const Scene& plainBuiltin(const std::string& name) {
    static std::map<std::string, Scene> made;
    const auto [found, added] = made.try_emplace(name);
    if (!added) return found->second;
    found->second = makeBuiltin(name);
    for (TextureImage& image : found->second.images) {
        image.width = image.height = 1;
        image.rgba.resize(std::min<std::size_t>(image.rgba.size(), 4));
        image.rgba16.resize(std::min<std::size_t>(image.rgba16.size(), 4));
        image.rgba32.resize(std::min<std::size_t>(image.rgba32.size(), 4));
    }
    return found->second;
}

}  // namespace diptych
