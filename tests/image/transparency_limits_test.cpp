// SPDX-License-Identifier: MIT
// The transparency modes at extremes and at the device's limits.
#include "compare/frames/nonfinite.h"
#include "shared/scene/builtin/builder.h"
#include "tests/image/transparency_modes.h"

#include <fmt/format.h>

namespace diptych::tests {
namespace {

// Radiance beyond the range of half floats, and nearly zero; opacities of 0 and 1; 32 layers at one depth.
TEST(TransparencyModes, ExtremesStayNumbers) {
    for (const float radiance : {1e-20f, 1.0f, 1e6f, 1e15f}) {
        Builder b;
        b.camera("front", {0, 0, 10}, {0, 0, 0}, 20, 0.1, 100);
        for (int i = 0; i < 32; ++i) {
            const int material = b.material(fmt::format("layer {}", i), {glm::vec3(radiance), 0, 1});
            Material& m = b.scene.materials.back();
            m.unlit = true;
            m.base_color.a = i % 3 == 0 ? 1.0f : i % 3 == 1 ? 0.0f : 0.3f;
            m.alpha_mode = AlphaMode::blend;
            b.add("layer", quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}), material, glm::dvec3(0.0));
        }
        for (const Transparency mode : allModes) {
            const Image made = litWith(b.scene, imageSettings(mode), nothing);
            EXPECT_EQ(nonfinitePixels(made), 0u) << nameOf(mode) << " " << radiance;
            // All layers emit the same radiance, so every order gives that.
            EXPECT_NEAR(double{made.at(48, 27, 0)} / double{radiance}, 1, 1e-4)
                << nameOf(mode) << " " << radiance;
        }
    }
}

// All weights underflow float32, and the optical depths overflow it.
TEST(TransparencyModes, ManyOpaqueLayersAtOneDepthAreSeen) {
    Builder b;
    b.camera("front", {0, 0, 10}, {0, 0, 0}, 20, 0.1, 100);
    const int material = b.material("layer", {glm::vec3(0.5f), 0, 1});
    b.scene.materials.back().unlit = true;
    b.scene.materials.back().alpha_mode = AlphaMode::blend;
    for (int i = 0; i < 64; ++i)
        b.add("layer", quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}), material, glm::dvec3(0.0));
    for (const Transparency mode : allModes)
        EXPECT_NEAR(litWith(b.scene, imageSettings(mode), nothing).at(48, 27, 0), 0.5f, 1e-5f)
            << nameOf(mode);
}

// An image that needs more than the largest bindable buffer is rendered in parts.
TEST(TransparencyModes, PartsOfAnImageJoin) {
    const Scene scene = loadScene("builtin:crossed");
    Settings settings = imageSettings(Transparency::list);
    settings.size = {256, 144};
    const Image whole = litWith(scene, settings, nothing);
    settings.transparency_layers = 256;
    const Image parts = litWith(scene, settings, nothing, [](PreparedView& view) {
        EXPECT_LT(view.fragments.rows(), 144u) << "this device binds larger buffers: the test shows nothing";
    });
    EXPECT_EQ(differingPixels(whole, parts), 0u);
}

// Light lists that would need several draws are an error where something is blended.
TEST(TransparencyModes, ListsThatOneDrawDoesNotWalkAreAnError) {
    Settings settings = imageSettings(Transparency::sorted);
    settings.assign = Assignment::every;
    settings.lights = fmt::format("point:{}", device().profile().light_iterations + 1);
    const Scene scene = loadScene("builtin:glass");
    try {
        litWith(scene, settings, nothing);
        FAIL() << "drawn";
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find("--assign clustered"), std::string::npos) << error.what();
    }
    settings.transparency = Transparency::off;
    settings.size = {8, 8};
    EXPECT_NO_THROW(litWith(scene, settings, nothing));
}

}  // namespace
}  // namespace diptych::tests
