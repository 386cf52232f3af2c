// SPDX-License-Identifier: MIT
#include "compare/report/layout.h"

#include "compare/report/titles.h"
#include "compare/report/values.h"
#include "shared/contract/debug_mode.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

namespace diptych {

using page::cameraTitle;

namespace {

// Letters, digits and single hyphens of `text`, lower case, at most 40.
std::string slug(const std::string& text) {
    std::string out;
    for (const char c : text) {
        const bool keep = std::isalnum(static_cast<unsigned char>(c)) != 0;
        if (keep) out += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        if (!keep && !out.empty() && out.back() != '-') out += '-';
    }
    out.resize(std::min<std::size_t>(out.size(), 40));
    while (out.ends_with('-')) out.pop_back();
    return out.empty() ? "unnamed" : out;
}

// The error at the end of the colour map: the tolerance if there is one, so that the picture shows how much
// of it is used and larger errors stand out; otherwise the largest finite error.
double errorTop(const ChannelDiff& channel, const Image& baseline, const Image& test,
                const Coverage& coverage) {
    if (channel.shown_error) return channel.shown_error_top;
    if (channel.tolerance.max > 0 && std::isfinite(channel.tolerance.max)) return channel.tolerance.max;
    if (std::isfinite(channel.stats.max)) return channel.stats.max;
    float largest = 0;
    for (const float e : errorImage(channel.mode->metric, channel.mode->kind, baseline, test, coverage).data)
        if (std::isfinite(e)) largest = std::max(largest, e);
    return double{largest};
}

ChannelPictures picturesOf(const Report& report, const Comparison& comparison, const ChannelDiff& channel,
                           const std::string& prefix, const Exposure& exposure) {
    const Frame &left = report.baseline(comparison), &right = report.test(comparison);
    const DebugMode& mode = *channel.mode;
    ChannelPictures pictures;
    std::vector<const Frame*> shown;
    const auto add = [&](const Frame& frame, std::string& name) {
        if (!frame.channels.contains(mode.number)) return;
        name = fmt::format("{}{}.{}.png", prefix, mode.name, frame.name);
        shown.push_back(&frame);
    };
    add(left, pictures.baseline);
    add(right, pictures.test);
    const Size size = left.settings.size;
    if (static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height) <= mostPixelsOfValues)
        pictures.values = fmt::format("{}{}.values.js", prefix, mode.name);
    pictures.scale = scaleFor(mode, exposure, shown);
    if (channel.verdict != Verdict::forward_only && channel.stats.different > 0) {
        pictures.difference = fmt::format("{}{}.difference.png", prefix, mode.name);
        pictures.error_top = errorTop(channel, left.channels.at(mode.number), right.channels.at(mode.number),
                                      comparison.coverage);
    }
    return pictures;
}

}  // namespace

std::vector<std::string> ReportLayout::files() const {
    std::vector<std::string> all{"index.html", "junit.xml", "report.json"};
    for (const std::string& name : exr)
        if (!name.empty()) all.push_back(name);
    for (const std::string& name : sections)
        if (!name.empty()) all.push_back(name);
    for (const auto& channels : pictures)
        for (const ChannelPictures& channel : channels)
            for (const std::string* name :
                 {&channel.baseline, &channel.test, &channel.difference, &channel.values})
                if (!name->empty()) all.push_back(*name);
    for (const auto& channels : closer_paths) all.insert(all.end(), channels.begin(), channels.end());
    std::ranges::sort(all);
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
}

const std::string& ReportLayout::source(const std::string& picture) const {
    const auto found = embedded.find(picture);
    return found == embedded.end() ? picture : found->second;
}

ReportLayout layoutOf(const Report& report, const PictureChoice& choice, bool singleFile) {
    ReportLayout layout;
    layout.single_file = singleFile;
    layout.order = failingFirst(report);
    std::vector<std::size_t> places(layout.order.size());
    for (std::size_t i = 0; i < places.size(); ++i) places[layout.order[i]] = i;
    layout.sections.resize(report.comparisons.size());
    layout.exr.resize(report.frames.size());
    for (std::size_t i = 0; i < report.comparisons.size(); ++i) {
        const Comparison& comparison = report.comparisons[i];
        const Frame& left = report.baseline(comparison);
        std::string prefix;
        if (report.comparisons.size() > 1) {
            std::string scene = slug(left.scene.substr(left.scene.find_last_of("/:") + 1));
            const std::string camera =
                left.settings.camera.empty() ? "" : fmt::format("-{}", slug(cameraTitle(left)));
            prefix = fmt::format("{}-{}{}.", i + 1, scene, camera);
        }
        for (const std::size_t frame : {comparison.baseline, comparison.test})
            if (report.frames[frame].origin.file.empty())
                layout.exr[frame] =
                    (report.closer_paths.size() == 1 ? "" : prefix) + report.frames[frame].name + ".exr";
        const auto lit = left.channels.find(gpu::DEBUG_lit);
        const Exposure exposure =
            exposureFor(choice, lit == left.channels.end() ? nullptr : &lit->second, comparison.coverage);
        auto& channels = layout.pictures.emplace_back();
        for (const ChannelDiff& channel : comparison.channels) {
            channels.push_back(picturesOf(report, comparison, channel, prefix, exposure));
            for (const std::size_t frame : {comparison.baseline, comparison.test})
                letGo(report.frames[frame], channel.mode->number);
        }
        if (singleFile)
            for (ChannelPictures& channel : channels) channel.values.clear();
        if (!singleFile && places[i] >= comparisonsInPage) layout.sections[i] = prefix + "section.js";
    }
    for (std::size_t i = 0; i < report.closer_paths.size(); ++i) {
        auto& names = layout.closer_paths.emplace_back();
        const std::string prefix = report.closer_paths.size() > 1 ? fmt::format("{}.", i + 1) : "";
        for (const CloserPathChannel& channel : report.closer_paths[i].channels)
            names.push_back(fmt::format("{}{}.nearer.png", prefix, channel.mode->name));
    }
    return layout;
}

}  // namespace diptych
