// SPDX-License-Identifier: MIT
// The probes of `diptych devices --probe` on the tests' device, and faults planted in what it gives.
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

const Probe& probeNamed(const std::string& name) {
    const auto found = std::ranges::find(allProbes(), name, &Probe::name);
    if (found == allProbes().end()) throw std::logic_error("no probe is called " + name);
    return *found;
}

// Whether the probe fails where `fault` has changed each row's outputs.
template <class Fault>
bool isCaught(const std::string& name, Fault fault) {
    const Probe& probe = probeNamed(name);
    DeviceRows rows(probeDevice());
    const std::vector<float> in = inputsOf(probe, 0, 4096 / probe.line * probe.line);
    std::vector<float> out = rows.run(probe, in);
    EXPECT_TRUE(concluded(probe, judged(probe, 0, in, out)).passed) << name;
    for (std::size_t i = 0; i * probe.ins < in.size(); ++i) fault(&out[i * probe.outs]);
    return !concluded(probe, judged(probe, 0, in, out)).passed;
}

TEST(DeviceProbesOnDevice, PlantedFaultsAreFound) {
    const auto times = [](float factor) { return [factor](float* out) { out[0] *= factor; }; };
    EXPECT_TRUE(isCaught("a / b", times(1 + 0x1p-20f))) << "8 ULP";
    EXPECT_TRUE(isCaught("exp2(a)", times(1.001f)));
    EXPECT_TRUE(isCaught("D", times(1.00002f))) << "a wrong constant";
}

}  // namespace
}  // namespace diptych::probe
