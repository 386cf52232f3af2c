// SPDX-License-Identifier: MIT
// The shaders' slab and diffuse transmission, compared with closed forms and with the reference.
#include "compare/reference/scattering/ambient.h"
#include "compare/reference/scattering/brdf.h"
#include "shared/contract/features.h"
#include "shared/contract/material.h"
#include "tests/probe/probe.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <random>

namespace diptych {
namespace {

void addVectors(std::vector<float>& row, std::initializer_list<glm::dvec3> vectors) {
    for (const glm::dvec3& v : vectors)
        for (int c = 0; c < 3; ++c) row.push_back(static_cast<float>(v[c]));
}
void addNumbers(std::vector<float>& row, std::initializer_list<double> numbers) {
    for (const double x : numbers) row.push_back(static_cast<float>(x));
}
glm::dvec3 vectorAt(const std::vector<float>& values, std::size_t at) {
    return {double{values[at]}, double{values[at + 1]}, double{values[at + 2]}};
}
// A unit vector at an angle from +Z.
glm::dvec3 tilted(double angle, double around) {
    return {std::sin(angle) * std::cos(around), std::sin(angle) * std::sin(around), std::cos(angle)};
}
constexpr double edge_on_angle = (90 - 0.01) * std::numbers::pi / 180;

// ---- slabs -------------------------------------------------------------------------------------------

constexpr std::size_t slab_width = 12;

TEST(SlabProbe, AbsorbsAsBeerAndLambertSay) {
    Probes probes;
    std::vector<float> input;
    for (const double thickness : {0.0, 1e-6, 0.5, 20.0, 3e30})  // the last is beyond float32 in distances
        for (const double distance : {0.0, 1e-12, 1e-3, 0.25, 4.0}) {
            addVectors(input, {{0, 0, 1}, {0, 0, 1}});
            addNumbers(input, {1.5, thickness, 0.5, 1, 1e-6, distance});
            addVectors(input, {{0, 0, 1}, {0, 0, 1}});
            addNumbers(input, {1.5, thickness, 0, 0.999, 1e-30, distance});
        }
    const std::vector<float> out = probes.run("slab", input, slab_width, 6);
    for (std::size_t i = 0; i < input.size() / slab_width; ++i) {
        const auto in = [&](std::size_t at) { return double{input[i * slab_width + at]}; };
        const double lengths = in(11) > 0 ? in(7) / in(11) : 0;
        for (std::size_t c = 0; c < 3; ++c) {
            const double expected = std::pow(in(8 + c), lengths), got = double{out[6 * i + c]};
            // Vulkan: a logarithm between 1/2 and 2 is 2^-21 off.
            EXPECT_NEAR(got, expected, (1e-6 * lengths + 1e-4) * expected + 1e-37)
                << in(7) << " m of " << in(11) << ", " << in(8 + c);
            if (in(8 + c) == 0) {
                EXPECT_EQ(got, lengths > 0 ? 0 : 1) << lengths;
            }
        }
    }
}

// The part across the normal shrinks by the index, and the way is as long as the slab is thick.
TEST(SlabProbe, BendsAsSnellSays) {
    Probes probes;
    std::vector<float> input;
    for (const double ior : {0.0, 0.5, 1.0, 1.33, 1.5, 2.4})  // 0: infinite; below 1: as 1
        for (const double angle : {0.0, 0.3, 1.2, edge_on_angle})
            for (const double tilt : {0.0, 0.8}) {
                const glm::dvec3 n = tilted(tilt, 2),
                                 x = glm::normalize(glm::cross(n, glm::dvec3(1, 0.2, 0)));
                addVectors(input, {glm::normalize(n * std::cos(angle) + x * std::sin(angle)), n});
                addNumbers(input, {ior, 0.7, 1, 1, 1, 1});
            }
    const std::vector<float> out = probes.run("slab", input, slab_width, 6);
    for (std::size_t i = 0; i < input.size() / slab_width; ++i) {
        const std::size_t at = i * slab_width;
        const glm::dvec3 v = glm::normalize(vectorAt(input, at)), n = glm::normalize(vectorAt(input, at + 3));
        const double ior = double{input[at + 6]}, eta = ior > 0 ? 1 / std::max(ior, 1.0) : 0;
        const glm::dvec3 across = (v - n * glm::dot(n, v)) * -eta;
        const glm::dvec3 expected = across - n * std::sqrt(std::max(1 - glm::dot(across, across), 0.0));
        EXPECT_LT(glm::distance(vectorAt(out, 6 * i + 3), 0.7 * expected), 2e-6)
            << ior << ", n.v " << glm::dot(n, v);
    }
}

// ---- diffuse transmission ----------------------------------------------------------------------------

constexpr std::size_t leaf_width = 15;
constexpr std::pair<std::uint32_t, std::uint32_t> leafy{gpu::FEATURE_layers, gpu::LAYER_DIFFUSE_TRANSMISSION};

void addLeaf(std::vector<float>& input, const glm::dvec3& v, const glm::dvec3& l, const glm::dvec3& n,
             std::initializer_list<double> values) {
    addVectors(input, {v, l, n});
    addNumbers(input, values);
}
reference::Surface leafAt(const std::vector<float>& input, std::size_t row) {
    const auto in = [&](std::size_t at) { return double{input[row * leaf_width + at]}; };
    reference::Surface s;
    s.to_viewer = vectorAt(input, row * leaf_width);
    s.normal = vectorAt(input, row * leaf_width + 6);
    s.diffuse_transmission = in(9);
    s.diffuse_transmission_color = glm::dvec3(in(10));
    s.albedo = glm::dvec3(in(11));
    s.metallic = in(12);
    s.roughness = 0.5;
    s.dielectric_f0 = glm::dvec3(in(13));
    s.dielectric_f90 = in(14);
    return s;
}

TEST(DiffuseTransmissionProbe, IsTheReferences) {
    Probes probes;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(0, 1), angle(0, 6.28);
    std::vector<float> input;
    constexpr std::size_t rows = 3000;
    for (std::size_t i = 0; i < rows; ++i) {
        const double light = std::acos(2 * unit(random) - 1),
                     view = i % 7 == 0 ? edge_on_angle : 1.5 * unit(random);
        addLeaf(input, tilted(view, angle(random)), tilted(light, angle(random)), {0, 0, 1},
                {i % 5 == 0 ? 0 : unit(random), unit(random), unit(random), i % 3 == 0 ? 0 : unit(random),
                 0.5 * unit(random), unit(random)});
    }
    const std::vector<float> out = probes.run("diffuse_transmission", input, leaf_width, 3, {leafy});
    std::size_t passing = 0;
    for (std::size_t i = 0; i < rows; ++i) {
        const reference::Surface s = leafAt(input, i);
        const glm::dvec3 l = vectorAt(input, i * leaf_width + 3);
        const reference::Reflected expected = reference::Brdf(s)(l);
        EXPECT_NEAR(double{out[3 * i]}, expected.diffuse.g, 1e-5) << i;
        EXPECT_NEAR(double{out[3 * i + 1]}, expected.transmitted.g, 1e-5) << i;
        passing += expected.transmitted.g > 0.01;
        if (l.z > 0) {
            EXPECT_EQ(out[3 * i + 1], 0) << i;
        } else {
            EXPECT_EQ(out[3 * i], 0) << i;
        }
        if (s.to_viewer.z > 0.06 && i % 50 == 1) {
            EXPECT_NEAR(double{out[3 * i + 2]}, reference::diffuseAlbedo(reference::behind(s)).g, 2e-5) << i;
        }
    }
    EXPECT_GT(passing, rows / 10);
}

}  // namespace
}  // namespace diptych
