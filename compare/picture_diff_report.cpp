// SPDX-License-Identifier: MIT
#include "compare/picture_diff_report.h"

#include "compare/picture.h"
#include "shared/image/exr.h"

#include <algorithm>

namespace diptych {
namespace {

bool judgedByFlip(const PictureChannelDiff& channel) {
    return wordsOf(channel.rule.fail).find("flip") != std::string::npos && channel.measurement->flip();
}

Image errorsOf(const PictureDiff& diff, const PictureChannelDiff& channel) {
    if (judgedByFlip(channel)) return channel.measurement->flip()->error;
    const MatchedChannel& pair = channel.pair;
    return errorImage(pair.metric, pair.kind, pair.reference, pair.test, *diff.coverage);
}

// What decides: the first of those that came out worst.
const PictureChannelDiff& deciding(const PictureDiff& diff) {
    return **std::ranges::max_element(diff.channels, {}, [](const auto& c) { return c->decision.level; });
}

}  // namespace

void writePictureDiff(const PictureDiff& diff, const Output& output, const ReportOptions&) {
    if (output.kind == OutputKind::exr) {
        std::vector<Image> errors;
        for (const auto& channel : diff.channels) errors.push_back(errorsOf(diff, *channel));
        std::vector<ExrLayerView> layers;
        for (std::size_t i = 0; i < errors.size(); ++i)
            layers.push_back({{diff.channels[i]->pair.name + ".Y"}, &errors[i]});
        writeExr(output.path, layers,
                 {{"software", softwareName}, {"reference", diff.reference}, {"test", diff.test}});
        return;
    }
    const PictureChannelDiff& channel = deciding(diff);
    const double top = judgedByFlip(channel) ? 1 : channel.measurement->stats().max;
    writePng(output.path, errorPicture(errorsOf(diff, channel), top));
}

}  // namespace diptych
