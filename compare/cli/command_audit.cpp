// SPDX-License-Identifier: MIT
#include "compare/audit/auditor.h"
#include "compare/audit/case.h"
#include "compare/audit/quantities.h"
#include "compare/audit/relate.h"
#include "compare/audit/relations.h"
#include "compare/audit/report.h"
#include "compare/cli/add_option.h"
#include "compare/cli/command.h"
#include "compare/cli/command_line.h"
#include "compare/cli/exit_code.h"
#include "compare/output/writers.h"
#include "compare/render/host_memory.h"
#include "compare/run/interruption.h"
#include "compare/run/print.h"
#include "shared/contract/debug_mode.h"
#include "shared/text/counted.h"
#include "shared/text/joined_names.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <stdexcept>

namespace diptych::cli {

namespace {

struct AuditLine : SceneGroup {
    std::vector<std::string> quantities;  // names; empty: all
    // --require: magnitudes that must pass, by quantity.
    std::vector<std::pair<std::string, double>> required;
    bool relations = false;                     // --relations: test relations instead of quantities
    std::vector<std::string> chosen_relations;  // --relation: names; empty: all
    std::vector<std::string> required_text;     // NAME=MAGNITUDE
};

void describeAudit(CLI::App& app, AuditLine& options) {
    addScene(app, options, one_scene_help);
    addFiles(app, options, "output folder");
    addOutput(app, options);
    app.option_defaults()->group("Stress test");
    addList(app, "--quantity", options.quantities, "NAME,...",
            fmt::format("quantities to push (all): {}. Defaults: --size 160x90; --shadows off, except for "
                        "shadow quantities",
                        joinedNames(audit::quantities())));
    addList(app, "--require", options.required_text, "NAME=MAGNITUDE,...",
            "exit code 1 if a path's error reaches 1e-2 between the original scene and this magnitude; "
            "repeatable");
    app.add_flag("--relations", options.relations,
                 "instead of pushing quantities, test changes that must not change the picture, on this "
                 "device, without a reference; exit code 1 if a relation is broken");
    addList(app, "--relation", options.chosen_relations, "NAME,...",
            fmt::format("relations to test (all): {}", joinedNames(audit::relations())));
    app.get_option("--size")->description("picture size, WxH (160x90)");
    app.get_option("--shadows")->description("shadow technique (off, except for shadow quantities)");
    acceptUnread(app, {"--path", "--runs"});
    acceptUnread(app, image_group);
}

void resolveAudit(AuditLine& options) {
    resolveScene(options);
    audit::relationsOf(options.chosen_relations);
    options.relations = options.relations || !options.chosen_relations.empty();
    if (options.relations && !options.quantities.empty())
        refuse("--quantity: --relations stresses no quantity; give one of the two");
    if (options.relations && !options.required_text.empty())
        refuse("--require: --relations stresses no quantity; give one of the two");
    audit::quantitiesOf(options.quantities);  // throws for unknown names
    for (const std::string& words : options.required_text) {
        const std::size_t at = words.find('=');
        double magnitude = -1;
        const char* const end = words.data() + words.size();
        const char* const begin = at == words.npos ? end : words.data() + at + 1;
        if (std::from_chars(begin, end, magnitude).ptr != end || !(magnitude >= 0) ||
            !std::isfinite(magnitude))
            refuse("--require {}: takes NAME=MAGNITUDE with MAGNITUDE 0 or more, for example offset=1e7",
                   words);
        const std::string name = words.substr(0, at);
        audit::quantitiesOf(std::array{name}, "--require");
        options.required.emplace_back(name, magnitude);
    }
}

// Defaults of an audit: a size that the reference renders in about 0.1 s, and no shadows. A shadow map's
// filter is an error by itself, so shadows are on only for shadow quantities.
Settings auditedSettings(const AuditLine& options) {
    Settings settings = options.settings;
    if (!options.size_requested) settings.size = {160, 90};
    if (!options.shadows_requested) settings.shadows = Shadows::off;
    return settings;
}

void checkAuditOptions(const AuditLine& options) {
    if (options.scenes.size() != 1)
        refuse("{}: audit takes one scene; run it once for each", options.scenes[1]);
    if (options.cameras.size() != 1)
        refuse("--camera {}: audit takes one camera; run it once for each", options.cameras[1]);
    if (options.path_requested) refuse("--path: audit compares both paths with the reference; leave it out");
    if (options.settings.msaa > 1)
        refuse("--msaa: audit compares one sample per pixel, like its reference; leave it out");
    checkSettings(auditedSettings(options));
}

// The start of both forms: opens the output folder, the device and the scene.
struct AuditOpening {
    // `folder`, `what` and `manifest` go to outputFolder(). Loads the command line's only scene. `options`
    // and `settings` must outlive the object. Throws std::runtime_error, one line.
    AuditOpening(const SceneGroup& options, const Settings& settings, const char* folder, const char* what,
                 const char* manifest)
        : line(options),
          out(outputFolder(options, folder, what, manifest)),
          progress(progressOutput(options)),
          device(deviceOptions(options)),
          stage(progress, options.scenes.front()),
          scene(loadSceneWithSettings(options.scenes.front(), settings, stage.part(0, 0.02))),
          subject(audit::makeSubject(scene, settings)),
          audited{options.scenes.front(), settings.camera.empty() ? subject.view_name : settings.camera,
                  settings, reportDevice(device), scene.notes} {
        logVerbose(options, "on " + device.info().name);
        // An audit keeps up to six reference Frames at a time.
        const std::vector<Settings> references(6, referenceSettings(settings));
        RenderOptions drawing;
        drawing.channels = {Channel::lit, Channel::material_id};
        SceneViews views(scene);
        checkHostMemory(views, references, drawing, device.profile().software);
    }

    // Prints on stdout, above the progress line. Does nothing with --json or --quiet.
    void print(const std::string& words) { printLive(line, progress, words, line.color); }

    const SceneGroup& line;
    const std::filesystem::path out;  // the folder
    Progress progress;
    Device device;
    const Stage stage;
    const Scene scene;
    const audit::Subject subject;
    const audit::Audited audited;  // includes the scene's notes
};

// Runs a command exactly as the report would print it. Returns whether compare fails.
bool compareFails(std::vector<std::string> words, const std::filesystem::path& folder) {
    // Not directly in `folder`: while it is temporary, its lock is taken, and a report locks the folder
    // that it is in.
    const std::string out = (folder / "trial/report").string();
    words.insert(words.begin() + 1, {"--runs", "0", "--quiet", "--force", "--out", out});
    return parseCommandLine(words).command.run() == exit_fail;
}

audit::AuditQuestion questionOf(const AuditLine& options, const std::filesystem::path& folder) {
    std::vector<std::string> device;
    if (!options.device.empty()) device = {"--device", options.device};
    return {options.quantities, options.required, folder, options.force, device, compareFails};
}

int auditQuantities(const AuditLine& options, const Settings& settings) {
    AuditOpening opened(options, settings, "diptych-audit", "audit", audit::auditManifest);
    audit::Audited audited = opened.audited;
    if (!options.shadows_requested)
        audited.notes.emplace_back(
            "--shadows off, except for shadow quantities: a shadow filter's error would hide other errors");
    const audit::AuditQuestion question = questionOf(options, opened.out);
    audit::Auditor auditor(question, std::move(audited), opened.subject, opened.device,
                           [&](const std::string& step) { logVerbose(options, step); });
    if (auditor.isRenewed())
        note(
            options,
            "the results of an interrupted audit belong to another scene, device or Settings; starting anew");
    setInterruptionMessage("finished steps are kept: the same command continues from there");
    auditor.measure(opened.stage, [&](const audit::QuantityAudit& quantity) {
        opened.print(output::inText(audit::blocksOf(quantity)));
    });
    checkValidation(opened.device);
    opened.stage.at(0.98, "write");
    if (const std::size_t resumed = auditor.audit().resumed; resumed > 0)
        note(options, fmt::format("{} kept from an interrupted run", counted(resumed, "step")));
    const std::string json = auditor.write();
    opened.progress.wipe();
    opened.print(output::inText(audit::closingOf(auditor.audit())));
    if (options.json) printText(json);
    opened.print((opened.out / "index.html").string() + "\n");
    return exitCode(auditor.audit().passes());
}

int auditRelations(const AuditLine& options, const Settings& settings) {
    AuditOpening opened(options, settings, "diptych-relations", "audit of relations",
                        audit::relationsManifest);
    audit::RelationAudit audited{opened.audited, {}};
    if (!options.shadows_requested)
        audited.notes.emplace_back("--shadows off: most relations do not test shadow maps");
    audit::RelationMeasurer measurer(opened.device, opened.subject,
                                     [&](const std::string& step) { logVerbose(options, step); });
    for (const std::string& left : measurer.omitted()) audited.notes.push_back("not drawn: " + left);
    const auto all = audit::relationsOf(options.chosen_relations);
    for (std::size_t i = 0; i < all.size(); ++i) {
        opened.stage.at(0.02 + 0.96 * static_cast<double>(i) / static_cast<double>(all.size()),
                        std::string(all[i]->name));
        audited.relations.push_back(measurer.measure(*all[i]));
        opened.print(output::inText(audit::blocksOf(audited.relations.back(), audited.device)));
    }
    checkValidation(opened.device);
    opened.stage.at(0.98, "write");
    const std::string json = audit::writeRelations(audited, opened.out, options.force);
    opened.progress.wipe();
    opened.print(output::inText(audit::closingOf(audited)));
    for (const std::string& left : measurer.omitted()) note(options, "not drawn: " + left);
    if (options.json) printText(json);
    opened.print((opened.out / "index.html").string() + "\n");
    return exitCode(audited.passes());
}

int runAudit(const AuditLine& options) {
    checkAuditOptions(options);
    const Settings settings = auditedSettings(options);
    return options.relations ? auditRelations(options, settings) : auditQuantities(options, settings);
}

}  // namespace

Command auditCommand() {
    return makeCommand<AuditLine>(
        {"audit", "Pushes scene and camera to numerical extremes and finds where each path breaks",
         "diptych audit helmet.glb --quantity near,fov",
         "quantity require shadows lights camera size device out force json"},
        describeAudit, resolveAudit, runAudit);
}

}  // namespace diptych::cli
