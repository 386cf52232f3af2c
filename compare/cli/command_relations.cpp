// SPDX-License-Identifier: MIT
// audit --relations
#include "compare/audit/relate.h"
#include "compare/audit/relation_words.h"
#include "compare/audit/relations.h"
#include "compare/cli/commands.h"

#include <fmt/format.h>

#include <cstdio>

namespace diptych::cli {

int runRelations(const Options& options, const Settings& settings) {
    const std::filesystem::path folder =
        outputFolder(options, "diptych-relations", "audit of relations", audit::relationsManifest);
    Progress progress(progressOutput(options));
    Device device(deviceOptions(options));
    say(options, "on " + device.info().name);
    const std::string& where = options.scenes.front();
    const Stage stage(progress, where);
    const Scene scene = loadShown(where, settings, stage.part(0, 0.02));
    const audit::Subject subject = audit::makeSubject(scene, settings);
    audit::RelationAudit audited;
    audited.scene = where;
    audited.settings = settings;
    audited.camera = settings.camera.empty() ? subject.view_name : settings.camera;
    audited.device = reportDevice(device);
    audited.notes = scene.notes;
    if (!options.shadows_given)
        audited.notes.emplace_back("--shadows off: most relations say nothing of shadow maps");
    audit::RelationMeasurer measurer(device, subject, [&](const std::string& step) { say(options, step); });
    const bool quiet = options.json || options.quiet;
    const auto print = [&](const std::string& words) {
        if (quiet || std::ferror(stdout)) return;
        progress.wipe();
        printColored(options, words);
        std::fflush(stdout);
    };
    const auto all = audit::relationsOf(options.audit.chosen_relations);
    for (std::size_t i = 0; i < all.size(); ++i) {
        stage.at(0.02 + 0.96 * static_cast<double>(i) / static_cast<double>(all.size()),
                 std::string(all[i]->name));
        audited.relations.push_back(measurer.measure(*all[i]));
        print(audit::inWords(audited.relations.back(), audited.device));
    }
    checkValidation(device);
    stage.at(0.98, "write");
    const std::string json = audit::writeRelations(audited, folder, options.force);
    progress.wipe();
    print(audit::inWords(audited));
    if (options.json) fmt::print("{}", json);
    print((folder / "index.html").string() + "\n");
    return audited.holds() ? 0 : 1;
}

}  // namespace diptych::cli
