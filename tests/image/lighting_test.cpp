// SPDX-License-Identifier: MIT
// Deferred lighting in fragment and compute shaders (--lighting) gives the same bits.
#include "compare/frames/frame_properties.h"
#include "compare/render/prepared_view.h"
#include "shared/contract/lighting_tiles.h"
#include "tests/image/shadow_scenes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace diptych::tests {
namespace {

Settings lightingSettings(Size size = {160, 90}) {
    Settings settings = smallImage(GBufferEncoding::full);
    settings.path = Path::deferred;
    settings.size = size;
    return settings;
}

// lit of the timed frame, not of a capture.
Image timedLit(Renderer& renderer, const Settings& settings) {
    RenderOptions options = untimed({Channel::lit});
    options.recheck = false;
    return renderer.draw(settings, options).channels.at(Channel::lit);
}

// Smallest compared radiance, W/(sr m^2). Lavapipe's fragments flush terms below 2^-126 to 0 in one
// process and keep them in another. Such terms have changed radiance by up to 6e-37.
constexpr float minCompared = 1e-30f;
Image withoutDarkness(Image image) {
    for (float& value : image.data)
        if (std::abs(value) < minCompared) value = 0;
    return image;
}

// Returns the image of fragment shading.
Image expectSameLighting(Renderer& renderer, Settings settings, const std::string& name) {
    settings.lighting = Lighting::fragment;
    Image fragments = timedLit(renderer, settings);
    settings.lighting = Lighting::compute;
    const Image threads = timedLit(renderer, settings);
    EXPECT_EQ(differingPixels(withoutDarkness(fragments), withoutDarkness(threads)), 0u) << name;
    return fragments;
}

// With options (with()) beyond lightingSettings().
Image expectSameLighting(const std::string& scene, const std::string& options) {
    return expectSameLighting(uploaded(scene).renderer, with(lightingSettings(), options),
                              scene + ", " + options);
}

std::size_t distinctTexels(const Image& image) {
    std::vector<std::array<float, 3>> texels;
    for (std::size_t i = 0; i < image.pixels(); ++i) {
        const float* p = image.pixel(i);
        texels.push_back({p[0], p[1], p[2]});
    }
    std::ranges::sort(texels);
    return static_cast<std::size_t>(std::unique(texels.begin(), texels.end()) - texels.begin());
}

class LightingOf : public testing::TestWithParam<std::string> {};

// As for a report: the capture of `lit`, by fragments, must reproduce the frame shaded in compute.
TEST_P(LightingOf, ChangesNoBit) {
    Settings settings = lightingSettings();
    const Image image = expectSameLighting(uploaded(GetParam()).renderer, settings, GetParam());
    EXPECT_GT(distinctTexels(image), 100u) << "there is something to compare";
    settings.lighting = Lighting::compute;
    const Frame frame = drawnBy(Path::deferred, uploaded(GetParam()).renderer, settings, {Channel::lit});
    EXPECT_EQ(frame.counters.unreproduced_pixels, 0u);
    expectSameLighting(GetParam(), "msaa 4");
}

INSTANTIATE_TEST_SUITE_P(Builtin, LightingOf,
                         testing::Values("builtin:gallery", "builtin:spheres", "builtin:points",
                                         "builtin:ortho", "builtin:cutout", "builtin:glass", "builtin:areas",
                                         "builtin:dielectrics", "builtin:occlusion", "builtin:far_away",
                                         "builtin:deep", "builtin:normals"),
                         sceneName);

// For every light assignment and G-buffer encoding.
TEST(LightingImages, AreTheSameForEveryAssignmentAndEncoding) {
    for (const char* assign : {"every", "tiled", "clustered"})
        for (const auto& [encoding, encoded] : enumNames<GBufferEncoding>())
            for (const char* lights : {"point:40,spot:10", "point:3"})
                expectSameLighting("builtin:gallery",
                                   fmt::format("assign {} gbuffer {} lights {}", assign, encoded, lights));
    for (const char* kernel : {"scatter", "gather"})
        expectSameLighting("builtin:points", fmt::format("light-kernel {}", kernel));
}

// Attachment writes and image stores may round to fewer bits differently.
TEST(LightingImages, AreTheSameInEveryFormat) {
    for (const auto& [lit_format, of_lit] : enumNames<LitFormat>())
        for (const auto& [depth_format, of_depth] : enumNames<DepthFormat>())
            expectSameLighting("builtin:gallery",
                               fmt::format("lit-format {} depth-format {}", of_lit, of_depth));
    if (device().support().has(DeviceFeature::shaderFloat16))
        expectSameLighting("builtin:gallery", "shading-precision fp16");
    // Beyond the largest half float.
    Scene bright = loadScene("builtin:points");
    for (Light& light : bright.lights) light.intensity *= 1e6f;
    Renderer renderer(device(), bright, pipelines());
    for (const LitFormat format : {LitFormat::fp16, LitFormat::b10g11r11}) {
        Settings settings = lightingSettings();
        settings.lit_format = format;
        const Image image = expectSameLighting(renderer, settings, "bright");
        EXPECT_GT(*std::ranges::max_element(image.data), 6e4f);
    }
}

TEST(LightingImages, AreTheSameUnderEveryShadow) {
    for (const auto& [shadows, name] : enumNames<Shadows>())
        expectSameLighting("builtin:gallery", fmt::format("shadows {} shadow-size 256", name));
    for (const char* exponent : {"5", "44.36"})
        expectSameLighting(
            "builtin:gallery",
            fmt::format("shadows evsm shadow-size 256 evsm-precision fp32 evsm-exponent {}", exponent));
    expectSameLighting("builtin:gallery",
                       "shadows pcf shadow-size 256 shadow-lights 4 lights point:8,spot:4");
}

TEST(LightingImages, AreTheSameUnderLightFromEverywhere) {
    Scene sky = loadScene("builtin:gallery");
    sky.environment = {"sky", Image(8, 4, 3, 0.5f)};
    for (std::size_t i = 0; i < sky.environment->radiance.data.size(); ++i)
        sky.environment->radiance.data[i] = 0.1f * static_cast<float>(i % 7);
    Renderer renderer(device(), sky, pipelines());
    for (const Ibl ibl : {Ibl::split, Ibl::sampled})
        for (const int samples : {1, 4}) {
            Settings settings = lightingSettings({96, 54});
            settings.ibl = ibl;
            settings.ibl_diffuse = ibl == Ibl::split ? IblDiffuse::sh : IblDiffuse::map;
            settings.ibl_samples = 16;
            settings.haze = samples > 1;
            settings.msaa = samples;
            expectSameLighting(renderer, settings, fmt::format("{} {}", nameOf(ibl), samples));
        }
    const std::string ambient = "ambient 0.3,0.4,0.5 ";
    for (const auto& [multiscatter, name] : enumNames<Multiscatter>())
        if (multiscatter != Multiscatter::walk)  // only the reference has it
            expectSameLighting("builtin:gallery", ambient + "multiscatter " + std::string(name));
    expectSameLighting("builtin:gallery", ambient + "specular-albedo fit");
    expectSameLighting("builtin:areas", "area-lights representative");
    expectSameLighting("builtin:points", "lights point:20,spot:20 spot-cone smoothstep range-window squared");
    for (const char* steps : {"0", "8"})
        expectSameLighting("builtin:gallery",
                           fmt::format("haze on haze-density 1000 haze-march-steps {}", steps));
}

// Background pixels stay 0 under ambient light, with either lighting.
TEST(LightingImages, LeaveTheBackground) {
    for (const std::string gbuffer : {"standard", "full"}) {
        const Image image = expectSameLighting("builtin:spheres", "ambient 0.3,0.4,0.5 gbuffer " + gbuffer);
        EXPECT_GT(std::ranges::count(image.data, 0.0f), 3000);
    }
}

// With negligible light. Whether fragments flush denormals may change after rendering to 16-bit floats.
TEST(LightingImages, KeepNoDenormals) {
    Scene dim = loadScene("builtin:points");
    for (Light& light : dim.lights) light.intensity *= 1e-38f;
    Renderer renderer(device(), dim, pipelines());
    for (const Lighting lighting : {Lighting::fragment, Lighting::compute, Lighting::fragment}) {
        Settings settings = lightingSettings();
        settings.lighting = lighting;
        std::size_t normal = 0;
        for (const float value : timedLit(renderer, settings).data) {
            EXPECT_TRUE(value == 0 || value >= std::numeric_limits<float>::min()) << value;
            normal += value != 0;
        }
        EXPECT_GT(normal, 10u);
        settings.lit_format = LitFormat::fp16;
        timedLit(renderer, settings);
    }
}

// Workgroups at the right and lower edges lie partly outside the image.
TEST(LightingImages, AreTheSameOfEverySize) {
    constexpr auto side = static_cast<int>(gpu::LIGHTING_GROUP);
    for (const Size size : {Size{1, 1}, Size{33, 17}, Size{side, side}, Size{side - 1, side + 1},
                            Size{2 * side + 1, 1}, Size{1, 3 * side - 1}, Size{257, 131}})
        for (const int samples : {1, 4})
            for (const Assignment assign : {Assignment::clustered, Assignment::tiled})
                expectSameLighting("builtin:gallery",
                                   fmt::format("size {}x{} msaa {} assign {} lights point:30", size.width,
                                               size.height, samples, nameOf(assign)));
}

TEST(LightingImages, AreTheSameOfSeveralSamples) {
    for (const auto& [edges, name] : enumNames<MsaaEdges>())
        for (const char* gbuffer : {"standard", "full"})
            expectSameLighting("builtin:gallery",
                               fmt::format("msaa 4 msaa-edges {} gbuffer {}", name, gbuffer));
    for (const char* shadows : {"pcf", "evsm"})
        expectSameLighting("builtin:cutout", fmt::format("msaa 4 alpha-to-coverage on shadows {}", shadows));
    expectSameLighting("builtin:cutout", "msaa 4 resolve tonemapped msaa-shading sample");
}

// Sums of earlier batches are stored, not blended; the sun and shadow-casting lights are included.
TEST(LightingImages, AreTheSameInBatches) {
    for (const char* shadows : {"shadows off shadow-lights 0", "shadows pcf shadow-lights 2"})
        for (const char* size : {"24x14", "33x17"})
            expectSameLighting("builtin:gallery",
                               fmt::format("{} size {} assign every shadow-size 256 lights point:{}", shadows,
                                           size, 2 * device().profile().light_iterations + 7));
}

TEST(LightingImages, AreTheSameUnderWhatIsBlended) {
    for (const auto& [transparency, name] : enumNames<Transparency>())
        expectSameLighting("builtin:glass", fmt::format("transparency {} lit-format fp16", name));
}

// On devices that must not be busy for a whole dispatch, rows of workgroups are split into bands.
TEST(LightingImages, AreTheSameInBands) {
    Device on({.choice = "", .validate = true, .choices = ProfileChoices::gpu});
    const Scene scene = loadScene("builtin:points");
    Renderer renderer(on, scene, makePipelineSet(on));
    Settings settings = with(lightingSettings({200, 131}), "assign every lights point:30000");
    expectSameLighting(renderer, settings, "bands");
    settings.msaa = 4;
    settings.lights = "point:300";
    expectSameLighting(renderer, settings, "as a GPU has it, four samples");
    EXPECT_EQ(on.validationMessages(), 0u) << on.firstValidationMessage();
}

// Checks that compute is in use: no full-screen triangle shades, and compute reads the G-buffer.
TEST(LightingImages, AreMadeInCompute) {
    const Scene scene = loadScene("builtin:points");
    for (const Lighting lighting : {Lighting::fragment, Lighting::compute})
        for (const int samples : {1, 4}) {
            Settings settings = lightingSettings();
            settings.lighting = lighting;
            settings.msaa = samples;
            settings.msaa_edges = MsaaEdges::all;
            SharedResources shared(device(), scene, pipelines());
            const SceneView view = makeSceneView(scene, viewRequest(settings));
            const PreparedFrame frame(device(), shared, view, settings);
            std::size_t computed = 0, drawn = 0;
            for (const DeclaredUse& use : frame.passes.declarations()) {
                if (use.pass != "shade" || use.resource != "albedo") continue;
                computed += (use.access.stages & inCompute) != 0;
                drawn += (use.access.stages & inFragment) != 0;
            }
            const bool computes = lighting == Lighting::compute;
            EXPECT_EQ(computed, computes ? static_cast<std::size_t>(samples) : 0u);
            EXPECT_EQ(drawn, computes ? 0u : 1u);
        }
}

}  // namespace
}  // namespace diptych::tests
