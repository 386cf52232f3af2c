// SPDX-License-Identifier: MIT
#include "compare/tradeoff/grid.h"
#include "tests/unit/files.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace diptych {
namespace {

std::string faultOf(const std::string& text) {
    try {
        readGrids(text, {});
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "none";
}

TEST(TradeoffGrid, AProductAndAListOfThem) {
    const Grid grid =
        readGrids(R"({"settings": {"gbuffer": ["compact", "full"], "size": ["1/2", "8x4", [8, 4]],
                                    "sort": false, "light_cutoff": [0.001, "1e-2"]}})",
                  {})
            .front();
    ASSERT_EQ(grid.size(), 4u);
    EXPECT_EQ(grid[0], (Grid::value_type{"gbuffer", {"compact", "full"}}));
    EXPECT_EQ(grid[1], (Grid::value_type{"size", {"320x180", "8x4"}})) << "said twice, tried once";
    EXPECT_EQ(grid[2], (Grid::value_type{"sort", {"off"}}));
    EXPECT_EQ(grid[3], (Grid::value_type{"light-cutoff", {"0.001", "0.01"}}));
    EXPECT_EQ(readGrids(R"([{"settings": {}}, {"settings": {"path": "deferred"}}])", {}).size(), 2u);
}

TEST(TradeoffGrid, AFileSaysTheSame) {
    const std::filesystem::path file = folder() / "grid.json";
    std::ofstream(file) << R"({"settings": {"prepass": ["on", "off"]}})";
    EXPECT_EQ(readGrids(file.string(), {}), readGrids(R"({"settings": {"prepass": ["on", "off"]}})", {}));
}

TEST(TradeoffGrid, EveryFaultIsNamed) {
    const std::pair<const char*, const char*> bad[] = {
        {R"({"settings": )", "not JSON at byte"},
        {R"([])", "asks for nothing"},
        {R"({})", "\"settings\""},
        {R"([7])", "7 is no object"},
        {R"({"settings": [1]})", "\"settings\""},
        {R"({"settings": {}, "runs": 3})", "\"runs\": unknown"},
        {R"({"settings": {"gamma": [2]}})", "\"gamma\": no such setting; there are path, assign"},
        {R"({"settings": {"gbuffer": []}})", "\"gbuffer\": no value"},
        {R"({"settings": {"gbuffer": ["tiny"]}})", "--gbuffer tiny: not compact|standard|full"},
        {R"({"settings": {"size": ["1/0"]}})", "WxH"},
        {R"({"settings": {"size": [320, 180]}})", "320 is not WxH"},
        {R"({"settings": {"msaa": [4.5]}})", "4.5 is not"},
        {R"({"settings": {"time": [0, 1]}})", "--time says it for every row"},
        {R"({"settings": {"camera": ["a"]}})", "--camera says it"},
        {R"({"settings": {"gbuffer": "full", "gbuffer": "compact"}})", "\"gbuffer\" stands twice"},
        {R"({"settings": {"light_cutoff": [0], "light-cutoff": [1]}})", "stands twice"},
        {"/nowhere/grid.json", "/nowhere/grid.json: cannot be read"},
        {"/tmp", "/tmp: is a folder"},
    };
    for (const auto& [text, fault] : bad) {
        const std::string said = faultOf(text);
        EXPECT_NE(said.find(fault), std::string::npos) << text << ": " << said;
        EXPECT_TRUE(said.starts_with("--grid")) << said;
        EXPECT_EQ(said.find('\n'), std::string::npos) << said;
    }
    EXPECT_NE(faultOf(std::string(100000, '[')).find("nests deeper"), std::string::npos);
}

}  // namespace
}  // namespace diptych
