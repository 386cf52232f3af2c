// SPDX-License-Identifier: MIT
// Each probe without a device: a device as inexact as Vulkan allows passes, and the limits are tight
// enough to find a fault.
#include "compare/probe/groups.h"
#include "compare/probe/run.h"

#include "tests/support/layer_formulas.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <string>

namespace diptych::probe {
namespace {

constexpr std::size_t some_rows = 4096;

// Results of a device with the error that Vulkan allows.
std::vector<float> inexactRows(const Probe& probe, const std::vector<float>& in) {
    std::vector<float> out(in.size() / probe.ins * probe.outs);
    for (std::size_t i = 0; i * probe.ins < in.size(); ++i)
        probe.inexact(&in[i * probe.ins], &out[i * probe.outs]);
    return out;
}

TEST(DeviceProbes, ADeviceThatIsAsInexactAsVulkanAllowsPasses) {
    for (const Probe& probe : allProbes()) {
        if (!probe.inexact) continue;
        const std::vector<float> in = inputsOf(probe, 0, some_rows / probe.line * probe.line);
        const Result result = concluded(probe, evaluated(probe, 0, in, inexactRows(probe, in)));
        EXPECT_EQ(result.tally.failures, 0u) << tableOf(std::array{result}, true);
        EXPECT_GT(result.tally.results, result.tally.unpromised) << probe.name;
    }
}

TEST(DeviceProbes, EachHasANameInputsAndAReason) {
    std::set<std::string> names;
    for (const Probe& p : allProbes()) {
        EXPECT_TRUE(names.insert(p.name).second) << p.name << " is there twice";
        EXPECT_FALSE(p.group.empty() || p.inputs.empty() || p.because.empty() || p.unit.empty()) << p.name;
        EXPECT_TRUE(p.make && (p.evaluate || (p.definition && p.allowance))) << p.name;
        EXPECT_EQ(p.rows % p.line, 0u) << p.name;
        EXPECT_LE(std::max(p.ins, p.outs), widest) << p.name;
    }
}

// A unit says what an error is divided by: the ULP of a number, a code's step, or the ULP of terms that only
// the inputs determine.
TEST(DeviceProbes, TheUnitNamesTheStep) {
    const std::map<std::string, std::function<double(double expected)>> of{
        {"ULP", [](double e) { return ulpOf(e); }},
        {"ULP of 1", [](double) { return ulpOf(1); }},
        {"ULP of 1+L", [](double e) { return ulpOf(1 + e); }},
        {"ULP of half", [](double e) { return std::max(ulpOf(e) * 0x1p13, 0x1p-24); }}};
    const std::set<std::string> terms{"ULP of sum", "ULP of point", "ULP of 1/d2"}, codes{"steps", "slices"};
    std::set<std::string> seen;
    for (const Probe& p : allProbes()) {
        seen.insert(p.unit);
        const std::vector<float> in = inputsOf(p, 0, 64);
        // Where outputs differ, the unit names the first of a light's (irradiance) or the last of a BRDF's.
        const auto step = [&](std::size_t row, std::size_t output, double expected) {
            return p.step ? p.step(&in[row * p.ins], output, expected) : ulpOf(expected);
        };
        std::set<double> steps;
        for (std::size_t row = 0; row < 64; ++row)
            for (const double expected : {0.01, 5.0}) {
                if (of.contains(p.unit)) {
                    ASSERT_EQ(step(row, p.outs - 1, expected), of.at(p.unit)(expected)) << p.name;
                } else if (terms.contains(p.unit)) {
                    ASSERT_EQ(step(row, 0, expected), step(row, 0, 1)) << p.name;
                    steps.insert(step(row, 0, expected));
                } else {
                    ASSERT_TRUE(codes.contains(p.unit) && (p.evaluate || p.step)) << p.unit << ": " << p.name;
                }
            }
        if (terms.contains(p.unit)) {
            EXPECT_GT(steps.size(), 1u) << p.name << " has one step, which a unit can name";
        }
    }
    EXPECT_EQ(seen.size(), of.size() + terms.size() + codes.size());
}

// Two kinds of probe accept it: equal results of an exchanged pair, and any fraction for moments of no
// distribution.
TEST(DeviceProbes, AResultOfZeroFails) {
    for (const Probe& p : allProbes()) {
        const std::vector<float> in = inputsOf(p, 0, std::max<std::size_t>(256 / p.line, 1) * p.line);
        const std::vector<float> zeros(in.size() / p.ins * p.outs);
        const bool any = p.name == "D V of l and v exchanged" || p.name.starts_with("EVSM of any ") ||
                         p.name.starts_with("MSM of any ");
        EXPECT_EQ(concluded(p, evaluated(p, 0, in, zeros)).passed, any) << p.name;
    }
}

// The mean over a line's half vectors is the lobe's albedo, by another quadrature, if they are distributed as
// their density says. 64 low-discrepancy samples of lobes this wide err by less than 0.01.
TEST(DeviceProbes, TheEnergyOfALobeIsItsAlbedo) {
    const Probe& p =
        *std::ranges::find(allProbes(), std::string_view("energy of the lobe, F = 1"), &Probe::name);
    std::size_t lobes = 0;
    for (std::size_t line = 0; line < p.rows / p.line; line += 97) {
        const std::vector<float> in = inputsOf(p, line * p.line, p.line);
        const auto vector = [&](std::size_t at) {
            return glm::dvec3(double{in[at]}, double{in[at + 1]}, double{in[at + 2]});
        };
        const double alpha = double{in[0]} * double{in[0]};
        const glm::dvec3 v = vector(4);
        if (alpha < 0.15 || v.z < 0.2) continue;
        ++lobes;
        const auto lobe = [&](const glm::dvec3& l) { return stretchedLobe(glm::dvec2(alpha), l, v); };
        std::vector<float> out;
        for (std::size_t k = 0; k < p.line; ++k) {
            const glm::dvec3 l = vector(k * p.ins + 7);
            out.push_back(l.z > 0 ? static_cast<float>(lobe(l) / l.z) : 0.0f);
        }
        double albedo = 0;
        for (const auto& [l, weight] : reflectedDirections(v, alpha, 128, 64)) albedo += lobe(l) * weight;
        EXPECT_NEAR(evaluated(p, line * p.line, in, out).worst.got, albedo, 0.01)
            << "alpha " << alpha << ", n.v " << v.z;
    }
    EXPECT_GT(lobes, 12u);
}

// The first three inputs are M^-1; only the cosine has the identity.
TEST(DeviceProbes, OnlyTheCosineIsNotTransformed) {
    int seen = 0;
    for (const Probe& p : allProbes()) {
        if (!p.name.starts_with("parallelogram, ")) continue;
        ++seen;
        const std::vector<float> in = inputsOf(p, 0, 64);
        std::size_t identities = 0;
        for (std::size_t i = 0; i < in.size(); i += p.ins)
            identities += in[i] == 1 && in[i + 1] == 1 && in[i + 2] == 0;
        EXPECT_EQ(identities, p.name == "parallelogram, cosine" ? 64u : 0u) << p.name;
    }
    EXPECT_EQ(seen, 2);
}

// Result of a probe that doubles a number, if the outputs are `factor` times as large; four rows.
Result doubled(const Probe& probe, float factor) {
    const std::vector<float> in = inputsOf(probe, 0, 4);
    std::vector<float> out;
    for (const float x : in) out.push_back(2 * x * factor);
    return concluded(probe, evaluated(probe, 0, in, out));
}

Probe doubling() {
    Probe p;
    p.group = "numbers", p.name = "2 a", p.inputs = "1 to 4", p.unit = "ULP", p.because = "a product";
    p.line = p.rows = 4;
    p.monotone = 1;
    p.strict = true;
    p.make = [](Random&, std::size_t row, float* in) { in[0] = static_cast<float>(row + 1); };
    p.definition = [](const float* in, double* out) { out[0] = 2 * double{in[0]}; };
    setOperations(p, [](const auto* in, auto* out) { out[0] = in[0] + in[0]; });
    return p;
}

TEST(DeviceProbes, OneThatFailsFailsAll) {
    const Probe probe = doubling();
    const std::array results{doubled(probe, 1), doubled(probe, 1.5f)};
    EXPECT_TRUE(results[0].passed);
    EXPECT_FALSE(results[1].passed);
    EXPECT_FALSE(allPassed(results));
    EXPECT_TRUE(allPassed(std::span(results).first(1)));
}

TEST(DeviceProbes, AStepBackFailsWhereNoDeviceMayTakeIt) {
    Probe probe = doubling();
    probe.allowance = [](const float*, double* allowed) { allowed[0] = 10; };
    const auto evaluate = [&] { return concluded(probe, evaluated(probe, 0, {1, 2, 3, 4}, {2, 4, 3, 8})); };
    EXPECT_FALSE(evaluate().passed);
    probe.strict = false;
    EXPECT_TRUE(evaluate().passed);
    EXPECT_EQ(evaluate().tally.backward, 1u) << "it is counted";
}

// A row's inputs do not depend on how many rows are made at once.
TEST(DeviceProbes, ARowsInputsFollowFromItsNumber) {
    for (const Probe& probe : allProbes()) {
        const std::vector<float> all = inputsOf(probe, 0, 8), last = inputsOf(probe, 7, 1);
        EXPECT_TRUE(std::equal(last.begin(), last.end(), all.end() - static_cast<std::ptrdiff_t>(probe.ins)))
            << probe.name;
    }
}

}  // namespace
}  // namespace diptych::probe
