// SPDX-License-Identifier: MIT
// Every probe by itself, without a device: the limits suffice for a device that is as inexact as Vulkan
// allows, and are not so wide that they forgive a fault.
#include "compare/probe/groups.h"
#include "compare/probe/run.h"

#include <gtest/gtest.h>

#include <set>

namespace diptych::probe {
namespace {

constexpr std::size_t some_rows = 4096;

// What a device would give that is `off` by that share.
std::vector<float> sloppyRows(const Probe& probe, const std::vector<float>& in) {
    std::vector<float> out(in.size() / probe.ins * probe.outs);
    for (std::size_t i = 0; i * probe.ins < in.size(); ++i)
        probe.sloppy(&in[i * probe.ins], &out[i * probe.outs]);
    return out;
}

TEST(DeviceProbes, ADeviceThatIsAsInexactAsVulkanAllowsPasses) {
    for (const Probe& probe : allProbes()) {
        if (!probe.sloppy) continue;
        const std::vector<float> in = inputsOf(probe, 0, some_rows / probe.line * probe.line);
        const Result result = concluded(probe, judged(probe, 0, in, sloppyRows(probe, in)));
        EXPECT_EQ(result.tally.failures, 0u) << tableOf(std::array{result}, true);
        EXPECT_GT(result.tally.results, result.tally.unpromised) << probe.name;
    }
}

TEST(DeviceProbes, EachHasANameInputsAndAReason) {
    std::set<std::string> names;
    for (const Probe& p : allProbes()) {
        EXPECT_TRUE(names.insert(p.name).second) << p.name << " is there twice";
        EXPECT_FALSE(p.group.empty() || p.inputs.empty() || p.because.empty() || p.unit.empty()) << p.name;
        EXPECT_TRUE(p.make && (p.judge || (p.definition && p.allowance))) << p.name;
        EXPECT_EQ(p.rows % p.line, 0u) << p.name;
        EXPECT_LE(std::max(p.ins, p.outs), widest) << p.name;
    }
}

// The same inputs in whatever pieces they are made.
TEST(DeviceProbes, ARowsInputsFollowFromItsNumber) {
    for (const Probe& probe : allProbes()) {
        const std::vector<float> all = inputsOf(probe, 0, 8), last = inputsOf(probe, 7, 1);
        EXPECT_TRUE(std::equal(last.begin(), last.end(), all.end() - static_cast<std::ptrdiff_t>(probe.ins)))
            << probe.name;
    }
}

}  // namespace
}  // namespace diptych::probe
