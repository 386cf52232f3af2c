// SPDX-License-Identifier: MIT
// Tables and JSON of probes, whole; tallies that are joined; medians and percentiles.
#include "compare/probe/run.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <array>
#include <limits>
#include <string>
#include <vector>

namespace diptych::probe {
namespace {

constexpr double endless_error = std::numeric_limits<double>::infinity();

// Three probes of two groups; each row's input is its number.
struct ThreeProbes {
    std::array<Probe, 3> probes;
    std::vector<Result> results;

    ThreeProbes() {
        for (std::size_t i = 0; i < 3; ++i) {
            Probe& p = probes[i];
            p.group = i == 2 ? "lights" : "operations";
            p.name = std::array{"a + b", "a / b", "irradiance"}[i];
            p.inputs = "all numbers";
            p.because = "Vulkan's table";
            p.unit = std::array{"ULP", "ULP", "steps"}[i];
            p.ins = 2;
            p.make = [](Random&, std::size_t row, float* in) {
                in[0] = static_cast<float>(row);
                in[1] = 0.5f;
            };
        }
        Tally exact, wrong, odd;
        exact.value(0, 0, 1, 1, 0, 1);
        exact.value(1, 0, 2, 2, 0, 1);
        wrong.value(3, 1, 2, 5, 2, 1);       // off by 3 of 2
        wrong.value(4, 0, 5.5f, 5, 0.5, 1);  // off by its limit
        wrong.value(5, 0, 5, 5, 0.5, 1);
        odd.value(7, 0, 1, 1, endless_error, 1);
        odd.value(8, 0, std::numeric_limits<float>::quiet_NaN(), 1, 1, 1);
        odd.back(9, 2, 1.5f);
        results = {concluded(probes[0], exact), concluded(probes[1], wrong), concluded(probes[2], odd)};
    }
};

TEST(ProbeText, TheTableIsWhole) {
    const ThreeProbes three;
    const std::string head =
        "     probe                               results   median   99.9 %    worst            of limit\n"
        "     operations\n"
        "       a + b                                   2        0        0        0 ULP               0  "
        "pass\n";
    EXPECT_EQ(tableOf(std::span(three.results).first(1), false),
              head + "     pass: 1 of 1 probes, 2 results\n");
    EXPECT_EQ(
        tableOf(three.results, false),
        head +
            "       a / b                                   3      0.5      0.5        3 ULP             "
            "1.5  FAIL\n"
            "         2 instead of 5 (2 allowed) for input 3 0.5\n"
            "     lights\n"
            "       irradiance                              1  1.0e+30  1.0e+30     none steps          "
            "none  FAIL; 1 not monotonic; 1 without a bound; 1 NaN or infinite\n"
            "         nan instead of 1 (1 allowed) for input 8 0.5\n"
            "     FAIL: 2 of 3 probes, 6 results\n");
    const std::string more =
        "         inputs: all numbers\n         allowed: Vulkan's table\n         errors: ";
    EXPECT_EQ(
        tableOf(std::span(three.results).first(2), true),
        head + more + "0: 2\n" + "         worst: 1 instead of 1 (0 allowed) for input 0 0.5\n" +
            "       a / b                                   3      0.5      0.5        3 ULP             "
            "1.5  FAIL\n"
            "         2 instead of 5 (2 allowed) for input 3 0.5\n" +
            more + "0: 1, to 0.5: 1, to 4: 1\n" +
            "         worst: 2 instead of 5 (2 allowed) for input 3 0.5\n"
            "     FAIL: 1 of 2 probes, 5 results\n");
}

TEST(ProbeText, TheJsonIsWhole) {
    const ThreeProbes three;
    using Json = nlohmann::ordered_json;
    const Json json = jsonOf(three.results);
    EXPECT_EQ(json[1], (Json{{"group", "operations"},
                             {"probe", "a / b"},
                             {"inputs", "all numbers"},
                             {"because", "Vulkan's table"},
                             {"unit", "ULP"},
                             {"pass", false},
                             {"results", 3},
                             {"failures", 1},
                             {"nonfinite", 0},
                             {"unpromised", 0},
                             {"backward", 0},
                             {"median", 0.5},
                             {"p99.9", 0.5},
                             {"worst",
                              {{"error", 3.0},
                               {"got", 2.0},
                               {"expected", 5.0},
                               {"allowed", 2.0},
                               {"output", 1},
                               {"row", 3},
                               {"input", {3.0, 0.5}}}},
                             {"of_limit", json[1]["of_limit"]},
                             {"histogram",
                              {{{"to", 0.0}, {"results", 1}},
                               {{"to", 0.5}, {"results", 1}},
                               {{"to", 4.0}, {"results", 1}}}}}));
    EXPECT_NEAR(json[1]["of_limit"]["error"].get<double>(), 1.5, 1e-12);
    EXPECT_EQ(json[2]["worst"]["error"], nullptr) << "no number";
    EXPECT_EQ(json[2]["worst"]["got"], nullptr);
    EXPECT_EQ(json[2]["histogram"], (Json{{{"to", nullptr}, {"results", 1}}})) << "the last bin is open";
    EXPECT_EQ(jsonOf(std::array{concluded(three.probes[0], {})})[0]["worst"], nullptr) << "no result";
}

TEST(ProbeText, TalliesAreJoinedInAnyOrder) {
    Tally one, two, three;
    one.value(4, 0, 3, 1, 4, 1);
    two.value(2, 1, 3, 1, 4, 1);  // as wrong, an earlier row
    three.value(9, 0, 1, 1, endless_error, 1);
    three.value(8, 0, 1.5f, 1, 0.25, 0);  // evaluated, not counted
    three.back(6, 1, 0.5f);
    three.back(5, 1, 0.5f);
    for (const auto& order : {std::array{&one, &two, &three}, {&three, &two, &one}, {&two, &three, &one}}) {
        Tally all;
        for (const Tally* part : order) all.add(*part);
        EXPECT_EQ(all.results, 3u);
        EXPECT_EQ(all.unpromised, 1u);
        EXPECT_EQ(all.failures, 1u);
        EXPECT_EQ(all.nonfinite, 0u);
        EXPECT_EQ(all.backward, 2u);
        EXPECT_EQ(all.histogram[3], 2u);
        EXPECT_EQ(all.errors, (std::vector<float>{2, 2}));
        EXPECT_EQ(all.worst.row, 2u);
        EXPECT_EQ(all.worst.output, 1u);
        EXPECT_EQ(all.tightest.row, 8u) << "twice its limit";
        EXPECT_EQ(all.farthest_back.row, 5u);
        EXPECT_EQ(all.farthest_back.error, 0.5);
        EXPECT_EQ(all.farthest_back.got, 0.5);
        EXPECT_EQ(all.farthest_back.expected, 1);
    }
}

// Nearest ranks from below; a limit may be passed by the definition's own rounding; exactly 0 needs none.
TEST(ProbeText, MediansPercentilesAndLimits) {
    Probe probe;
    probe.make = [](Random&, std::size_t row, float* in) { in[0] = static_cast<float>(row); };
    Tally tally;
    for (int i = 0; i < 2001; ++i) tally.value(0, 0, static_cast<float>(i), 0, 1e6, 1);
    const Result result = concluded(probe, tally);
    EXPECT_EQ(result.median, 1000);
    EXPECT_EQ(result.p999, 1998);
    EXPECT_TRUE(result.passed);
    EXPECT_TRUE(result.tally.errors.empty());
    EXPECT_FALSE(concluded(probe, {}).passed) << "nothing was evaluated";
    Tally limits;
    limits.value(0, 0, 1, 1 + 0x1p-46, 0, 1);
    EXPECT_EQ(limits.failures, 0u);
    limits.value(1, 0, 1, 1 + 0x1p-45, 0, 1);
    EXPECT_EQ(limits.failures, 1u);
    Tally zero;
    zero.value(0, 0, 0, 0, 0, 1);
    EXPECT_EQ(zero.tightest.error, 0);
    zero.value(1, 0, 0x1p-140f, 0, 0, 1);
    EXPECT_EQ(zero.tightest.error, std::numeric_limits<double>::max()) << "of no limit";
}

}  // namespace
}  // namespace diptych::probe
