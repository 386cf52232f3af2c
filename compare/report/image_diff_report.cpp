// SPDX-License-Identifier: MIT
#include "compare/report/image_diff_report.h"

#include "compare/files/diptych_files.h"
#include "compare/image/channel_image.h"
#include "compare/run/command_text.h"
#include "shared/image/exr.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>

namespace diptych {
namespace {

// The channel that decides the verdict: the first with the worst outcome.
const ImageChannelDiff& deciding(const ImageDiff& diff) {
    return **std::ranges::max_element(diff.channels, {}, [](const auto& c) { return c->decision.level; });
}

// Describes the channels as debug modes outside the table; their names refer to strings of the
// ImageDiff.
std::vector<DebugMode> modesOf(const ImageDiff& diff) {
    std::vector<DebugMode> modes;
    for (const auto& channel : diff.channels) {
        const MatchedChannel& pair = channel->pair;
        const DebugMode* known = findDebugMode(pair.name);
        const bool is_known =
            known && known->name == pair.name && known->width == pair.reference.components();
        DebugMode mode{.channel = is_known ? known->channel : foreignChannel(static_cast<int>(modes.size())),
                       .name = pair.name,
                       .width = pair.reference.components(),
                       .error_kind = pair.error_kind,
                       .kind = pair.kind,
                       .domain = Domain::any,
                       .supported_by = SupportedBy::both,
                       .shows = is_known ? known->shows : std::string_view(pair.reference_type)};
        const bool color = pair.kind == ChannelKind::color && mode.width == 3;
        if (channel->display && color)
            mode.shown = ShownAs::display;
        else if (color && (!is_known || known->error_kind == ErrorKind::relative))
            mode.shown = ShownAs::radiance;
        else if (!is_known && pair.kind != ChannelKind::id)
            mode.shown = ShownAs::normalised;
        modes.push_back(mode);
    }
    return modes;
}

Frame frameOf(const ImageDiff& diff, bool test) {
    Frame frame;
    frame.name = test ? "test" : "reference";
    frame.origin.file = test ? diff.test : diff.reference;
    frame.scene =
        diff.name.empty() ? std::filesystem::path(frame.origin.file).filename().string() : diff.name;
    frame.settings.size = {diff.width, diff.height};
    return frame;
}

// Without images and the metrics that only a page shows.
ChannelDiff channelOf(const ImageChannelDiff& channel, const DebugMode& mode) {
    ChannelDiff row;
    row.mode = &mode;
    row.stats = channel.measurement->stats();
    row.tolerance = {boundOn(channel.rule.fail, "max").value_or(std::numeric_limits<double>::infinity()),
                     channel.rule.because};
    row.rule = fmt::format("{}: {}", channel.rule.origin, conditionText(channel.rule.fail));
    (channel.decision.level == Level::warn ? row.warning : row.reason) = channel.decision.reason;
    row.criterion = channel.decision.criterion;
    row.stats.worst_x = channel.worst_x;
    row.stats.worst_y = channel.worst_y;
    for (const char* metric : {"psnr", "ssim"})
        if (const std::optional<double> value = (*channel.measurement)({metric, 0}))
            row.metrics.emplace_back(metric, *value);
    row.verdict = channel.decision.level == Level::fail ? Verdict::fail : Verdict::pass;
    return row;
}

// A comparison for each pair; fills `modes`, which must live as long as the report.
Report reportOf(std::span<const ImageDiff> diffs, const std::vector<SceneError>& errors,
                const std::vector<SceneError>& failures, std::vector<std::vector<DebugMode>>& modes) {
    Report report;
    report.errors = errors;
    report.failures = failures;
    for (const ImageDiff& diff : diffs) {
        const std::vector<DebugMode>& its = modes.emplace_back(modesOf(diff));
        Comparison& comparison = report.comparisons.emplace_back();
        comparison.baseline = report.frames.size();
        comparison.test = comparison.baseline + 1;
        comparison.failures = diff.failures;
        comparison.notes = diff.notes;
        comparison.emptiness = diff.emptiness;
        for (std::size_t i = 0; i < its.size(); ++i)
            comparison.channels.push_back(channelOf(*diff.channels[i], its[i]));
        for (const bool test : {false, true}) report.frames.push_back(frameOf(diff, test));
    }
    return report;
}

// Adds what only a page shows. Moves the images out of the ImageDiff, which cannot be measured afterwards.
void addImages(Report& report, Comparison& comparison, ImageDiff& diff) {
    comparison.coverage = *diff.coverage;
    for (std::size_t i = 0; i < comparison.channels.size(); ++i) {
        ImageChannelDiff& channel = *diff.channels[i];
        ChannelDiff& row = comparison.channels[i];
        row.flip = (*channel.measurement)({"flip", 0});
        if (DecidingErrors errors = decidingErrors(diff, channel); !errors.name.empty()) {
            row.shown_error = std::move(errors.image);
            row.shown_error_name = errors.name;
            row.shown_error_top = errors.top;
        }
        row.metrics = channel.measurement->all();
    }
    for (std::size_t i = 0; i < comparison.channels.size(); ++i) {
        diff.channels[i]->measurement.reset();
        MatchedChannel& pair = diff.channels[i]->pair;
        for (const bool test : {false, true}) {
            Frame& frame = report.frames[test ? comparison.test : comparison.baseline];
            Image& channel = frame.channels[comparison.channels[i].mode->channel];
            channel = (test ? pair.test : pair.reference).takeImage();
            keepInFile(channel.data);
        }
    }
}

}  // namespace

std::string diffTable(std::span<const ImageDiff> diffs, const std::vector<SceneError>& errors,
                      const std::vector<SceneError>& failures) {
    std::vector<std::vector<DebugMode>> modes;
    return reportTable(reportOf(diffs, errors, failures, modes));
}

void writeDiffs(std::span<ImageDiff> diffs, const std::filesystem::path& folder, const ReportOptions& options,
                const std::vector<std::string>& words, const std::vector<SceneError>& errors,
                const std::vector<SceneError>& failures) {
    std::vector<std::vector<DebugMode>> modes;
    Report report = reportOf(diffs, errors, failures, modes);
    for (std::size_t i = 0; i < diffs.size(); ++i) {
        addImages(report, report.comparisons[i], diffs[i]);
        report.comparisons[i].command = withOption(
            withArguments({"diff", diffs[i].reference, diffs[i].test}, words), "-o", againFolder(folder));
    }
    writeReport(report, folder, options);
}

void writeDiffErrors(const ImageDiff& diff, const Output& output) {
    if (output.kind == OutputKind::exr) {
        std::vector<std::shared_ptr<const Image>> errors;
        for (const auto& channel : diff.channels) errors.push_back(decidingErrors(diff, *channel).image);
        std::vector<ExrLayerView> layers;
        for (std::size_t i = 0; i < errors.size(); ++i)
            layers.push_back({{diff.channels[i]->pair.name + ".Y"}, errors[i].get()});
        writeExr(output.path, layers,
                 {{"software", softwareName}, {"reference", diff.reference}, {"test", diff.test}});
        return;
    }
    const ImageChannelDiff& channel = deciding(diff);
    const DecidingErrors errors = decidingErrors(diff, channel);
    writePng(output.path, errorMap(*errors.image, errors.top));
}

}  // namespace diptych
