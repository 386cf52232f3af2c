// SPDX-License-Identifier: MIT
// A G-buffer has exactly the attachments that a scene's materials need: each costs bandwidth at every
// pixel.
#include "shared/material/gbuffer_layout.h"

#include "shared/vulkan/device/resources.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>
#include <utility>
#include <vector>

namespace diptych {
namespace {

Requirements noneNeeded() {
    Requirements needs;
    needs.materials = 1;
    return needs;
}

std::uint32_t bytesOf(GBufferEncoding encoding, const Requirements& needs) {
    std::uint32_t bytes = 0;
    for (const VkFormat format : gbufferLayout(encoding, needs).formats)
        if (format != VK_FORMAT_UNDEFINED) bytes += bytesPerTexel(format);
    return bytes;
}

TEST(GBufferLayout, HoldsWhatTheMaterialsNeed) {
    for (const auto& [encoding, min, emission, more] :
         {std::tuple{GBufferEncoding::compact, 12u, 4u, 4u},
          {GBufferEncoding::standard, 16u, 4u, 4u},
          {GBufferEncoding::full, 64u, 0u, 16u}}) {  // full stores the material's index with the emission
        const Requirements none = noneNeeded();
        EXPECT_EQ(bytesOf(encoding, none), min);
        Requirements needs = none;
        needs.emission = true;
        needs.max_emission = needs.min_emission = 1;
        EXPECT_EQ(bytesOf(encoding, needs), min + emission);
        needs = none;
        needs.dielectric_specular = true;
        EXPECT_EQ(bytesOf(encoding, needs), min + more);
        needs = none;
        needs.lightmap = true;
        needs.max_lightmap = 1;
        EXPECT_EQ(bytesOf(encoding, needs), min + more);
        needs.dielectric_specular = true;
        EXPECT_EQ(bytesOf(encoding, needs), min + 2 * more);
    }
}

// Radiance beyond 9.9.9.e5 is stored as float32, and indices beyond their bits get a word.
TEST(GBufferLayout, WidensWhatDoesNotFit) {
    Requirements needs = noneNeeded();
    needs.emission = true;
    needs.max_emission = 2 * gpu::EMISSION_MAX;
    needs.min_emission = 1;
    EXPECT_EQ(bytesOf(GBufferEncoding::standard, needs), 16u + 16);
    needs.max_emission = 1;
    needs.min_emission = gpu::EMISSION_MIN / 2;
    EXPECT_EQ(bytesOf(GBufferEncoding::standard, needs), 16u + 16);
    needs = noneNeeded();
    needs.materials = 1u << gpu::COMPACT_ID_BITS;
    EXPECT_EQ(bytesOf(GBufferEncoding::compact, needs), 12u);
    ++needs.materials;
    EXPECT_EQ(bytesOf(GBufferEncoding::compact, needs), 12u + 4);
}

TEST(GBufferLayout, EachPropertyIsAFeature) {
    for (const auto& [wide, feature] :
         {std::pair{&GBufferLayout::wide_emission, gpu::FEATURE_gbuffer_wide_emission},
          {&GBufferLayout::wide_lightmap, gpu::FEATURE_gbuffer_wide_lightmap},
          {&GBufferLayout::wide_material_id, gpu::FEATURE_gbuffer_wide_material_id}}) {
        GBufferLayout layout;
        layout.encoding = gpu::GBUFFER_full;
        layout.layers = gpu::LAYER_SHEEN;
        layout.*wide = true;
        Variant variant;
        layout.specialise(variant);
        EXPECT_EQ(variant, Variant()
                               .set(feature)
                               .set(gpu::FEATURE_gbuffer_encoding, gpu::GBUFFER_full)
                               .set(gpu::FEATURE_gbuffer_layers, gpu::LAYER_SHEEN))
            << feature;
    }
}

// ---- two passes --------------------------------------------------------------------------------------

constexpr gpu::uint coat = gpu::LAYER_CLEARCOAT, brushed = gpu::LAYER_ANISOTROPY, cloth = gpu::LAYER_SHEEN,
                    film = gpu::LAYER_IRIDESCENCE, leaf = gpu::LAYER_DIFFUSE_TRANSMISSION;
constexpr gpu::uint everyLayer = coat | brushed | cloth | film | leaf;
using Attachments = std::vector<gpu::uint>;

GBufferPasses passesOf(GBufferEncoding encoding, gpu::uint layers, bool specular, bool sampled) {
    Requirements needs = noneNeeded();
    needs.surface_layers = layers;
    needs.dielectric_specular = specular;
    return gbufferPasses(gbufferLayout(encoding, needs, sampled));
}

// Float32 layers in order: coat 5 words, anisotropy 3, sheen 4, film 3, diffuse transmission 4; four words
// are an attachment.
TEST(GBufferPasses, TheSecondHasTheLastLayers) {
    const Attachments base{gpu::GBUFFER_ALBEDO, gpu::GBUFFER_NORMALS, gpu::GBUFFER_PARAMS,
                           gpu::GBUFFER_EMISSION};
    // 4 and 4 attachments: one pass.
    GBufferPasses passes = passesOf(GBufferEncoding::full, coat | brushed | cloth | film, false, false);
    Attachments first = base;
    for (gpu::uint i = 0; i < 4; ++i) first.push_back(gpu::GBUFFER_LAYERS + i);
    EXPECT_EQ(passes.first, first);
    EXPECT_EQ(passes.second, Attachments{});
    EXPECT_EQ(passes.second_layers, 0u);
    // 5 and 4: words 12 to 15.
    passes = passesOf(GBufferEncoding::full, coat | cloth | film | leaf, true, false);
    first = base;
    for (const gpu::uint i :
         {gpu::GBUFFER_SPECULAR, gpu::GBUFFER_LAYERS, gpu::GBUFFER_LAYERS + 1, gpu::GBUFFER_LAYERS + 2})
        first.push_back(i);
    EXPECT_EQ(passes.first, first);
    EXPECT_EQ(passes.second, Attachments{gpu::GBUFFER_LAYERS + 3});
    EXPECT_EQ(passes.second_layers, leaf);
    // 6 with shaded locations, which stay in the first pass, and 5: from word 8 on, which begins the sheen.
    passes = passesOf(GBufferEncoding::full, everyLayer, true, true);
    first.back() = gpu::GBUFFER_SHADED;
    EXPECT_EQ(passes.first, first);
    EXPECT_EQ(passes.second,
              (Attachments{gpu::GBUFFER_LAYERS + 2, gpu::GBUFFER_LAYERS + 3, gpu::GBUFFER_LAYERS + 4}));
    EXPECT_EQ(passes.second_layers, cloth | film | leaf);
}

// The second pass also draws a layer whose last word alone lies there.
TEST(GBufferPasses, ALayerMayBeInBoth) {
    Requirements needs = noneNeeded();
    needs.surface_layers = coat | brushed;
    needs.dielectric_specular = needs.lightmap = true;
    const GBufferPasses passes = gbufferPasses(gbufferLayout(GBufferEncoding::full, needs, true));
    EXPECT_EQ(passes.second, Attachments{gpu::GBUFFER_LAYERS + 1});  // words 4 to 7; the coat has 0 to 4
    EXPECT_EQ(passes.second_layers, coat | brushed);
}

// All combinations: two passes suffice, hold every attachment once, and the first one is filled.
TEST(GBufferPasses, TwoSufficeForEveryScene) {
    std::size_t divided = 0;
    for (const GBufferEncoding encoding :
         {GBufferEncoding::compact, GBufferEncoding::standard, GBufferEncoding::full})
        for (gpu::uint layers = 0; layers <= everyLayer; ++layers)
            for (gpu::uint others = 0; others < 32; ++others) {
                Requirements needs = noneNeeded();
                needs.surface_layers = layers;
                needs.emission = (others & 1) != 0;
                needs.max_emission = needs.min_emission = 1;
                needs.dielectric_specular = (others & 2) != 0;
                needs.lightmap = (others & 4) != 0;
                needs.max_lightmap = 1;
                if ((others & 8) != 0) needs.materials = 1u << 20;
                const GBufferLayout layout = gbufferLayout(encoding, needs, (others & 16) != 0);
                const GBufferPasses passes = gbufferPasses(layout);
                Attachments all = passes.first, there;
                all.insert(all.end(), passes.second.begin(), passes.second.end());
                std::ranges::sort(all);
                for (gpu::uint i = 0; i < gpu::GBUFFER_ATTACHMENTS; ++i)
                    if (layout.formats[i] != VK_FORMAT_UNDEFINED) there.push_back(i);
                EXPECT_EQ(all, there);
                EXPECT_LE(passes.first.size(), gpu::MAX_COLOR_ATTACHMENTS);
                EXPECT_LE(passes.second.size(), 4u);  // outputs of gbuffer_layers.frag
                EXPECT_EQ(passes.second.empty(), there.size() <= gpu::MAX_COLOR_ATTACHMENTS);
                EXPECT_EQ(passes.second_layers != 0, !passes.second.empty());
                if (passes.second.empty()) continue;
                ++divided;
                EXPECT_EQ(passes.first.size(), gpu::MAX_COLOR_ATTACHMENTS);
                EXPECT_GE(passes.second.front(), gpu::GBUFFER_LAYERS);
                EXPECT_LT(passes.second.back(), gpu::GBUFFER_SHADED);
            }
    EXPECT_GT(divided, 100u);
}

}  // namespace
}  // namespace diptych
