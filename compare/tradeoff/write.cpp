// SPDX-License-Identifier: MIT
#include "compare/files/our_files.h"
#include "compare/files/output.h"
#include "compare/files/output_folder.h"
#include "compare/tradeoff/html.h"
#include "compare/tradeoff/plot.h"
#include "compare/tradeoff/tradeoff.h"
#include "shared/image/atomic_file.h"
#include "shared/image/png.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace diptych::tradeoff {
namespace {

namespace fs = std::filesystem;

// Copies a kept picture to its final name in the folder.
void copyPicture(const fs::path& from, const fs::path& to) {
    const auto held = holdTemporaries();  // or an interruption could not remove the folder
    std::error_code error;
    fs::copy_file(from, to, error);
    if (error) throw std::runtime_error(writingFailed(finalName(to), error.value()));
}

}  // namespace

std::string writeTradeoff(const Tradeoff& measured, const fs::path& path, const fs::path& kept,
                          const Image8& reference, bool force) {
    const auto earlier = [&] {
        checkReplaceable({OutputKind::folder, path}, tradeoffManifest, force);
        return manifestFiles(path, tradeoffManifest);
    };
    earlier();
    OutputFolder folder(path);
    Tradeoff tradeoff = measured;
    std::vector<std::string> files{"index.html", "tradeoff.csv", tradeoffManifest};
    const auto text = [&](const std::string& name, const std::string& contents) {
        writeFile(folder / name, contents);
        if (std::ranges::count(files, name) == 0) files.push_back(name);
    };
    for (std::size_t i = 0; i < tradeoff.rows.size(); ++i)
        for (const auto& [member, name] :
             {std::pair{&TradeoffRow::picture, fmt::format("row-{:03}.png", i + 1)},
              {&TradeoffRow::errors_map, fmt::format("row-{:03}.flip.png", i + 1)}}) {
            copyPicture(kept / (tradeoff.rows[i].*member), folder / name);
            tradeoff.rows[i].*member = name;
            files.push_back(name);
        }
    tradeoff.reference_picture = "reference.png";
    writePng(folder / tradeoff.reference_picture, reference);
    files.push_back(tradeoff.reference_picture);
    for (std::size_t figure = 0; figure < errorFigures.size(); ++figure) {
        text(plotName(figure, {}), tradeoffPlot(tradeoff, figure, {}, PlotPlace::file));
        for (const Path one : pathsOf(tradeoff))
            text(plotName(figure, one), tradeoffPlot(tradeoff, figure, one, PlotPlace::file));
    }
    text("tradeoff.csv", tradeoffCsv(tradeoff));
    text("index.html", tradeoffHtml(tradeoff));
    std::ranges::sort(files);
    std::string json = tradeoffJson(tradeoff, files);
    writeFile(folder / tradeoffManifest, json);
    folder.put(files, earlier);
    return json;
}

}  // namespace diptych::tradeoff
