// SPDX-License-Identifier: MIT
// The shaders' multiple-scattering compensation compared with the reference's, light by light.
#include "compare/reference/scattering/multiscatter.h"
#include "compare/reference/scattering/ambient.h"
#include "shared/contract/constants.h"
#include "shared/contract/features.h"
#include "shared/contract/multiscatter.h"
#include "shared/environment/directional_albedo.h"
#include "tests/probe/area_builder.h"
#include "tests/probe/probe.h"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace diptych {
namespace {

constexpr std::size_t multiscatterWidth = 13;

void push(std::vector<float>& input, const reference::Surface& s, const glm::dvec3& l) {
    const double min = double{gpu::MIN_PERCEPTUAL_ROUGHNESS}, roughness = std::max(s.roughness, min);
    const double cosine = std::max(s.to_viewer.z, double{gpu::MIN_N_DOT_V});
    const glm::dvec2 table = specularAlbedo(cosine, roughness * roughness);
    for (const double x : {s.to_viewer.x, s.to_viewer.y, s.to_viewer.z, l.x, l.y, l.z, s.roughness,
                           s.metallic, s.albedo.r, s.dielectric_f0.r, s.dielectric_f90, table.x, table.y})
        input.push_back(static_cast<float>(x));
}

struct CompensationKind {
    Multiscatter multiscatter;
    gpu::uint feature;
};
constexpr std::array compensationKinds{CompensationKind{Multiscatter::energy, gpu::MULTISCATTER_ENERGY},
                                       CompensationKind{Multiscatter::fdez, gpu::MULTISCATTER_FDEZ}};

// Most rows mix both materials, at every roughness and angle. The lobe is as exact as without compensation
// (Brdf.IsTheReferences); the factor has float32 error.
TEST(Multiscatter, IsTheReferences) {
    Probes probes;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(0, 1), angle(0, 6.28);
    const auto direction = [&](double z) {
        const double r = std::sqrt(1 - z * z), phi = angle(random);
        return glm::dvec3(r * std::cos(phi), r * std::sin(phi), z);
    };
    constexpr int rows = 600;
    std::vector<float> input;
    std::vector<reference::Surface> surfaces;
    std::vector<glm::dvec3> lights;
    for (int i = 0; i < rows; ++i) {
        reference::Surface s;
        s.to_viewer = direction(0.01 + 0.99 * unit(random));
        s.roughness = unit(random);
        s.metallic = i % 4 == 0 ? 0 : i % 4 == 1 ? 1 : unit(random);
        s.albedo = glm::dvec3(unit(random));
        s.dielectric_f0 = glm::dvec3(i % 3 == 0 ? 0.04 : 0.5 * unit(random));
        s.dielectric_f90 = i % 3 == 0 ? 1 : 0.5 + 0.5 * unit(random);
        surfaces.push_back(s);
        lights.push_back(direction(0.01 + 0.99 * unit(random)));
        push(input, s, lights.back());
    }
    for (const auto& [multiscatter, feature] : compensationKinds) {
        const std::vector<float> out =
            probes.run("multiscatter", input, multiscatterWidth, 4, {{gpu::FEATURE_multiscatter, feature}});
        int changed = 0;
        for (std::size_t i = 0; i < rows; ++i) {
            const reference::Surface& s = surfaces[i];
            const reference::Compensation compensation = compensationOf(s, multiscatter);
            const reference::Reflected expected = reference::Brdf(s, compensation)(lights[i]),
                                       plain = reference::Brdf(s)(lights[i]);
            const std::string row = fmt::format("{} {}", nameOf(multiscatter), i);
            EXPECT_NEAR(out[4 * i], expected.diffuse.g, 2e-5) << row;
            EXPECT_NEAR(out[4 * i + 1], expected.specular.g, 1e-3 * expected.specular.g + 1e-5) << row;
            EXPECT_NEAR(out[4 * i + 2], diffuseAlbedo(s, compensation).g, 2e-5) << row;
            EXPECT_NEAR(out[4 * i + 3], reference::specularAlbedo(s, compensation).g, 2e-5) << row;
            changed += expected.specular.g > 1.02 * plain.specular.g;
        }
        EXPECT_GT(changed, rows / 3);
    }
}

// Switched off, the BRDF is unchanged to the bit.
TEST(Multiscatter, OffIsTheBrdfAlone) {
    Probes probes;
    std::vector<float> input, plain;
    for (const double roughness : {0.1, 0.5, 1.0})
        for (const double metallic : {0.0, 0.5, 1.0}) {
            reference::Surface s;
            s.to_viewer = {0.6, 0, 0.8};
            s.roughness = roughness;
            s.metallic = metallic;
            s.albedo = glm::dvec3(0.7);
            s.dielectric_f0 = glm::dvec3(0.04);
            push(input, s, {0, 0.8, 0.6});
            plain.insert(plain.end(), input.end() - multiscatterWidth, input.end() - 2);
        }
    // The probe always applies the compensation; with the feature off, only the base changes.
    const std::vector<float> off = probes.run("multiscatter", input, multiscatterWidth, 4),
                             brdf = probes.run("brdf", plain, multiscatterWidth - 2, 2);
    for (std::size_t i = 0; i < brdf.size() / 2; ++i) EXPECT_EQ(off[4 * i + 1], brdf[2 * i + 1]) << i;
}

// A lobe scaled by a factor is scaled for every light, independent of how it is evaluated. A Lambertian
// lobe reflects an area light as a Lambertian base does.
TEST(Multiscatter, AreaLightsAreCompensatedAsTheLobeIs) {
    Probes probes;
    std::vector<float> mirrors, bases;
    std::vector<tests::Receiver> receivers;
    for (const LightKind kind : areaKinds)
        for (const double roughness : {0.3, 0.6, 1.0})
            for (const double degrees : {0.0, 40.0, 80.0}) {
                Light light = reference::lightOf(kind, {0.3, -0.4, 1.2}, {0.1, 0.2, -1});
                light.width = light.height = light.length = 0.9f;
                light.radius = 0.2f;
                tests::Receiver r{.roughness = roughness, .to_viewer = tests::viewAt(degrees, 1)};
                tests::pushArea(mirrors, light, r);
                receivers.push_back(r);
                r.metallic = r.f0 = r.f90 = 0;
                tests::pushArea(bases, light, r);
            }
    for (const bool points : {false, true}) {
        const auto off = tests::shadeArea(probes, mirrors, points),
                   energy = tests::shadeArea(probes, mirrors, points, gpu::MULTISCATTER_ENERGY),
                   fdez = tests::shadeArea(probes, mirrors, points, gpu::MULTISCATTER_FDEZ),
                   lambert = tests::shadeArea(probes, bases, points);
        for (std::size_t i = 0; i < receivers.size(); ++i) {
            const LtcCell cell = ltcTable().at(receivers[i].roughness, receivers[i].nDotV());
            const double all = double{cell.magnitude};
            // F = 1: the whole lobe is divided by its albedo; the Lambertian lobe takes the remainder.
            EXPECT_NEAR(energy[i][1], off[i][1] / all, 1e-5 * off[i][1] / all) << points << " " << i;
            EXPECT_NEAR(fdez[i][1], off[i][1] + (1 - all) * lambert[i][0], 2e-6) << points << " " << i;
            EXPECT_GT(lambert[i][0], 0.01) << points << " " << i;
        }
    }
}

}  // namespace
}  // namespace diptych
