// SPDX-License-Identifier: MIT
#include "compare/explain/write.h"

#include "compare/explain/html.h"
#include "compare/explain/pictures.h"
#include "compare/files/our_files.h"
#include "compare/files/output.h"
#include "compare/files/output_folder.h"
#include "shared/contract/debug_mode.h"
#include "shared/frame/debug_modes.h"
#include "shared/image/atomic_file.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

namespace diptych {

Image8 litPicture(const Frame& frame, const Frame& baseline, const PictureChoice& choice) {
    const DebugMode& lit = debugMode(static_cast<int>(gpu::DEBUG_lit));
    const Exposure exposure =
        exposureFor(choice, &baseline.channels.at(lit.number), coverage(baseline, baseline));
    const Frame* const shown = &frame;
    return channelPicture(lit, frame, scaleFor(lit, exposure, std::span(&shown, 1)));
}

std::string writeExplanation(const Explanation& explanation, const ExplainedPictures& of,
                             const Frame& baseline, const Frame& test, const PictureChoice& choice,
                             const std::string& device, const std::filesystem::path& path, bool force) {
    const auto earlier = [&] {
        checkReplaceable({OutputKind::folder, path}, explanationManifest, force);
        return manifestFiles(path, explanationManifest);
    };
    earlier();
    std::vector<NamedPicture> pictures = explanationMaps(explanation);
    pictures.push_back({litFiles[0], litPicture(baseline, baseline, choice)});
    pictures.push_back({litFiles[1], litPicture(test, baseline, choice)});
    pictures.push_back({dominantFile, dominantPicture(explanation, pictures.back().picture)});
    OutputFolder folder(path);
    std::vector<std::string> files{"index.html", explanationManifest};
    for (const NamedPicture& picture : pictures) files.push_back(picture.name);
    tbb::parallel_for(std::size_t{0}, pictures.size(),
                      [&](std::size_t i) { writePng(folder / pictures[i].name, pictures[i].picture); });
    writeFile(folder / "index.html", explanationHtml(explanation, of, device));
    std::ranges::sort(files);
    nlohmann::ordered_json json = toJson(explanation, of);
    json["files"] = files;
    std::string text = json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
    writeFile(folder / explanationManifest, text);
    folder.put(files, earlier);
    return text;
}

}  // namespace diptych
