// SPDX-License-Identifier: MIT
// The command line of a report, which may come from anywhere.
#include "compare/cli/command_view.h"
#include "tests/support/errors.h"

#include <gtest/gtest.h>

#include <iterator>
#include <sstream>
#include <string>
#include <vector>

namespace diptych {

using namespace cli;

namespace {

// A report may come from anywhere. Its command must not write or run anything, only choose what is shown.
TEST(CommandLine, OfAReportsCommandOnlyWhatIsShownIsTaken) {
    const std::string camera = "eye=0,0,1 target=0,0,0 fov=40";
    std::istringstream others(
        "-o x --renderer evil=nowhere.json --renderer=evil=nowhere.json --gbuffer compact --env -o "
        "--ibl-bias=-1 --baseline reference --crop 0,0,8x8 --ids 1,2 --allow-noise -- -a.glb");
    std::vector<std::string> reported{"compare", "--camera", camera};
    reported.insert(reported.end(), std::istream_iterator<std::string>(others),
                    std::istream_iterator<std::string>());
    const ViewLine parsed = parseReported(reported);
    EXPECT_EQ(parsed.out, "");
    EXPECT_TRUE(parsed.renderers.empty());
    EXPECT_EQ(parsed.settings.gbuffer, GBufferEncoding::compact);
    EXPECT_EQ(parsed.settings.env, "-o");
    EXPECT_EQ(parsed.settings.ibl_bias, -1);
    EXPECT_EQ(parsed.settings.camera, camera);
    EXPECT_EQ(parsed.baseline, Path::reference);
    EXPECT_EQ(parsed.selection.ids, (std::vector<int>{1, 2}));
    EXPECT_TRUE(parsed.allow_noise);
    EXPECT_EQ(parsed.scenes, std::vector<std::string>{"-a.glb"});
    for (const std::string words :
         {"--update-baseline", "--out x", "--out=x", "-ox", "--force", "--settings /dev/zero", "--validate",
          "--report x", "--watch", "--pixel 1,1", "--help", "--manual", "--match-exposure a.exr",
          "--shard 1/2", "--gbuffer", "-"}) {
        std::istringstream stream("compare a.glb " + words);
        const std::vector<std::string> command{std::istream_iterator<std::string>(stream), {}};
        const std::string refusal = faultOf([&] { parseReported(command); });
        EXPECT_TRUE(refusal.starts_with("the command of the comparison ")) << refusal;
        EXPECT_NE(refusal.find(words.substr(0, words.find_first_of("= "))), std::string::npos) << refusal;
    }
}

}  // namespace
}  // namespace diptych
