// SPDX-License-Identifier: MIT
// Options that a command accepts and cannot use are named on stderr, each in a line. Without them, commands
// print nothing there (tests of each command).
#include "tests/tool/run.h"

#include <string>
#include <vector>

namespace diptych {
namespace {

TEST(UnusedOptions, AreNamed) {
    struct Case {
        std::string command;
        std::vector<std::string> lines;
    };
    const Case cases[] = {
        {"compare builtin:triangle --channels lit --path deferred --heat --debug albedo -o c",
         {"--path is not used: compare renders both",
          "--heat is not used: the report shows every channel, including light_count",
          "--debug is not used: the report shows every channel"}},
        {"compare builtin:triangle --pixel 8,5 --crop 0,0,4x4 --channels lit",
         {"--mask, --ids, --ignore-edges and --crop are not used: --pixel selects the pixel",
          "--channels is not used: --pixel prints every channel"}},
        {"bench builtin:triangle --sizes 16x9 --paths deferred --light-counts 1 --debug albedo --channels "
         "lit -o b",
         {"--debug is not used: bench writes no image of a channel",
          "--channels is not used: bench writes no channels"}},
        {"tradeoff builtin:triangle --grid '{\"settings\":{\"path\":[\"deferred\"]}}' --debug albedo "
         "--channels lit -o t",
         {"--debug is not used: errors are measured in lit",
          "--channels is not used: errors are measured in lit"}},
    };
    const Folder folder;
    for (const Case& c : cases) {
        const bool sized = c.command.starts_with("bench");
        const Ran ran = runTool(folder, c.command + (sized ? " --runs 1" : " --size 16x9 --runs 1"));
        EXPECT_LE(ran.code, 1) << ran.err;
        std::string expected;
        for (const std::string& line : c.lines) expected += "diptych: " + line + "\n";
        EXPECT_EQ(ran.err, expected) << c.command;
    }
}

}  // namespace
}  // namespace diptych
