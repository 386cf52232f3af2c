// SPDX-License-Identifier: MIT
#include "compare/experiment/grid.h"
#include "tests/support/errors.h"
#include "tests/support/files.h"

#include <gtest/gtest.h>

#include <random>
#include <stdexcept>

namespace diptych::experiment {
namespace {

std::string gridFault(const std::string& text) {
    return faultOf([&] { readGrids(text, {}); });
}

TEST(ExperimentGrid, AProductAndAListOfThem) {
    const Grid grid =
        readGrids(R"({"settings": {"gbuffer": ["compact", "full"], "size": ["1/2", "8x4", [8, 4]],
                                    "transparency": "unsorted", "light_cutoff": [0.001, "1e-2"]}})",
                  {})
            .front();
    ASSERT_EQ(grid.size(), 4u);
    EXPECT_EQ(grid[0], (Grid::value_type{"gbuffer", {"compact", "full"}}));
    EXPECT_EQ(grid[1], (Grid::value_type{"size", {"320x180", "8x4"}})) << "said twice, tried once";
    EXPECT_EQ(grid[2], (Grid::value_type{"transparency", {"unsorted"}}));
    EXPECT_EQ(grid[3], (Grid::value_type{"light-cutoff", {"0.001", "0.01"}}));
    EXPECT_EQ(readGrids(R"([{"settings": {}}, {"settings": {"path": "deferred"}}])", {}).size(), 2u);
}

TEST(ExperimentGrid, AFileSaysTheSame) {
    const std::filesystem::path file = folder() / "grid.json";
    std::ofstream(file) << R"({"settings": {"prepass": ["on", "off"]}})";
    EXPECT_EQ(readGrids(file.string(), {}), readGrids(R"({"settings": {"prepass": ["on", "off"]}})", {}));
}

TEST(ExperimentGrid, EveryFaultIsNamed) {
    const std::pair<const char*, const char*> bad[] = {
        {R"({"settings": )", "is not JSON: parse error at line 1, column 14"},
        {R"([])", "--grid: is an empty list"},
        {R"({})", "\"settings\""},
        {R"([7])", "7 is not an object"},
        {R"({"settings": [1]})", "\"settings\""},
        {R"({"settings": {}, "runs": 3})", "\"runs\": unknown"},
        {R"({"settings": {"gamma": [2]}})", "\"gamma\": no such setting; there are path, assign"},
        {R"({"settings": {"gbuffer": []}})", "\"gbuffer\": has no value"},
        {R"({"settings": {"gbuffer": ["tiny"]}})", "--gbuffer tiny: not compact|standard|full"},
        {R"({"settings": {"size": ["1/0"]}})", "WxH"},
        {R"({"settings": {"size": [320, 180]}})", "320 is not WxH"},
        {R"({"settings": {"msaa": [4.5]}})", "4.5 is not"},
        {R"({"settings": {"time": [0, 1]}})", "--time sets it for every row"},
        {R"({"settings": {"camera": ["a"]}})", "--camera sets it"},
        {R"({"settings": {"gbuffer": "full", "gbuffer": "compact"}})", "\"gbuffer\" appears twice"},
        {R"({"settings": {"light_cutoff": [0], "light-cutoff": [1]}})", "appears twice"},
        {"/nowhere/grid.json", "/nowhere/grid.json: no such file"},
        {"/tmp", "/tmp: is a folder"},
    };
    for (const auto& [text, fault] : bad) {
        const std::string said = gridFault(text);
        EXPECT_NE(said.find(fault), std::string::npos) << text << ": " << said;
        EXPECT_TRUE(said.starts_with("--grid")) << said;
        EXPECT_EQ(said.find('\n'), std::string::npos) << said;
    }
    EXPECT_NE(gridFault(std::string(100000, '[')).find("nested deeper"), std::string::npos);
}

// Changes, removes and inserts bytes: the result is a plan, or one line with the reason.
TEST(ExperimentGrid, WhateverItHoldsIsPlannedOrRefused) {
    const std::string sound =
        R"([{"settings": {"gbuffer": ["compact", "full"], "size": ["1/2", "8x4", [8, 4]], "msaa": [1, 4]}},
            {"settings": {"transparency": ["sorted", "triangles"], "light_cutoff": [0.001, "0e-2"]}}])";
    const std::string pieces[] = {"[", "]", "{", "}", "\"", "\\n",  "\\u0000", "1e999",
                                  "/", "0", "-", ",", ":",  "\xff", "null"};
    std::mt19937 random(3);
    const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random()) % n; };
    int planned = 0, refused = 0;
    for (int trial = 0; trial < 1500; ++trial) {
        std::string text = sound;
        for (std::size_t change = below(4); change > 0; --change)
            text.replace(
                below(text.size()), below(4),
                below(2) ? pieces[below(std::size(pieces))] : std::string(1, static_cast<char>(below(256))));
        try {
            makeSweepRows({}, readGrids("[" + text.substr(1), {}));
            ++planned;
        } catch (const std::runtime_error& error) {
            const std::string what = error.what();
            ASSERT_TRUE(what.find('\n') == std::string::npos && what.size() < 400) << text << "\n" << what;
            ++refused;
        }
    }
    EXPECT_GT(planned, 200);
    EXPECT_GT(refused, 200);
}

}  // namespace
}  // namespace diptych::experiment
