// SPDX-License-Identifier: MIT
// The reference's texture filtering, compared with means over texels; and its ray-triangle intersections.
#include "tests/support/reference_scene.h"
#include "tests/support/srgb.h"

#include "compare/reference/scene/geometry.h"
#include "compare/reference/scene/texture.h"

namespace diptych::reference {
namespace {

// Random codes, opaque.
TextureImage noiseTexels(int width, int height) {
    TextureImage image{"noise", width, height, {}};
    std::uint32_t state = 1;
    for (int i = 0; i < width * height; ++i) {
        for (int c = 0; c < 3; ++c)
            image.rgba.push_back(static_cast<std::uint8_t>((state = state * 1664525 + 1013904223) >> 24));
        image.rgba.push_back(255);
    }
    return image;
}

Scene sceneOf(TextureImage image, const Sampler& sampler) {
    Scene scene;
    scene.images = {std::move(image)};
    scene.textures = {{0, sampler}};
    return scene;
}

double code(const TextureImage& image, int x, int y) {
    return image.rgba[static_cast<std::size_t>(4 * (y * image.width + x))] / 255.0;
}

int repeated(int i, int size) {
    return (i % size + size) % size;
}

TEST(ReferenceTexture, PyramidsKeepTheMeanOfAnySize) {
    for (const glm::ivec2 size : {glm::ivec2(1, 1), {2, 2}, {7, 5}, {13, 1}, {1, 9}, {16, 3}, {33, 17}}) {
        const TextureImage image = noiseTexels(size.x, size.y);
        const Pyramid levels(image, false);
        double mean = 0;
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x) mean += code(image, x, y) / (size.x * size.y);
        const int last = levels.levels() - 1;
        EXPECT_EQ(levels.width(last), 1);
        EXPECT_EQ(levels.height(last), 1);
        // Every level is rounded to float32 once.
        for (int level = 0; level <= last; ++level) {
            double sum = 0;
            const int w = levels.width(level), h = levels.height(level);
            for (int y = 0; y < h; ++y)
                for (int x = 0; x < w; ++x) sum += levels.texel(level, x, y).r / (w * h);
            EXPECT_NEAR(sum, mean, 1e-6) << size.x << "x" << size.y << " level " << level;
        }
    }
}

TEST(ReferenceTexture, ColoursAreDecodedBeforeTheyAreMixed) {
    TextureImage image{"two", 2, 1, {0, 0, 0, 0, 255, 255, 255, 255}};
    const Scene scene = sceneOf(image, {});
    const Textures textures(scene);
    const glm::dvec4 both = textures(scene.textures[0], true, {{0.5, 0.5}, {}, {}});
    EXPECT_NEAR(both.r, 0.5, 1e-12) << "light, not codes";
    EXPECT_NEAR(both.a, 0.5, 1e-12);
    image.rgba[4] = 128;
    EXPECT_NEAR(Pyramid(image, true).texel(0, 1, 0).r, decodedSrgb(128 / 255.0), 1e-15);
    EXPECT_NEAR(Pyramid(image, true).texel(0, 1, 0).a, 1, 1e-15);
    EXPECT_NEAR(Pyramid(image, false).texel(0, 1, 0).r, 128 / 255.0, 1e-15);
    const TextureImage wide{"16", 1, 1, {}, {6554, 0, 65535, 32768}};
    EXPECT_NEAR(Pyramid(wide, false).texel(0, 0, 0).r, 6554 / 65535.0, 1e-15);
    EXPECT_NEAR(Pyramid(wide, true).texel(0, 0, 0).r, decodedSrgb(6554 / 65535.0), 1e-15);
    const TextureImage dark{"dark", 1, 1, {10, 0, 0, 255}};
    EXPECT_NEAR(Pyramid(dark, true).texel(0, 0, 0).r, decodedSrgb(10 / 255.0), 1e-15)
        << "below the knee, linear";
}

// Only 8-bit and 16-bit colours are encoded; float images are linear.
TEST(ReferenceTexture, AlphaIsNeverDecoded) {
    const TextureImage narrow{"8", 1, 1, {200, 100, 50, 128}};
    const TextureImage wide{"16", 1, 1, {}, {6554, 0, 65535, 32768}};
    for (const bool srgb : {false, true}) {
        EXPECT_NEAR(Pyramid(narrow, srgb).texel(0, 0, 0).a, 128 / 255.0, 1e-15);
        EXPECT_NEAR(Pyramid(wide, srgb).texel(0, 0, 0).a, 32768 / 65535.0, 1e-15);
        const TextureImage floats{"floats", 1, 1, {}, {}, {0.25f, 0.5f, 2, 0.5f}};
        EXPECT_EQ(Pyramid(floats, srgb).texel(0, 0, 0), glm::dvec4(0.25, 0.5, 2, 0.5));
    }
}

// Magnification: bilinear, or nearest. Beyond the edge, glTF's wrap modes apply.
TEST(ReferenceTexture, MagnifiedAndWrapped) {
    const TextureImage image = noiseTexels(4, 4);
    const auto edge = [](int i, Wrap wrap) {
        if (wrap == Wrap::clamp_to_edge) return std::clamp(i, 0, 3);
        const int within = repeated(i, wrap == Wrap::repeat ? 4 : 8);
        return within < 4 ? within : 7 - within;
    };
    for (const Wrap s : {Wrap::repeat, Wrap::mirrored_repeat, Wrap::clamp_to_edge})
        for (const Wrap t : {Wrap::repeat, Wrap::mirrored_repeat, Wrap::clamp_to_edge})
            for (const bool smooth : {true, false}) {
                Sampler sampler;
                sampler.wrap_s = s;
                sampler.wrap_t = t;
                sampler.magnify_linear = smooth;
                const Scene scene = sceneOf(image, sampler);
                const Textures textures(scene);
                for (double u = -1.52; u < 2.5; u += 0.37)
                    for (double v = -1.51; v < 2.5; v += 0.41) {
                        const double x = u * 4 - (smooth ? 0.5 : 0), y = v * 4 - (smooth ? 0.5 : 0);
                        const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
                        const auto texel = [&](int i, int j) {
                            return code(image, edge(x0 + i, s), edge(y0 + j, t));
                        };
                        const double fx = x - x0, fy = y - y0;
                        const double expected = smooth
                                                    ? (texel(0, 0) * (1 - fx) + texel(1, 0) * fx) * (1 - fy) +
                                                          (texel(0, 1) * (1 - fx) + texel(1, 1) * fx) * fy
                                                    : texel(0, 0);
                        EXPECT_NEAR(textures(scene.textures[0], false, {{u, v}, {}, {}}).r, expected, 1e-12)
                            << u << " " << v;
                    }
            }
}

// Mean over a box, by very many points. The reference's 64 points are a texel of their level apart, and
// bilinear interpolation spreads texels over their neighbours. Noise of 0.29 leaves an error of a few
// hundredths for the smallest box (8 x 8 texels), less for larger ones.
TEST(ReferenceTexture, FootprintsAreMeans) {
    const TextureImage image = noiseTexels(64, 64);
    const Scene scene = sceneOf(image, {});
    const Textures textures(scene);
    const auto box = [&](const Footprint& f) {
        constexpr int steps = 400;
        double sum = 0;
        for (int j = 0; j < steps; ++j)
            for (int i = 0; i < steps; ++i) {
                const glm::dvec2 at =
                    f.uv + f.dx * ((i + 0.5) / steps - 0.5) + f.dy * ((j + 0.5) / steps - 0.5);
                sum += code(image, repeated(static_cast<int>(std::floor(at.x * 64)), 64),
                            repeated(static_cast<int>(std::floor(at.y * 64)), 64));
            }
        return sum / (steps * steps);
    };
    for (const Footprint& f : {Footprint{{0.3, 0.4}, {0.125, 0}, {0, 0.125}},
                               {{0.9, 0.1}, {0.2, 0.1}, {-0.1, 0.2}},
                               {{0.5, 0.5}, {0.5, 0}, {0, 0.03}},
                               {{0.1, 0.7}, {0.01, 0.6}, {0.02, 0.0}},
                               {{0.2, 0.2}, {1, 0}, {0, 1}},
                               {{0.2, 0.2}, {3, 0}, {0, 2}}}) {
        const double texels = std::max(1.0, std::abs(f.dx.x * f.dy.y - f.dx.y * f.dy.x) * 64 * 64);
        EXPECT_NEAR(textures(scene.textures[0], false, f).r, box(f),
                    0.29 / std::sqrt(std::min(texels, 4096.0)) + 1e-3)
            << f.dx.x << " " << texels;
    }
    // Over a whole period the result is the mean.
    EXPECT_NEAR(textures(scene.textures[0], false, {{0.5, 0.5}, {1, 0}, {0, 1}}).r,
                Pyramid(image, false).texel(6, 0, 0).r, 2e-3);
}

// Grazing angle: a footprint within a stripe of four rows, in every orientation of stripes and footprint.
TEST(ReferenceTexture, LongFootprintsAreNotBlurredAcross) {
    for (const bool rows : {true, false}) {
        TextureImage image{"stripes", 64, 64, {}};
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 64; ++x)
                image.rgba.insert(image.rgba.end(), 4, (rows ? y : x) / 4 % 2 == 1 ? 255 : 0);
        const Scene scene = sceneOf(image, {});
        const Textures textures(scene);
        const auto turned = [&](const glm::dvec2& v) { return rows ? v : glm::dvec2(v.y, v.x); };
        for (const double length : {0.1, 0.25, 0.5, 0.9})
            for (const double roll : {0.0, 0.5}) {
                // Two rows wide in the middle of rows 20 to 23: bilinear interpolation stays inside the
                // stripe.
                const glm::dvec2 along(length, 1.0 / 64), side(roll * length, (1 + roll) / 64);
                const Footprint f{turned({0.5, 22 / 64.0}), turned({along.x, 0}), turned({side.x, side.y})};
                EXPECT_NEAR(textures(scene.textures[0], false, f).r, 1, 1e-3) << rows << length << roll;
            }
    }
}

TEST(ReferenceTexture, FlatColoursAreThemselvesAtAnySize) {
    TextureImage image{"flat", 5, 3, {}};
    image.rgba.assign(60, 77);
    const Scene scene = sceneOf(image, {});
    const Textures textures(scene);
    for (const double size : {0.0, 1e-3, 0.3, 1.0, 50.0, 1e6, 1e300})
        EXPECT_NEAR(textures(scene.textures[0], false, {{0.4, 1e9}, {size, 0}, {0, size}}).g, 77 / 255.0,
                    1e-6)
            << size;
}

// ---- geometry ----------------------------------------------------------------------------------------

const Geometry::Counts all = [](const Hit&) { return true; };

TEST(ReferenceGeometry, HitsAreWhereTheyAreToThirteenDigits) {
    for (const double far : {0.0, 1e6}) {
        Scene scene = floorScene();
        scene.nodes[0].parent_from_node[3] = {far, -far, far, 1};
        const Pose pose = poseAt(scene, 0);
        const glm::dvec3 eye(far + 1.25, -far + 0.5, far + 3);
        const Geometry geometry(scene, pose, eye);
        for (double x = -0.8; x < 0.9; x += 0.21)
            for (double y = -0.8; y < 0.9; y += 0.23) {
                const std::optional<Hit> hit = geometry.nearest({{0, 0, 0}, {x, y, -1}, 0, 1e9}, all);
                ASSERT_TRUE(hit);
                EXPECT_NEAR(hit->t, 3, 1e-13 * std::max(far, 1.0));
                EXPECT_LT(glm::length(hit->position - 3.0 * glm::dvec3(x, y, -1)),
                          1e-13 * std::max(far, 1.0));
                EXPECT_EQ(hit->geometric_normal, glm::dvec3(0, 0, 1));
                EXPECT_TRUE(hit->front);
                const std::array<glm::dvec3, 3> p = geometry.corners(hit->id);
                const glm::dvec3 again =
                    p[0] + (p[1] - p[0]) * hit->barycentric.x + (p[2] - p[0]) * hit->barycentric.y;
                EXPECT_LT(glm::length(again - hit->position), 1e-12 * std::max(far, 1.0));
            }
    }
}

TEST(ReferenceGeometry, RaysEndWhereTheyShould) {
    const Scene scene = floorScene();
    const Pose pose = poseAt(scene, 0);
    const Geometry geometry(scene, pose, {0.3, 0.2, 3});
    const glm::dvec3 down(0, 0, -1);
    EXPECT_FALSE(geometry.nearest({{0, 0, 0}, down, 0, 2.999999}, all));
    EXPECT_FALSE(geometry.nearest({{0, 0, 0}, down, 0, 3}, all)) << "both ends are outside";
    EXPECT_TRUE(geometry.nearest({{0, 0, 0}, down, 0, 3.000001}, all));
    EXPECT_FALSE(geometry.nearest({{0, 0, 0}, down, 3.000001, 9}, all));
    EXPECT_TRUE(geometry.nearest({{0, 0, 0}, down, 2.999999, 9}, all));
    EXPECT_TRUE(geometry.meets({{0, 0, 0}, down, 0, std::numeric_limits<double>::infinity()}, all));
    EXPECT_FALSE(geometry.meets({{0, 0, 0}, down, 0, 2.9}, all));
    EXPECT_FALSE(geometry.meets({{0, 0, 0}, -down, 0, 1e9}, all));
    EXPECT_FALSE(geometry.meets({{0, 0, 0}, {1, 0, 0}, 0, 1e9}, all)) << "along the plane";
    const std::optional<Hit> hit = geometry.nearest({{0, 0, 0}, down, 0, 9}, all);
    EXPECT_FALSE(geometry.meets({{0, 0, 0}, down, 0, 9, hit->id}, all)) << "without the one it leaves";
    EXPECT_FALSE(geometry.nearest({{0, 0, 0}, down, 0, 9}, [](const Hit&) { return false; }));
}

// Counter-clockwise is front. A mirroring node does not swap sides; `front` tells the side the ray comes
// from.
TEST(ReferenceGeometry, BackFacesAndMirrors) {
    for (const double mirror : {1.0, -1.0}) {
        Scene scene = floorScene();
        scene.nodes[0].parent_from_node[0].x = mirror;
        const Pose pose = poseAt(scene, 0);
        const Geometry above(scene, pose, {0.3, 0.2, 3}), below(scene, pose, {0.3, 0.2, -3});
        const std::optional<Hit> top = above.nearest({{0, 0, 0}, {0, 0, -1}, 0, 9}, all);
        const std::optional<Hit> under = below.nearest({{0, 0, 0}, {0, 0, 1}, 0, 9}, all);
        ASSERT_TRUE(top && under);
        EXPECT_TRUE(top->front) << mirror;
        EXPECT_FALSE(under->front) << mirror;
        EXPECT_EQ(top->geometric_normal, glm::dvec3(0, 0, 1));
    }
}

TEST(ReferenceGeometry, OneSidedMaterialsAreSeenFromTheirFrontAlone) {
    Scene scene = floorScene();
    const View below = viewFrom({0, 0, -3}, {0, 0, 0}, 1, 1, 0.01);
    EXPECT_EQ(drawn(scene, below)[Channel::material_id].at(0, 0), -1);
    scene.materials[0].double_sided = true;
    const Drawn d = drawn(scene, below);
    EXPECT_EQ(d[Channel::material_id].at(0, 0), 0);
    EXPECT_EQ(d[Channel::normals].at(0, 0, 2), -1) << "a back face is turned round";
    EXPECT_EQ(d[Channel::geometric_normal].at(0, 0, 2), -1);
}

TEST(ReferenceGeometry, TrianglesWithoutAreaAreNotThere) {
    Scene scene = floorScene();
    Primitive flat = quad({-1, -1, 1}, {2, 0, 0}, {0, 2, 0});
    flat.positions = {{-1, 0, 1}, {0, 0, 1}, {1, 0, 1}, {0, 0, 1}};
    add(scene, flat);
    scene.lights = {lightOf(LightKind::point, {0, 0, 2})};
    const Drawn d = drawn(scene, viewFrom({0, 0, 3}, {0, 0, 0}, 1, 1, 0.01), true);
    EXPECT_NEAR(double{d[Channel::depth].at(0, 0)}, 3, 1e-6);
    EXPECT_NEAR(double{d[Channel::lit].at(0, 0, 0)}, 0.25 / pi, 1e-6);
}

TEST(ReferenceGeometry, WhatIsOutsideNearAndFarIsNotSeen) {
    const Scene scene = floorScene();
    View view = viewFrom({0, 0, 3}, {0, 0, 0}, 1, 1, 0.01);
    view.camera.near = 3.1;
    EXPECT_EQ(drawn(scene, view)[Channel::material_id].at(0, 0), -1);
    view.camera.near = 0.1;
    view.camera.far = 2.9;
    EXPECT_EQ(drawn(scene, view)[Channel::material_id].at(0, 0), -1);
    view.camera.far = 3.1;
    EXPECT_EQ(drawn(scene, view)[Channel::material_id].at(0, 0), 0);
}

}  // namespace
}  // namespace diptych::reference
