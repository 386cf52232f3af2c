// SPDX-License-Identifier: MIT
#include "compare/render/omitted_lights.h"

#include "shared/scene/lights/shadow_casters.h"
#include "shared/text/counted.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>

namespace diptych {

namespace {

std::string nameOf(const Light& light, std::size_t index) {
    return light.name.empty() ? fmt::format("light {}", index) : light.name;
}

}  // namespace

std::vector<std::string> omittedLights(Path path, const Requirements& needs) {
    std::vector<std::string> notes;
    if (isReference(path)) return notes;
    const auto note = [&](const std::string& what, bool one) {
        notes.push_back(fmt::format("{}: not rendered by {} yet; the reference has {}", what, nameOf(path),
                                    one ? "it" : "them"));
    };
    if (needs.sun_discs > 0) note(counted(needs.sun_discs, "sun disc"), needs.sun_discs == 1);
    return notes;
}

std::vector<std::string> omittedShadows(const std::vector<Light>& lights, const Settings& settings) {
    const std::optional<std::size_t> sun = brightestSun(lights);
    if (settings.shadows == Shadows::off || !sun) return {};
    std::vector<std::string> others;
    for (std::size_t i = 0; i < lights.size(); ++i)
        if (i != *sun && lights[i].kind == LightKind::directional) others.push_back(nameOf(lights[i], i));
    if (others.empty()) return {};
    return {fmt::format("only the brightest of {} directional lights, {}, casts a shadow; these do not: {}",
                        others.size() + 1, nameOf(lights[*sun], *sun), fmt::join(others, ", "))};
}

}  // namespace diptych
