// SPDX-License-Identifier: MIT
// audit --relations
#include "compare/audit/relate.h"
#include "compare/audit/relations.h"
#include "compare/audit/report.h"
#include "compare/cli/audit_opening.h"
#include "compare/cli/commands.h"
#include "compare/output/writers.h"
#include "compare/run/print.h"

#include <fmt/format.h>

namespace diptych::cli {

int runRelations(const Options& options, const Settings& settings) {
    AuditOpening opened(options, settings, "diptych-relations", "audit of relations",
                        audit::relationsManifest);
    audit::RelationAudit audited{opened.audited(), {}};
    if (!options.shadows_given)
        audited.notes.emplace_back("--shadows off: most relations do not test shadow maps");
    audit::RelationMeasurer measurer(opened.device(), opened.subject(),
                                     [&](const std::string& step) { say(options, step); });
    for (const std::string& left : measurer.leftOut()) audited.notes.push_back("not drawn: " + left);
    const auto all = audit::relationsOf(options.audit.chosen_relations);
    for (std::size_t i = 0; i < all.size(); ++i) {
        opened.stage().at(0.02 + 0.96 * static_cast<double>(i) / static_cast<double>(all.size()),
                          std::string(all[i]->name));
        audited.relations.push_back(measurer.measure(*all[i]));
        opened.print(output::inText(audit::blocksOf(audited.relations.back(), audited.device)));
    }
    checkValidation(opened.device());
    opened.stage().at(0.98, "write");
    const std::string json = audit::writeRelations(audited, opened.folder(), options.force);
    opened.progress().wipe();
    opened.print(output::inText(audit::closingOf(audited)));
    for (const std::string& left : measurer.leftOut()) note(options, "not drawn: " + left);
    if (options.json) printText(json);
    opened.print((opened.folder() / "index.html").string() + "\n");
    return audited.passes() ? 0 : 1;
}

}  // namespace diptych::cli
