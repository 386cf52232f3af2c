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

TEST(EnvironmentErrors, FilteringAndTheTableAddATenthOfTheSplit) {
    for (const bool lamp : {false, true}) {
        const Environment environment = lamp ? lampSky(skyHeight) : smoothSky(skyHeight);
        const AllDirections sky(environment);
        const EnvironmentMaps maps = makeEnvironmentMaps(environment, {});
        for (const double roughness : {0.25, 0.5, 0.75, 1.0}) {
            const SpecularErrors e = specularErrors(sky, maps, roughness, sphereAngles, skyDirections);
            EXPECT_GT(e.split, 0.01) << roughness;
            EXPECT_LE(e.steps(), 0.1 * e.split) << roughness << (lamp ? " lamp" : " sky");
            EXPECT_LE(e.table, 1e-4) << roughness;
            EXPECT_LE(e.all, 1.02 * e.split) << roughness << (lamp ? " lamp" : " sky");
        }
        const IrradianceErrors i = irradianceErrors(sky, maps, 100);
        EXPECT_LE(i.harmonics.rms, lamp ? 0.05 : 0.02);
        EXPECT_LE(i.harmonics.worst, lamp ? 0.1 : 0.07) << "a lamp's are those of a clamped cosine";
        EXPECT_LE(i.map.rms, 0.005);
        EXPECT_LE(i.map.worst, 0.01) << "verdict/environment_cost";
    }
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
