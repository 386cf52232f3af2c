// SPDX-License-Identifier: MIT
#include "shared/scene/requirements.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

namespace diptych {

namespace {

std::array<const TextureSlot*, 7> slotsOf(const Material& m) {
    return {&m.base_color_texture,    &m.metallic_roughness_texture, &m.normal_texture,
            &m.occlusion_texture,     &m.emissive_texture,           &m.specular_texture,
            &m.specular_color_texture};
}

bool isTransformed(const TextureSlot& slot) {
    return slot.u != glm::dvec3(1, 0, 0) || slot.v != glm::dvec3(0, 1, 0);
}

void addMaterial(Requirements& r, const Material& m, std::set<int>& textures) {
    r.normal_maps |= m.normal_texture.texture >= 0;
    r.alpha_mask |= m.alpha_mode == AlphaMode::mask;
    r.alpha_blend |= m.alpha_mode == AlphaMode::blend;
    r.double_sided |= m.double_sided;
    r.occlusion |= m.occlusion_texture.texture >= 0 && m.occlusion_strength > 0;
    r.dielectric_specular |= m.ior != 1.5f || m.specular != 1.0f || m.specular_color != glm::vec3(1) ||
                             m.specular_texture.texture >= 0 || m.specular_color_texture.texture >= 0;
    const float emission = std::max({m.emissive.r, m.emissive.g, m.emissive.b});
    if (emission > 0) {
        r.min_emission = r.emission ? std::min(r.min_emission, emission) : emission;
        r.max_emission = std::max(r.max_emission, emission);
        r.emission = true;
    }
    for (const TextureSlot* slot : slotsOf(m)) {
        if (slot->texture < 0) continue;
        textures.insert(slot->texture);
        r.second_texcoord |= slot->texcoord == 1;
        r.texture_transform |= isTransformed(*slot);
    }
}

}  // namespace

Requirements requirements(const Scene& scene, const Pose& pose) {
    Requirements r;
    r.materials = static_cast<std::uint32_t>(scene.materials.size());

    std::vector<bool> used(scene.materials.size(), false);
    for (const Instance& instance : pose.instances) {
        const Primitive& primitive = scene.meshes[static_cast<std::size_t>(instance.mesh)]
                                         .primitives[static_cast<std::size_t>(instance.primitive)];
        if (primitive.indices.empty()) continue;
        ++r.draws;
        r.triangles += primitive.indices.size() / 3;
        r.vertices += primitive.positions.size();
        r.vertex_colors |= !primitive.colors.empty();
        used[static_cast<std::size_t>(primitive.material)] = true;
    }

    std::set<int> textures;
    for (std::size_t i = 0; i < used.size(); ++i)
        if (used[i]) addMaterial(r, scene.materials[i], textures);
    r.textures = static_cast<std::uint32_t>(textures.size());

    for (const Light& light : pose.lights) {
        r.directional_lights += light.kind == LightKind::directional;
        r.point_lights += light.kind == LightKind::point;
        r.spot_lights += light.kind == LightKind::spot;
    }
    return r;
}

std::vector<Requirements::Line> Requirements::lines() const {
    std::vector<Line> result;
    const auto say = [&](bool modelled, const char* what, std::string yes, std::string no) {
        result.push_back({modelled, what, modelled ? std::move(yes) : std::move(no)});
    };
    const std::uint32_t local_lights = point_lights + spot_lights;

    say(textures > 0, "textures", fmt::format("the materials in use read {}", textures),
        "no material in use reads a texture");
    say(normal_maps, "normal maps", "a material has a normal texture: it needs tangents",
        "no material has a normal texture: tangents are not read");
    say(vertex_colors, "vertex colours", "a mesh carries COLOR_0", "no mesh carries COLOR_0");
    say(second_texcoord, "second UV set", "a texture reads TEXCOORD_1", "every texture reads TEXCOORD_0");
    say(texture_transform, "texture transforms", "a texture has KHR_texture_transform",
        "no texture has KHR_texture_transform");
    say(alpha_mask, "alpha test", "a material has alphaMode MASK",
        "no material has alphaMode MASK: depth passes read positions alone");
    result.push_back({false, "alpha blending",
                      alpha_blend
                          ? "a material has alphaMode BLEND, but blending is not built yet: drawn opaque"
                          : "no material has alphaMode BLEND"});
    say(double_sided, "back faces", "a material is double-sided: nothing of it is culled",
        "no material is double-sided: back faces are culled");
    say(occlusion, "occlusion textures", "a material has an occlusion texture",
        "no material has an occlusion texture: ambient light is not dimmed");
    say(emission, "emission",
        min_emission == max_emission
            ? fmt::format("materials emit {:g} W/(sr m^2)", max_emission)
            : fmt::format("materials emit {:g} to {:g} W/(sr m^2)", min_emission, max_emission),
        "no material emits: no emission attachment");
    say(dielectric_specular, "dielectric specular", "a material has KHR_materials_specular or _ior",
        "every dielectric has F0 = 0.04: no specular attachment");
    say(directional_lights > 0, "directional lights", fmt::format("{} in the scene", directional_lights),
        "none in the scene");
    say(local_lights > 0, "point and spot lights",
        fmt::format("{} point and {} spot in the scene", point_lights, spot_lights),
        "none in the scene: no light lists");
    return result;
}

}  // namespace diptych
