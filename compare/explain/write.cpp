// SPDX-License-Identifier: MIT
#include "compare/explain/write.h"

#include "compare/explain/html.h"
#include "compare/explain/pictures.h"
#include "compare/files/listed_folder.h"
#include "shared/contract/debug_mode.h"
#include "shared/frame/debug_modes.h"

#include <tbb/parallel_for.h>

#include <span>
#include <utility>
#include <vector>

namespace diptych {

Image8 litPicture(const Frame& frame, const Frame& baseline, const PictureChoice& choice) {
    const DebugMode& lit = debugMode(Channel::lit);
    const Exposure exposure =
        exposureFor(choice, &baseline.channels.at(lit.channel), coverage(baseline, baseline));
    const Frame* const shown = &frame;
    return channelPicture(lit, frame, scaleFor(lit, exposure, std::span(&shown, 1)));
}

std::string writeExplanation(const Explanation& explanation, const ExplainedPictures& of,
                             std::array<Image8, 2> lit, const std::filesystem::path& path, bool force) {
    ListedFolder folder(path, explanationManifest, force);
    std::vector<NamedPicture> pictures = explanationMaps(explanation);
    for (std::size_t side = 0; side < 2; ++side)
        pictures.push_back({litFiles[side], std::move(lit.at(side))});
    pictures.push_back({dominantFile, dominantPicture(explanation, pictures.back().picture)});
    for (const NamedPicture& picture : pictures) folder.list(picture.name);
    tbb::parallel_for(std::size_t{0}, pictures.size(),
                      [&](std::size_t i) { writePng(folder / pictures[i].name, pictures[i].picture); });
    folder.put("index.html", explanationHtml(explanation, of));
    return folder.finish(toJson(explanation, of));
}

}  // namespace diptych
