// SPDX-License-Identifier: MIT
#include "compare/diff.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>

namespace diptych {
namespace {

// Why a channel fails; empty where it passes.
std::string faultOf(const ChannelDiff& channel) {
    if (channel.unexplained_pixels.value_or(0) > 0)
        return fmt::format("{} pixel(s) differ from what the encoding explains", *channel.unexplained_pixels);
    if (channel.stats.infinite > 0)
        return fmt::format(
            "{} pixel(s) are infinitely far apart (a NaN or infinity against a number, or a baseline "
            "of zero)",
            channel.stats.infinite);
    if (!(channel.stats.max <= channel.tolerance.max))
        return fmt::format("max {:.4g} exceeds {:.4g}", channel.stats.max, channel.tolerance.max);
    return {};
}

ChannelDiff diffChannel(const DebugMode& mode, const FramePair& pair) {
    ChannelDiff channel;
    channel.mode = &mode;
    channel.stats = channelStats(mode.metric, mode.kind, pair.baseline.channels.at(mode.number),
                                 pair.test.channels.at(mode.number), pair.coverage);
    channel.tolerance = tolerance(mode, pair);
    channel.unexplained_pixels = unexplainedPixels(mode, pair);
    channel.reason = faultOf(channel);
    channel.verdict = channel.reason.empty() ? Verdict::pass : Verdict::fail;
    return channel;
}

// What a Frame says about itself that no channel shows.
void readCounters(const Frame& frame, Comparison& comparison) {
    const FrameCounters& counters = frame.counters;
    if (counters.unreproduced_pixels > 0)
        comparison.failures.push_back(fmt::format(
            "{}: {} pixel(s) of the capture's lit are not the timed pipeline's, so its channels may belong "
            "to another picture",
            frame.name, counters.unreproduced_pixels));
    if (counters.overflowed_lists > 0)
        comparison.failures.push_back(fmt::format("{}: {} light lists overflowed: lights are missing",
                                                  frame.name, counters.overflowed_lists));
    if (counters.nonfinite_pixels > 0)
        comparison.failures.push_back(
            fmt::format("{}: lit is NaN or infinite at {} pixel(s)", frame.name, counters.nonfinite_pixels));
}

}  // namespace

std::string_view nameOf(Verdict verdict) {
    switch (verdict) {
        case Verdict::pass:
            return "pass";
        case Verdict::fail:
            return "fail";
        case Verdict::forward_only:
            return "forward-only";
    }
    return "?";
}

bool Comparison::passed() const {
    return failures.empty() &&
           std::ranges::none_of(channels, [](const ChannelDiff& c) { return c.verdict == Verdict::fail; });
}

bool Report::passed() const {
    return std::ranges::all_of(comparisons, &Comparison::passed);
}

Comparison compareFrames(const Report& report, std::size_t baseline, std::size_t test,
                         const Requirements& needs) {
    Comparison comparison;
    comparison.baseline = baseline;
    comparison.test = test;
    const Frame &left = report.baseline(comparison), &right = report.test(comparison);
    if (left.settings.size != right.settings.size)
        throw std::runtime_error(
            fmt::format("{} is {}x{} and {} is {}x{}: only pictures of one size are compared", left.name,
                        left.settings.size.width, left.settings.size.height, right.name,
                        right.settings.size.width, right.settings.size.height));
    comparison.coverage = coverage(left, right);
    const FramePair pair{left, right, needs, comparison.coverage, report.device.type == "cpu"};

    bool shared = false;
    for (const DebugMode& mode : debugModes()) {
        const bool onLeft = left.channels.contains(mode.number) && left.isAsked(mode.number),
                   onRight = right.channels.contains(mode.number) && right.isAsked(mode.number);
        if (onLeft && onRight) {
            shared = true;
            comparison.channels.push_back({&mode, {}, {}, {}, Verdict::pass, {}});
        } else if (onLeft || onRight) {
            const std::string& one = onLeft ? left.name : right.name;
            if (mode.maker == MadeBy::forward_only)
                comparison.channels.push_back(
                    {&mode,
                     {},
                     {0, "the G-buffer does not carry it, so only forward+ shows it"},
                     {},
                     Verdict::forward_only,
                     {}});
            else
                comparison.notes.push_back(
                    fmt::format("{} is in {} alone and was not compared", mode.name, one));
        }
    }
    if (!shared)
        throw std::runtime_error(
            fmt::format("{} and {} share no channel that was asked for; add one that both make to --channels",
                        left.name, right.name));
    tbb::parallel_for(std::size_t{0}, comparison.channels.size(), [&](std::size_t i) {
        ChannelDiff& channel = comparison.channels[i];
        if (channel.verdict != Verdict::forward_only) channel = diffChannel(*channel.mode, pair);
    });

    readCounters(left, comparison);
    readCounters(right, comparison);
    if (!comparison.coverage.known)
        comparison.notes.push_back(
            "neither material_id nor depth is there: background pixels count in every mean");
    else if (comparison.coverage.count == 0)
        comparison.notes.push_back("no surface is in view: every pixel is background");
    return comparison;
}

Report makeReport(std::vector<Frame> frames, const std::vector<Requirements>& needs, ReportDevice device,
                  Path baseline, std::vector<std::vector<FeatureMarks>> marks) {
    const auto start = std::chrono::steady_clock::now();
    Report report;
    report.device = std::move(device);
    report.frames = std::move(frames);
    for (std::size_t i = 0; i + 1 < report.frames.size(); i += 2) {
        const bool swapped = report.frames[i + 1].settings.path == baseline;
        report.comparisons.push_back(compareFrames(report, i + swapped, i + !swapped, needs.at(i)));
        if (!marks.empty()) report.comparisons.back().marks = std::move(marks.at(i / 2));
    }
    report.diff_ms =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    return report;
}

}  // namespace diptych
