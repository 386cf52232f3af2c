// SPDX-License-Identifier: MIT
// Specular anti-aliasing in both paths: roughness for a known change of the normal, flat surfaces, normal
// maps, MSAA, and the reference shading the filtered surface.
#include "shared/contract/debug_mode.h"
#include "shared/scene/builtin/shapes.h"
#include "tests/image/square.h"

#include <glm/gtc/matrix_transform.hpp>

#include <cmath>
#include <numbers>

namespace diptych::tests {
namespace {

constexpr float paper_variance = 0.15915494f, paper_limit = 0.18f;

Settings filtered(Settings settings, SpecularNormals of = SpecularNormals::geometry) {
    settings.spec_aa = true;
    settings.spec_aa_normals = of;
    return settings;
}

Settings fullImage(Size size = {160, 90}) {
    Settings settings = smallImage(GBufferEncoding::full);
    settings.size = size;
    return settings;
}

// The shader's formula for a pixel; `change`: sum of the squared differences of the normal to its
// neighbours.
double expectedRoughness(double roughness, double change, double variance = paper_variance,
                         double limit = paper_limit) {
    const double kernel = std::min(2 * variance * change, limit);
    return std::pow(std::min(std::pow(roughness, 4) + kernel, 1.0), 0.25);
}

// The square, filling the image. Its normals at the left and right edges tilt by atan(-+`slope`), as on a
// cylinder about y.
Scene cylindrical(float slope, float rough) {
    Scene scene = square();
    const glm::vec3 left = glm::normalize(glm::vec3(-slope, 0, 1)),
                    right = glm::normalize(glm::vec3(slope, 0, 1));
    scene.meshes[0].primitives[0].normals = {left, right, right, left};
    scene.materials[0].roughness = rough;
    return scene;
}

// Interpolation is linear in the image, so every pixel's normal is known. A derivative is the difference
// within a pair of pixels.
TEST(SpecularAa, OfAKnownCurvature) {
    constexpr int pixels = 32;
    for (const float slope : {0.05f, 0.5f, 8.0f})
        for (const float rough : {0.05f, 0.3f, 1.0f}) {
            const Scene scene = cylindrical(slope, rough);
            const auto normalAt = [&](int x) {
                return glm::normalize(glm::dvec3(double{slope} * (2 * x + 1 - pixels) / pixels, 0, 1));
            };
            for (const Frame& frame : bothPaths(scene, filtered(fullImage({pixels, pixels})), {roughness}))
                for (int x = 0; x < pixels; ++x) {
                    const glm::dvec3 change = normalAt(x | 1) - normalAt(x & ~1);
                    const double expected = expectedRoughness(rough, glm::dot(change, change));
                    for (const int y : {0, 7, pixels - 1})
                        EXPECT_NEAR(double{frame.channels.at(roughness).at(x, y, 0)}, expected, 2e-5)
                            << frame.name << " slope " << slope << " roughness " << rough << " at " << x;
                }
        }
}

// As in three.js: perceptual roughness plus the normal's largest component change along the image's axes.
TEST(SpecularAa, BySlopeItIsTheLargestChange) {
    constexpr int pixels = 32;
    for (const float slope : {0.05f, 0.5f, 8.0f})
        for (const float rough : {0.01f, 0.3f, 1.0f}) {
            const Scene scene = cylindrical(slope, rough);
            const auto normalAt = [&](int x) {
                return glm::normalize(glm::dvec3(double{slope} * (2 * x + 1 - pixels) / pixels, 0, 1));
            };
            Settings settings = filtered(fullImage({pixels, pixels}));
            settings.spec_aa_kernel = SpecularKernel::slope;
            for (const Frame& frame : bothPaths(scene, settings, {roughness}))
                for (int x = 0; x < pixels; ++x) {
                    const glm::dvec3 change = glm::abs(normalAt(x | 1) - normalAt(x & ~1));
                    const double expected = std::min(
                        std::max(double{rough}, 0.045) + std::max({change.x, change.y, change.z}), 1.0);
                    EXPECT_NEAR(double{frame.channels.at(roughness).at(x, 7, 0)}, expected, 2e-5)
                        << frame.name << " slope " << slope << " roughness " << rough << " at " << x;
                }
        }
}

TEST(SpecularAa, TakesItsTwoNumbersFromTheSettings) {
    constexpr int pixels = 16;
    const Scene scene = cylindrical(2, 0.2f);
    for (const auto& [variance, limit] :
         {std::pair(0.05f, 1.0f), std::pair(0.5f, 1.0f), std::pair(100.0f, 0.3f), std::pair(0.5f, 1e-3f)}) {
        Settings settings = filtered(fullImage({pixels, pixels}));
        settings.spec_aa_variance = variance;
        settings.spec_aa_limit = limit;
        const auto normalAt = [](int x) {
            return glm::normalize(glm::dvec3(2.0 * (2 * x + 1 - pixels) / pixels, 0, 1));
        };
        const glm::dvec3 step = normalAt(9) - normalAt(8);
        for (const Frame& frame : bothPaths(scene, settings, {roughness}))
            EXPECT_NEAR(
                double{frame.channels.at(roughness).at(8, 8, 0)},
                expectedRoughness(double{0.2f}, glm::dot(step, step), double{variance}, double{limit}), 2e-5)
                << frame.name << " " << variance << " " << limit;
    }
    for (const bool none : {false, true}) {
        Settings settings = filtered(fullImage({pixels, pixels}));
        (none ? settings.spec_aa_limit : settings.spec_aa_variance) = 0;
        for (const Frame& frame : bothPaths(scene, settings, {roughness}))
            EXPECT_EQ(frame.channels.at(roughness).at(8, 8, 0), 0.2f) << frame.name;
    }
}

// A distant sphere of radius 1: at its centre the normal turns by a pixel's size in both directions.
TEST(SpecularAa, OfASphereAtAKnownDistance) {
    constexpr int pixels = 64;
    Scene scene = square();
    scene.meshes[0].primitives[0] = sphere(1, 256, 128);
    scene.materials[0].roughness = 0.1f;
    Camera& camera = scene.cameras[0];
    camera.orthographic = true;
    camera.ymag = 2;
    camera.far = 10;
    camera.world_from_camera[3] = {0, 0, 5, 1};
    const double pixel = 2 * camera.ymag / pixels;  // m; the radius is 1
    for (const Frame& frame : bothPaths(scene, filtered(fullImage({pixels, pixels})), {roughness}))
        for (const int at : {pixels / 2 - 1, pixels / 2}) {
            const double kernel = std::pow(double{frame.channels.at(roughness).at(at, at, 0)}, 4) - 1e-4;
            // Normals interpolated over segments of 1.4 degrees are chords: up to 1 % off the arc's
            // change, twice that when squared.
            EXPECT_NEAR(kernel / (2 * double{paper_variance} * 2 * pixel * pixel), 1, 0.03) << frame.name;
        }
}

// ---- flat surfaces -----------------------------------------------------------------------------------

// Despite the rounding of interpolation, up to the horizon and for any filter width.
TEST(SpecularAa, AFlatSurfaceKeepsItsRoughnessBitForBit) {
    for (const double degrees : {0.0, 37.0, 80.0, 89.9}) {
        Scene scene = square();
        glm::dmat4& transform = scene.nodes[0].parent_from_node;
        transform =
            glm::translate(glm::dmat4(1), glm::dvec3(0, -0.3, -0.5)) *
            glm::rotate(glm::dmat4(1), glm::radians(-degrees), glm::normalize(glm::dvec3(1, 0.3, 0.1))) *
            glm::scale(glm::dmat4(1), glm::dvec3(1000));
        for (const float rough : {0.0f, 0.01f, 0.045f, 0.3333333f, 1.0f}) {
            scene.materials[0].roughness = rough;
            Settings settings = with(filtered(fullImage({161, 91})), "spec-aa-variance 100 spec-aa-limit 1");
            for (const Frame& frame : bothPaths(scene, settings, {roughness, Channel::material_id})) {
                const Image& drawn = frame.channels.at(roughness);
                std::size_t other = 0;
                for (std::size_t i = 0; i < drawn.data.size(); ++i)
                    other += frame.channels.at(Channel::material_id).data[i] >= 0 && drawn.data[i] != rough;
                EXPECT_EQ(other, 0u) << frame.name << " " << degrees << " " << rough;
                EXPECT_GT(coveredPixels(frame), 1000u);
            }
        }
    }
}

// ---- normal maps -------------------------------------------------------------------------------------

// Waves of normals on a plane, in a magnified texture.
Scene wavy(float scale, int cells) {
    Scene scene = square();
    scene.meshes[0].primitives[0] = quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, cells, cells);
    TextureImage waves{"waves", 16, 16, {}};
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) {
            const auto wave = [](int i) { return std::sin(2 * std::numbers::pi * (i + 0.5) / 16); };
            const glm::dvec3 n = glm::normalize(glm::dvec3(0.7 * wave(x), 0.4 * wave(y), 1));
            for (const double c : {n.x, n.y, n.z})
                waves.rgba.push_back(static_cast<std::uint8_t>(std::lround(255 * (0.5 + 0.5 * c))));
            waves.rgba.push_back(255);
        }
    scene.images.push_back(waves);
    scene.textures.push_back({static_cast<int>(scene.images.size()) - 1, {}});
    scene.materials[0].normal_texture.texture = static_cast<int>(scene.textures.size()) - 1;
    scene.materials[0].normal_scale = scale;
    scene.materials[0].roughness = 0.2f;
    return scene;
}

TEST(SpecularAa, OfANormalMapWhereThatIsAskedFor) {
    const Settings settings = fullImage({64, 64});
    for (const Frame& frame : bothPaths(wavy(1, 1), filtered(settings), {roughness}))
        for (const float value : frame.channels.at(roughness).data) ASSERT_EQ(value, 0.2f) << frame.name;
    for (const Frame& frame :
         bothPaths(wavy(1, 1), filtered(settings, SpecularNormals::mapped), {roughness, normals})) {
        // The filter uses the differences of the normals that both paths show.
        const Image &shown = frame.channels.at(normals), &drawn = frame.channels.at(roughness);
        const auto normalAt = [&](int x, int y) {
            return glm::dvec3(shown.at(x, y, 0), shown.at(x, y, 1), shown.at(x, y, 2));
        };
        double widest = 0;
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 64; ++x) {
                const glm::dvec3 dx = normalAt(x | 1, y) - normalAt(x & ~1, y),
                                 dy = normalAt(x, y | 1) - normalAt(x, y & ~1);
                const double expected = expectedRoughness(double{0.2f}, glm::dot(dx, dx) + glm::dot(dy, dy));
                ASSERT_NEAR(double{drawn.at(x, y, 0)}, expected, 2e-5) << frame.name << " " << x << "," << y;
                widest = std::max(widest, expected);
            }
        EXPECT_GT(widest, 0.24) << "the map does change";
    }
}

// Helper pixels of a quad, outside the triangle, also get the map's scale: fine triangles filter like a
// single one.
TEST(SpecularAa, OfANormalMapAtTheEdgesOfTriangles) {
    const Settings settings = filtered(fullImage({64, 64}), SpecularNormals::mapped);
    for (const float scale : {0.5f, -0.7f}) {
        const std::vector<Frame> one = bothPaths(wavy(scale, 1), settings, {roughness}),
                                 many = bothPaths(wavy(scale, 23), settings, {roughness});
        for (std::size_t path = 0; path < one.size(); ++path) {
            const PixelData &a = one[path].channels.at(roughness).data,
                            &b = many[path].channels.at(roughness).data;
            double largest = 0;
            for (std::size_t i = 0; i < a.size(); ++i)
                largest = std::max(largest, std::abs(double{a[i]} - double{b[i]}));
            EXPECT_LT(largest, 1e-4) << one[path].name << ": what texture coordinates round, "
                                     << "the filter of a texel in steps of 1/256";
        }
    }
}

// ---- both paths --------------------------------------------------------------------------------------

class SpecularAaBuiltin : public testing::TestWithParam<std::string> {};

TEST_P(SpecularAaBuiltin, BothPathsFilterAlike) {
    UploadedScene& scene = uploaded(GetParam());
    for (const SpecularNormals of : {SpecularNormals::geometry, SpecularNormals::mapped}) {
        const std::vector<Channel> channels{Channel::lit, roughness, Channel::material_id};
        const std::vector<Frame> on = bothPaths(scene.renderer, filtered(fullImage(), of), channels),
                                 off = bothPaths(scene.renderer, fullImage(), channels);
        expectSameChannels(on[0], on[1], 3);
        const PixelData &rough = on[0].channels.at(roughness).data,
                        &before = off[0].channels.at(roughness).data;
        std::size_t wider = 0, narrower = 0;
        for (std::size_t i = 0; i < rough.size(); ++i)
            wider += rough[i] > before[i], narrower += rough[i] < before[i];
        EXPECT_GT(wider, 100u) << GetParam();
        EXPECT_EQ(narrower, 0u) << GetParam();
    }
}

TEST_P(SpecularAaBuiltin, TheStandardGBufferKeepsItWithinAStep) {
    UploadedScene& scene = uploaded(GetParam());
    Settings settings = filtered(fullImage());
    settings.gbuffer = GBufferEncoding::standard;
    const std::vector<Frame> frames = bothPaths(scene.renderer, settings, {roughness, Channel::material_id});
    const PixelData &packed = frames[0].channels.at(roughness).data,
                    &plain = frames[1].channels.at(roughness).data;
    double largest = 0;
    for (std::size_t i = 0; i < packed.size(); ++i)
        largest = std::max(largest, std::abs(double{packed[i]} - double{plain[i]}));
    EXPECT_LE(largest, 0.501 / 4095) << "half a step of 12 bits, and roundings";
    EXPECT_GT(largest, 0) << "they are packed";
}

INSTANTIATE_TEST_SUITE_P(Builtin, SpecularAaBuiltin,
                         testing::Values("builtin:gallery", "builtin:normals", "builtin:spheres"), sceneName);

// MSAA: derivatives are taken at pixel centres, wherever the samples are shaded, also along the diagonal,
// where triangles cover pixels partly. lavapipe's centre is half a pixel off, which changes this curve's
// roughness by 1.5e-4. Differences between shading locations would change it by 5e-3.
TEST(SpecularAa, SeveralSamplesFilterAlike) {
    Settings settings = filtered(fullImage({64, 64}));
    const Scene scene = cylindrical(1, 0.2f);
    Renderer renderer(device(), scene, pipelines());
    const Image one = drawnBy(Path::forward_plus, renderer, settings, {roughness}).channels.at(roughness);
    settings.msaa = 4;
    const Image four = drawnBy(Path::forward_plus, renderer, settings, {roughness}).channels.at(roughness);
    double largest = 0;
    for (std::size_t i = 0; i < one.data.size(); ++i)
        largest = std::max(largest, std::abs(double{one.data[i]} - double{four.data[i]}));
    EXPECT_LT(largest, 3e-4);
    EXPECT_GT(*std::ranges::max_element(four.data), 0.208f);
}

// The reference in mode surface shades the filtered surface: it checks shading alone.
TEST(SpecularAa, TheReferenceShadesWhatWasFiltered) {
    UploadedScene& scene = uploaded("builtin:normals");
    const Settings settings = filtered(fullImage({96, 54}));
    const std::vector<Channel> channels{Channel::lit, roughness, Channel::material_id};
    const Frame reference = drawnBy(Path::reference, scene.renderer, settings, channels);
    for (const Frame& path : bothPaths(scene.renderer, settings, channels)) {
        EXPECT_EQ(differingPixels(reference, path, roughness), 0u);
        const Coverage covered = coverage(reference, path);
        const DebugMode& mode = debugMode(Channel::lit);
        const ChannelStats stats =
            channelStats(mode.error_kind, mode.kind, reference.channels.at(Channel::lit),
                         path.channels.at(Channel::lit), covered);
        EXPECT_LE(stats.p999, 1e-4) << path.name << ", max " << stats.max;
    }
}

}  // namespace
}  // namespace diptych::tests
