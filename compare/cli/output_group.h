// SPDX-License-Identifier: MIT
// Options of every command: where its output goes, and what it prints.
#pragma once

#include "compare/run/color.h"
#include "compare/run/progress.h"
#include "compare/verdict/comparison.h"

#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace CLI {
class App;
}

namespace diptych::cli {

// Headings of --help.
inline constexpr const char* pixel_group = "Settings (may change a pixel)";
inline constexpr const char* image_group = "Channels and pictures";
inline constexpr const char* output_group = "Output";
inline constexpr const char* selection_group = "Comparison";
inline constexpr const char* device_group = "Device and timing";

// Hides options, or all under a heading, that the command accepts and ignores. They are accepted so that one
// option line works for several commands.
void acceptUnread(CLI::App& app, std::initializer_list<const char*> options);
void acceptUnread(CLI::App& app, const char* group);

// Throws std::runtime_error, one line.
template <class... Values>
[[noreturn]] void refuse(fmt::format_string<Values...> format, Values&&... values) {
    throw std::runtime_error(fmt::format(format, std::forward<Values>(values)...));
}

// Throws std::runtime_error, one line, for a file's or scene's name with a line break.
void refuseLineBreaks(const std::vector<std::string>& names);

// The value that an option's word names. Throws std::runtime_error, one line, for any other word.
template <class Value>
Value valueNamed(const char* option, const std::string& word,
                 const std::array<std::pair<const char*, Value>, 3>& values) {
    for (const auto& [name, value] : values)
        if (word == name) return value;
    refuse("{} {}: takes {}, {} or {}", option, word, values[0].first, values[1].first, values[2].first);
}

struct OutputGroup {
    std::filesystem::path out;  // empty: the command's default
    bool force = false, json = false, quiet = false, verbose = false;
    ColorChoice color = ColorChoice::automatic;

    virtual ~OutputGroup() = default;
};

// -o and --force. `defaults`: help of --out.
void addFiles(CLI::App& app, OutputGroup& options, const std::string& defaults);
// The other options.
void addOutput(CLI::App& app, OutputGroup& options);

// Throws if -o is given to a command that writes no file.
void refuseOut(const OutputGroup& options, const char* command);

// The folder of -o, or `name` without -o. `what` ("benchmark") is for messages. Throws if -o is not a
// folder, or if its contents have no `manifest` (output.h).
std::filesystem::path outputFolder(const OutputGroup& options, const char* name, const char* what,
                                   const char* manifest);

// stderr; empty with --quiet.
std::optional<ProgressOutput> progressOutput(const OutputGroup& options);

// Print a line on stderr: note() unless --quiet is given, logVerbose() only with --verbose.
void note(const OutputGroup& options, const std::string& line);
void logVerbose(const OutputGroup& options, const std::string& line);

// Prints the first error, one line on stderr, even with --quiet. For results with exit code 2.
void printFirstError(const std::vector<SceneError>& errors);
// Prints why a merge is incomplete: the first problem on a line of its own, all of them with -v.
void printIncomplete(const OutputGroup& options, const std::vector<std::string>& problems,
                     const std::filesystem::path& page);

// Prints text for people on stdout, in colour if --color or the terminal allows it.
void printColored(const OutputGroup& options, const std::string& text);
// Prints the JSON with --json, else the text, in colour; no text with --quiet.
void printResult(const OutputGroup& options, const std::string& json, const std::string& text);
// Prints a result on stdout above the progress line; nothing with --json or --quiet. A closed stdout does not
// end a command that writes a folder.
void printLive(const OutputGroup& options, Progress& progress, const std::string& text,
               ColorChoice color = ColorChoice::off);

}  // namespace diptych::cli
