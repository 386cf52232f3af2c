// SPDX-License-Identifier: MIT
#include "shared/scene/requirements.h"

#include "shared/scene/lights/lights_json.h"
#include "shared/scene/model/material_slots.h"
#include "shared/scene/motion/animation.h"
#include "shared/text/counted.h"
#include "shared/text/one_line.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace diptych {

namespace {

void addMaterial(Requirements& r, const Scene& scene, const Material& m, std::set<int>& textures) {
    r.alpha_mask |= m.alpha_mode == AlphaMode::mask;
    r.alpha_blend |= m.alpha_mode == AlphaMode::blend;
    r.double_sided |= m.double_sided;
    r.unlit |= m.unlit;
    r.specular_glossiness |= m.specular_glossiness;
    r.dielectric_specular |= m.unlit || m.specular_glossiness || m.ior != 1.5f || m.specular != 1.0f ||
                             m.specular_color != glm::vec3(1) || m.specular_texture.texture >= 0 ||
                             m.specular_color_texture.texture >= 0;
    const glm::vec3 emitted = m.unlit ? glm::vec3(m.base_color) : m.emissive;
    const float emission = std::max({emitted.r, emitted.g, emitted.b});
    if (emission > 0) {
        r.min_emission = r.emission ? std::min(r.min_emission, emission) : emission;
        r.max_emission = std::max(r.max_emission, emission);
        r.emission = true;
    }
    r.layers |= layersOf(m);
    if (!blends(m)) r.surface_layers |= layersOf(m);
    r.volume |= transmits(m) && m.thickness > 0;
    r.rough_glass |= transmits(m) && m.roughness > 0;
    r.dispersion |= transmits(m) && m.thickness > 0 && m.dispersion > 0;
    r.normal_maps |= readsSlot(m, gpu::SLOT_normal);
    r.occlusion |= readsSlot(m, gpu::SLOT_occlusion);
    for (std::size_t i = 0; i < materialSlots.size(); ++i) {
        if (!readsSlot(m, i)) continue;
        const TextureSlot& slot = m.*materialSlots[i].texture;
        textures.insert(slot.texture);
        r.second_texcoord |= slot.texcoord == 1;
        if (i == gpu::SLOT_lightmap) {
            const int image = scene.textures[static_cast<std::size_t>(slot.texture)].image;
            r.lightmap = true;
            r.max_lightmap = std::max(
                r.max_lightmap, m.lightmap_intensity * scene.images[static_cast<std::size_t>(image)].largest);
        }
        if (i == gpu::SLOT_iridescence_thickness)
            r.film_thickness_range = std::max(
                r.film_thickness_range, std::abs(m.iridescence_thickness_max - m.iridescence_thickness_min));
        r.texture_transform |= isTransformed(slot);
    }
}

// Adds a line: `yes` says why a feature is rendered, `no` why it is omitted.
auto lineAdder(std::vector<Requirements::Line>& lines) {
    return [&lines](bool modelled, const char* what, std::string yes, std::string no) {
        lines.push_back({modelled, what, modelled ? std::move(yes) : std::move(no)});
    };
}

}  // namespace

Requirements requirements(const Scene& scene, const Pose& pose, const std::vector<Light>& lights) {
    Requirements r;
    r.materials = static_cast<std::uint32_t>(scene.materials.size());

    std::vector<bool> used(scene.materials.size(), false);
    // The last node counted of each type; a node's instances are consecutive.
    int skinned = -1, morphed = -1;
    std::set<int> skins;
    for (const Instance& instance : pose.instances) {
        const Primitive& primitive = primitiveOf(scene, instance);
        if (primitive.indices.empty()) continue;
        ++r.draws;
        r.triangles += primitive.indices.size() / 3;
        r.vertices += primitive.positions.size();
        r.vertex_colors |= !primitive.colors.empty();
        used[static_cast<std::size_t>(primitive.material)] = true;
        const Material& material = materialsOf(scene, pose)[static_cast<std::size_t>(primitive.material)];
        if (readsSlot(material, gpu::SLOT_thickness))
            r.volume_thickness_range =
                std::max(r.volume_thickness_range,
                         static_cast<float>(double{material.thickness} * lengthScale(instance)));
        if (instance.skin >= 0 || instance.weights >= 0) r.deformed_vertices += primitive.positions.size();
        if (instance.skin >= 0) skins.insert(instance.skin);
        r.skinned += instance.skin >= 0 && std::exchange(skinned, instance.node) != instance.node;
        r.morphed += instance.weights >= 0 && std::exchange(morphed, instance.node) != instance.node;
    }
    for (const int skin : skins) r.joints += pose.skins[static_cast<std::size_t>(skin)].size();
    for (const Animation& animation : animationsOf(scene, pose.animation))
        r.animations += movesAnything(animation);

    std::set<int> textures;
    for (std::size_t i = 0; i < used.size(); ++i)
        if (used[i]) addMaterial(r, scene, materialsOf(scene, pose)[i], textures);
    r.textures = static_cast<std::uint32_t>(textures.size());

    for (const Light& light : lights) {
        ++r.light_counts[indexOf(light.kind)];
        r.sun_discs += light.kind == LightKind::directional && light.angle > 0;
    }
    if (scene.environment) r.environment = oneLine(scene.environment->name);
    return r;
}

std::string Requirements::areaLightsText() const {
    std::vector<std::string> kinds;
    for (const LightKind kind : areaKinds)
        if (lights(kind) > 0) kinds.push_back(fmt::format("{} {}", lights(kind), nameOf(kind)));
    return fmt::format("{} ({})", counted(areaLights(), "area light"), fmt::join(kinds, ", "));
}

std::string Requirements::deformedText() const {
    if (skinned + morphed == 0) return {};
    std::string text;
    if (skinned > 0) text = counted(skinned, "skinned mesh", "skinned meshes");
    if (morphed > 0)
        text += skinned > 0 ? fmt::format(", {} morphed", morphed)
                            : counted(morphed, "morphed mesh", "morphed meshes");
    text += ": " + counted(deformed_vertices, "vertex", "vertices");
    if (skinned > 0) text += " by " + counted(joints, "joint");
    return text;
}

void Requirements::addMaterialLines(std::vector<Line>& lines) const {
    const auto add = lineAdder(lines);
    add(textures > 0, "textures", fmt::format("the materials in use read {}", textures),
        "no material in use reads a texture");
    add(normal_maps, "normal maps", "a material has a normal texture, which needs tangents",
        "no material has a normal texture");
    add(vertex_colors, "vertex colours", "a mesh has COLOR_0", "no mesh has COLOR_0");
    add(second_texcoord, "second UV set", "a texture reads TEXCOORD_1", "every texture reads TEXCOORD_0");
    add(texture_transform, "texture transforms", "a texture has KHR_texture_transform",
        "no texture has KHR_texture_transform");
    add(alpha_mask, "alpha test", "a material has alphaMode MASK",
        "no material has alphaMode MASK: depth passes read only positions");
    add(alpha_blend, "alpha blending", "a material has alphaMode BLEND: drawn over opaque surfaces",
        "no material has alphaMode BLEND: no blending pass");
    add(double_sided, "back faces", "a material is double-sided: its back faces are drawn",
        "no material is double-sided: back faces are culled");
    add(occlusion, "occlusion textures", "a material has an occlusion texture",
        "no material has an occlusion texture: ambient light is not dimmed");
    add(emission, "emission",
        min_emission == max_emission
            ? fmt::format("materials emit {:g} W/(sr m^2)", max_emission)
            : fmt::format("materials emit {:g} to {:g} W/(sr m^2)", min_emission, max_emission),
        "no material emits: no emission attachment");
    add(lightmap, "lightmaps", fmt::format("a material has one, up to {:g} W/(sr m^2)", max_lightmap),
        "no material has one: no lightmap attachment");
    add(unlit, "unlit materials",
        "a material has KHR_materials_unlit: it emits its base colour and reflects nothing",
        "no material has KHR_materials_unlit");
    add(specular_glossiness, "specular-glossiness materials",
        "a material has KHR_materials_pbrSpecularGlossiness: its F0 is stored, its albedo is what F0 leaves",
        "no material has KHR_materials_pbrSpecularGlossiness");
    add(dielectric_specular, "dielectric specular",
        "a material has KHR_materials_specular, _ior, _pbrSpecularGlossiness or _unlit",
        "every dielectric has F0 = 0.04: no specular attachment");
}

void Requirements::addLayerLines(std::vector<Line>& lines) const {
    const auto add = lineAdder(lines);
    add((layers & gpu::LAYER_CLEARCOAT) != 0, "clear coats",
        "a lit material has clearcoatFactor above 0: a second specular layer over its base",
        "no lit material has KHR_materials_clearcoat with a factor above 0");
    add((layers & gpu::LAYER_ANISOTROPY) != 0, "anisotropy",
        "a lit material has anisotropyStrength above 0: stretched highlights, which need tangents",
        "no lit material has KHR_materials_anisotropy with a strength above 0");
    add((layers & gpu::LAYER_SHEEN) != 0, "sheen",
        "a lit material has sheenColorFactor above 0: a layer of fibres that dims what lies below",
        "no lit material has KHR_materials_sheen with a colour above 0");
    add((layers & gpu::LAYER_IRIDESCENCE) != 0, "iridescence",
        "a lit material has iridescenceFactor above 0: a thin film colours what its base reflects",
        "no lit material has KHR_materials_iridescence with a factor above 0");
    add((layers & gpu::LAYER_TRANSMISSION) != 0, "transmission",
        "a lit material has transmissionFactor above 0: it shows the opaque surfaces behind it",
        "no lit material has KHR_materials_transmission with a factor above 0");
    add(volume, "volumes", "a material that transmits light has a thickness: it refracts and absorbs",
        "no material that transmits light has KHR_materials_volume with a thickness above 0");
    add(dispersion, "dispersion", "a volume has dispersion above 0: components refract apart",
        "no volume has KHR_materials_dispersion above 0");
    add((layers & gpu::LAYER_DIFFUSE_TRANSMISSION) != 0, "diffuse transmission",
        "a lit material has diffuseTransmissionFactor above 0: light from behind passes it",
        "no lit material has KHR_materials_diffuse_transmission with a factor above 0");
}

void Requirements::addMotionAndLightLines(std::vector<Line>& lines) const {
    const auto add = lineAdder(lines);
    const std::uint32_t directional = lights(LightKind::directional), points = lights(LightKind::point),
                        spots = lights(LightKind::spot);
    add(animations > 0, "animation",
        fmt::format("{} play{}: nodes, lights, cameras and materials follow --time", animations,
                    animations == 1 ? "s" : ""),
        "the scene has no animation");
    add(skinned + morphed > 0, "skins and morph targets", deformedText(),
        "no mesh is skinned or morphed: no deformation");
    add(directional > 0, "directional lights", fmt::format("{} in the scene", directional),
        "none in the scene");
    add(points + spots > 0, "point and spot lights",
        fmt::format("{} point and {} spot in the scene", points, spots), "none in the scene: no light lists");
    add(areaLights() > 0, "area lights", areaLightsText() + " in the scene",
        "none in the scene: no table of linearly transformed cosines");
    lines.push_back({false, "sun discs",
                     sun_discs > 0
                         ? fmt::format("{} in the scene: only the reference renders them", sun_discs)
                         : "no directional light has an angular size"});
    add(!environment.empty(), "environment",
        environment + ": prefiltered maps, spherical harmonics, background",
        "none in the scene: no maps, no pass");
}

std::vector<Requirements::Line> Requirements::lines() const {
    std::vector<Line> lines;
    addMaterialLines(lines);
    addLayerLines(lines);
    addMotionAndLightLines(lines);
    return lines;
}

}  // namespace diptych
