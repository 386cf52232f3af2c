// SPDX-License-Identifier: MIT
// Errors of the single steps of environment lighting: filtering and the table add at most a tenth of the
// split sum's error.
#include "tests/bench/environment_errors.h"

#include <gtest/gtest.h>

namespace diptych {
namespace {

using namespace environment_errors;

constexpr int skyHeight = 192;
constexpr std::size_t skyDirections = 16;

void expectSmallSteps(const Environment& environment, const std::vector<double>& roughnesses,
                      const IrradianceErrors::Error& harmonics) {
    const AllDirections sky(environment);
    const EnvironmentMaps maps = makeEnvironmentMaps(environment, {});
    for (const double roughness : roughnesses) {
        const SpecularErrors e = specularErrors(sky, maps, roughness, sphereAngles, skyDirections);
        EXPECT_GT(e.split, 0.01) << roughness;
        EXPECT_LE(e.steps(), 0.1 * e.split) << roughness;
        EXPECT_LE(e.table, 1e-4) << roughness;
        EXPECT_LE(e.all, 1.02 * e.split) << roughness;
    }
    const IrradianceErrors i = irradianceErrors(sky, maps, 100);
    EXPECT_LE(i.harmonics.rms, harmonics.rms);
    EXPECT_LE(i.harmonics.worst, harmonics.worst);
    EXPECT_LE(i.map.rms, 0.005);
    EXPECT_LE(i.map.worst, 0.01) << "verdict/environment_cost";
}

// Harmonics of a lamp have the errors of a clamped cosine's.
TEST(EnvironmentErrors, FilteringAndTheTableAddATenthOfTheSplit) {
    expectSmallSteps(lampSky(skyHeight), {0.25, 0.5, 1.0}, {0.05, 0.1});
}

TEST(EnvironmentErrors, SoTheyDoUnderASmoothSky) {
    expectSmallSteps(smoothSky(skyHeight), {0.25, 0.5, 0.75, 1.0}, {0.02, 0.07});
}

// With constant light there is no error, so sums and maps have the same scale.
TEST(EnvironmentErrors, ThereAreNoneUnderAConstantSky) {
    const Environment environment{"sky", Image(64, 32, 3, 2.0f)};
    const AllDirections sky(environment);
    const SpecularErrors e = specularErrors(sky, makeEnvironmentMaps(environment, {}), 0.5, sphereAngles, 4);
    EXPECT_LE(e.split, 2e-3);
    EXPECT_LE(e.prefilter, 2e-3);
    EXPECT_LE(e.table, 1e-4);
}

}  // namespace
}  // namespace diptych
