// SPDX-License-Identifier: MIT
#include "compare/experiment/sensitivity.h"

#include "shared/environment/harmonics.h"
#include "shared/scene/lights/shadow_casters.h"
#include "shared/scene/model/material_slots.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace diptych::experiment {
namespace {

// Key: option; value: why the scene is not sensitive to it.
using Reasons = std::map<std::string_view, std::string_view>;

bool hasPosition(const Light& light) {
    return light.kind != LightKind::directional;
}

// Properties of a scene: surfaces that reflect irradiance, specular surfaces, an environment, windowed
// spherical harmonics, skinned or morphed vertices, blended materials, glass, textured materials, layers of
// opaque surfaces.
struct Reflectors {
    bool base = true, specular = true, environment = true, windowed = true, deformed = true, blended = true,
         glass = true, textured = true, layered = true;
};
bool readsTextures(const Material& material) {
    for (std::size_t slot = 0; slot < materialSlots.size(); ++slot)
        if (readsSlot(material, slot)) return true;
    return false;
}
Reflectors reflectorsOf(const Scene* scene) {
    if (!scene) return {};
    Reflectors found{false, false, scene->environment.has_value(), true, false, false, false, false, false};
    for (const Mesh& mesh : scene->meshes)
        for (const Primitive& primitive : mesh.primitives) {
            found.deformed = found.deformed || !primitive.joint_sets.empty() || !primitive.targets.empty();
            // Index -1 is glTF's default material, which is fully metallic.
            const Material material = primitive.material < 0
                                          ? Material{}
                                          : scene->materials[static_cast<std::size_t>(primitive.material)];
            found.glass = found.glass || transmits(material);
            found.blended = found.blended || (blends(material) && !transmits(material));
            found.textured = found.textured || readsTextures(material);
            found.layered = found.layered || (!blends(material) && layersOf(material) != 0);
            if (material.unlit) continue;
            const bool textured = material.metallic_roughness_texture.texture >= 0;
            // A sheen reflects irradiance; a film reflects even where F0 is 0.
            const bool sheen = (layersOf(material) & gpu::LAYER_SHEEN) != 0;
            found.base = found.base || material.metallic < 1 || textured || sheen;
            found.specular = found.specular || material.metallic > 0 || material.specular > 0 ||
                             material.clearcoat > 0 || material.iridescence > 0;
        }
    if (scene->environment) found.windowed = minWindow(project(LatLong(*scene->environment))) > 0;
    return found;
}

// Resets Settings that do not affect the image and records why. Rows with equal images become equal.
class InsensitiveReset {
public:
    InsensitiveReset(Settings row, std::span<const Light> lights, const Reflectors& surfaces)
        : row_(std::move(row)) {
        const auto any = [&](const auto& of) { return std::ranges::any_of(lights, of); };
        if (!any(hasPosition)) {
            constexpr std::string_view why = "no light has a position: every light reaches every pixel";
            if (row_.assign != Assignment::per_object) reset("assign", why);
            reset("light-kernel", why);
            reset("light-cutoff", why);
        } else if (!any([](const Light& light) { return hasPosition(light) && std::isinf(light.range); })) {
            reset("light-cutoff", "every light has its own range");
        }
        if (lights.empty()) reset("pixel-lights", "there is no light");
        if (!any([](const Light& light) { return isArea(light.kind); }))
            reset("area-lights", "there is no area light");
        if (!surfaces.layered) reset("layers", "no opaque material has a layer");
        if (!surfaces.textured) reset("textures", "no material reads a texture");
        if (!any([](const Light& light) { return hasPosition(light) && !isArea(light.kind); }))
            reset("shadow-lights", "there is no point or spot light");
        if (std::ranges::all_of(lights, [](const Light& light) { return isArea(light.kind); }))
            reset("shading-precision", "there is no point, spot or directional light");
        noteShadows(lights);
        noteEnvironment(surfaces);
        if (row_.multiscatter == Multiscatter::off && row_.ambient == Settings().ambient &&
            (!surfaces.environment || row_.ibl_intensity == 0 || row_.ibl == Ibl::sampled))
            reset("specular-albedo",
                  "no ambient, split-sum or multiply scattered light uses the directional albedo");
        if (!surfaces.deformed) reset("skinning", "no vertex is skinned or morphed");
        if (!surfaces.blended) {
            const std::string_view why = surfaces.glass
                                             ? "no material has alphaMode BLEND: glass has one order"
                                             : "no material has alphaMode BLEND or transmits light";
            if (!surfaces.glass || row_.transparency != Transparency::off) reset("transparency", why);
            reset("transparency-layers", why);
        }
        noteHaze();
    }
    const Settings& row() const { return row_; }
    const Reasons& reasons() const { return reasons_; }

private:
    void noteEnvironment(const Reflectors& surfaces) {
        constexpr std::string_view none = "the environment contributes no light",
                                   dull = "no surface is specular";
        if (row_.ibl_intensity == 0)
            for (const std::string_view option : {"ibl", "ibl-diffuse", "ibl-samples", "ibl-bias"})
                reset(option, none);
        if (!surfaces.specular)
            for (const std::string_view option :
                 {"ibl", "ibl-samples", "ibl-bias", "specular-albedo", "multiscatter"})
                reset(option, dull);
        // fdez also reflects irradiance between microfacets.
        if (!surfaces.base && row_.multiscatter != Multiscatter::fdez)
            reset("ibl-diffuse", "every surface is a metal, without diffuse reflection");
        if (!surfaces.windowed && row_.ibl_diffuse == IblDiffuse::sh_windowed) {
            row_.ibl_diffuse = IblDiffuse::sh;
            reasons_.emplace("ibl-diffuse",
                             "no spherical-harmonics irradiance is negative: sh-windowed equals sh");
        }
    }
    void noteHaze() {
        const Rgb none{};
        if (!row_.haze || row_.haze_density == 0 || (row_.haze_rayleigh == none && row_.haze_mie == none))
            reset("haze-march-steps", "there is no haze");
    }
    void noteShadows(std::span<const Light> lights) {
        const std::optional<std::size_t> sun = brightestSun(lights);
        if (castingLights(lights, row_.shadow_lights).empty()) {
            constexpr std::string_view why =
                "no light casts shadows: no sun, and no point or spot light selected by --shadow-lights";
            for (const Field& field : settingFields())
                if (field.option.starts_with("shadow") || field.option.starts_with("clipmap") ||
                    field.option.starts_with("evsm"))
                    reset(field.option, why);
        } else if (row_.shadows == Shadows::pcss && !(sun && lights[*sun].angle > 0)) {
            row_.shadows = Shadows::pcf;
            reasons_.emplace("shadows", "the sun has no angular size: pcss equals pcf");
        }
    }
    void reset(std::string_view option, std::string_view why) {
        static const Settings defaults;
        row_.set(option, defaults.valueOf(option));
        reasons_.emplace(option, why);
    }

    Settings row_;
    Reasons reasons_;
};

}  // namespace

SweepRows sensitiveRows(const SweepRows& sweep, std::span<const Light> lights, const Scene* scene) {
    const Reflectors surfaces = reflectorsOf(scene);
    SweepRows result{{}, sweep.skips};
    std::vector<Settings> drawn;  // result.rows with insensitive Settings reset
    for (const Settings& row : sweep.rows) {
        const InsensitiveReset reset(row, lights, surfaces);
        const auto same = std::ranges::find(drawn, reset.row());
        if (same == drawn.end()) {
            drawn.push_back(reset.row());
            result.rows.push_back(row);
            continue;
        }
        const Settings& earlier = result.rows[static_cast<std::size_t>(same - drawn.begin())];
        for (const auto& [option, why] : reset.reasons()) {
            const std::string value = row.valueOf(option);
            if (value == earlier.valueOf(option)) continue;
            const SweepSkip skip{{{"path", std::string(nameOf(row.path))}, {std::string(option), value}},
                                 std::string(why)};
            const auto isSame = [&](const SweepSkip& other) {
                return other.tried == skip.tried && other.reason == skip.reason;
            };
            if (std::ranges::none_of(result.skips, isSame)) result.skips.push_back(skip);
        }
    }
    return result;
}

}  // namespace diptych::experiment
