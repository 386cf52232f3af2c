// SPDX-License-Identifier: MIT
#include "compare/audit/write.h"

#include "compare/audit/plot.h"
#include "compare/audit/words.h"
#include "compare/files/listed_folder.h"

namespace diptych::audit {

std::string writeAudit(const Audit& audit, const std::filesystem::path& path, bool force) {
    ListedFolder folder(path, auditManifest, force);
    folder.put("audit.csv", toCsv(audit));
    for (const QuantityAudit& quantity : audit.quantities)
        if (!quantity.steps.empty())
            folder.put(std::string(quantity.quantity->name) + ".svg", auditPlot(quantity, PlotPlace::file));
    for (const auto& [name, text] : audit.scenes) folder.put(name, text);
    folder.put("index.html", auditHtml(audit, folder.files()));
    return folder.finish(toJson(audit));
}

}  // namespace diptych::audit
