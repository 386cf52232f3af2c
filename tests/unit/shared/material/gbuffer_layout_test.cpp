// SPDX-License-Identifier: MIT
// A G-buffer has exactly the attachments that a scene's materials need: each costs bandwidth at every
// pixel.
#include "shared/material/gbuffer_layout.h"

#include "shared/vulkan/resources.h"

#include <gtest/gtest.h>

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
    for (const auto& [encoding, least, emission, more] :
         {std::tuple{GBufferEncoding::compact, 12u, 4u, 4u},
          {GBufferEncoding::standard, 16u, 4u, 4u},
          {GBufferEncoding::full, 64u, 0u, 16u}}) {  // full stores the material's index with the emission
        const Requirements none = noneNeeded();
        EXPECT_EQ(bytesOf(encoding, none), least);
        Requirements needs = none;
        needs.emission = true;
        needs.max_emission = needs.min_emission = 1;
        EXPECT_EQ(bytesOf(encoding, needs), least + emission);
        needs = none;
        needs.dielectric_specular = true;
        EXPECT_EQ(bytesOf(encoding, needs), least + more);
        needs = none;
        needs.lightmap = true;
        needs.max_lightmap = 1;
        EXPECT_EQ(bytesOf(encoding, needs), least + more);
        needs.dielectric_specular = true;
        EXPECT_EQ(bytesOf(encoding, needs), least + 2 * more);
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

}  // namespace
}  // namespace diptych
