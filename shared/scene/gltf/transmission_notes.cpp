// SPDX-License-Identifier: MIT
#include "shared/scene/gltf/transmission_notes.h"

#include "shared/scene/gltf/value.h"
#include "shared/text/counted.h"
#include "shared/text/one_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <set>
#include <string>
#include <utility>

namespace diptych::gltf {

namespace {

constexpr std::array transmitting{"KHR_materials_transmission", "KHR_materials_volume",
                                  "KHR_materials_dispersion", "KHR_materials_diffuse_transmission"};

class Noter {
public:
    Noter(const tinygltf::Model& model, const std::vector<bool>& drawn, Scene& scene)
        : model_(model), drawn_(drawn), scene_(scene) {
        for (const Animation& animation : scene.animations)
            for (const AnimationChannel& channel : animation.channels)
                animated_.insert({channel.object, channel.part});
    }

    bool drawn(std::size_t i) const { return drawn_[i]; }
    const Material& material(std::size_t i) const { return scene_.materials[i]; }
    bool has(std::size_t i, const char* name) const {
        return extension(model_.materials[i].extensions, name) != nullptr;
    }
    // Whether a factor is ever above 0.
    bool ever(std::size_t i, float Material::*factor, AnimatedPart part) const {
        return material(i).*factor > 0 || animated_.contains({static_cast<int>(i), part});
    }

    // Adds the note "3 materials (a, b, c) ..." about those for which `test` is true.
    template <class Test>
    void note(const Test& test, const char* what) {
        std::string names;
        std::uint64_t count = 0;
        for (std::size_t i = 0; i < model_.materials.size(); ++i) {
            if (!drawn(i) || !test(i)) continue;
            const std::string& name = model_.materials[i].name;
            names += (count++ ? ", " : "") + (name.empty() ? std::to_string(i) : name);
        }
        if (count)
            scene_.notes.push_back(
                fmt::format("{} ({}) {}", counted(count, "material"), oneLine(names), what));
    }

private:
    const tinygltf::Model& model_;
    const std::vector<bool>& drawn_;
    Scene& scene_;
    std::set<std::pair<int, AnimatedPart>> animated_;
};

}  // namespace

void noteTransmission(const tinygltf::Model& model, const std::vector<bool>& drawn, Scene& scene) {
    Noter noter(model, drawn, scene);
    const auto lit = [&](std::size_t i) {
        return !noter.material(i).unlit && !noter.material(i).specular_glossiness;
    };
    const auto transmits = [&](std::size_t i) {
        return noter.ever(i, &Material::transmission, AnimatedPart::transmission);
    };
    const auto diffuses = [&](std::size_t i) {
        return noter.ever(i, &Material::diffuse_transmission, AnimatedPart::diffuse_transmission);
    };
    const auto thick = [&](std::size_t i) {
        return noter.ever(i, &Material::thickness, AnimatedPart::thickness);
    };
    noter.note(
        [&](std::size_t i) {
            return noter.material(i).unlit &&
                   std::ranges::any_of(transmitting, [&](const char* name) { return noter.has(i, name); });
        },
        "with KHR_materials_unlit: light that they transmit is left out");
    noter.note(
        [&](std::size_t i) {
            return lit(i) && noter.has(i, "KHR_materials_volume") && !transmits(i) && !diffuses(i);
        },
        "with KHR_materials_volume, but without transmission: the volume has no effect");
    noter.note(
        [&](std::size_t i) {
            return lit(i) && noter.has(i, "KHR_materials_dispersion") && !(transmits(i) && thick(i));
        },
        "with KHR_materials_dispersion, but without transmission through a thickness: no effect");
    noter.note([&](std::size_t i) { return lit(i) && diffuses(i) && thick(i); },
               "with KHR_materials_diffuse_transmission and a volume: diffuses as a thin surface and absorbs "
               "over the thickness, scattering in the volume is not modelled");
}

}  // namespace diptych::gltf
