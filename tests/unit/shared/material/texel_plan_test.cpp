// SPDX-License-Identifier: MIT
// Where a material's slots get their texels.
#include "shared/material/texel_plan.h"

#include "shared/scene/model/material_slots.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

namespace diptych {
namespace {

// 4 x 2 texels; each component has two values.
TextureImage twoValues(int width = 4, int height = 2) {
    TextureImage result{"image", width, height, {}};
    for (int i = 0; i < 4 * width * height; ++i) result.rgba.push_back(i % 8 < 4 ? 10 : 200);
    return result;
}

// Four textures of four such images, and a fifth with the first image and another sampler.
Scene fourImages() {
    Scene scene;
    scene.images.assign(4, twoValues());
    for (int i = 0; i < 4; ++i) scene.textures.push_back({i, {}});
    scene.textures.push_back({0, {.wrap_s = Wrap::clamp_to_edge}});
    return scene;
}

// The plan that Materials requests, for images that were not uploaded.
SlotTexels plannedTexels(const Material& material, const Scene& scene, bool packed = false) {
    const auto imageOf = [&](int texture) -> const Texture& {
        return scene.textures[static_cast<std::size_t>(texture)];
    };
    return slotTexels(
        material,
        {[&](int texture, std::size_t slot) {
             return hasOneColor(scene.images[static_cast<std::size_t>(imageOf(texture).image)], slot);
         },
         [&](int a, int b) {
             return imageOf(a).image == imageOf(b).image && imageOf(a).sampler == imageOf(b).sampler;
         },
         [&](const Material& m) { return packed && isPacked(m, scene); }});
}

gpu::uint plannedTexel(gpu::uint slot, const Material& material, const Scene& scene, bool packed = false) {
    return plannedTexels(material, scene, packed)[slot];
}

TEST(TexelPlan, AnImageHasOneColorWhereASlotReadsIt) {
    const std::vector<std::pair<gpu::uint, std::string>> reads = {
        {gpu::SLOT_base_color, "rgba"},
        {gpu::SLOT_metallic_roughness, "gb"},
        {gpu::SLOT_normal, "rgb"},
        {gpu::SLOT_occlusion, "r"},
        {gpu::SLOT_emissive, "rgb"},
        {gpu::SLOT_specular, "a"},
        {gpu::SLOT_specular_color, "rgb"},
        {gpu::SLOT_lightmap, "rgb"},
        {gpu::SLOT_clearcoat, "r"},
        {gpu::SLOT_clearcoat_roughness, "g"},
        {gpu::SLOT_clearcoat_normal, "rgb"},
        {gpu::SLOT_anisotropy, "rgb"},
        {gpu::SLOT_sheen_color, "rgb"},
        {gpu::SLOT_sheen_roughness, "a"},
        {gpu::SLOT_iridescence, "r"},
        {gpu::SLOT_iridescence_thickness, "g"},
        {gpu::SLOT_transmission, "r"},
        {gpu::SLOT_thickness, "g"},
        {gpu::SLOT_diffuse_transmission, "a"},
        {gpu::SLOT_diffuse_transmission_color, "rgb"}};
    ASSERT_EQ(reads.size(), gpu::SLOT_COUNT);
    for (const auto& [slot, components] : reads)
        for (std::size_t c = 0; c < 4; ++c) {
            TextureImage one{"one", 2, 2, std::vector<std::uint8_t>(16, 77)};
            EXPECT_TRUE(hasOneColor(one, slot));
            one.rgba[12 + c] = 78;  // the last texel
            EXPECT_EQ(hasOneColor(one, slot), components.find("rgba"[c]) == std::string::npos)
                << slot << ", component " << c;
        }
    EXPECT_FALSE(hasOneColor({"deep", 1, 1, {}, {1, 1, 1, 1}}, gpu::SLOT_base_color));
}

TEST(TexelPlan, WhatReadsNothingHasNone) {
    EXPECT_EQ(plannedTexels({}, fourImages()), SlotTexels{});
    Material unlit;
    unlit.unlit = true;
    unlit.base_color_texture.texture = unlit.metallic_roughness_texture.texture = 0;
    SlotTexels expected{};
    expected[gpu::SLOT_base_color] = gpu::TEXEL_OWN;
    EXPECT_EQ(plannedTexels(unlit, fourImages()), expected);
}

TEST(TexelPlan, OneColorIsAFactor) {
    Scene scene = fourImages();
    scene.images[0].rgba.assign(scene.images[0].rgba.size(), 9);
    Material m;
    m.emissive = {1, 1, 1};
    m.clearcoat = m.anisotropy = m.iridescence = m.transmission = m.thickness = m.diffuse_transmission = 1;
    m.sheen_color = {1, 1, 1};
    for (const MaterialSlot& slot : materialSlots) (m.*slot.texture).texture = 0;
    for (const gpu::uint texel : plannedTexels(m, scene)) EXPECT_EQ(texel, gpu::TEXEL_CONSTANT);
}

// The alpha of its specular colour is glossiness, which KHR_materials_specular does not read there.
TEST(TexelPlan, GlossinessIsReadToo) {
    Scene scene = fourImages();
    for (std::size_t i = 0; i < scene.images[0].rgba.size(); ++i)
        if (i % 4 < 3) scene.images[0].rgba[i] = 9;
    Material m;
    m.specular_color_texture.texture = 0;
    EXPECT_EQ(plannedTexel(gpu::SLOT_specular_color, m, scene), gpu::TEXEL_CONSTANT);
    m.specular_glossiness = true;
    EXPECT_EQ(plannedTexel(gpu::SLOT_specular_color, m, scene), gpu::TEXEL_OWN);
}

// Occlusion shares a sample with roughness and metallic, emission with the base colour, unless anything
// about their lookup differs.
TEST(TexelPlan, SlotsThatReadAlikeShareASample) {
    const Scene scene = fourImages();
    Material m;
    m.emissive = {1, 1, 1};
    m.metallic_roughness_texture.texture = m.occlusion_texture.texture = 0;
    m.base_color_texture.texture = m.emissive_texture.texture = 1;
    EXPECT_EQ(plannedTexel(gpu::SLOT_occlusion, m, scene), gpu::TEXEL_SHARED);
    EXPECT_EQ(plannedTexel(gpu::SLOT_metallic_roughness, m, scene), gpu::TEXEL_OWN);
    EXPECT_EQ(plannedTexel(gpu::SLOT_emissive, m, scene), gpu::TEXEL_SHARED);
    EXPECT_EQ(plannedTexel(gpu::SLOT_base_color, m, scene), gpu::TEXEL_OWN);
    using Change = std::function<void(TextureSlot&)>;
    const std::vector<std::pair<std::string, Change>> changes = {
        {"UV set", [](TextureSlot& s) { s.texcoord = 1; }},
        {"u", [](TextureSlot& s) { s.u.z = 1e-9; }},
        {"v", [](TextureSlot& s) { s.v.x = 1e-9; }},
        {"sampler", [](TextureSlot& s) { s.texture = 4; }},
        {"image", [](TextureSlot& s) { s.texture = 2; }}};
    for (const auto& [what, change] : changes) {
        Material other = m;
        change(other.occlusion_texture);
        EXPECT_EQ(plannedTexel(gpu::SLOT_occlusion, other, scene), gpu::TEXEL_OWN) << what;
        other = m;
        other.emissive_texture.texture = other.base_color_texture.texture = 0;
        change(other.emissive_texture);
        EXPECT_EQ(plannedTexel(gpu::SLOT_emissive, other, scene), gpu::TEXEL_OWN) << what;
    }
    Scene half = scene;  // roughness and metallic become constant, occlusion does not
    for (std::size_t i = 0; i < half.images[0].rgba.size(); ++i)
        if (i % 4 == 1 || i % 4 == 2) half.images[0].rgba[i] = 5;
    EXPECT_EQ(plannedTexel(gpu::SLOT_occlusion, m, half), gpu::TEXEL_OWN);
    EXPECT_EQ(plannedTexel(gpu::SLOT_metallic_roughness, m, half), gpu::TEXEL_CONSTANT);
    Material rough = m;  // only occlusion reads the texture
    rough.metallic_roughness_texture.texture = -1;
    EXPECT_EQ(plannedTexel(gpu::SLOT_occlusion, rough, scene), gpu::TEXEL_OWN);
}

// A sheen's roughness and the weight of diffuse transmission are the alpha of their colour.
TEST(TexelPlan, AnAlphaSharesTheSampleOfItsColour) {
    const Scene scene = fourImages();
    Material m;
    m.sheen_color = {1, 1, 1};
    m.diffuse_transmission = 1;
    for (const auto& [color, alpha] :
         {std::pair{gpu::SLOT_sheen_color, gpu::SLOT_sheen_roughness},
          {gpu::SLOT_diffuse_transmission_color, gpu::SLOT_diffuse_transmission}}) {
        TextureSlot& own = m.*materialSlots[alpha].texture;
        (m.*materialSlots[color].texture).texture = own.texture = 0;
        EXPECT_EQ(plannedTexel(color, m, scene), gpu::TEXEL_OWN);
        EXPECT_EQ(plannedTexel(alpha, m, scene), gpu::TEXEL_SHARED);
        own.texture = 1;
        EXPECT_EQ(plannedTexel(alpha, m, scene), gpu::TEXEL_OWN) << "another image";
        own = {0, 1};
        EXPECT_EQ(plannedTexel(alpha, m, scene), gpu::TEXEL_OWN) << "another UV set";
    }
}

// A thickness texture needs both transmission and a thickness; without transmission nothing reads either.
TEST(TexelPlan, TransmissionOfFactorZeroReadsNothing) {
    const Scene scene = fourImages();
    Material m;
    m.transmission_texture.texture = m.thickness_texture.texture = 0;
    m.diffuse_transmission_texture.texture = m.diffuse_transmission_color_texture.texture = 0;
    m.thickness = 1;
    EXPECT_EQ(plannedTexels(m, scene), SlotTexels{});
    m.transmission = 1;
    EXPECT_EQ(plannedTexel(gpu::SLOT_transmission, m, scene), gpu::TEXEL_OWN);
    EXPECT_EQ(plannedTexel(gpu::SLOT_thickness, m, scene), gpu::TEXEL_OWN);
    m.thickness = 0;
    EXPECT_EQ(plannedTexel(gpu::SLOT_thickness, m, scene), 0u);
    EXPECT_EQ(plannedTexel(gpu::SLOT_diffuse_transmission, m, scene), 0u);
}

TEST(TexelPlan, RoughnessAndMetallicAreInAlphasOfOpaqueSurfaces) {
    Scene scene = fourImages();
    scene.images[2] = twoValues(2, 1);
    Material m;
    m.base_color_texture.texture = 0;
    m.normal_texture.texture = 1;
    m.metallic_roughness_texture.texture = 2;
    const auto texel = [](const Material& of, const Scene& in) {
        return plannedTexel(gpu::SLOT_metallic_roughness, of, in, true);
    };
    EXPECT_EQ(texel(m, scene), gpu::TEXEL_ALPHAS);
    EXPECT_EQ(plannedTexel(gpu::SLOT_metallic_roughness, m, scene), gpu::TEXEL_OWN) << "unless asked for";
    Scene sizes = scene;
    sizes.images[2] = twoValues();
    EXPECT_EQ(texel(m, sizes), gpu::TEXEL_ALPHAS) << "the same size";
    for (const auto& [width, height] : {std::pair{2, 2}, {3, 1}, {8, 4}, {4, 1}}) {
        sizes.images[2] = twoValues(width, height);
        EXPECT_EQ(texel(m, sizes), gpu::TEXEL_OWN) << width << " x " << height;
    }
    using Change = std::function<void(Material&)>;
    const std::vector<std::pair<std::string, Change>> changes = {
        {"mask", [](Material& o) { o.alpha_mode = AlphaMode::mask; }},
        {"blend", [](Material& o) { o.alpha_mode = AlphaMode::blend; }},
        {"transmission", [](Material& o) { o.transmission = 0.5f; }},
        {"no normal map", [](Material& o) { o.normal_texture.texture = -1; }},
        {"no base colour", [](Material& o) { o.base_color_texture.texture = -1; }},
        {"UV set", [](Material& o) { o.normal_texture.texcoord = 1; }},
        {"transform", [](Material& o) { o.base_color_texture.u.x = 2; }},
        {"sampler", [](Material& o) { o.base_color_texture.texture = 4; }},
        {"occlusion beside them", [](Material& o) { o.occlusion_texture.texture = 2; }}};
    for (const auto& [what, change] : changes) {
        Material other = m;
        change(other);
        EXPECT_EQ(texel(other, scene), gpu::TEXEL_OWN) << what;
    }
    Scene deep = scene;
    deep.images[1] = {"deep", 4, 2, {}, std::vector<std::uint16_t>(32, 7)};
    EXPECT_EQ(texel(m, deep), gpu::TEXEL_OWN);
}

}  // namespace
}  // namespace diptych
