// SPDX-License-Identifier: MIT
#include "compare/bench/bench.h"
#include "compare/files/our_files.h"
#include "compare/files/output.h"
#include "compare/files/output_folder.h"
#include "shared/image/atomic_file.h"

#include <algorithm>

namespace diptych::bench {

std::string writeBench(const Bench& bench, const std::filesystem::path& path, bool force) {
    const auto earlier = [&] {
        checkReplaceable({OutputKind::folder, path}, benchManifest, force);
        return manifestFiles(path, benchManifest);
    };
    earlier();
    OutputFolder folder(path);
    std::vector<std::string> files{benchManifest, "index.html"};
    writeFile(folder / "index.html", benchHtml(bench));
    if (!bench.rows.empty()) {
        files.emplace_back("bench.svg");
        writeFile(folder / "bench.svg", benchPlot(bench, PlotPlace::file));
    }
    std::ranges::sort(files);
    std::string json = benchJson(bench, files);
    writeFile(folder / benchManifest, json);
    folder.put(files, earlier);
    return json;
}

}  // namespace diptych::bench
