// SPDX-License-Identifier: MIT
#include "compare/cli/output_group.h"

#include "compare/cli/add_option.h"
#include "compare/files/output.h"
#include "compare/report/titles.h"
#include "compare/run/print.h"
#include "shared/text/one_line.h"

#include <fmt/format.h>

#include <cstdio>

namespace diptych::cli {

void refuseLineBreaks(const std::vector<std::string>& names) {
    for (const std::string& name : names) refuseLineBreak(name);
}

void acceptUnread(CLI::App& app, std::initializer_list<const char*> options) {
    for (const char* option : options) app.get_option(option)->group("");
}

void acceptUnread(CLI::App& app, const char* group) {
    for (CLI::Option* option : app.get_options())
        if (option->get_group() == group) option->group("");
}

void addFiles(CLI::App& app, OutputGroup& options, const std::string& defaults) {
    app.option_defaults()->group(output_group);
    addOption(app, "-o,--out", options.out, "DIR|FILE", defaults)->check([](const std::string& word) {
        return std::string(word.empty() ? "\"\" names no folder or file" : "");
    });
    app.add_flag("--force", options.force, "also replace files that diptych did not write");
}

void addOutput(CLI::App& app, OutputGroup& options) {
    app.option_defaults()->group(output_group);
    app.add_flag("--json", options.json, "print the result as JSON on stdout, and nothing else");
    app.add_option_function<std::string>(
           "--color",
           [&options](const std::string& word) {
               options.color = valueNamed<ColorChoice>(
                   "--color", word,
                   {{{"auto", ColorChoice::automatic}, {"on", ColorChoice::on}, {"off", ColorChoice::off}}});
           },
           "colours of verdicts (auto: on a terminal, unless NO_COLOR is set)")
        ->type_name("auto|on|off");
    CLI::Option* quiet = app.add_flag("-q,--quiet", options.quiet, "print only errors");
    app.add_flag("-v,--verbose", options.verbose, "print on stderr what is being done, and routine notes")
        ->excludes(quiet);
}

void refuseOut(const OutputGroup& options, const char* command) {
    if (!options.out.empty())
        refuse("-o {}: {} writes no file; use {} --json > FILE", options.out.string(), command, command);
}

std::filesystem::path outputFolder(const OutputGroup& options, const char* name, const char* what,
                                   const char* manifest) {
    const Output output = outputOf(options.out.empty() ? name : options.out, true);
    if (output.kind != OutputKind::folder)
        refuse("-o {}: the {} is a folder; give a name without an extension", output.path.string(), what);
    checkReplaceable(output, manifest, options.force);
    return output.path;
}

std::optional<ProgressOutput> progressOutput(const OutputGroup& options) {
    return options.quiet ? std::nullopt : std::optional(ProgressOutput::standardError());
}

void note(const OutputGroup& options, const std::string& line) {
    if (options.quiet) return;
    wipeProgress();
    printMessage(line);
}

void logVerbose(const OutputGroup& options, const std::string& line) {
    if (options.verbose) note(options, line);
}

void printFirstError(const std::vector<SceneError>& errors) {
    if (errors.empty()) return;
    wipeProgress();
    printMessage(errorText(errors.front()) +
                 (errors.size() == 1 ? "" : fmt::format("; and {} more", errors.size() - 1)));
}

void printIncomplete(const OutputGroup& options, const std::vector<std::string>& problems,
                     const std::filesystem::path& page) {
    for (std::size_t i = 1; i < problems.size(); ++i) logVerbose(options, problems[i]);
    printFirstError(
        {{"",
          fmt::format("{}{}; {} shows the results so far", problems.front(),
                      problems.size() == 1 ? "" : fmt::format(" (and {} more, see -v)", problems.size() - 1),
                      page.string())}});
}

void printColored(const OutputGroup& options, const std::string& text) {
    printText(text, options.color);
}

void printResult(const OutputGroup& options, const std::string& json, const std::string& text) {
    if (options.json)
        printText(json);
    else if (!options.quiet)
        printColored(options, text);
}

void printLive(const OutputGroup& options, Progress& progress, const std::string& text, ColorChoice color) {
    if (options.json || options.quiet || std::ferror(stdout)) return;
    progress.wipe();
    printText(text, color);
    flushText();
}

}  // namespace diptych::cli
