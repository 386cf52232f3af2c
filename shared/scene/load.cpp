// SPDX-License-Identifier: MIT
#include "shared/scene/load.h"
#include "shared/scene/builtin/builtin.h"
#include "shared/scene/gltf/gltf.h"
#include "shared/scene/model/scene.h"
#include "shared/scene/motion/deformation_bounds.h"
#include "shared/text/fail.h"
#include "shared/text/one_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace diptych {

namespace {

constexpr std::string_view builtinPrefix = "builtin:";

std::string lowerCase(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

struct SceneFile {
    std::string file, scene;
};

// Splits off a suffix ?scene=INDEX or ?scene=NAME, unless a file of the whole name exists.
SceneFile fileOf(const std::string& where) {
    constexpr std::string_view key = "?scene=";
    const std::size_t question = std::filesystem::exists(where) ? where.npos : where.rfind(key);
    const std::string file = where.substr(0, question);
    const std::string ending = lowerCase(std::filesystem::path(file).extension().string());
    if (ending != ".gltf" && ending != ".glb")
        fail(fmt::format(
            "{}: is not a scene; give a .gltf or .glb file or builtin:NAME (render --list-scenes lists them)",
            where));
    return {file, question == where.npos ? "" : where.substr(question + key.size())};
}

Scene builtinOf(const std::string& where, const std::string& variant) {
    Scene scene = makeBuiltin(where.substr(builtinPrefix.size()));
    if (!variant.empty())
        fail(fmt::format("{}: --variant \"{}\": built-in scenes have no material variants", where,
                         oneLine(variant)));
    return scene;
}

}  // namespace

Scene loadScene(const std::string& where, const LoadProgress& progress, const std::string& variant) {
    Scene scene;
    if (where.starts_with(builtinPrefix)) {
        scene = builtinOf(where, variant);
    } else {
        const auto [file, choice] = fileOf(where);
        scene = loadGltf(file, choice, variant, progress);
    }
    scene.name = where;
    prepareDeformationBounds(scene);
    return scene;
}

std::uint64_t askedBytes(const std::string& where) {
    return where.starts_with(builtinPrefix) ? builtinBytes(where.substr(builtinPrefix.size())) : 0;
}

void checkScene(const std::string& where, const std::string& variant) {
    if (where.starts_with(builtinPrefix))
        builtinOf(where, variant);
    else
        checkGltf(fileOf(where).file, variant);
}

}  // namespace diptych
