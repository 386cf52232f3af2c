// SPDX-License-Identifier: MIT
#include "compare/audit/write.h"

#include "compare/audit/plot.h"
#include "compare/audit/words.h"
#include "compare/files/our_files.h"
#include "compare/files/output.h"
#include "compare/files/output_folder.h"
#include "shared/image/atomic_file.h"

#include <algorithm>

namespace diptych::audit {

std::string writeAudit(const Audit& audit, const std::filesystem::path& path, bool force) {
    const auto earlier = [&] {
        checkReplaceable({OutputKind::folder, path}, auditManifest, force);
        return manifestFiles(path, auditManifest);
    };
    earlier();
    OutputFolder folder(path);
    std::vector<std::string> files;
    const auto put = [&](const std::string& name, const std::string& text) {
        writeFile(folder / name, text);
        files.push_back(name);
    };
    put("audit.csv", toCsv(audit));
    for (const QuantityAudit& quantity : audit.quantities)
        if (!quantity.steps.empty())
            put(std::string(quantity.quantity->name) + ".svg", auditPlot(quantity, PlotPlace::file));
    for (const auto& [name, text] : audit.scenes) put(name, text);
    std::vector<std::string> linked = files;
    linked.emplace_back(auditManifest);
    put("index.html", auditHtml(audit, linked));
    files.emplace_back(auditManifest);
    std::ranges::sort(files);
    nlohmann::ordered_json json = toJson(audit);
    json["software"] = softwareName;
    json["files"] = files;
    const std::string text =
        json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
    writeFile(folder / auditManifest, text);
    folder.put(files, earlier);
    return text;
}

}  // namespace diptych::audit
