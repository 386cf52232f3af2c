// SPDX-License-Identifier: MIT
#include "compare/bench/bench.h"
#include "compare/files/listed_folder.h"
#include "compare/output/writers.h"

namespace diptych::bench {

std::string writeBench(const Bench& bench, const std::filesystem::path& path, bool force) {
    ListedFolder folder(path, benchManifest, force);
    folder.put("index.html", benchHtml(bench));
    folder.put(experiment::rowsFile, inCsv(experiment::rowsTable(allRows(bench))));
    if (!bench.rows.empty()) folder.put("bench.svg", benchPlot(bench, PlotPlace::file));
    std::string json = benchJson(bench, folder.files());
    folder.finish(json);
    return json;
}

}  // namespace diptych::bench
