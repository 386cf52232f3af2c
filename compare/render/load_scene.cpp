// SPDX-License-Identifier: MIT
#include "compare/render/load_scene.h"

#include "compare/render/host_memory.h"
#include "compare/render/renderer.h"
#include "compare/run/still_working.h"
#include "shared/scene/image/environment.h"
#include "shared/scene/lights/rig.h"
#include "shared/scene/load.h"
#include "shared/scene/motion/pose.h"
#include "shared/text/one_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

namespace diptych {

Scene loadSceneWithSettings(const std::string& where, const Settings& settings, const Stage& progress) {
    StillWorking working(progress, "read");
    std::optional<Environment> environment;
    std::vector<std::string> notes;
    const bool own = settings.env == "scene";
    if (!own && settings.env != Settings().env) environment = readEnvironment(settings.env, notes);
    Scene scene = loadScene(
        where, [&](double fraction, const char* step) { working.at(fraction, step); }, settings.variant);
    if (own && !scene.environment)
        throw std::runtime_error(
            fmt::format("--env scene: {} has no readable EXT_lights_image_based", oneLine(where)));
    if (environment) {
        if (scene.environment)
            notes.push_back(oneLine(scene.environment->name) + ": ignored because --env is given");
        scene.environment = std::move(environment);
    }
    std::ranges::move(notes, std::back_inserter(scene.notes));
    return scene;
}

void requireTriangles(const Scene& scene, const std::string& where) {
    if (hasArea(scene)) return;
    if (hasTriangles(scene))
        throw std::runtime_error(fmt::format(
            "{}: has nothing to draw: no triangle has an area; --allow-empty compares it all the same",
            oneLine(where)));
    const auto why = std::ranges::find_if(
        scene.notes, [](const std::string& note) { return note.find("left out") != note.npos; });
    throw std::runtime_error(fmt::format("{}: has nothing to draw{}; --allow-empty compares it all the same",
                                         oneLine(where), why == scene.notes.end() ? "" : ": " + *why));
}

void checkAsked(const std::string& file, const std::string& where, const Settings& settings) {
    constexpr std::uint64_t max = std::uint64_t{1} << 30;
    const auto check = [&](const std::string& what, std::uint64_t bytes) {
        if (bytes > max)
            throw std::runtime_error(fmt::format(
                "{}: asks for {}, about {:.1f} GB; a file may ask for 1 GiB, a command line for more", file,
                oneLine(what), static_cast<double>(bytes) / 1e9));
    };
    check(where, askedBytes(where));
    check("--lights " + settings.lights, rigBytes(settings.lights));
    check(fmt::format("--shadow-size {}", settings.shadow_size),
          static_cast<std::uint64_t>(shadowBytes(settings)));
}

double loadingFraction(const std::string& scene, const RenderOptions& render, std::size_t frames) {
    // In units of one rendered frame, roughly. File sizes vary widely; built-in scenes load at once.
    const double load = scene.starts_with("builtin:") ? 0.1 : 4;
    return load / (load + framesIn(render) * static_cast<double>(frames));
}

}  // namespace diptych
