// SPDX-License-Identifier: MIT
#include "compare/report/layout.h"

#include "compare/report/exposure_line.h"
#include "compare/report/folders.h"
#include "compare/report/titles.h"
#include "compare/report/values.h"
#include "shared/contract/debug_mode.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string_view>

namespace diptych {

namespace {

// Whether a rule's `metric` is a maximum or a percentile of the errors that the difference image shows.
bool isDrawn(const ChannelDiff& channel, std::string_view metric) {
    const auto isOneOf = [&](std::initializer_list<std::string_view> names) {
        return std::ranges::count(names, metric) > 0;
    };
    if (channel.shown_error_name == "FLIP") return metric == "flip_max";
    const ErrorKind errorKind = channel.shown_error_name == nameOf(ErrorKind::relative)
                                    ? ErrorKind::relative
                                    : channel.mode->error_kind;
    if (errorKind == channel.mode->error_kind && isOneOf({"max", "p99", "p999"})) return true;
    return (errorKind == ErrorKind::relative && isOneOf({"relative_max", "relative_p99", "relative_p999"})) ||
           (isAngle(errorKind) && metric == "angle_max");
}

std::optional<double> errorLimit(const ChannelDiff& channel) {
    if (channel.rule.empty())
        return std::isfinite(channel.tolerance.max) ? std::optional(channel.tolerance.max) : std::nullopt;
    if (!channel.criterion) return {};
    if (channel.criterion->above && !channel.shown_error) return channel.criterion->above;
    return isDrawn(channel, channel.criterion->metric) ? std::optional(channel.criterion->limit)
                                                       : std::nullopt;
}

// The error at the end of the colour map: the limit if there is one, so that larger errors stand out;
// otherwise the largest finite error.
double errorTop(const ChannelDiff& channel, const std::optional<double>& limit, const Image& baseline,
                const Image& test, const Coverage& coverage) {
    if (limit && *limit > 0) return *limit;
    if (channel.shown_error) return channel.shown_error_top;
    if (std::isfinite(channel.stats.max)) return channel.stats.max;
    float largest = 0;
    for (const float e :
         errorImage(channel.mode->error_kind, channel.mode->kind, baseline, test, coverage).data)
        if (std::isfinite(e)) largest = std::max(largest, e);
    return double{largest};
}

ChannelImages imagesOf(const Report& report, const Comparison& comparison, const ChannelDiff& channel,
                       const std::string& prefix, const Exposure& exposure) {
    const Frame &left = report.baseline(comparison), &right = report.test(comparison);
    const DebugMode& mode = *channel.mode;
    ChannelImages images;
    const std::string files = prefix + nameOfFile(mode.name);
    std::vector<const Frame*> shown;
    const auto add = [&](const Frame& frame, std::string& name) {
        if (!frame.channels.contains(mode.channel)) return;
        name = fmt::format("{}.{}.png", files, frame.name);
        shown.push_back(&frame);
    };
    add(left, images.baseline);
    add(right, images.test);
    if (shown.size() == 2) images.same = files + ".png";
    const Size size = left.settings.size;
    if (static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height) <= maxPixelsOfValues)
        images.values = files + ".values.js";
    images.scale = scaleFor(mode, exposure, shown);
    if (isCompared(channel.verdict) && channel.stats.different > 0) {
        images.differ = true;
        images.difference = files + ".difference.png";
        images.error_limit = errorLimit(channel);
        images.error_top = errorTop(channel, images.error_limit, left.channels.at(mode.channel),
                                    right.channels.at(mode.channel), comparison.coverage);
    }
    return images;
}

bool isKept(const Comparison& comparison, Keep keep) {
    return keep == Keep::all || (keep == Keep::failing && !comparison.passed());
}

void leaveOut(ChannelImages& images) {
    for (std::string* name :
         {&images.baseline, &images.test, &images.difference, &images.same, &images.values})
        name->clear();
    images.kept = false;
}

}  // namespace

std::vector<std::string> ReportLayout::files() const {
    std::vector<std::string> all{"index.html", "junit.xml", "report.json"};
    const auto add = [&](const std::string& name) {
        if (!name.empty()) all.push_back(name);
    };
    std::ranges::for_each(exr, add);
    std::ranges::for_each(sections, add);
    if (!single_file) {
        for (const auto& channels : images)
            for (const ChannelImages& channel : channels)
                for (const std::string* name :
                     {&channel.baseline, &channel.test, &channel.difference, &channel.values})
                    add(*name);
        for (const auto& channels : closer_paths) std::ranges::for_each(channels, add);
        std::ranges::for_each(cause_maps, add);
    }
    std::ranges::sort(all);
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
}

const std::string& ReportLayout::source(const std::string& image) const {
    const auto found = embedded.find(image);
    return found == embedded.end() ? image : found->second;
}

ReportLayout layoutOf(const Report& report, const ReportOptions& options) {
    ReportLayout layout;
    layout.single_file = options.single_file;
    layout.part = options.scene_folder.has_value();
    layout.keep = options.keep;
    layout.folder = folderOfAll(report);
    layout.order = failingFirst(report);
    std::vector<std::size_t> places(layout.order.size());
    for (std::size_t i = 0; i < places.size(); ++i) places[layout.order[i]] = i;
    layout.sections.resize(report.comparisons.size());
    layout.exr.resize(report.frames.size());
    const ReportFolders folders = reportFolders(report, options.scene_folder);
    for (std::size_t i = 0; i < report.comparisons.size(); ++i) {
        layout.ids.push_back(layout.part ? std::string(indexPlaceholder) : std::to_string(i));
        const Comparison& comparison = report.comparisons[i];
        const bool kept = isKept(comparison, options.keep);
        for (const std::size_t frame : {comparison.baseline, comparison.test})
            if (kept && !options.single_file &&
                (report.frames[frame].origin.file.empty() || report.frames[frame].origin.external))
                layout.exr[frame] = folders.frames[frame] + report.frames[frame].name + ".exr";
        const Exposure exposure = exposureOf(report, comparison, options.image);
        layout.cause_maps.push_back(kept && comparison.explained && comparison.explained->map
                                        ? folders.comparisons[i] + "causes.png"
                                        : "");
        auto& channels = layout.images.emplace_back();
        for (const ChannelDiff& channel : comparison.channels) {
            channels.push_back(imagesOf(report, comparison, channel, folders.comparisons[i], exposure));
            if (!kept) leaveOut(channels.back());
            if (options.single_file) channels.back().values.clear();
            for (const std::size_t frame : {comparison.baseline, comparison.test})
                letGo(report.frames[frame], channel.mode->channel);
        }
        if (layout.part || (!options.single_file && places[i] >= comparisonsInPage))
            layout.sections[i] = folders.comparisons[i] + "comparison.section.js";
    }
    for (const CloserPath& closer : report.closer_paths) {
        auto& names = layout.closer_paths.emplace_back();
        for (const CloserPathChannel& channel : closer.channels)
            names.push_back(
                options.keep == Keep::none
                    ? ""
                    : fmt::format("{}{}.nearer.png", folders.frames[closer.reference], channel.mode->name));
    }
    return layout;
}

ReportLayout onDisk(const ReportLayout& layout) {
    ReportLayout files;
    files.images = layout.images;
    for (auto& channels : files.images)
        if (layout.single_file) std::ranges::fill(channels, ChannelImages());
    return files;
}

}  // namespace diptych
