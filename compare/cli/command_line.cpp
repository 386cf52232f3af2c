// SPDX-License-Identifier: MIT
#include "compare/cli/command_line.h"

#include "compare/cli/add_option.h"
#include "compare/cli/manual.h"
#include "compare/run/version.h"
#include "shared/scene/builtin/builtin.h"
#include "shared/text/counted.h"
#include "shared/text/did_you_mean.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string_view>

namespace diptych::cli {

namespace {

// CLI11 flags take values only after "=": joins "--heat off" into "--heat=off".
std::vector<std::string> joinFlagValues(const std::vector<std::string>& words) {
    std::vector<std::string> joined;
    for (const std::string& word : words)
        if (!joined.empty() && joined.back() == "--heat" && (word == "on" || word == "off" || word == "none"))
            joined.back() += word == "on" ? "=true" : "=false";
        else
            joined.push_back(word == "--heat=none" ? "--heat=false" : word);
    return joined;
}

// Rewrites CLI11's "--size: At Most 1 required but received 3".
std::string inOurTerms(const std::string& error) {
    constexpr std::string_view tooOften = ": At Most 1 required but received ";
    const std::size_t at = error.find(tooOften);
    if (at == std::string::npos) return error;
    return fmt::format("{}: given {} times; once is enough", error.substr(0, at),
                       error.substr(at + tooOften.size()));
}

std::vector<std::string> builtinScenes() {
    std::vector<std::string> names;
    for (const BuiltinName& row : builtinNames()) names.push_back("builtin:" + row.name);
    return names;
}

// The likely intended option for CLI11's "The following argument was not expected: --sise".
std::string meantOption(const std::string& error, const CLI::App& app) {
    const std::size_t at = error.find("--");
    if (at == error.npos) return {};
    const std::string word = error.substr(at, error.find_first_of(" =", at) - at);
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_options())
        if (!option->get_lnames().empty()) names.push_back("--" + option->get_lnames().front());
    return didYouMean(word, names);
}

Command& commandOf(std::vector<Command>& commands, const CLI::App& sub) {
    return *std::ranges::find(commands, sub.get_name(), &Command::name);
}

// Removes the word of "--help all"; "--help" prints the options used most. Returns whether it was there.
bool takeAll(std::vector<std::string>& words) {
    bool taken = false;
    for (std::size_t i = 1; i < words.size(); ++i)
        if (words[i] == "all" && (words[i - 1] == "--help" || words[i - 1] == "-h")) {
            words.erase(words.begin() + static_cast<std::ptrdiff_t>(i));
            taken = true;
        }
    return taken;
}

// The command that the first word names; nullptr if it is an option.
const Command* commandIn(const std::vector<Command>& commands, const std::vector<std::string>& words) {
    if (words.empty()) refuse("a command is missing; see diptych --help");
    const auto found = std::ranges::find(commands, words.front(), &Command::name);
    if (found != commands.end()) return &*found;
    if (words.front().starts_with('-')) return nullptr;
    std::vector<std::string> names;
    for (const Command& command : commands) names.push_back(command.name);
    refuse("{}: no such command{}; see diptych --help", words.front(), didYouMean(words.front(), names));
}

// CLI11 accepts C literals: "0x10" would mean 16.
void refuseHexadecimals(CLI::App& app) {
    constexpr std::array<std::string_view, 9> numbers{"F",      "N",     "K",     "T",     "E",
                                                      "PIXELS", "STOPS", "SHARE", "ID,..."};
    for (CLI::Option* option : app.get_options())
        if (std::ranges::count(numbers, option->get_type_name()) > 0)
            option->check([](const std::string& word) {
                return word.find_first_of("xX") == word.npos
                           ? std::string()
                           : word + " is not a decimal number; write for example 0.5";
            });
}

void describeProgram(CLI::App& app, const std::vector<Command>& commands) {
    app.set_version_flag("--version", std::string("diptych ") + versionName());
    app.require_subcommand(0, 1);
    app.get_formatter()->column_width(44);
    app.footer(
        "Example: diptych compare builtin:gallery\nCOMMAND --help lists its common options, COMMAND --help "
        "all every option.\nExit codes: 0 parity, 1 difference beyond tolerance, 2 error.");
    for (const Command& command : commands) {
        CLI::App& sub = *app.add_subcommand(command.name, command.does);
        sub.footer("Example: " + command.example + command.more_help);
        command.describe(sub);
        refuseHexadecimals(sub);
    }
}

// Hides all options but the most used ones. Returns how many it hid.
std::size_t hideSeldomUsed(CLI::App& app, const std::string& most_used) {
    if (most_used.empty()) return 0;
    const std::string names = " " + most_used + " ";
    std::size_t hidden = 0;
    for (CLI::Option* option : app.get_options()) {
        if (option->get_group().empty() || option->get_positional() || option == app.get_help_ptr()) continue;
        const bool shown = std::ranges::any_of(option->get_lnames(), [&](const std::string& name) {
            return names.find(" " + name + " ") != names.npos;
        });
        if (shown) continue;
        option->group("");
        ++hidden;
    }
    return hidden;
}

// The help of the given command, or of the program.
std::string helpText(CLI::App& app, std::vector<Command>& commands, bool every_option) {
    const CLI::App* chosen = &app;
    for (CLI::App* sub : app.get_subcommands()) {
        chosen = sub;
        const std::size_t more = every_option ? 0 : hideSeldomUsed(*sub, commandOf(commands, *sub).most_used);
        if (more > 0)
            sub->footer(fmt::format("{}: diptych {} --help all\n\n{}", counted(more, "more option"),
                                    sub->get_name(), sub->get_footer()));
    }
    return chosen->help(chosen == &app ? "" : "diptych");
}

std::string parseErrorText(const CLI::App& app, const CLI::ParseError& error) {
    const CLI::App* chosen = &app;
    for (const CLI::App* sub : app.get_subcommands()) chosen = sub;
    return fmt::format(
        "{}{}; see diptych {}--help", inOurTerms(error.what()),
        dynamic_cast<const CLI::ExtrasError*>(&error) ? meantOption(error.what(), *chosen) : "",
        chosen == &app ? "" : chosen->get_name() + " ");
}

}  // namespace

CommandLine parseCommandLine(const std::vector<std::string>& requested) {
    std::vector<Command> commands = allCommands();
    std::vector<std::string> words = requested;
    const Command* const first = commandIn(commands, words);
    if (first != nullptr && first->submitted != nullptr) {
        const auto end = std::ranges::find(words, "--");
        if (end != words.end()) first->submitted->assign(end + 1, words.end());
        words.erase(end, words.end());
    }
    const bool every_option = takeAll(words);
    CLI::App app(
        "Renders a glTF scene with a deferred and a forward+ renderer and reports where the two differ,\nby "
        "how much, why, and what each costs.",
        "diptych");
    bool manual = false;
    std::string shell;
    describeProgram(app, commands);
    app.add_flag("--manual", manual, "print the manual page (view it with man -l -)");
    addOption(app, "--completion", shell, std::string(completedShells), "print a shell completion script");
    try {
        words = joinFlagValues(words);
        app.parse(std::vector<std::string>(words.rbegin(), words.rend()));  // CLI11 reads from the back
    } catch (const CLI::CallForHelp&) {
        return {helpText(app, commands, every_option)};
    } catch (const CLI::CallForVersion& version) {
        return {std::string(version.what()) + "\n"};
    } catch (const CLI::ParseError& error) {
        throw std::runtime_error(parseErrorText(app, error));
    }
    if (manual) return {manualPage(app, std::string("diptych ") + versionName())};
    if (!shell.empty()) return {completion(app, shell, builtinScenes())};
    if (app.get_subcommands().empty()) refuse("a command is missing; see diptych --help");
    Command& chosen = commandOf(commands, *app.get_subcommands().front());
    chosen.resolve();
    return {"", std::move(chosen)};
}

}  // namespace diptych::cli
