// SPDX-License-Identifier: MIT
#include "compare/files/listed_folder.h"
#include "compare/files/output.h"
#include "compare/output/writers.h"
#include "compare/tradeoff/plot.h"
#include "compare/tradeoff/tradeoff.h"
#include "shared/image/png.h"

#include <fmt/format.h>

namespace diptych::tradeoff {

namespace fs = std::filesystem;

std::string writeTradeoff(const Tradeoff& measured, const fs::path& path, const fs::path& kept,
                          const Image8& reference, bool force) {
    ListedFolder folder(path, tradeoffManifest, force);
    Tradeoff tradeoff = measured;
    for (std::size_t i = 0; i < tradeoff.rows.size(); ++i)
        for (const auto& [member, name] :
             {std::pair{&TradeoffRow::picture, fmt::format("row-{:03}.png", i + 1)},
              {&TradeoffRow::errors_map, fmt::format("row-{:03}.flip.png", i + 1)}}) {
            linkOrCopy(kept, tradeoff.rows[i].*member, folder / name);
            tradeoff.rows[i].*member = name;
            folder.list(name);
        }
    tradeoff.reference_picture = "reference.png";
    writePng(folder / tradeoff.reference_picture, reference);
    folder.list(tradeoff.reference_picture);
    for (std::size_t figure = 0; figure < errorFigures.size(); ++figure) {
        folder.put(plotName(figure, {}), tradeoffPlot(tradeoff, figure, {}, PlotPlace::file));
        for (const Path one : pathsOf(tradeoff))
            folder.put(plotName(figure, one), tradeoffPlot(tradeoff, figure, one, PlotPlace::file));
    }
    folder.put("tradeoff.csv", tradeoffCsv(tradeoff));
    folder.put(experiment::rowsFile, inCsv(experiment::rowsTable(experiment::pointersTo(tradeoff.rows))));
    folder.put("index.html", tradeoffHtml(tradeoff));
    std::string json = tradeoffJson(tradeoff, folder.files());
    folder.finish(json);
    return json;
}

}  // namespace diptych::tradeoff
