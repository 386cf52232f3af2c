// SPDX-License-Identifier: MIT
#include "compare/cli/add_option.h"
#include "compare/cli/command.h"
#include "compare/report/accept.h"
#include "compare/run/print.h"
#include "shared/text/counted.h"

namespace diptych::cli {
namespace {

struct AcceptLine : OutputGroup {
    std::vector<std::string> words;  // a report, and maybe one of its scenes
    std::string channel;             // empty: all failing channels
    std::string because;             // empty: names the report
};

void describeAccept(CLI::App& app, AcceptLine& options) {
    addOption(app, "report", options.words, "DIR [SCENE]",
              "a report, and one of its scenes (all failing ones)");
    addOption(app, "--channel", options.channel, "NAME", "channel to accept (all failing ones)");
    addOption(app, "--because", options.because, "TEXT", "reason, which reports print");
    addFiles(app, options, "rules file to extend (accepted.json)");
    addOutput(app, options);
}

int runAccept(const AcceptLine& options) {
    if (options.words.empty() || options.words.size() > 2)
        refuse(
            "accept: give a report, and at most one of its scenes (none: all), for example accept report "
            "Box.glb");
    const std::filesystem::path out = options.out.empty() ? "accepted.json" : options.out;
    if (out.extension() != ".json")
        refuse("-o {}: rules go into a .json file; give a name that ends in .json", out.string());
    const std::size_t rules = acceptDifferences({.report = options.words.front(),
                                                 .scene = options.words.size() > 1 ? options.words[1] : "",
                                                 .channel = options.channel,
                                                 .because = options.because},
                                                out);
    if (!options.quiet)
        printOut("{}: {} written; use with compare --tolerances {}\n", out.string(), counted(rules, "rule"),
                 out.string());
    return 0;
}

}  // namespace

Command acceptCommand() {
    return makeCommand<AcceptLine>(
        {"accept", "Writes rules that accept the differences of a report",
         "diptych accept diptych-report Box.glb --channel lit -o accepted.json"},
        describeAccept, [](AcceptLine& options) { refuseLineBreaks(options.words); }, runAccept);
}

}  // namespace diptych::cli
