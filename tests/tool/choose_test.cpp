// SPDX-License-Identifier: MIT
// choose: what is chosen is within its budget, and what cannot be is said.
#include "tests/tool/run.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace diptych {

namespace {

using Json = nlohmann::json;

constexpr const char* grid =
    "--grid '{\"settings\":{\"path\":[\"deferred\",\"forward_plus\"],\"gbuffer\":[\"compact\",\"full\"],"
    "\"size\":[\"1/2\",\"1/1\"]}}'";

TEST(ChooseTool, TheChosenSettingsAreWithinTheErrorAndDrawn) {
    const Folder folder;
    const Ran ran =
        runTool(folder, fmt::format("choose builtin:spots --size 64x36 --max-error 0.02 {} --json "
                                    "-o chosen.json",
                                    grid));
    ASSERT_EQ(ran.code, 0) << ran.err;
    const Json json = Json::parse(ran.out);
    const Json& chosen = json["candidates"][json["chosen"].get<std::size_t>()];
    EXPECT_LE(chosen["error"].get<double>(), 0.02);
    EXPECT_EQ(json["settings"]["size"], Json({64, 36})) << "half the size is off by more";
    EXPECT_EQ(json["candidates"].size(), 8u);
    for (const Json& candidate : json["candidates"])
        if (candidate["fate"] == "raced") {
            EXPECT_LE(candidate["error"].get<double>(), 0.02);
        }
    EXPECT_EQ(json["unseen_cameras"].size(), 0u);
    EXPECT_EQ(Json::parse(std::ifstream(folder / "chosen.json"))["size"], Json({64, 36}));
    EXPECT_EQ(runTool(folder, "render builtin:spots --settings chosen.json -o chosen.png").code, 0);
}

TEST(ChooseTool, WhereNothingFitsTheNearestIsNamedWithItsGap) {
    const Folder folder;
    const Ran ran =
        runTool(folder, fmt::format("choose builtin:spots --size 64x36 --max-error 1e-9 {}", grid));
    EXPECT_EQ(ran.code, 1) << ran.err;
    EXPECT_NE(ran.out.find("nothing fits; the nearest is"), ran.out.npos) << ran.out;
    EXPECT_NE(ran.out.find("over the error of 1e-09"), ran.out.npos) << ran.out;
    const Ran little =
        runTool(folder, fmt::format("choose builtin:spots --size 64x36 --max-bytes 1KiB {} --json", grid));
    EXPECT_EQ(little.code, 1) << little.err;
    EXPECT_TRUE(Json::parse(little.out)["settings"].is_null());
}

// Without a limit to speak of the most accurate is the one whose G-buffer packs nothing, or forward+.
TEST(ChooseTool, TheMostAccurateWithinATime) {
    const Folder folder;
    const Ran ran =
        runTool(folder, fmt::format("choose builtin:spots --size 64x36 --max-ms 100000 {} --json", grid));
    ASSERT_EQ(ran.code, 0) << ran.err;
    const Json json = Json::parse(ran.out);
    const double error = json["candidates"][json["chosen"].get<std::size_t>()]["error"];
    for (const Json& candidate : json["candidates"])
        if (!candidate["error"].is_null()) {
            EXPECT_LE(error, 1.01 * candidate["error"].get<double>());
        }
}

TEST(ChooseTool, RefusesWhatItCannotDo) {
    const Folder folder;
    folder.write("foreign.json", "[ 1 ]");
    for (const auto& [options, word] : {std::pair{"", "--max-error"},
                                        {"--max-error -1", "--max-error"},
                                        {"--max-error 1 --figure ssim", "relative_rmse"},
                                        {"--max-ms 0", "--max-ms"},
                                        {"--max-bytes 5MB", "MiB"},
                                        {"--max-error 1 -o foreign.json", "--force"},
                                        {"--max-error 1 -o chosen.png", ".json"},
                                        {"--max-error 1 --explain-choice", "not built"},
                                        {"--max-error 1 --path reference", "reference"}}) {
        const Ran ran = runTool(folder, fmt::format("choose builtin:triangle --size 16x16 {}", options));
        EXPECT_EQ(ran.code, 2) << options;
        EXPECT_NE(ran.err.find(word), ran.err.npos) << ran.err;
    }
}

}  // namespace

}  // namespace diptych
