// SPDX-License-Identifier: MIT
// Alpha masks that set sample coverage (--alpha-to-coverage).
#include "compare/image/channel_image.h"
#include "tests/image/square.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace diptych::tests {
namespace {

constexpr float cutoff = 0.4f;

Settings covered(Size size, bool on = true) {
    Settings settings = smallImage(GBufferEncoding::full);
    settings.size = size;
    settings.msaa = 4;
    settings.alpha_to_coverage = on;
    return settings;
}

// A masked square with radiance 1 where it covers. Vertex colours make alpha a linear ramp along `turned`
// (radians).
Scene slope(double turned) {
    Scene scene = square();
    Primitive& p = scene.meshes[0].primitives[0];
    const double c = std::cos(turned), s = std::sin(turned);
    for (const glm::vec3& at : p.positions)
        p.colors.emplace_back(1.0f, 1.0f, 1.0f,
                              static_cast<float>(0.5 + 0.35 * (c * double{at.x} + s * double{at.y})));
    Material& m = scene.materials[0];
    m.unlit = true;
    m.base_color = {1, 1, 1, 1};
    m.alpha_mode = AlphaMode::mask;
    m.alpha_cutoff = cutoff;
    return scene;
}

// The fraction of each pixel that the mask covers, equal in both paths. The square fills the image.
std::vector<double> fractionsOf(const Scene& scene, int pixels, bool on) {
    Renderer renderer(device(), scene, pipelines());
    std::vector<std::vector<double>> fractions;
    for (const Path path : drawn_paths) {
        const Frame frame = drawnBy(path, renderer, covered({pixels, pixels}, on), {Channel::lit});
        const Image& image = frame.channels.at(Channel::lit);
        std::vector<double>& of = fractions.emplace_back();
        for (std::size_t i = 0; i < image.pixels(); ++i) of.push_back(double{image.pixel(i)[0]});
        EXPECT_EQ(frame.counters.unreproduced_pixels, 0u);
    }
    EXPECT_EQ(fractions[0], fractions[1]);
    return fractions[0];
}

// The fraction of pixel x, y where the ramp reaches the cutoff, by 64 x 64 points; `pixels` is the image's
// size.
double exactFraction(double turned, int pixels, int x, int y) {
    constexpr int points = 64;
    int inside = 0;
    for (int i = 0; i < points; ++i)
        for (int j = 0; j < points; ++j) {
            const double u = 2 * (x + (i + 0.5) / points) / pixels - 1,
                         v = 1 - 2 * (y + (j + 0.5) / points) / pixels;
            inside += 0.5 + 0.35 * (std::cos(turned) * u + std::sin(turned) * v) >= double{cutoff};
        }
    return static_cast<double>(inside) / (points * points);
}

// The sample count nearest to the fraction of the pixel where alpha reaches the cutoff. Along an axis the
// error is at most 1/8 pixel; in other directions rounding at pixel corners adds up to 1/8. Averaged along
// an edge it is far smaller.
TEST(AlphaCoverage, IsTheFractionOfThePixel) {
    constexpr int pixels = 24;
    for (const double degrees : {0.0, 90.0, 45.0, 20.0, 67.0, 200.0}) {
        const double turned = degrees * std::numbers::pi / 180;
        const std::vector<double> fractions = fractionsOf(slope(turned), pixels, true);
        const bool axis = std::fmod(degrees, 90.0) == 0;
        double sum = 0, exact_sum = 0, parts = 0;
        for (int y = 0; y < pixels; ++y)
            for (int x = 0; x < pixels; ++x) {
                // On the diagonal, each of the square's triangles uses the alpha of its own part.
                if (x == pixels - 1 - y) continue;
                const double fraction = fractions[static_cast<std::size_t>(y * pixels + x)],
                             exact = exactFraction(turned, pixels, x, y);
                EXPECT_NEAR(fraction, exact, (axis ? 0.125 : 0.25) + 1.0 / 64)
                    << degrees << ": " << x << "," << y;
                EXPECT_NEAR(fraction * 4, std::round(fraction * 4), 1e-6);
                sum += fraction;
                exact_sum += exact;
                parts += exact > 0 && exact < 1;
            }
        ASSERT_GT(parts, 10) << degrees;
        EXPECT_NEAR(sum / parts, exact_sum / parts, 0.125) << degrees;
    }
}

// Negative control: without it a pixel is covered entirely or not at all, which exceeds the bound.
TEST(AlphaCoverage, WithoutItMasksCutWholePixels) {
    constexpr int pixels = 24;
    const double turned = 20 * std::numbers::pi / 180;
    const std::vector<double> fractions = fractionsOf(slope(turned), pixels, false);
    int beyond = 0;
    for (int y = 0; y < pixels; ++y)
        for (int x = 0; x < pixels; ++x) {
            const double fraction = fractions[static_cast<std::size_t>(y * pixels + x)];
            EXPECT_TRUE(fraction == 0 || fraction == 1 || x == y || x == pixels - 1 - y) << x << "," << y;
            beyond += std::abs(fraction - exactFraction(turned, pixels, x, y)) > 0.3;
        }
    EXPECT_GT(beyond, 5);
}

// A repeating texture wraps beyond the triangle's edge, where nothing is rasterised. The square is clear
// along one edge and opaque along the opposite one. None of that opacity may leak onto the clear edge.
TEST(AlphaCoverage, NothingIsTakenFromBeyondAnEdge) {
    Scene scene = slope(0);
    scene.meshes[0].primitives[0].colors.clear();
    scene.nodes[0].parent_from_node = glm::rotate(glm::scale(glm::dmat4(1.0), glm::dvec3(0.6, 0.6, 1)),
                                                  glm::radians(17.0), glm::dvec3(0, 0, 1));
    scene.images = {{"ramp", 8, 1, {}}};
    for (int x = 0; x < 8; ++x)
        for (const int c : {255, 255, 255, x < 4 ? 0 : 255})
            scene.images[0].rgba.push_back(static_cast<std::uint8_t>(c));
    scene.materials[0].base_color_texture.texture = 0;
    Renderer renderer(device(), scene, pipelines());
    const Frame frame = drawnBy(Path::forward_plus, renderer, covered({64, 64}), {Channel::lit});
    const Image& image = frame.channels.at(Channel::lit);
    double left = 0, all = 0;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {
            all += double{image.at(x, y, 0)};
            // In the square's axes, -1 to 1.
            const double u = 2 * (x + 0.5) / 64 - 1, v = 1 - 2 * (y + 0.5) / 64, turn = glm::radians(17.0);
            if ((u * std::cos(turn) + v * std::sin(turn)) / 0.6 < -0.5) left += double{image.at(x, y, 0)};
        }
    EXPECT_EQ(left, 0);
    EXPECT_GT(all, 200);
}

// Constant alpha covers all or nothing; per glTF, alpha equal to the cutoff is visible.
TEST(AlphaCoverage, OfOneAlphaIsAllOrNothing) {
    for (const float alpha : {cutoff - 0.01f, cutoff, 0.9f}) {
        Scene scene = slope(0);
        scene.meshes[0].primitives[0].colors.clear();
        scene.materials[0].base_color = {1, 1, 1, alpha};
        for (const double fraction : fractionsOf(scene, 8, true))
            EXPECT_EQ(fraction, alpha < cutoff ? 0 : 1) << alpha;
    }
}

class AlphaCoverageOf : public SceneTest {};

// Both paths agree bit for bit, with or without a pre-pass and for any sample grouping. The image is
// closer to the reference's (64 samples a pixel) than with binary masks.
TEST_P(AlphaCoverageOf, IsTheSameInBothPathsAndNearerToTheTruth) {
    Renderer& renderer = uploaded(name()).renderer;
    Settings settings = covered({320, 180});
    const Frame forward = drawnBy(Path::forward_plus, renderer, settings, {Channel::lit});
    const auto same = [&](Path path, const std::string& what) {
        const Frame frame = drawnBy(path, renderer, settings, {Channel::lit});
        EXPECT_EQ(differingPixels(forward, frame, Channel::lit), 0u) << what;
        EXPECT_EQ(frame.counters.unreproduced_pixels, 0u) << what;
    };
    for (const Switch prepass : {Switch::on, Switch::off}) {
        settings.prepass = prepass;
        same(Path::forward_plus, prepass == Switch::on ? "with a pre-pass" : "without a pre-pass");
    }
    settings.prepass = Switch::automatic;
    for (const MsaaEdges edges : {MsaaEdges::all, MsaaEdges::exact}) {
        settings.msaa_edges = edges;
        same(Path::deferred, std::string(nameOf(edges)));
    }
    settings.path = Path::reference;
    settings.reference_mode = ReferenceMode::scene;
    settings.spp = 64;
    const Image truth = renderer.draw(settings, untimed({Channel::lit})).channels.at(Channel::lit);
    // The displayed error; exposure puts the 95th percentile at 0.7.
    std::vector<float> ordered(truth.data.begin(), truth.data.end());
    const auto p95 = ordered.begin() + static_cast<std::ptrdiff_t>(ordered.size() * 95 / 100);
    std::nth_element(ordered.begin(), p95, ordered.end());
    const double exposure = 0.7 / double{*p95};
    const auto error = [&](const Image& image) {
        double sum = 0;
        for (std::size_t i = 0; i < truth.data.size(); ++i)
            sum += std::abs(srgbFromLinear(exposure * double{image.data[i]}) -
                            srgbFromLinear(exposure * double{truth.data[i]}));
        return sum;
    };
    const Frame cut = drawnBy(Path::forward_plus, renderer, covered({320, 180}, false), {Channel::lit});
    EXPECT_GT(differingPixels(cut, forward, Channel::lit), 20u);
    EXPECT_LT(error(forward.channels.at(Channel::lit)), 0.8 * error(cut.channels.at(Channel::lit)));
}

INSTANTIATE_TEST_SUITE_P(Msaa, AlphaCoverageOf,
                         testing::Values("builtin:cutout", "features/alpha_mask/01_alpha_mask.gltf"),
                         sceneName);

// `coverage` shades every sample of a pixel that a mask covers partly, as if a triangle's edge did.
TEST(AlphaCoverage, CoverageEdgesKnowOfMasks) {
    Scene scene = slope(0.35);
    scene.materials[0].unlit = false;
    scene.materials[0].emissive = {1, 0, 0};
    scene.nodes.push_back({"behind", -1,
                           glm::translate(glm::dmat4(1.0), glm::dvec3(0, 0, -1)) *
                               glm::scale(glm::dmat4(1.0), glm::dvec3(3, 3, 1)),
                           1});
    scene.meshes.push_back(square().meshes[0]);
    scene.materials.push_back({});
    scene.materials[1].emissive = {0, 1, 0};
    scene.meshes[1].primitives[0].material = 1;
    Renderer renderer(device(), scene, pipelines());
    Settings settings = covered({24, 24});
    const Frame exact = drawnBy(Path::deferred, renderer, settings, {Channel::lit});
    settings.msaa_edges = MsaaEdges::coverage;
    const Frame coverage = drawnBy(Path::deferred, renderer, settings, {Channel::lit});
    EXPECT_EQ(differingPixels(exact, coverage, Channel::lit), 0u);
}

TEST(AlphaCoverage, HasNoMeaningWhereSamplesAreShadedApart) {
    Settings settings = covered({4, 4});
    EXPECT_FALSE(settings.problem());
    settings.msaa_shading = MsaaShading::sample;
    EXPECT_NE(settings.problem().value_or("").find("--alpha-to-coverage on"), std::string::npos);
    settings = covered({4, 4});
    settings.msaa = 1;
    EXPECT_NE(settings.problem().value_or("").find("--alpha-to-coverage on"), std::string::npos);
}

}  // namespace
}  // namespace diptych::tests
