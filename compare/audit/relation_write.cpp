// SPDX-License-Identifier: MIT
#include "compare/audit/relation_words.h"

#include "compare/files/listed_folder.h"
#include "compare/metrics/channel.h"
#include "compare/picture/picture.h"
#include "shared/contract/debug_mode.h"
#include "shared/image/png.h"

#include <fmt/format.h>

#include <span>

namespace diptych::audit {

namespace {

// lit with the original image's exposure.
Image8 shownLit(const Frame& frame, const Frame& given) {
    const DebugMode& mode = debugMode(Channel::lit);
    PictureScale scale;
    scale.exposure = exposureFor({}, &given.channels.at(mode.channel), coverage(given, given));
    return channelPicture(mode, frame, scale);
}

void putPictures(ListedFolder& folder, const std::string& stem, const SeriesResult& of) {
    const auto put = [&](const char* name, const Image8& picture) {
        const std::string file = fmt::format("{}-{}.png", stem, name);
        folder.list(file);
        writePng(folder / file, picture);
    };
    put("given", shownLit(*of.given, *of.given));
    put("changed", shownLit(*of.changed, *of.given));
    put("used", errorPicture(of.comparison.used, 1));
}

}  // namespace

std::string writeRelations(const RelationAudit& audit, const std::filesystem::path& path, bool force) {
    ListedFolder folder(path, relationsManifest, force);
    for (const RelationResult& of : audit.relations)
        for (const SeriesResult& series : of.series)
            if (series.changed) putPictures(folder, pictureStem(*of.relation, series), series);
    folder.put("index.html", relationsHtml(audit, folder.files()));
    return folder.finish(toJson(audit));
}

}  // namespace diptych::audit
