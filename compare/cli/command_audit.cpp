// SPDX-License-Identifier: MIT
#include "compare/audit/auditor.h"
#include "compare/audit/report.h"
#include "compare/cli/audit_opening.h"
#include "compare/cli/command_line.h"
#include "compare/cli/commands.h"
#include "compare/output/writers.h"
#include "compare/run/interruption.h"
#include "compare/run/print.h"
#include "shared/text/counted.h"

#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace diptych::cli {

namespace {

// Defaults of an audit: a size that the reference renders in about 0.1 s, and no shadows. A shadow map's
// filter is an error by itself, so shadows are on only for shadow quantities.
Settings auditedSettings(const Options& options) {
    Settings settings = options.settings;
    if (!options.size_given) settings.size = {160, 90};
    if (!options.shadows_given) settings.shadows = Shadows::off;
    return settings;
}

void checkAuditOptions(const Options& options) {
    if (options.scenes.size() != 1)
        throw std::runtime_error(
            fmt::format("{}: audit takes one scene; run it once for each", options.scenes[1]));
    if (options.cameras.size() != 1)
        throw std::runtime_error(
            fmt::format("--camera {}: audit takes one camera; run it once for each", options.cameras[1]));
    if (options.path_given)
        throw std::runtime_error("--path: audit compares both paths with the reference; leave it out");
    if (options.settings.msaa > 1)
        throw std::runtime_error(
            "--msaa: audit compares one sample per pixel, like its reference; leave it out");
    if (const auto problem = auditedSettings(options).problem()) throw std::runtime_error(*problem);
}

// Runs a command exactly as the report would print it. Returns whether compare fails.
bool compareFails(std::vector<std::string> words, const std::filesystem::path& folder) {
    // Not directly in `folder`: while it is temporary, its lock is taken, and a report locks the folder
    // that it is in.
    const std::string out = (folder / "trial/report").string();
    words.insert(words.begin() + 1, {"--runs", "0", "--quiet", "--force", "--out", out});
    return runCommand(parseCommandLine(words)) == 1;
}

audit::AuditQuestion questionOf(const Options& options, const std::filesystem::path& folder) {
    std::vector<std::string> device;
    if (!options.device.empty()) device = {"--device", options.device};
    return {options.audit.quantities, options.audit.required, folder, options.force, device, compareFails};
}

int auditQuantities(const Options& options, const Settings& settings) {
    AuditOpening opened(options, settings, "diptych-audit", "audit", audit::auditManifest);
    audit::Audited audited = opened.audited();
    if (!options.shadows_given)
        audited.notes.emplace_back(
            "--shadows off, except for shadow quantities: a shadow filter's error would hide other "
            "errors");
    const audit::AuditQuestion question = questionOf(options, opened.folder());
    audit::Auditor auditor(question, std::move(audited), opened.subject(), opened.device(),
                           [&](const std::string& step) { say(options, step); });
    if (auditor.isRenewed())
        note(options,
             "the results of an interrupted audit belong to another scene, device or Settings; starting "
             "anew");
    sayWhenInterrupted("finished steps are kept: the same command continues from there");
    auditor.measure(opened.stage(), [&](const audit::QuantityAudit& quantity) {
        opened.print(output::inText(audit::blocksOf(quantity)));
    });
    checkValidation(opened.device());
    opened.stage().at(0.98, "write");
    if (const std::size_t kept = auditor.audit().kept; kept > 0)
        note(options, fmt::format("{} kept from an interrupted run", counted(kept, "step")));
    const std::string json = auditor.write();
    opened.progress().wipe();
    opened.print(output::inText(audit::closingOf(auditor.audit())));
    if (options.json) printText(json);
    opened.print((opened.folder() / "index.html").string() + "\n");
    return auditor.audit().passes() ? 0 : 1;
}

}  // namespace

int runAudit(const Options& options) {
    checkAuditOptions(options);
    const Settings settings = auditedSettings(options);
    return options.audit.relations ? runRelations(options, settings) : auditQuantities(options, settings);
}

}  // namespace diptych::cli
