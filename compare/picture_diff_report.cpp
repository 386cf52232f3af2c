// SPDX-License-Identifier: MIT
#include "compare/picture_diff_report.h"

#include "compare/picture.h"
#include "shared/image/exr.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>

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

// The channels as debug modes that are in no table: their names lie in the PictureDiff.
std::vector<DebugMode> modesOf(const PictureDiff& diff) {
    std::vector<DebugMode> modes;
    for (const auto& channel : diff.channels) {
        const MatchedChannel& pair = channel->pair;
        const DebugMode* known = findDebugMode(pair.name);
        const bool ours = known && known->name == pair.name && known->width == pair.reference.components;
        DebugMode mode{.number = ours ? known->number : 1000 + static_cast<int>(modes.size()),
                       .name = pair.name,
                       .width = pair.reference.components,
                       .metric = pair.metric,
                       .kind = pair.kind,
                       .maker = MadeBy::both,
                       .shows = ours ? known->shows : std::string_view(pair.reference_type)};
        const bool color = pair.kind == ChannelKind::color && mode.width == 3;
        if (channel->display && color)
            mode.shown = Shown::display;
        else if (color && (!ours || known->metric == Metric::relative))
            mode.shown = Shown::radiance;
        else if (!ours && pair.kind != ChannelKind::id)
            mode.shown = Shown::normalised;
        modes.push_back(mode);
    }
    return modes;
}

Frame frameOf(const PictureDiff& diff, const std::vector<DebugMode>& modes, bool test) {
    Frame frame;
    frame.name = test ? "test" : "reference";
    frame.origin.file = test ? diff.test : diff.reference;
    frame.scene = std::filesystem::path(frame.origin.file).filename().string();
    frame.settings.size = {diff.width, diff.height};
    for (std::size_t i = 0; i < modes.size(); ++i) {
        const MatchedChannel& pair = diff.channels[i]->pair;
        frame.channels[modes[i].number] = test ? pair.test : pair.reference;
    }
    return frame;
}

ChannelDiff channelOf(const PictureChannelDiff& channel, const DebugMode& mode) {
    ChannelDiff row;
    row.mode = &mode;
    row.stats = channel.measurement->stats();
    row.flip = (*channel.measurement)({"flip", 0});
    row.tolerance = {boundOn(channel.rule.fail, "max").value_or(std::numeric_limits<double>::infinity()),
                     channel.rule.because};
    row.rule = fmt::format("{}: {}", channel.rule.origin, wordsOf(channel.rule.fail));
    (channel.decision.level == Level::warn ? row.warning : row.reason) = channel.decision.reason;
    if (judgedByFlip(channel)) {
        row.shown_error = std::make_shared<Image>(channel.measurement->flip()->error);
        row.shown_error_name = "FLIP";
    }
    row.verdict = channel.decision.level == Level::fail ? Verdict::fail : Verdict::pass;
    return row;
}

void writeFolder(const PictureDiff& diff, const Output& output, const ReportOptions& options) {
    const std::vector<DebugMode> modes = modesOf(diff);
    Report report;
    for (const bool test : {false, true}) report.frames.push_back(frameOf(diff, modes, test));
    Comparison& comparison = report.comparisons.emplace_back();
    comparison.test = 1;
    comparison.coverage = *diff.coverage;
    comparison.notes = diff.notes;
    comparison.command = {"diff", diff.reference, diff.test};
    for (std::size_t i = 0; i < modes.size(); ++i)
        comparison.channels.push_back(channelOf(*diff.channels[i], modes[i]));
    writeReport(report, output.path, options);
}

}  // namespace

void writePictureDiff(const PictureDiff& diff, const Output& output, const ReportOptions& options) {
    if (output.kind == OutputKind::folder) return writeFolder(diff, output, options);
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
