// SPDX-License-Identifier: MIT
// The paths' environment maps from the CPU, compared with closed forms, sums over all directions in
// double, and the reference's own reading of the image.
#include "shared/environment/environment_maps.h"
#include "compare/reference/light/environment.h"
#include "shared/contract/environment.h"
#include "tests/support/files.h"

#include <gtest/gtest.h>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace diptych {
namespace {

constexpr double pi = std::numbers::pi;

Environment skyOf(int width, int height, unsigned seed) {
    Environment sky{"sky", Image(width, height, 3)};
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> value(0, 2);
    for (float& v : sky.radiance.data) v = value(random);
    return sky;
}

Environment constantSky(float radiance, int width = 64, int height = 32) {
    return {"sky", Image(width, height, 3, radiance)};
}

// One texel of 6e4 among 35.
Environment sunnySky(int width, int height) {
    Environment sky = constantSky(35, width, height);
    for (int c = 0; c < 3; ++c) sky.radiance.at(width * 5 / 8, height * 3 / 8, c) = 6e4f;
    return sky;
}

glm::dvec3 onSphere(int i, int count) {
    const double y = 1 - (2 * i + 1.0) / count, s = std::sqrt(1 - y * y), turn = 2.399963229728653 * i;
    return {s * std::cos(turn), y, s * std::sin(turn)};
}

std::array<double, 9> basis(const glm::dvec3& d) {
    return {std::sqrt(1 / (4 * pi)),
            std::sqrt(3 / (4 * pi)) * d.y,
            std::sqrt(3 / (4 * pi)) * d.z,
            std::sqrt(3 / (4 * pi)) * d.x,
            std::sqrt(15 / (4 * pi)) * d.x * d.y,
            std::sqrt(15 / (4 * pi)) * d.y * d.z,
            std::sqrt(5 / (16 * pi)) * (3 * d.z * d.z - 1),
            std::sqrt(15 / (4 * pi)) * d.x * d.z,
            std::sqrt(15 / (16 * pi)) * (d.x * d.x - d.y * d.y)};
}

// The image's sides divide the grid's, so no kink of the interpolation is inside a grid cell.
TEST(EnvironmentMaps, HarmonicsAreTheProjectionInDouble) {
    for (const glm::ivec2 size : {glm::ivec2(3, 2), {10, 6}}) {
        const Environment sky = skyOf(size.x, size.y, 3);
        const reference::EnvironmentLight light(sky, 1);
        Harmonics expected{};
        constexpr int rows = 480, columns = 960;
        for (int y = 0; y < rows; ++y)
            for (int x = 0; x < columns; ++x) {
                const double polar = pi * (y + 0.5) / rows, azimuth = 2 * pi * (x + 0.5) / columns - pi;
                const glm::dvec3 d(std::sin(polar) * std::sin(azimuth), std::cos(polar),
                                   -std::sin(polar) * std::cos(azimuth));
                const double solid =
                    2 * pi / columns * (std::cos(pi * y / rows) - std::cos(pi * (y + 1) / rows));
                const auto values = basis(d);
                for (std::size_t i = 0; i < 9; ++i) expected[i] += light.radiance(d) * (values[i] * solid);
            }
        const Harmonics made = project(LatLong(sky));
        for (std::size_t i = 0; i < 9; ++i)
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(made[i][c], expected[i][c], 1e-5 * expected[0].x)
                    << size.x << " " << i << " " << c;
    }
}

TEST(EnvironmentMaps, RadianceIsWhatTheReferenceReads) {
    for (const glm::ivec2 size : {glm::ivec2(1, 1), {3, 2}, {16, 8}, {5, 7}}) {
        const Environment sky = skyOf(size.x, size.y, 4);
        const reference::EnvironmentLight light(sky, 1);
        const LatLong read(sky);
        for (int i = 0; i < 2000; ++i) {
            const glm::dvec3 d = onSphere(i, 2000);
            const glm::dvec3 expected = light.radiance(d), got(read.radiance(glm::vec3(d)));
            EXPECT_LT(glm::length(got - expected), 2e-5) << size.x << " " << i;
        }
        for (const glm::dvec3 d : {glm::dvec3(0, 1, 0), {0, -1, 0}, {0, 0, 1}, {1e-9, 0, 1}, {-1e-9, 0, 1}})
            EXPECT_LT(glm::length(glm::dvec3(read.radiance(glm::vec3(d))) - light.radiance(d)), 1e-4);
    }
}

// A pixel's solid angle is the integral's change with it: the first harmonic is linear in the pixel.
TEST(EnvironmentMaps, SolidAnglesAreTheFractions) {
    for (const glm::ivec2 size : {glm::ivec2(1, 1), {4, 3}, {16, 8}}) {
        Environment sky = constantSky(0, size.x, size.y);
        const std::vector<double> solid = LatLong(sky).solidAngles();
        double sum = 0;
        for (int y = 0; y < size.y; ++y) {
            sky.radiance.at(0, y, 1) = 1;
            EXPECT_NEAR(project(LatLong(sky))[0].y * std::sqrt(4 * pi), solid[static_cast<std::size_t>(y)],
                        1e-7)
                << size.y << " " << y;
            sky.radiance.at(0, y, 1) = 0;
            sum += solid[static_cast<std::size_t>(y)] * size.x;
        }
        EXPECT_NEAR(sum, 4 * pi, 1e-9);
    }
}

// For radiance 1 + d.a, E(n) / pi is 1 + 2/3 n.a; for (d.a)^2 it is 1/4 + 1/4 (n.a)^2.
TEST(EnvironmentMaps, ThePolynomialIsTheIrradiance) {
    const glm::dvec3 a = glm::normalize(glm::dvec3(0.3, -0.8, 0.5));
    Environment sky = constantSky(0, 256, 128);
    const LatLong light(sky);
    for (int y = 0; y < 128; ++y)
        for (int x = 0; x < 256; ++x) {
            const double cosine = glm::dot(light.direction(x, y), a);
            sky.radiance.at(x, y, 0) = static_cast<float>(1 + cosine);
            sky.radiance.at(x, y, 1) = static_cast<float>(cosine * cosine);
        }
    const auto polynomial = irradiancePolynomial(project(light));
    for (int i = 0; i < 50; ++i) {
        const glm::dvec3 n = onSphere(i, 50);
        const double cosine = glm::dot(n, a);
        const glm::dvec3 e = evaluate(polynomial, n);
        // Bilinear interpolation has an error of up to h^2 / 8 for a curvature of 2.
        EXPECT_NEAR(e.x, 1 + 2 / 3.0 * cosine, 3e-4) << i;
        EXPECT_NEAR(e.y, 0.25 + 0.25 * cosine * cosine, 3e-4) << i;
    }
}

TEST(EnvironmentMaps, ATurnedPolynomialIsThatOfTheTurnedNormal) {
    const auto polynomial = irradiancePolynomial(project(LatLong(skyOf(16, 8, 5))), 0.1);
    const glm::dmat3 turn(glm::rotate(glm::dmat4(1), 0.8, glm::normalize(glm::dvec3(0.2, 0.9, -0.4))));
    const auto turned = rotatedPolynomial(polynomial, turn);
    for (int i = 0; i < 50; ++i) {
        const glm::dvec3 n = onSphere(i, 50);
        EXPECT_LT(glm::length(evaluate(turned, n) - evaluate(polynomial, turn * n)), 1e-14) << i;
    }
}

TEST(EnvironmentMaps, AWindowIsAsSmallAsKeepsIrradianceFromBeingNegative) {
    EXPECT_EQ(minWindow(project(LatLong(constantSky(1)))), 0);
    Environment sun = constantSky(0, 64, 32);
    sun.radiance.at(20, 10, 0) = 1000;
    const Harmonics harmonics = project(LatLong(sun));
    const double window = minWindow(harmonics);
    EXPECT_GT(window, 0);
    double min = 0, without = 0;
    for (int i = 0; i < 500; ++i) {
        min = std::min(min, evaluate(irradiancePolynomial(harmonics, window), onSphere(i, 500)).x);
        without = std::min(without, evaluate(irradiancePolynomial(harmonics), onSphere(i, 500)).x);
    }
    EXPECT_LT(without, 0);
    EXPECT_GT(min, 0.01 * without) << "but for what lies between the directions that are tried";
}

TEST(EnvironmentMaps, AnOctahedralMapHasNoSeam) {
    for (int i = 0; i < 500; ++i) {
        const glm::vec3 d(onSphere(i, 500));
        EXPECT_LT(glm::length(octahedralDirection(octahedralPosition(d)) - d), 1e-6f) << i;
    }
    OctahedralMap map(8);
    double sum = 0;
    std::mt19937 random(1);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x) {
            map.at(x, y) = Texel{std::uniform_real_distribution<float>(0, 1)(random), 0, 0, 0};
            sum += map.solidAngle(x, y);
        }
    EXPECT_NEAR(sum, 4 * pi, 4 * pi * 2e-3);
    map.fillBorder();
    // Mirrored points on each edge, below the horizon, are the same point on the sphere.
    for (float t = -1; t <= 1; t += 0.05f)
        for (const bool across : {false, true}) {
            const auto at = [&](float s) {
                return map.bilinear(across ? glm::vec2(s, 1) : glm::vec2(1, s))[0];
            };
            EXPECT_NEAR(at(t), at(-t), 1e-6f) << t;
        }
    const float corner = map.bilinear({1, 1})[0];
    for (const glm::vec2 p : {glm::vec2(-1, 1), {1, -1}, {-1, -1}})
        EXPECT_NEAR(map.bilinear(p)[0], corner, 1e-6f);
}

TEST(EnvironmentMaps, AConstantSkyStaysConstant) {
    const EnvironmentMaps maps = makeEnvironmentMaps(constantSky(3), {});
    ASSERT_EQ(maps.levels.size(), gpu::ENVIRONMENT_SPECULAR_LEVELS);
    EXPECT_NEAR(levelAlpha(maps.levels.size() - 1), 1, 1e-12) << "contract/environment.h";
    // Float sums of a few thousand terms.
    for (const NodeMap& level : maps.levels)
        for (const Texel& t : level.nodes) ASSERT_NEAR(t[1], 3, 3e-5) << level.side;
    for (const Texel& t : maps.diffuse.nodes) ASSERT_NEAR(t[1], 3, 3e-5);
}

// The largest common image, in closed form: radiance 2 + d.y. Maps stay within their limit.
TEST(EnvironmentMaps, ALargeImageIsReadWhole) {
    constexpr int width = 8192, height = 4096;
    Environment sky{"sky", Image(width, height, 3)};
    for (int y = 0; y < height; ++y) {
        const auto value = static_cast<float>(2 + std::cos(pi * (y + 0.5) / height));
        float* const row = sky.radiance.data.data() + static_cast<std::size_t>(y) * width * 3;
        std::fill(row, row + std::size_t{width} * 3, value);
    }
    const EnvironmentMaps maps = makeEnvironmentMaps(sky, {{1, 0}, true});
    EXPECT_NEAR(maps.harmonics[0].g, 2 * std::sqrt(4 * pi), 1e-5);
    EXPECT_NEAR(maps.harmonics[1].g, std::sqrt(4 * pi / 3), 1e-5);
    EXPECT_EQ(maps.levels.front().side, 1025);
    for (int i = 0; i < 200; ++i) {
        const glm::dvec3 d = onSphere(i, 200);
        const glm::vec2 position = octahedralPosition(glm::vec3(d));
        EXPECT_NEAR(maps.levels.front().interpolated(position).y, 2 + d.y, 1e-4) << i;
        EXPECT_NEAR(maps.diffuse.interpolated(position).y, 2 + d.y * 2 / 3, 3e-3) << i;
    }
}

// The mean is over the sphere, wherever the texel is: in the middle of the square or in its corner.
TEST(EnvironmentMaps, OfABrightTexelEightTimesTheMeanStays) {
    for (const int at : {0, 8, 15}) {
        OctahedralMap map(16);
        map.at(at, at) = Texel{1000, 1000, 1000, 0};
        const double solid = map.solidAngle(at, at), stays = 8 * 1000 * solid / (4 * pi);
        ASSERT_LT(stays, 1000);
        const std::vector<BrightTexel> bright = takeBrightTexels(map);
        ASSERT_EQ(bright.size(), 1u);
        EXPECT_NEAR(map.at(at, at)[0] / stays, 1, 0.01) << at;  // of solidAngle()
        EXPECT_NEAR(double{bright[0].power[0]} / ((1000 - stays) * solid), 1, 0.01);
    }
}

// The lobe's weights depend only on the angle, so filtering preserves the integral over all directions.
TEST(EnvironmentMaps, ABrightTexelNeitherVanishesNorSparkles) {
    const Environment sky = sunnySky(256, 128);
    const LatLong light(sky);
    const double expected = project(light)[0].x * std::sqrt(4 * pi);
    OctahedralMap rest = resampled(light, 128);
    const std::vector<OctahedralMap> whole = pyramid(rest, 4);
    for (const OctahedralMap& level : whole)
        EXPECT_NEAR(level.integral().x / expected, 1, 1e-3) << level.side;
    const std::vector<BrightTexel> bright = takeBrightTexels(rest);
    double taken = 0;
    for (const BrightTexel& texel : bright) taken += double{texel.power[0]};
    EXPECT_GT(taken, 0);
    EXPECT_NEAR((rest.integral().x + taken) / whole.front().integral().x, 1, 1e-5) << "nothing is lost";
    const std::vector<OctahedralMap> source = pyramid(std::move(rest), 4);
    for (const double alpha : {0.125, 0.25, 0.5, 1.0}) {
        constexpr int side = 25;
        const NodeMap exact = filteredExhaustively(whole.front(), alpha, side);
        NodeMap made = filtered(source, alpha, side, {});
        addBrightTexels(made, bright, alpha);
        double worst = 0;
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x)
                worst = std::max(worst, std::abs(double{made.at(x, y)[0]} / exact.at(x, y)[0] - 1));
        EXPECT_LT(worst, 0.02) << alpha;
    }
}

// Mean over all directions; nodes on an edge occur twice.
double meanOfMap(const NodeMap& map) {
    double sum = 0, solid = 0;
    const auto edge = [&](int i) { return i == 0 || i + 1 == map.side ? 0.5 : 1.0; };
    for (int y = 0; y < map.side; ++y)
        for (int x = 0; x < map.side; ++x) {
            const glm::dvec3 d(octahedralDirection(map.positionOf(x, y)));
            const double l1 = std::abs(d.x) + std::abs(d.y) + std::abs(d.z),
                         fraction = l1 * l1 * l1 * edge(x) * edge(y);
            sum += double{map.at(x, y)[0]} * fraction;
            solid += fraction;
        }
    return sum / solid;
}

// Near the poles a pixel is far narrower than a map's texels; between columns it lies between nodes.
TEST(EnvironmentMaps, ASunKeepsItsLightWhereverItStands) {
    for (const auto& [row, column] :
         {std::pair{0, 17}, {1, 0}, {6, 17}, {20, 0}, {40, 0}, {64, 17}, {101, 0}, {127, 17}}) {
        Environment sky = constantSky(0.2f, 256, 128);
        sky.radiance.at(column, row, 0) = 6e4f;
        const EnvironmentMaps maps = makeEnvironmentMaps(sky, {{1, 0}, true});
        const double expected = maps.harmonics[0].x / std::sqrt(4 * pi);
        EXPECT_NEAR(meanOfMap(maps.diffuse) / expected, 1, 1e-3) << row << " " << column;
        // Sums over 129 x 129 nodes.
        EXPECT_NEAR(meanOfMap(maps.levels.front()) / expected, 1, 3e-3) << row << " " << column;
    }
}

// For images of any size, all maps have the image's mean and finite values, even with one sample.
TEST(EnvironmentMaps, ImagesOfAnyShapeKeepTheirLight) {
    for (const glm::ivec2 size : {glm::ivec2(1, 1), {3, 2}, {8, 8}, {1, 40}, {200, 3}, {7, 5}})
        for (const int samples : {1, 2, 3, 64}) {
            const EnvironmentMaps maps = makeEnvironmentMaps(skyOf(size.x, size.y, 6), {{samples, 0}, true});
            const double expected = maps.harmonics[0].x / std::sqrt(4 * pi);
            EXPECT_NEAR(meanOfMap(maps.diffuse) / expected, 1, 5e-3) << size.x << " x " << size.y;
            for (const NodeMap& level : maps.levels)
                for (const Texel& t : level.nodes)
                    ASSERT_TRUE(t[0] >= 0 && t[0] <= 2.001f) << size.x << " x " << size.y << " " << samples;
        }
}

TEST(EnvironmentMaps, AnIrradianceMapIsTheSum) {
    // Light from the upper hemisphere: E / pi is (1 + n.y) / 2.
    Environment sky = constantSky(0, 256, 128);
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 256; ++x) sky.radiance.at(x, y, 2) = 1;
    const EnvironmentMaps maps = makeEnvironmentMaps(sky, {{16, 1}, true});
    for (int i = 0; i < 100; ++i) {
        const glm::dvec3 n = onSphere(i, 100);
        EXPECT_NEAR(maps.diffuse.interpolated(octahedralPosition(glm::vec3(n))).z, (1 + n.y) / 2, 2e-3) << i;
    }
    const TruncationError raw = truncationError(maps, 0);
    EXPECT_LT(raw.worst, 1e-3) << "a half sky has no even band but 0, which irradiance would keep";
    // A sun has the largest error, that of a clamped cosine: 9.4 % of the peak at worst (Ramamoorthi and
    // Hanrahan 2001).
    Environment sun = constantSky(0, 256, 128);
    sun.radiance.at(60, 40, 1) = 1000;
    const EnvironmentMaps hard = makeEnvironmentMaps(sun, {{16, 1}, true});
    EXPECT_NEAR(truncationError(hard, 0).worst, 0.094, 0.01);
    EXPECT_GT(truncationError(hard, minWindow(hard.harmonics)).worst, truncationError(hard, 0).worst);
}

TEST(EnvironmentMaps, NodesHaveNoFoldAndNoSeam) {
    NodeMap numbers(9);
    std::mt19937 random(2);
    for (Texel& t : numbers.nodes) t = Texel{std::uniform_real_distribution<float>(0, 1)(random), 0, 0, 0};
    for (int i = 0; i < 9; ++i)
        for (const auto& [x, y] : {std::pair(i, 0), {i, 8}, {0, i}, {8, i}}) {
            const glm::vec3 here = octahedralDirection(numbers.positionOf(x, y)),
                            there = octahedralDirection(numbers.positionOf(x == 0 || x == 8 ? x : 8 - x,
                                                                           x == 0 || x == 8 ? 8 - y : y));
            EXPECT_LT(glm::length(here - there), 1e-6f) << x << "," << y << ": opposite ends are one node";
        }
    // A function that is linear on each face of the octahedron stays so: |x| and |y| of the direction.
    NodeMap faces(9);
    for (int y = 0; y < 9; ++y)
        for (int x = 0; x < 9; ++x) {
            const glm::vec3 d = octahedralDirection(faces.positionOf(x, y));
            const float l1 = std::abs(d.x) + std::abs(d.y) + std::abs(d.z);
            faces.at(x, y) = Texel{std::abs(d.x) / l1, std::abs(d.y) / l1, d.z / l1, 0};
        }
    for (int i = 0; i < 500; ++i) {
        const glm::vec3 d(onSphere(i, 500));
        const float l1 = std::abs(d.x) + std::abs(d.y) + std::abs(d.z);
        const glm::vec3 got = faces.interpolated(octahedralPosition(d));
        EXPECT_LT(glm::length(got - glm::vec3(std::abs(d.x), std::abs(d.y), d.z) / l1), 2e-6f) << i;
    }
}

TEST(EnvironmentMaps, AnAtlasHoldsEachMapOnce) {
    const EnvironmentMaps maps = makeEnvironmentMaps(skyOf(32, 16, 9), {{16, 1}, true});
    const EnvironmentAtlas atlas = layOut(maps);
    ASSERT_EQ(atlas.levels.size(), maps.levels.size());
    std::vector<int> owners(atlas.texels.size());
    const auto check = [&](const NodeMap& map, const glm::vec4& position) {
        EXPECT_EQ(position.z, static_cast<float>(map.side));
        for (int y = 0; y < map.side; ++y)
            for (int x = 0; x < map.side; ++x) {
                const std::size_t i = static_cast<std::size_t>(static_cast<int>(position.y) + y) *
                                          static_cast<std::size_t>(atlas.width) +
                                      static_cast<std::size_t>(static_cast<int>(position.x) + x);
                ASSERT_EQ(++owners.at(i), 1);
                ASSERT_EQ(atlas.texels[i].y, map.at(x, y)[1]);
            }
    };
    check(maps.diffuse, atlas.diffuse);
    for (std::size_t i = 0; i < maps.levels.size(); ++i) check(maps.levels[i], atlas.levels[i]);
}

}  // namespace
}  // namespace diptych
