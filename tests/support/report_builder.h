// SPDX-License-Identifier: MIT
// Small reports built by tests, and a parser for their pages.
#pragma once

#include "compare/report/document.h"
#include "compare/report/json.h"
#include "compare/report/report.h"
#include "compare/verdict/pair_reports.h"
#include "shared/contract/debug_mode.h"
#include "shared/frame/supported_channels.h"

#include <algorithm>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace diptych {

inline std::size_t countOf(const std::string& text, const std::string& word) {
    std::size_t found = 0;
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++found;
    return found;
}

// The first error of malformed markup: an unclosed or crossed element, a bare & or <. `voids`: void
// elements of HTML.
inline std::string markupFault(const std::string& text, const std::set<std::string>& voids = {}) {
    std::vector<std::string> open;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '&' && text.find(';', i) > i + 8) return "bare & at " + text.substr(i, 20);
        if (text[i] != '<') continue;
        const std::size_t end = text.find('>', i);
        if (end == std::string::npos) return "bare < at " + text.substr(i, 20);
        std::string tag = text.substr(i + 1, end - i - 1);
        if (std::ranges::count(tag, '"') % 2 != 0 || tag.find('<') != std::string::npos)
            return "broken tag " + tag;
        i = end;
        if (tag.starts_with('?') || tag.starts_with('!') || tag.ends_with('/')) continue;
        const std::string name = tag.substr(0, tag.find(' '));
        if (tag.starts_with('/')) {
            if (open.empty() || "/" + open.back() != tag) return "unexpected <" + tag + ">";
            open.pop_back();
        } else if (!voids.contains(name)) {
            open.push_back(name);
            if (name == "style" || name == "script") i = text.find("</" + name, end) - 1;
        }
    }
    return open.empty() ? "" : "unclosed <" + open.back() + ">";
}

// Number of channels that a single-sampled frame has in either path.
inline std::size_t channelsOfOneSample() {
    return static_cast<std::size_t>(std::ranges::count_if(
        debugModes(), [](const DebugMode& mode) { return mode.supported_by != SupportedBy::deferred_only; }));
}

// Both paths of a small scene with all channels: one surface pixel, the others background.
inline std::vector<Frame> bothFrames(const std::string& scene = "builtin:one") {
    std::vector<Frame> frames(2);
    for (const Path path : {Path::deferred, Path::forward_plus}) {
        Frame& frame = frames[path == Path::forward_plus];
        frame.name = std::string(nameOf(path));
        frame.scene = scene;
        frame.settings.path = path;
        frame.settings.size = {4, 3};
        frame.background = {0, 0, 1};
        frame.camera.far = std::numeric_limits<double>::infinity();
        frame.time = {2, 1, 3, 5};
        frame.passes = {{"shade", 1.5}};
        for (const DebugMode& mode : debugModes()) {
            if (!unsupportedReason(frame.settings, mode).empty()) continue;
            Image& image = frame.channels[mode.channel] = Image(4, 3, mode.width);
            if (mode.kind == ChannelKind::id) std::ranges::fill(image.data, -1.0f);
            for (int c = 0; c < mode.width; ++c) image.at(1, 2, c) = mode.kind == ChannelKind::id ? 3 : 0.5f;
            if (isAngle(mode.error_kind)) {
                image.at(1, 2, 0) = 0.6f;
                image.at(1, 2, 1) = 0;
                image.at(1, 2, 2) = 0.8f;
            }
        }
    }
    for (const Channel mode : litModes) frames[1].through_gbuffer[mode] = frames[0].channels.at(mode);
    return frames;
}

// Without the other channels, which makes reports fast. Comparisons need the material_id.
inline std::vector<Frame> withOnly(const std::set<Channel>& kept, std::vector<Frame> frames) {
    for (Frame& frame : frames)
        std::erase_if(frame.channels, [&](const auto& channel) { return !kept.contains(channel.first); });
    return frames;
}

inline Report reportOf(std::vector<Frame> frames, std::vector<std::vector<FeatureChecks>> checks = {}) {
    std::vector<ViewFrames> views(frames.size() / 2);
    for (std::size_t i = 0; i < frames.size(); ++i) views[i / 2].frames.push_back(std::move(frames[i]));
    for (std::size_t i = 0; i < checks.size(); ++i) views[i].checks = std::move(checks[i]);
    return makeReport(std::move(views), {"a CPU", "1.0", "cpu"});
}
// index.html and junit.xml of writeReport(), without the files and what writing them counts: histograms and
// worst pixels.
inline std::string pageOf(const Report& report, const ReportOptions& options = {}) {
    const ReportLayout layout = layoutOf(report, options);
    return reportHtml(report, layout, textsOf(report, layout));
}
inline std::string junitOf(const Report& report) {
    return reportJunit(report, layoutOf(report, {}), "out");
}
// Void elements of HTML.
inline const std::set<std::string> htmlVoids{"meta", "img", "input", "br", "wbr"};

}  // namespace diptych
