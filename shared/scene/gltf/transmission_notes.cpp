// SPDX-License-Identifier: MIT
#include "shared/scene/gltf/transmission_notes.h"

#include "shared/scene/gltf/value.h"
#include "shared/text/counted.h"
#include "shared/text/one_line.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <utility>

namespace diptych::gltf {

using Json = nlohmann::json;

void noteTransmission(const Json& materials, const std::vector<bool>& drawn, Scene& scene) {
    std::set<std::pair<int, AnimatedPart>> animated;
    for (const Animation& animation : scene.animations)
        for (const AnimationChannel& channel : animation.channels)
            animated.insert({channel.object, channel.part});
    // Adds the note "3 materials (a, b, c) ..." about those for which `test` is true.
    const auto note = [&](const char* what, const auto& test) {
        std::string names;
        std::uint64_t count = 0;
        for (std::size_t i = 0; i < drawn.size(); ++i) {
            if (!drawn[i] || !test(i)) continue;
            const std::string& name = scene.materials[i].name;
            names += (count++ ? ", " : "") + (name.empty() ? std::to_string(i) : name);
        }
        if (count)
            scene.notes.push_back(
                fmt::format("{} ({}) {}", counted(count, "material"), oneLine(names), what));
    };
    const auto has = [&](std::size_t i, std::string_view name) {
        return extension(materials[i], fmt::format("KHR_materials_{}", name)) != nullptr;
    };
    const auto unlit = [&](std::size_t i) { return scene.materials[i].unlit; };
    const auto lit = [&](std::size_t i) { return !unlit(i) && !scene.materials[i].specular_glossiness; };
    // Whether a factor is ever above 0.
    const auto ever = [&](std::size_t i, float Material::*factor, AnimatedPart part) {
        return scene.materials[i].*factor > 0 || animated.contains({static_cast<int>(i), part});
    };
    const auto transmits = [&](std::size_t i) {
        return ever(i, &Material::transmission, AnimatedPart::transmission);
    };
    const auto diffuses = [&](std::size_t i) {
        return ever(i, &Material::diffuse_transmission, AnimatedPart::diffuse_transmission);
    };
    const auto thick = [&](std::size_t i) { return ever(i, &Material::thickness, AnimatedPart::thickness); };
    note("with KHR_materials_unlit: light that they transmit is left out", [&](std::size_t i) {
        return unlit(i) && (has(i, "transmission") || has(i, "volume") || has(i, "dispersion") ||
                            has(i, "diffuse_transmission"));
    });
    note("with KHR_materials_volume, but without transmission: the volume has no effect",
         [&](std::size_t i) { return lit(i) && has(i, "volume") && !transmits(i) && !diffuses(i); });
    note("with KHR_materials_dispersion, but without transmission through a thickness: no effect",
         [&](std::size_t i) { return lit(i) && has(i, "dispersion") && !(transmits(i) && thick(i)); });
    note(
        "with KHR_materials_diffuse_transmission and a volume: diffuses as a thin surface and absorbs over "
        "the thickness, scattering in the volume is not modelled",
        [&](std::size_t i) { return lit(i) && diffuses(i) && thick(i); });
}

}  // namespace diptych::gltf
