// SPDX-License-Identifier: MIT
// The normal about which a stretched lobe mirrors the environment: McAuley 2015, "Rendering the World of Far
// Cry 4", with less of it for rough lobes.
#include "tests/probe/probe.h"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <cmath>
#include <random>
#include <vector>

namespace diptych {
namespace {

TEST(BentNormal, LiesBetweenTheNormalAndThePlaneOfViewAndStretch) {
    std::mt19937 random(1);
    const auto uniform = [&](double from, double to) {
        return from + (to - from) * static_cast<double>(random()) / 4294967295.0;
    };
    std::vector<float> in;
    std::vector<glm::dvec3> expected;
    for (int row = 0; row < 512; ++row) {
        const double up = uniform(0.02, 0.98), azimuth = uniform(0, 6.28), turn = uniform(0, 6.28),
                     width = uniform(0.002, 1), strength = uniform(0, 1), sine = std::sqrt(1 - up * up);
        const glm::dvec3 n(0, 0, 1), v(sine * std::cos(azimuth), sine * std::sin(azimuth), up),
            across(-std::sin(turn), std::cos(turn), 0);
        const glm::dvec3 bent = glm::normalize(v - across * glm::dot(across, v));
        const double t = std::pow(1 - strength * (1 - std::sqrt(width)), 4);
        expected.push_back(glm::normalize(bent * (1 - t) + n * t));
        for (const double x : {v.x, v.y, v.z, std::cos(turn), std::sin(turn), width, strength})
            in.push_back(static_cast<float>(x));
    }
    Probes probes;
    const std::vector<float> out = probes.run("bent_normal", in, 7, 3);
    for (std::size_t row = 0; row < expected.size(); ++row)
        for (int i = 0; i < 3; ++i)  // about ten roundings; the shortest `bent` has length 0.02
            EXPECT_NEAR(double{out[3 * row + static_cast<std::size_t>(i)]}, expected[row][i], 2e-5) << row;
}

}  // namespace
}  // namespace diptych
