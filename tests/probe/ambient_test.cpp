// SPDX-License-Identifier: MIT
// Analytic ambient terms of the shaders (no table), compared with the reference's integrals.
#include "compare/reference/scattering/ambient.h"
#include "shared/environment/directional_albedo.h"
#include "tests/probe/probe.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace diptych {
namespace {

// Roughness and n.v of each row, and the shader's output.
struct AlbedoRows {
    std::vector<double> roughness, n_dot_v;
    std::vector<float> out;  // three a row
};
AlbedoRows albedoRows() {
    AlbedoRows rows;
    std::vector<float> input;
    for (int i = 0; i <= 20; ++i)
        for (int j = 0; j <= 40; ++j) {
            const double roughness = std::max(0.045, i / 20.0), n_dot_v = std::max(1e-3, j / 40.0);
            rows.roughness.push_back(roughness);
            rows.n_dot_v.push_back(n_dot_v);
            input.push_back(static_cast<float>(roughness * roughness));
            input.push_back(static_cast<float>(n_dot_v));
        }
    Probes probes;
    rows.out = probes.run("ambient", input, 2, 3);
    return rows;
}

// Tolerance: 4.3e-6 between polynomial and integral, 4e-6 of the reference's quadrature, and float32
// rounding.
TEST(AmbientShader, TheMeanOfSchlicksWeightIsTheReferences) {
    const AlbedoRows rows = albedoRows();
    for (std::size_t i = 0; i < rows.n_dot_v.size(); ++i) {
        reference::Surface s;
        s.albedo = glm::dvec3(1);
        s.roughness = 1;
        s.dielectric_f0 = glm::dvec3(0);
        s.dielectric_f90 = 1;
        const double sine = std::sqrt(1 - rows.n_dot_v[i] * rows.n_dot_v[i]);
        s.to_viewer = {sine, 0, rows.n_dot_v[i]};
        EXPECT_NEAR(1 - double{rows.out[3 * i + 2]}, reference::diffuseAlbedo(s).g, 9e-6) << rows.n_dot_v[i];
    }
}

// Error of a widely used fit, made for another masking function. The known maximum for F0 = 0.04 is 0.082.
TEST(AmbientShader, TheFitIsOffByWhatIsSaid) {
    const AlbedoRows rows = albedoRows();
    double worst = 0, white = 0, grazing = 0, sum = 0;
    for (std::size_t i = 0; i < rows.n_dot_v.size(); ++i) {
        const glm::dvec2 exact = specularAlbedo(rows.n_dot_v[i], rows.roughness[i] * rows.roughness[i]);
        const glm::dvec2 off = glm::dvec2(rows.out[3 * i], rows.out[3 * i + 1]) - exact;
        EXPECT_GE(rows.out[3 * i], 0);
        EXPECT_GE(rows.out[3 * i + 1], 0);
        worst = std::max(worst, std::abs(off.x * 0.04 + off.y));
        double& metal = rows.n_dot_v[i] < 0.1 ? grazing : white;
        metal = std::max(metal, std::abs(off.x + off.y));
        sum += off.x * 0.04 + off.y;
    }
    EXPECT_NEAR(worst, 0.082, 0.002);
    EXPECT_NEAR(white, 0.308, 0.002);
    EXPECT_NEAR(grazing, 0.54, 0.002);
    EXPECT_NEAR(sum / static_cast<double>(rows.n_dot_v.size()), -0.0108, 0.0005);
}

}  // namespace
}  // namespace diptych
