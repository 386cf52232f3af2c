// SPDX-License-Identifier: MIT
#include "compare/render/left_out.h"

#include "shared/scene/lights/casters.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace diptych {

namespace {

std::string nameOf(const Light& light, std::size_t index) {
    return light.name.empty() ? fmt::format("light {}", index) : light.name;
}

}  // namespace

std::vector<std::string> leftOutLight(Path path, const Requirements& needs) {
    std::vector<std::string> notes;
    if (path == Path::reference) return notes;
    const auto note = [&](const std::string& what, bool one) {
        notes.push_back(fmt::format("{}: not drawn by {} yet: the reference has {}", what, nameOf(path),
                                    one ? "it" : "them"));
    };
    if (needs.sun_discs > 0)
        note(needs.sun_discs == 1 ? "1 sun's disc" : fmt::format("{} suns' discs", needs.sun_discs),
             needs.sun_discs == 1);
    if (!needs.environment.empty()) note("environment " + needs.environment, true);
    return notes;
}

std::vector<std::string> leftOutMotion(Path path, const Requirements& needs) {
    if (path == Path::reference || needs.skinned + needs.morphed == 0) return {};
    return {fmt::format("{}: drawn undeformed by {} yet: the reference poses {} in mode scene",
                        needs.deformedInWords(), nameOf(path),
                        needs.skinned + needs.morphed == 1 ? "it" : "them")};
}

std::vector<std::string> leftOutShadows(const std::vector<Light>& lights, const Settings& settings) {
    const std::optional<std::size_t> sun = brightestSun(lights);
    if (settings.shadows == Shadows::off || !sun) return {};
    std::vector<std::string> others;
    for (std::size_t i = 0; i < lights.size(); ++i)
        if (i != *sun && lights[i].kind == LightKind::directional) others.push_back(nameOf(lights[i], i));
    if (others.empty()) return {};
    return {fmt::format("of {} directional lights the brightest, {}, casts a shadow; without one: {}",
                        others.size() + 1, nameOf(lights[*sun], *sun), fmt::join(others, ", "))};
}

std::optional<std::string> undrawnSetting(std::span<const Settings> paths) {
    const auto isReference = [](const Settings& s) { return s.path == Path::reference; };
    if (paths.empty() || std::ranges::all_of(paths, isReference)) return {};
    const Settings& asked = paths.front();
    if (asked.env == Settings().env) return {};
    return fmt::format(
        "--env {}: neither deferred nor forward_plus draws an environment yet; leave it out, or see it with "
        "render --path reference",
        asked.env);
}

}  // namespace diptych
