// SPDX-License-Identifier: MIT
#include "shared/scene/builtin/builtin.h"
#include "shared/scene/gltf.h"
#include "shared/scene/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <stdexcept>

namespace diptych {

namespace {

constexpr std::string_view builtinPrefix = "builtin:";

std::string lowerCase(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

}  // namespace

Scene loadScene(const std::string& where) {
    Scene scene;
    if (where.starts_with(builtinPrefix)) {
        scene = makeBuiltin(where.substr(builtinPrefix.size()));
    } else {
        const std::string ending = lowerCase(std::filesystem::path(where).extension().string());
        if (ending != ".gltf" && ending != ".glb")
            throw std::runtime_error(fmt::format(
                "{}: not a scene: expected a .gltf or .glb file or builtin:NAME (--list-scenes names them)",
                where));
        scene = loadGltf(where);
    }
    scene.name = where;
    return scene;
}

}  // namespace diptych
