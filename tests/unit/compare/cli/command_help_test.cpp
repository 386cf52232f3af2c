// SPDX-License-Identifier: MIT
// --help of each command: the options that it shows.
#include "compare/audit/relations.h"
#include "compare/bench/cases.h"
#include "compare/cli/command_diff.h"
#include "compare/cli/command_line.h"
#include "compare/experiment/measures.h"
#include "tests/support/command_lines.h"
#include "tests/support/setting_samples.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <tuple>
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
}

TEST(CommandLine, HelpSaysWhatAnOptionMeansInItsCommand) {
    EXPECT_NE(parseCommandLine({"compare", "--help", "all"}).help.find("path that --update-baseline writes"),
              std::string::npos);
}

// The options of a command, as it describes them.
struct DescribedCommand {
    explicit DescribedCommand(const Command& command) { command.describe(app); }
    CLI::App app;
};

// Every Setting, by its row: text, printed default and values, and what the command line makes of a word.
TEST(CommandLine, EverySettingIsAnOptionAsItsRowSays) {
    using Option = std::pair<std::string, std::string_view>;
    const std::map<Option, std::string> own_texts{
        {{"compare", "path"}, "path that --update-baseline writes (the file's own)"},
        {{"audit", "size"}, "picture size, WxH (160x90)"},
        {{"audit", "shadows"}, "shadow technique (off, except for shadow quantities)"}};
    const std::set<Option> unread{{"audit", "path"}, {"choose", "path"}, {"explain", "path"}};
    const Settings defaults, changed = everythingChanged();
    std::size_t commands = 0;
    for (const Command& command : allCommands()) {
        if (dynamic_cast<const SettingsGroup*>(command.line.get()) == nullptr) continue;
        ++commands;
        const DescribedCommand described(command);
        Settings expected = changed;
        std::vector<std::string> words{command.name};
        for (const Field& field : settingFields()) {
            SCOPED_TRACE(fmt::format("{} --{}", command.name, field.option));
            if (command.name == "bench" && field.option == "assign") {  // its own list
                expected.assign = defaults.assign;
                continue;
            }
            const CLI::Option* const option =
                described.app.get_option_no_throw(fmt::format("--{}", field.option));
            ASSERT_NE(option, nullptr);
            const std::string value = defaults.valueOf(field.option);
            std::string text = fmt::format("{}{}", field.help, value.empty() ? "" : " (" + value + ")");
            if (const auto own = own_texts.find({command.name, field.option}); own != own_texts.end())
                text = own->second;
            if (field.option == "camera") {
                EXPECT_TRUE(option->get_description().starts_with(text + "; repeatable."));
            } else {
                EXPECT_EQ(option->get_description(), text);
                EXPECT_EQ(option->get_type_name(), acceptedValues(field.option));
            }
            EXPECT_EQ(option->get_group().empty(),
                      command.name == "devices" || unread.contains({command.name, field.option}));
            words.push_back(fmt::format("--{}={}", field.option, changed.valueOf(field.option)));
        }
        EXPECT_EQ(parsedAs<SettingsGroup>(words).settings, expected) << command.name;
        EXPECT_EQ(parsedAs<SettingsGroup>({command.name}).settings, defaults) << command.name;
    }
    EXPECT_EQ(commands, 10u);
}

// The help of an option that takes names from a table has all of them, in the table's order.
TEST(CommandLine, HelpNamesAllThatAnOptionChoosesFrom) {
    const auto namesOf = [](const auto& table) {
        std::vector<std::string_view> names;
        for (const auto& row : table) names.push_back(row.name);
        return names;
    };
    std::vector<std::string_view> axes;
    for (int axis = 0; axis <= static_cast<int>(bench::GrowthAxis::pixels); ++axis)
        axes.push_back(nameOf(static_cast<bench::GrowthAxis>(axis)));
    const std::tuple<std::string, const char*, std::vector<std::string_view>, const char*> options[] = {
        {"audit", "--quantity", namesOf(audit::quantities()), ", "},
        {"audit", "--relation", namesOf(audit::relations()), ", "},
        {"bench", "--axes", axes, ", "},
        {"choose", "--figure", namesOf(experiment::errorMetrics), "|"}};
    for (const auto& [name, option, names, separator] : options) {
        ASSERT_GE(names.size(), 3u);
        const std::vector<Command> commands = allCommands();
        const DescribedCommand described(*std::ranges::find(commands, name, &Command::name));
        const CLI::Option& found = *described.app.get_option(option);
        const std::string help = fmt::format(" {} {} ", found.get_type_name(), found.get_description()),
                          all = fmt::format("{}", fmt::join(names, separator));
        const std::size_t at = help.find(all);
        ASSERT_NE(at, help.npos) << option << ": " << all << "\n" << help;
        EXPECT_EQ(help[at - 1], ' ');
        EXPECT_NE(std::string(". ").find(help[at + all.size()]), std::string::npos) << "and no other";
    }
}

// Printed defaults that no variable of the parser holds, because the command finds the value.
std::set<std::string> foundDefaults() {
    return {"scenes (builtin:gallery)",
            "report (all failing ones)",
            "--assign (all supported)",
            "--at-once (no limit)",
            "--axes (all)",
            "--channel (all failing ones)",
            "--channels (all)",
            "--color (auto: on a terminal, unless NO_COLOR is set)",
            "--debug (lit)",
            "--device (a GPU if there is one)",
            "--fps (30)",
            "--frames (1)",
            "--grid (each Setting alone, and declared pairs)",
            "--grid (each Setting alone, and helpful combinations)",
            "--light-counts (the scene's own lights; --table layers: 1,64,1024)",
            "--lightings (--lighting)",
            "--metric (flip)",
            "--out (accepted.json)",
            "--out (diptych-bench)",
            "--out (diptych-render)",
            "--out (diptych-report)",
            "--out (diptych-tradeoff)",
            "--out (the current one)",
            "--paths (deferred,forward_plus)",
            "--shards (one per scene, at most 16)",
            "--sizes (--size)",
            "--start-exposure (from the reference)",
            "--test (path: the other path)",
            "--times (--time)",
            "--timings (by file size)",
            "--tolerance (none: only equal values pass)",
            "--transparencies (--transparency)"};
}

// A default in parentheses ends the text of an option. It is the value that the option's variable has.
TEST(CommandLine, PrintedDefaultsAreThoseThatAreUsed) {
    static const std::regex ending(R"(\(([^()]*)\)$)");
    const std::set<std::string> unset{"", "[]", "0"};
    std::set<std::string> seen;
    for (const Command& command : allCommands()) {
        DescribedCommand described(command);
        for (CLI::Option* const option : described.app.get_options()) {
            const std::string name =
                option->get_lnames().empty() ? option->get_name() : "--" + option->get_lnames().front();
            const std::string text = option->get_description();
            const bool isList = command.name == "bench" && name == "--assign";
            std::smatch found;
            if (!std::regex_search(text, found, ending)) continue;
            if (!isList && name.starts_with("--") &&
                std::ranges::count(settingFields(), name.substr(2), &Field::option) > 0)
                continue;  // the test above has it
            const std::string printed = found[1], value = option->capture_default_str()->get_default_str();
            if (name == "--runs") {
                EXPECT_EQ(printed, std::to_string(dynamic_cast<const SceneGroup&>(*command.line).runs));
            } else if (printed != value) {
                EXPECT_TRUE(unset.contains(value)) << command.name << " " << name << ": is " << value;
                seen.insert(name + " (" + printed + ")");
            }
        }
    }
    EXPECT_EQ(seen, foundDefaults());
}

// A default that the command line accepts means the same as omitting the option.
TEST(CommandLine, SayingADefaultChangesNothing) {
    const auto plain = parsedAs<SceneGroup>({"render"});
    const auto said = parsedAs<SceneGroup>({"render", "builtin:gallery", "--debug", "lit", "--channels",
                                            "all", "--frames", "1", "--fps", "30", "--color", "auto"});
    EXPECT_EQ(said.scenes, plain.scenes);
    EXPECT_EQ(said.shown, plain.shown);
    EXPECT_EQ(said.channels, plain.channels);
    EXPECT_EQ(said.frames, plain.frames);
    EXPECT_EQ(said.fps, plain.fps);
    EXPECT_EQ(said.color, plain.color);
    EXPECT_EQ(parsedAs<DiffLine>({"diff", "a", "b", "--metric", "flip"}).diff.metric,
              parsedAs<DiffLine>({"diff", "a", "b"}).diff.metric);
}

}  // namespace
}  // namespace diptych
