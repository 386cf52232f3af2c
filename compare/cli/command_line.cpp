// SPDX-License-Identifier: MIT
#include "compare/cli/command_line.h"

#include "compare/cli/command_options.h"
#include "compare/cli/manual.h"
#include "compare/cli/resolve_options.h"
#include "compare/run/version.h"
#include "compare/viewer/keys.h"
#include "shared/scene/builtin/builtin.h"
#include "shared/text/counted.h"
#include "shared/text/did_you_mean.h"
#include "shared/text/one_line.h"

#include <fmt/format.h>

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
std::string inOurWords(const std::string& error) {
    constexpr std::string_view tooOften = ": At Most 1 required but received ";
    const std::size_t at = error.find(tooOften);
    if (at == std::string::npos) return error;
    return fmt::format("{}: given {} times; once is enough", error.substr(0, at),
                       error.substr(at + tooOften.size()));
}

std::vector<std::string> commandNames() {
    std::vector<std::string> names;
    for (const Command& command : allCommands()) names.push_back(command.name);
    return names;
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

// The words of the command line, apart from those that CLI11 does not parse.
struct CommandWords {
    std::vector<std::string> parsed, submitted;  // submit: of the command after --
    bool every_option = false;                   // "--help all"; "--help" prints the most used ones
};

CommandWords splitWords(const std::vector<std::string>& given) {
    CommandWords words{given, {}};
    std::vector<std::string>& parsed = words.parsed;
    if (!given.empty() && given.front() == "submit") {
        const auto end = std::ranges::find(parsed, "--");
        if (end != parsed.end()) words.submitted.assign(end + 1, parsed.end());
        parsed.erase(end, parsed.end());
    }
    for (std::size_t i = 1; i < parsed.size(); ++i)
        if (parsed[i] == "all" && (parsed[i - 1] == "--help" || parsed[i - 1] == "-h")) {
            parsed.erase(parsed.begin() + static_cast<std::ptrdiff_t>(i));
            words.every_option = true;
        }
    return words;
}

void refuseUnknownCommand(const std::vector<std::string>& words) {
    if (words.empty()) throw std::runtime_error("a command is missing; see diptych --help");
    const auto known = [&](const Command& command) { return command.name == words.front(); };
    if (!words.front().starts_with('-') && std::ranges::none_of(allCommands(), known))
        throw std::runtime_error(fmt::format("{}: no such command{}; see diptych --help", words.front(),
                                             didYouMean(words.front(), commandNames())));
}

void describeProgram(CLI::App& app, Options& options, ParsedOptions& parsed) {
    app.set_version_flag("--version", std::string("diptych ") + versionName());
    app.require_subcommand(0, 1);
    app.get_formatter()->column_width(44);
    app.footer(
        "Example: diptych compare builtin:gallery\nCOMMAND --help lists its common options, COMMAND --help "
        "all every option.\nExit codes: 0 parity, 1 difference beyond tolerance, 2 error.");
    for (const Command& command : allCommands()) {
        CLI::App& sub = *app.add_subcommand(command.name, command.does);
        sub.footer("Example: " + command.example +
                   (command.name == "view" ? "\n\nKeys:\n" + viewer::keyColumns() : ""));
        describe(sub, command.name, options, parsed);
    }
}

// The help of the given command, or of the program.
std::string helpText(CLI::App& app, bool every_option) {
    const CLI::App* chosen = &app;
    for (CLI::App* sub : app.get_subcommands()) {
        chosen = sub;
        const std::size_t more =
            every_option
                ? 0
                : hideSeldomUsed(*sub, *std::ranges::find(allCommands(), sub->get_name(), &Command::name));
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
        "{}{}; see diptych {}--help", inOurWords(error.what()),
        dynamic_cast<const CLI::ExtrasError*>(&error) ? meantOption(error.what(), *chosen) : "",
        chosen == &app ? "" : chosen->get_name() + " ");
}

}  // namespace

Options parseCommandLine(const std::vector<std::string>& given) {
    const CommandWords words = splitWords(given);
    Options options;
    options.submit.words = words.submitted;
    options.scenes.clear();
    ParsedOptions parsed;
    CLI::App app(
        "Renders a glTF scene with a deferred and a forward+ renderer and reports where the two differ,\nby "
        "how much, why, and what each costs.",
        "diptych");
    bool manual = false;
    std::string shell;
    describeProgram(app, options, parsed);
    app.add_flag("--manual", manual, "print the manual page (view it with man -l -)");
    app.add_option("--completion", shell, "print a shell completion script")
        ->type_name(std::string(completedShells));
    refuseUnknownCommand(words.parsed);
    try {
        const std::vector<std::string> joined = joinFlagValues(words.parsed);
        app.parse(std::vector<std::string>(joined.rbegin(), joined.rend()));  // CLI11 reads from the back
        if (manual) {
            options.help = manualPage(app, std::string("diptych ") + versionName());
            return options;
        }
        if (!shell.empty()) {
            options.help = completion(app, shell, builtinScenes());
            return options;
        }
        if (app.get_subcommands().empty())
            throw std::runtime_error("a command is missing; see diptych --help");
    } catch (const CLI::CallForHelp&) {
        options.help = helpText(app, words.every_option);
        return options;
    } catch (const CLI::CallForVersion& version) {
        options.help = std::string(version.what()) + "\n";
        return options;
    } catch (const CLI::ParseError& error) {
        throw std::runtime_error(parseErrorText(app, error));
    }
    options.command = app.get_subcommands().front()->get_name();
    resolve(options, parsed);
    return options;
}

Options parseReported(const std::vector<std::string>& words) {
    constexpr std::array taken{"--baseline", "--tolerances",  "--against-device", "--device",
                               "--mask",     "--ids",         "--ignore-edges",   "--crop",
                               "--deferred", "--forward-plus"};
    constexpr std::array flags{"--allow-noise", "--strict", "--allow-empty"};
    constexpr std::array left_out{"-o", "--renderer"};
    const auto isOneOf = [](const auto& options, const std::string& name) {
        return std::ranges::find(options, name) != options.end();
    };
    const auto isSetting = [](const std::string& name) {
        return std::ranges::any_of(
            settingFields(), [&](const Field& field) { return name == "--" + std::string(field.option); });
    };
    std::vector<std::string> read{"view"};
    for (std::size_t i = 1; i < words.size(); ++i) {
        const std::string& word = words[i];
        const std::string name = word.substr(0, word.find('='));
        if (word == "--") {  // scenes follow
            read.insert(read.end(), words.begin() + static_cast<std::ptrdiff_t>(i), words.end());
            break;
        }
        if (!word.starts_with('-') || isOneOf(flags, word)) {
            read.push_back(word);
            continue;
        }
        const bool unread = isOneOf(left_out, name);
        if (!unread && !isOneOf(taken, name) && !isSetting(name))
            throw std::runtime_error(
                fmt::format("the command of the comparison has {}: view takes only scene, Settings and "
                            "comparison options from a report",
                            oneLine(name)));
        if (name == word && i + 1 == words.size())
            throw std::runtime_error(
                fmt::format("the command of the comparison ends after {}, without its value", name));
        // Joined with "=", so that CLI11 never reads a value as an option.
        const std::string value = name == word ? name + "=" + words[++i] : word;
        if (!unread) read.push_back(value);
    }
    return parseCommandLine(read);
}

}  // namespace diptych::cli
