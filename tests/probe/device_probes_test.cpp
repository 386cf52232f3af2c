// SPDX-License-Identifier: MIT
// Runs the probes of `diptych devices --probe` on the tests' device, and injects faults into its outputs.
#include "compare/probe/groups.h"
#include "compare/probe/run.h"
#include "tests/probe/probe.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace diptych::probe {
namespace {

constexpr std::size_t tested_rows = 1u << 14;

TEST(DeviceProbesOnDevice, AllPass) {
    DeviceRows rows(probeDevice());
    for (const Probe& probe : allProbes()) {
        const Result result = runProbe(rows, probe, tested_rows);
        EXPECT_TRUE(result.passed) << tableOf(std::array{result}, true);
    }
}

// Converting a float to fewer bits gives one of the two nearest codes (Vulkan, "Fixed-Point Data
// Conversion" and 16-bit floats): an error of less than a step.
TEST(DeviceProbesOnDevice, RoundingToATargetStaysWithinAStep) {
    const std::vector<TargetRounding> all = probeDevice().probeRounding();
    EXPECT_EQ(all.size(), 5u);
    for (const TargetRounding& target : all) {
        EXPECT_GT(target.steps, 0.4) << target.format;  // one of 4,096 values is close to the middle
        EXPECT_LT(target.steps, 1.0) << target.format;
    }
}

const Probe& probeNamed(std::string_view name) {
    const auto found = std::ranges::find(allProbes(), name, &Probe::name);
    if (found == allProbes().end()) throw std::logic_error("no probe is called " + std::string(name));
    return *found;
}

// Whether the probe fails if `fault` changes each row's outputs.
template <class Fault>
bool isCaught(std::string_view name, Fault fault) {
    const Probe& probe = probeNamed(name);
    DeviceRows rows(probeDevice());
    const std::vector<float> in =
        inputsOf(probe, 0, std::min<std::size_t>(probe.rows, 4096) / probe.line * probe.line);
    std::vector<float> out = rows.run(probe, in);
    EXPECT_TRUE(concluded(probe, evaluated(probe, 0, in, out)).passed) << name;
    for (std::size_t i = 0; i * probe.ins < in.size(); ++i) fault(&out[i * probe.outs]);
    return !concluded(probe, evaluated(probe, 0, in, out)).passed;
}

TEST(DeviceProbesOnDevice, PlantedFaultsAreFound) {
    const auto times = [](float factor) { return [factor](float* out) { out[0] *= factor; }; };
    EXPECT_TRUE(isCaught("a / b", times(1 + 0x1p-20f))) << "8 ULP";
    EXPECT_TRUE(isCaught("exp2(a)", times(1.001f)));
    EXPECT_TRUE(isCaught("D", times(1.00002f))) << "a wrong constant";
    EXPECT_TRUE(isCaught("D V, the specular lobe", times(1.00002f)));
    EXPECT_TRUE(isCaught("D V of l and v exchanged", times(1.00002f))) << "no longer symmetric";
    EXPECT_TRUE(isCaught("energy of the lobe, F = 1", times(1.001f)));
    EXPECT_TRUE(isCaught("F, Schlick's weight", times(1.00001f)));
    EXPECT_TRUE(isCaught("a point's irradiance, direction", times(1.00001f))) << "a bias";
    EXPECT_TRUE(isCaught("a spot's irradiance", times(1.0001f)));
    EXPECT_TRUE(isCaught("view depth of a depth", times(1.00001f)));
    EXPECT_TRUE(isCaught("square root, 8 bits", [](float* out) { out[0] += 1; })) << "one code higher";
    EXPECT_TRUE(isCaught("radiance, 9.9.9.e5", times(0.99f)));
    for (const char* octahedral :
         {"octahedral from 8 bits", "octahedral from 12 bits", "octahedral from 16 bits"})
        EXPECT_TRUE(isCaught(octahedral, [](float* out) { out[0] = std::abs(out[0]); })) << "a lost sign";
    EXPECT_TRUE(isCaught("octahedral, 16 bits", [](float* out) { out[1] += 1; }));
    EXPECT_TRUE(isCaught("G-buffer, compact", [](float* out) { out[19] += 0.01f; }))
        << "metallic: half a step";
    EXPECT_TRUE(isCaught("G-buffer, full", [](float* out) { out[9] = std::nextafter(out[9], 0.0f); }));
    EXPECT_TRUE(isCaught("EVSM, four moments of a depth", times(1.001f)));
    EXPECT_TRUE(isCaught("Chebyshev's bound", times(1.00001f)));
    EXPECT_TRUE(isCaught("MSM, d to d^4 and back", times(1.001f)));
    EXPECT_TRUE(isCaught("MSM of any moments", [](float* out) { out[0] += 0.5f; })) << "more than all";
    EXPECT_TRUE(isCaught("e^x and e^x - 1", times(1.000001f)));
    EXPECT_TRUE(isCaught("air along a ray", times(1.00001f)));
    EXPECT_TRUE(isCaught("air of an endless ray", times(1.0001f)));
    EXPECT_TRUE(isCaught("transmittance, scattered light", times(1.00001f)));
    EXPECT_TRUE(isCaught("angle of a cosine and sine", times(1.0001f)));
    EXPECT_TRUE(isCaught("an edge of an outline", times(-1)));
    EXPECT_TRUE(isCaught("parallelogram, cosine", times(1.001f)));
    EXPECT_TRUE(isCaught("parallelogram, transformed", times(1.001f)));
    EXPECT_TRUE(isCaught("roughness, specular anti-aliasing", times(1.00001f)));
    EXPECT_TRUE(isCaught("between microfacets, energy", times(1.00001f)));
    EXPECT_TRUE(isCaught("between microfacets, Fdez-Aguera", [](float* out) { out[2] *= 1.0001f; }));
    EXPECT_TRUE(isCaught("mean of Schlick's weight", times(1.001f)));
    EXPECT_TRUE(isCaught("harmonics of an environment", times(1.00001f)));
    EXPECT_TRUE(isCaught("harmonics of a draw's lights", times(1.00001f)));
    EXPECT_TRUE(isCaught("level of a GGX width", times(1.0001f)));
    EXPECT_TRUE(isCaught("tone curve, on the host", times(1.00001f)));
    EXPECT_TRUE(isCaught("froxel of a pixel and depth", [](float* out) { out[0] += 1; }));
}

TEST(DeviceProbesOnDevice, WhatTheShaderDoesNotWriteIsNoNumber) {
    Probe probe = probeNamed("uint to float");
    probe.function = 1000;  // not in operations.comp
    DeviceRows rows(probeDevice());
    for (const float x : rows.run(probe, inputsOf(probe, 0, 100))) EXPECT_TRUE(std::isnan(x));
}

// NaN fails whatever the tolerance; so does a decreasing code.
TEST(DeviceProbesOnDevice, NoNumbersAndStepsBackAreFound) {
    const auto spoil = [](float* out) { out[0] = std::numeric_limits<float>::quiet_NaN(); };
    for (const Probe& probe : allProbes()) EXPECT_TRUE(isCaught(probe.name, spoil)) << probe.name;
    const Probe& codes = probeNamed("unorm from 12 bits");
    const std::vector<float> in = inputsOf(codes, 0, codes.rows);
    DeviceRows rows(probeDevice());
    std::vector<float> out = rows.run(codes, in);
    std::swap(out[100], out[101]);
    EXPECT_EQ(evaluated(codes, 0, in, out).backward, 1u);
    out = rows.run(codes, in);
    out[7] = std::nextafter(out[7], 0.0f);
    EXPECT_TRUE(concluded(codes, evaluated(codes, 0, in, out)).passed) << "a ULP less is in order";
}

}  // namespace
}  // namespace diptych::probe
