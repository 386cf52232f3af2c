// SPDX-License-Identifier: MIT
// Images with 4 samples a pixel against the reference with 64, each resolve against its own ground truth.
#include "compare/image/channel_image.h"
#include "compare/metrics/flip.h"
#include "tests/image/scenes.h"

#include <array>
#include <string>
#include <tuple>

namespace diptych::tests {
namespace {

Frame referenceLit(Renderer& renderer, Settings settings, int samples) {
    settings.path = Path::reference;
    settings.reference_mode = ReferenceMode::scene;
    settings.spp = samples;
    return renderer.draw(settings, untimed({Channel::lit}));
}

// As displayed: tone-mapped and in sRGB.
Image shown(const Image& radiance, const Exposure& exposure) {
    Image image = radiance;
    for (std::size_t i = 0; i + 2 < image.data.size(); i += 3) {
        std::array<float, 3> rgb{};
        for (std::size_t c = 0; c < 3; ++c)
            rgb.at(c) = radiance.data[i + c] * static_cast<float>(exposure.factor);
        rgb = pbrNeutral(rgb);
        for (std::size_t c = 0; c < 3; ++c)
            image.data[i + c] = static_cast<float>(srgbFromLinear(double{rgb.at(c)}));
    }
    return image;
}

// Mean FLIP against the reference with 64 samples: of the paths with 4, and of the reference with 4, which
// shows how much 4 samples can resolve.
struct Flips {
    std::array<double, 2> paths;
    double reference;
};
Flips flipsOf(const Scene& scene, const Settings& settings) {
    Renderer renderer(device(), scene, pipelines());
    const Frame truth = referenceLit(renderer, settings, 64);
    const Image& radiance = truth.channels.at(Channel::lit);
    const Exposure exposure = exposureFor({}, &radiance, coverage(truth, truth));
    const Image seen = shown(radiance, exposure);
    const auto flip = [&](const Frame& frame) {
        return ldrFlip(seen, shown(frame.channels.at(Channel::lit), exposure)).mean;
    };
    return {{flip(drawnBy(Path::deferred, renderer, settings, {Channel::lit})),
             flip(drawnBy(Path::forward_plus, renderer, settings, {Channel::lit}))},
            flip(referenceLit(renderer, settings, 4))};
}

Settings fourSamples(Resolve resolve, Size size = {112, 63}) {
    Settings settings = smallImage(GBufferEncoding::full);
    settings.size = size;
    settings.msaa = 4;
    settings.resolve = resolve;
    return settings;
}

class MsaaTruth : public testing::TestWithParam<Resolve> {
protected:
    // Without textures, because paths filter mip levels and the reference takes one point per sample. The
    // standard sample locations are spread over columns and rows: closer to the ground truth than 4
    // samples of the reference.
    void expectNearAsFourSamplesCanBe(Scene scene) const {
        for (Material& m : scene.materials)
            for (TextureSlot* slot :
                 {&m.base_color_texture, &m.metallic_roughness_texture, &m.normal_texture,
                  &m.occlusion_texture, &m.emissive_texture, &m.specular_texture, &m.specular_color_texture})
                slot->texture = -1;
        const Flips flips = flipsOf(scene, fourSamples(GetParam()));
        for (const double flip : flips.paths) EXPECT_LT(flip, 0.85 * flips.reference) << flips.reference;
    }
};

TEST_P(MsaaTruth, Gallery) {
    expectNearAsFourSamplesCanBe(loadScene("builtin:gallery"));
}

TEST_P(MsaaTruth, Sponza) {
    const std::filesystem::path file = assets() / "sponza/Sponza.gltf";
    if (!std::filesystem::exists(file))
        GTEST_SKIP() << "SKIPPED, NOT PROVED HERE: no " << file << "; the gallery proves it";
    expectNearAsFourSamplesCanBe(loadScene(file.string()));
}

// With its textures, which have little detail below a pixel.
TEST_P(MsaaTruth, FlightHelmet) {
    const std::filesystem::path file = assets() / "flight_helmet/FlightHelmet.gltf";
    if (!std::filesystem::exists(file))
        GTEST_SKIP() << "SKIPPED, NOT PROVED HERE: no " << file << "; the gallery proves it";
    for (const double flip : flipsOf(loadScene(file.string()), fourSamples(GetParam(), {160, 90})).paths)
        EXPECT_LT(flip, 0.02);
}

// Negative control: the image of one resolve is far from the other's ground truth.
TEST(MsaaTruthNegativeControl, ResolvesDiffer) {
    const Scene scene = loadScene("builtin:gallery");
    Renderer renderer(device(), scene, pipelines());
    const Frame truth = referenceLit(renderer, fourSamples(Resolve::linear), 16);
    const Image& radiance = truth.channels.at(Channel::lit);
    const Exposure exposure = exposureFor({}, &radiance, coverage(truth, truth));
    const Frame other = referenceLit(renderer, fourSamples(Resolve::tonemapped), 16);
    EXPECT_GT(ldrFlip(shown(radiance, exposure), shown(other.channels.at(Channel::lit), exposure)).mean,
              0.02);
}

INSTANTIATE_TEST_SUITE_P(Msaa, MsaaTruth, testing::Values(Resolve::linear, Resolve::tonemapped),
                         [](const auto& resolve) { return std::string(nameOf(resolve.param)); });

}  // namespace
}  // namespace diptych::tests
