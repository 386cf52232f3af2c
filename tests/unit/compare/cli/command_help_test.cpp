// SPDX-License-Identifier: MIT
// --help of each command: the options that it shows.
#include "compare/cli/command_line.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace diptych {

using namespace cli;

namespace {

TEST(CommandLine, EveryCommandHasHelpWithAnExample) {
    for (const Command& command : allCommands()) {
        const std::string help = parseCommandLine({command.name, "--help"}).help;
        EXPECT_TRUE(command.example.starts_with("diptych " + command.name + " ") ||
                    command.name == "devices");
        EXPECT_NE(help.find("Example: " + command.example), std::string::npos) << help;
        EXPECT_NE(parseCommandLine({"--help"}).help.find("  " + command.name + " "), std::string::npos);
    }
    EXPECT_EQ(parseCommandLine({"--version"}).help.find("diptych "), 0u);
}

// Options in a command's --help: the lines that begin with one.
std::vector<std::string> printedOptions(const std::vector<std::string>& words) {
    const std::string help = parseCommandLine(words).help;
    std::vector<std::string> options;
    for (std::size_t at = help.find("\n  -"); at != help.npos; at = help.find("\n  -", at + 1)) {
        const std::size_t name = help.find("--", at), end = help.find_first_of(" \n", name);
        options.push_back(help.substr(name + 2, end - name - 2));
    }
    return options;
}

// At most ten, all of them real options. --help all has all others, and --help states their number.
TEST(CommandLine, HelpBeginsWithTheOptionsUsedMost) {
    for (const Command& command : allCommands()) {
        const auto few = printedOptions({command.name, "--help"}),
                   all = printedOptions({command.name, "--help", "all"});
        EXPECT_EQ(printedOptions({command.name, "-h", "all"}), all);
        for (const std::string& option : few) EXPECT_EQ(std::ranges::count(all, option), 1) << option;
        if (command.most_used.empty()) {
            EXPECT_EQ(few, all) << command.name;
            EXPECT_LE(all.size(), 12u) << command.name << ": name those that are used most";
            continue;
        }
        std::istringstream words(command.most_used);
        const std::set<std::string> wanted(std::istream_iterator<std::string>(words), {});
        EXPECT_LE(wanted.size(), 10u) << command.name;
        EXPECT_EQ(std::set<std::string>(few.begin(), few.end()).size(), wanted.size() + 1)
            << command.name << ", with --help itself";
        for (const std::string& option : wanted) EXPECT_EQ(std::ranges::count(few, option), 1) << option;
        EXPECT_NE(parseCommandLine({command.name, "--help"})
                      .help.find(std::to_string(all.size() - few.size()) + " more options: diptych " +
                                 command.name + " --help all"),
                  std::string::npos)
            << command.name;
    }
}

// --help omits options that a command accepts for uniformity but does not read.
TEST(CommandLine, HelpShowsWhatTheCommandReads) {
    const auto help = [](const std::string& command) {
        return parseCommandLine({command, "--help", "all"}).help;
    };
    const std::pair<const char*, std::vector<const char*>> unread[] = {
        {"compare", {"--debug", "--heat", "--frames", "--fps"}},
        {"render", {"--times"}},
        {"bench", {"--debug", "--channels", "--exposure", "--kernels"}},
        {"plan", {"--exposure", "--runs", "--out", "--channels"}},
        {"devices", {"--size", "--exposure", "--lights", "--out"}},
    };
    for (const auto& [command, options] : unread)
        for (const char* option : options)
            EXPECT_EQ(help(command).find(std::string(option) + " "), std::string::npos)
                << command << " " << option;
    for (const char* option :
         {"--tolerances", "--gbuffer", "--exposure", "--match-exposure", "--color", "--allow-empty"})
        EXPECT_NE(help("compare").find(option), std::string::npos) << option;
    EXPECT_NE(help("compare").find("--times "), std::string::npos);
    for (const char* option : {"--debug ", "--frames ", "--fps "})
        EXPECT_NE(help("render").find(option), std::string::npos) << option;
    EXPECT_NO_THROW(parseCommandLine({"devices", "--size", "3x3"})) << "it is accepted yet";
}

TEST(CommandLine, HelpSaysWhatAnOptionMeansInItsCommand) {
    EXPECT_NE(parseCommandLine({"compare", "--help", "all"}).help.find("path that --update-baseline writes"),
              std::string::npos);
}

TEST(CommandLine, HelpShowsTheSettings) {
    const auto shows = [](const std::string& command, const std::string& option) {
        return parseCommandLine({command, "--help", "all"}).help.find("--" + option + " ") !=
               std::string::npos;
    };
    for (const std::string command : {"compare", "tradeoff", "bench"}) {
        for (const char* option : {"gbuffer",
                                   "cull",
                                   "lighting",
                                   "pixel-lights",
                                   "spp",
                                   "reference-mode",
                                   "ambient",
                                   "camera",
                                   "shadows",
                                   "shadow-kernel",
                                   "shadow-lights",
                                   "evsm-exponent",
                                   "env",
                                   "env-rotation",
                                   "env-sun",
                                   "ibl-intensity",
                                   "ibl",
                                   "ibl-diffuse",
                                   "haze",
                                   "haze-density",
                                   "haze-rayleigh",
                                   "haze-march-steps",
                                   "specular-albedo",
                                   "time",
                                   "animation",
                                   "variant",
                                   "msaa",
                                   "msaa-shading",
                                   "msaa-edges",
                                   "resolve",
                                   "alpha-to-coverage",
                                   "spec-aa",
                                   "spec-aa-variance",
                                   "spec-aa-limit",
                                   "spec-aa-normals",
                                   "spec-aa-kernel"})
            EXPECT_TRUE(shows(command, option)) << command << " " << option;
    }
    for (const char* option : {"env", "ibl-intensity", "shadows", "time", "animation", "gbuffer", "spp"})
        EXPECT_TRUE(shows("render", option)) << option;
}

}  // namespace
}  // namespace diptych
