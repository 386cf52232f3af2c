// SPDX-License-Identifier: MIT
#include "compare/cli/manual.h"

#include "compare/cli/output_group.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <algorithm>

namespace diptych::cli {
namespace {

using Words = std::vector<std::string>;

// Visible commands in the order of --help.
std::vector<const CLI::App*> commandsOf(const CLI::App& app) {
    return app.get_subcommands([](const CLI::App* sub) { return !sub->get_group().empty(); });
}

// Options that --help prints.
std::vector<const CLI::Option*> optionsOf(const CLI::App& app) {
    return app.get_options(
        [](const CLI::Option* option) { return !option->get_group().empty() && !option->get_positional(); });
}

Words spellingsOf(const CLI::Option& option) {
    Words spellings;
    for (const std::string& name : option.get_snames()) spellings.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) spellings.push_back("--" + name);
    return spellings;
}

// The values of an option of type "on|off". Empty if it takes any value, or none.
Words valuesOf(const CLI::Option& option) {
    Words values;
    const std::string type = option.get_type_size() == 0 ? "" : option.get_type_name();
    if (type.find('|') == std::string::npos || type.find_first_of(" ,[<") != std::string::npos) return values;
    std::size_t from = 0;
    for (std::size_t bar = 0; bar != std::string::npos; from = bar + 1) {
        bar = type.find('|', from);
        values.push_back(type.substr(from, bar == std::string::npos ? bar : bar - from));
    }
    // Drop placeholders, which are in capitals.
    std::erase_if(values, [](const std::string& value) {
        return value.empty() || std::ranges::all_of(value, [](char c) { return c < 'a' || c > 'z'; });
    });
    return values;
}

// ---- the manual page --------------------------------------------------------------------------------------

// Escapes text for roff: lines that begin with a dot or quote, backslashes and hyphens.
std::string roff(const std::string& text) {
    std::string out;
    bool at_start = true;
    for (const char c : text) {
        if (at_start && (c == '.' || c == '\'')) out += "\\&";
        if (c == '\\')
            out += "\\e";
        else if (c == '-')
            out += "\\-";
        else
            out += c;
        at_start = c == '\n';
    }
    return out;
}

std::string oneParagraph(std::string text) {
    std::ranges::replace(text, '\n', ' ');
    return text;
}

std::string optionEntry(const CLI::Option& option) {
    const std::string type = option.get_type_size() == 0 ? "" : " " + option.get_type_name();
    return fmt::format(".TP\n\\fB{}\\fR{}\n{}\n",
                       roff(fmt::format("{}", fmt::join(spellingsOf(option), ", "))), roff(type),
                       roff(oneParagraph(option.get_description())));
}

// ---- completions ------------------------------------------------------------------------------------------

std::string singleQuoted(const std::string& word) {
    std::string out = "'";
    for (const char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return out + "'";
}

std::string list(const Words& words) {
    return fmt::format("{}", fmt::join(words, " "));
}

// Options of every command, and values of every option that has a list of them.
std::string bashCompletion(const CLI::App& app, const Words& scenes) {
    Words names;
    std::string cases, values;
    for (const CLI::App* command : commandsOf(app)) {
        names.push_back(command->get_name());
        Words spellings;
        for (const CLI::Option* option : optionsOf(*command)) {
            for (const std::string& spelling : spellingsOf(*option)) spellings.push_back(spelling);
            if (const Words words = valuesOf(*option); !words.empty())
                values +=
                    fmt::format("        {}:{}) choices={} ;;\n", command->get_name(),
                                fmt::join(spellingsOf(*option), fmt::format("|{}:", command->get_name())),
                                singleQuoted(list(words)));
        }
        cases +=
            fmt::format("        {}) options={} ;;\n", command->get_name(), singleQuoted(list(spellings)));
    }
    return fmt::format(
        R"(# bash completion of diptych
_diptych() {{
    local word=${{COMP_WORDS[COMP_CWORD]}} command=${{COMP_WORDS[1]-}} before= options= choices=
    [ "$COMP_CWORD" -lt 2 ] || before=${{COMP_WORDS[COMP_CWORD - 1]}}
    COMPREPLY=()
    if [ "$COMP_CWORD" -eq 1 ]; then
        COMPREPLY=($(compgen -W {} -- "$word"))
        return
    fi
    case "$command:$before" in
{}    esac
    if [ -n "$choices" ]; then
        COMPREPLY=($(compgen -W "$choices" -- "$word"))
        return
    fi
    case "$command" in
{}    esac
    if [ "${{word#-}}" != "$word" ]; then
        COMPREPLY=($(compgen -W "$options" -- "$word"))
    else
        # A colon parts words for bash: what stands before it is there already.
        [ "$before" != : ] || COMPREPLY=($(compgen -W {} -- "$word"))
        COMPREPLY+=($(compgen -W builtin: -- "$word") $(compgen -f -- "$word"))
    fi
}}
complete -o filenames -o nospace -F _diptych diptych
)",
        singleQuoted(list(names) + " --help --version"), values, cases, [&] {
            Words bare;
            for (const std::string& scene : scenes) bare.push_back(scene.substr(scene.find(':') + 1));
            return singleQuoted(list(bare));
        }());
}

// One paragraph with a backslash before each special character.
std::string escaped(const std::string& text, std::string_view special) {
    std::string out;
    for (const char c : oneParagraph(text)) {
        if (special.find(c) != special.npos) out += '\\';
        out += c;
    }
    return out;
}

std::string zshCompletion(const CLI::App& app, const Words& scenes) {
    std::string commands, cases;
    for (const CLI::App* command : commandsOf(app)) {
        commands += fmt::format("        {}\n", singleQuoted(command->get_name() + ":" +
                                                             oneParagraph(command->get_description())));
        cases += fmt::format("        {}) _arguments -s \\\n", command->get_name());
        for (const CLI::Option* option : optionsOf(*command))
            for (const std::string& spelling : spellingsOf(*option)) {
                std::string spec =
                    fmt::format("*{}[{}]", spelling, escaped(option->get_description(), "[]:\\"));
                if (option->get_type_size() != 0) {
                    const Words words = valuesOf(*option);
                    spec += words.empty() ? ":value:_files" : fmt::format(":value:({})", list(words));
                }
                cases += fmt::format("            {} \\\n", singleQuoted(spec));
            }
        cases += "            '*:scene:_diptych_scenes' ;;\n";
    }
    Words escaped;
    for (const std::string& scene : scenes) escaped.push_back(singleQuoted(scene));
    return fmt::format(R"(#compdef diptych
_diptych_scenes() {{
    compadd -- {}
    _files
}}
_diptych() {{
    local -a commands
    commands=(
{}    )
    if (( CURRENT == 2 )); then
        _describe command commands
        return
    fi
    local command=$words[2]
    shift words
    (( CURRENT-- ))
    case $command in
{}    esac
}}
_diptych "$@"
)",
                       list(escaped), commands, cases);
}

std::string fishText(const std::string& text) {
    return "'" + escaped(text, "'\\") + "'";
}

std::string fishCompletion(const CLI::App& app, const Words& scenes) {
    std::string out = "# fish completion of diptych\n";
    for (const CLI::App* command : commandsOf(app))
        out += fmt::format("complete -c diptych -n __fish_use_subcommand -f -a {} -d {}\n",
                           command->get_name(), fishText(command->get_description()));
    for (const CLI::App* command : commandsOf(app)) {
        const std::string here =
            fmt::format("complete -c diptych -n '__fish_seen_subcommand_from {}'", command->get_name());
        out += fmt::format("{} -a {}\n", here, fishText(list(scenes)));
        for (const CLI::Option* option : optionsOf(*command)) {
            std::string line = here;
            for (const std::string& name : option->get_snames()) line += " -s " + name;
            for (const std::string& name : option->get_lnames()) line += " -l " + name;
            if (option->get_type_size() != 0) line += " -r";
            if (const Words words = valuesOf(*option); !words.empty())
                line += " -f -a " + fishText(list(words));
            out += fmt::format("{} -d {}\n", line, fishText(option->get_description()));
        }
    }
    return out;
}

}  // namespace

std::string manualPage(const CLI::App& app, const std::string& version) {
    std::string page = fmt::format(
        ".TH DIPTYCH 1 \"\" \"{}\" \"User Commands\"\n.SH NAME\ndiptych \\- renders a scene with two render "
        "paths and reports where they differ\n",
        roff(version));
    page += ".SH SYNOPSIS\n.B diptych\n.I COMMAND\n[\\fIOPTION\\fR]... [\\fISCENE\\fR]...\n";
    page += fmt::format(
        ".SH DESCRIPTION\n{}\n.PP\nSCENE is a .gltf or .glb file or builtin:NAME; without it, "
        "builtin:gallery.\n",
        roff(oneParagraph(app.get_description())));
    page += ".SH COMMANDS\n";
    for (const CLI::App* command : commandsOf(app))
        page += fmt::format(".TP\n\\fB{}\\fR\n{}\n", command->get_name(),
                            roff(oneParagraph(command->get_description())));
    for (const CLI::App* command : commandsOf(app)) {
        page += fmt::format(".SH OPTIONS OF {}\n", command->get_name());
        std::string group;
        for (const CLI::Option* option : optionsOf(*command)) {
            if (option->get_group() != group) {
                group = option->get_group();
                page += fmt::format(".SS {}\n", roff(oneParagraph(group)));
            }
            page += optionEntry(*option);
        }
        page += fmt::format(".PP\n.nf\n{}\n.fi\n", roff(command->get_footer()));
    }
    page +=
        ".SH EXIT STATUS\n.TP\n0\nparity holds, a budget is met, an image is written\n.TP\n1\na difference "
        "is beyond tolerance, or a budget is not met\n.TP\n2\nan error: one line on stderr says what failed "
        "and where\n";
    return page;
}

std::string completion(const CLI::App& app, const std::string& shell,
                       const std::vector<std::string>& scenes) {
    if (shell == "bash") return bashCompletion(app, scenes);
    if (shell == "zsh") return zshCompletion(app, scenes);
    if (shell == "fish") return fishCompletion(app, scenes);
    refuse("--completion {}: takes one of {}", shell, completedShells);
}

}  // namespace diptych::cli
