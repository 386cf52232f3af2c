// SPDX-License-Identifier: MIT
#include "compare/verdict/comparison.h"

#include "compare/render/reference_frame.h"
#include "compare/run/command_text.h"
#include "compare/verdict/domain.h"
#include "compare/verdict/measurement.h"
#include "shared/contract/debug_mode.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <iterator>
#include <limits>
#include <stdexcept>

namespace diptych {
namespace {

// Why a channel fails; empty where it passes.
std::string faultOf(const ChannelDiff& channel) {
    if (channel.unexplained_pixels.value_or(0) > 0)
        return fmt::format("{} pixel(s) differ from what the encoding explains", *channel.unexplained_pixels);
    if (channel.encoding_use && channel.encoding_use->beyond > 0)
        return fmt::format(
            "explained by what deferred reads back, but {:.3g} times what the bits of its G-buffer can do at "
            "{},{}, "
            "and more than they can at {} pixel(s)",
            channel.encoding_use->used, channel.encoding_use->x, channel.encoding_use->y,
            channel.encoding_use->beyond);
    if (const auto& f = channel.footprints) {
        if (!(f->used <= 1))
            return fmt::format(
                "over 0.1 % of the {} pixels whose surroundings are smooth are beyond what they are held to: "
                "p99.9 "
                "is {:.3g} times it, most at {},{}",
                f->smooth, f->used, f->x, f->y);
        if (!(f->flip <= detailFlip))
            return fmt::format("FLIP is {:.3g} over the {} pixels with detail, which exceeds {}", f->flip,
                               f->detailed, detailFlip);
        return {};
    }
    // At most 0.1 % of the pixels exceed the tolerance if and only if p99.9 does not.
    if (channel.tolerance.most_pixels) {
        const double p999 = channel.certain_p999.value_or(channel.stats.p999);
        return p999 <= channel.tolerance.max
                   ? std::string()
                   : fmt::format("over 0.1 % of the pixels exceed {:.4g}: p99.9 is {:.4g}",
                                 channel.tolerance.max, p999);
    }
    if (channel.stats.infinite > 0)
        return fmt::format(
            "{} pixel(s) are infinitely far apart (a NaN or infinity against a number, or a baseline "
            "of zero)",
            channel.stats.infinite);
    if (!(channel.stats.max <= channel.tolerance.max))
        return fmt::format("max {:.4g} exceeds {:.4g}", channel.stats.max, channel.tolerance.max);
    return {};
}

// The sum of what two runs of each path differ by.
double noiseOf(const FramePair& pair, int mode) {
    double sum = 0;
    for (const Frame* frame : {&pair.baseline, &pair.test})
        if (const auto noise = frame->noise.find(mode); noise != frame->noise.end()) sum += noise->second.max;
    return sum;
}

// Judges by the derived tolerance.
void judge(ChannelDiff& channel, const FramePair& pair, bool allowNoise) {
    const DebugMode& mode = *channel.mode;
    channel.tolerance = derivedTolerance(mode, pair);
    if (const double noise = allowNoise && !pair.cpu ? noiseOf(pair, mode.number) : 0; noise > 0) {
        channel.tolerance.max += noise;
        channel.tolerance.because += fmt::format("; and {:.3g} that two runs of one path differ by", noise);
    }
    channel.unexplained_pixels = unexplainedPixels(mode, pair);
    channel.encoding_use = encodingUse(mode, pair);
    channel.footprints = footprints(mode, pair);
    if (channel.footprints) channel.tolerance = footprintTolerance(*channel.footprints);
    channel.certain_p999 = certainP999(mode, pair);
    channel.reason = faultOf(channel);
    // What this program drew must be what it may be at all, whatever it is compared with.
    for (const Frame* frame : {&pair.baseline, &pair.test}) {
        if (!channel.reason.empty() || !frame->origin.file.empty()) continue;
        const auto ids = frame->channels.find(static_cast<int>(gpu::DEBUG_material_id));
        const std::string fault = outsideDomain(mode, frame->channels.at(mode.number), pair.coverage,
                                                ids == frame->channels.end() ? nullptr : &ids->second);
        if (!fault.empty()) channel.reason = frame->name + ": " + fault;
    }
}

// Judges by a rule of the user.
void judge(ChannelDiff& channel, const Rule& rule, const Measurement& measurement) {
    const Decision decision = decide(rule, measurement);
    channel.tolerance = {boundOn(rule.fail, "max").value_or(std::numeric_limits<double>::infinity()),
                         rule.because};
    channel.rule = fmt::format("{}: {}", rule.origin, conditionText(rule.fail));
    (decision.level == Level::warn ? channel.warning : channel.reason) = decision.reason;
}

ChannelDiff diffChannel(const DebugMode& mode, const FramePair& pair, const CompareOptions& options) {
    ChannelDiff channel;
    channel.mode = &mode;
    channel.stats = channelStats(mode.metric, mode.kind, pair.baseline.channels.at(mode.number),
                                 pair.test.channels.at(mode.number), pair.coverage);
    const Measurement measurement({mode.metric, mode.kind, false, &pair.baseline.channels.at(mode.number),
                                   &pair.test.channels.at(mode.number), &pair.coverage, &channel.stats});
    if (mode.kind == ChannelKind::color) channel.flip = measurement({"flip", 0});
    channel.figures = measurement.all();
    if (const Rule* rule = ruleFor(options.rules, mode.name))
        judge(channel, *rule, measurement);
    else
        judge(channel, pair, options.allow_noise);
    channel.verdict = channel.reason.empty() ? Verdict::pass : Verdict::fail;
    return channel;
}

// The planes that distinguish objects in two Frames.
ObjectPlanes objectsOf(const Frame& reference, const Frame& test) {
    ObjectPlanes objects;
    const auto find = [](const Frame& frame, gpu::uint mode) {
        const auto found = frame.channels.find(static_cast<int>(mode));
        return found == frame.channels.end() ? nullptr : &found->second;
    };
    for (const int side : {0, 1}) {
        const Frame& frame = side == 0 ? reference : test;
        objects.ids[side] = find(frame, gpu::DEBUG_material_id);
        objects.depth[side] = find(frame, gpu::DEBUG_depth);
    }
    return objects;
}

// Adds failures and notes from the Frame's counters, which no channel shows.
void readCounters(const Frame& frame, Comparison& comparison) {
    const FrameCounters& counters = frame.counters;
    if (counters.unreproduced_pixels > 0)
        comparison.failures.push_back(fmt::format(
            "{}: {} pixel(s) of the capture's lit are not the timed pipeline's, so its channels may belong "
            "to another picture",
            frame.name, counters.unreproduced_pixels));
    if (counters.overflowed_lists > 0)
        comparison.notes.push_back(fmt::format(
            "{}: {} light list(s) found no room, so every light was evaluated there: exact, but slow",
            frame.name, counters.overflowed_lists));
    if (counters.energy_cut > 0)
        comparison.notes.push_back(
            fmt::format("{}: --light-cutoff {} takes away {:.3g} % of the flux that lights without a range "
                        "send onto the scene's "
                        "surfaces, unshadowed",
                        frame.name, frame.settings.light_cutoff, 100 * counters.energy_cut));
    if (counters.nonfinite_pixels > 0)
        comparison.failures.push_back(
            fmt::format("{}: lit is NaN or infinite at {} pixel(s)", frame.name, counters.nonfinite_pixels));
}

// Reports two runs of one path that differ: on a CPU device that is a race, on a GPU scheduling may cause it.
void readNoise(const Frame& frame, bool cpu, bool allowed, Comparison& comparison) {
    for (const auto& [mode, noise] : frame.noise) {
        if (noise.pixels == 0) continue;
        const std::string line = fmt::format("{}: two runs differ in {} at {} pixel(s), by up to {:.3g}",
                                             frame.name, debugMode(mode).name, noise.pixels, noise.max);
        if (cpu)
            comparison.failures.push_back(line + ": a race");
        else
            comparison.notes.push_back(line + (allowed ? ", which is added to the tolerance"
                                                       : "; --allow-noise adds that to the tolerance"));
    }
}

// The forward+ Frame of this pair's scene and camera that tells what its encoding may do.
const Frame* explaining(const Report& report, const Frame& left, const Frame& right) {
    if (!isReferenceFrame(left) && !isReferenceFrame(right)) return nullptr;
    Settings wanted = right.settings;
    wanted.path = Path::forward_plus;
    for (const Frame& frame : report.frames) {
        // Which deferred ignores.
        wanted.prepass = frame.settings.prepass;
        if (!frame.encoding_bound.empty() && frame.scene == right.scene &&
            effectiveSettings(frame.settings) == effectiveSettings(wanted))
            return &frame;
    }
    return nullptr;
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

double usedShare(const ChannelDiff& channel) {
    constexpr double endless = std::numeric_limits<double>::infinity();
    if (channel.verdict == Verdict::forward_only || channel.stats.max == 0) return 0;
    if (channel.verdict == Verdict::fail && channel.unexplained_pixels.value_or(0) > 0) return endless;
    if (channel.footprints) return std::max(channel.footprints->used, channel.footprints->flip / detailFlip);
    if (channel.encoding_use) return channel.encoding_use->used;
    const double error =
        channel.tolerance.most_pixels ? channel.certain_p999.value_or(channel.stats.p999) : channel.stats.max;
    if (error == 0) return 0;
    return channel.tolerance.max > 0 ? error / channel.tolerance.max : endless;
}

bool Report::passed() const {
    return std::ranges::all_of(comparisons, &Comparison::passed);
}

Comparison compareFrames(const Report& report, std::size_t baseline, std::size_t test,
                         const Requirements& needs, const CompareOptions& options) {
    Comparison comparison;
    comparison.baseline = baseline;
    comparison.test = test;
    const Frame &left = report.baseline(comparison), &right = report.test(comparison);
    if (left.settings.size != right.settings.size)
        throw std::runtime_error(
            fmt::format("{} is {}x{} and {} is {}x{}: only pictures of one size are compared", left.name,
                        left.settings.size.width, left.settings.size.height, right.name,
                        right.settings.size.width, right.settings.size.height));
    // A picture of another device may have been rounded differently.
    const bool here = std::ranges::all_of(std::array{&left, &right}, [&](const Frame* frame) {
        return frame->origin.file.empty() ||
               (frame->origin.device == report.device.name && frame->origin.driver == report.device.driver);
    });
    const bool cpu = report.device.bitExact() && here;
    comparison.coverage = coverage(left, right);
    applySelection(comparison.coverage, left.settings.size.width, left.settings.size.height,
                   options.selection, objectsOf(left, right), comparison.notes);
    const FramePair pair{left,
                         right,
                         needs,
                         comparison.coverage,
                         cpu,
                         explaining(report, left, right),
                         options.texels ? &*options.texels : nullptr};

    bool shared = false;
    auto& oneSided = options.strict ? comparison.failures : comparison.notes;
    for (const Frame* frame : {&left, &right})
        if (frame->requested.empty() && !frame->origin.left_out.empty())
            oneSided.push_back(fmt::format("{} of {}: none of our channels, not compared",
                                           fmt::join(frame->origin.left_out, ", "), frame->name));
    for (const DebugMode& mode : debugModes()) {
        const bool onLeft = left.channels.contains(mode.number) && left.isRequested(mode.number),
                   onRight = right.channels.contains(mode.number) && right.isRequested(mode.number);
        const bool paths = mode.maker == MadeBy::paths_only;
        if (paths && onLeft && onRight && left.settings.assign != right.settings.assign) {
            comparison.notes.push_back(
                fmt::format("{} was not compared: --assign {} and {} evaluate other lights", mode.name,
                            nameOf(left.settings.assign), nameOf(right.settings.assign)));
        } else if (onLeft && onRight) {
            shared = true;
            comparison.channels.emplace_back().mode = &mode;
        } else if (onLeft || onRight) {
            const std::string& one = onLeft ? left.name : right.name;
            const Path lacking = onLeft ? right.settings.path : left.settings.path;
            if (paths && isReferenceFrame(onLeft ? right : left)) continue;
            if (mode.maker == MadeBy::forward_only && lacking == Path::deferred) {
                ChannelDiff& channel = comparison.channels.emplace_back();
                channel.mode = &mode;
                channel.tolerance = {0, "the G-buffer does not carry it, so only forward+ shows it"};
                channel.verdict = Verdict::forward_only;
            } else {
                oneSided.push_back(fmt::format("{} is in {} alone and was not compared", mode.name, one));
            }
        }
    }
    if (!shared)
        throw std::runtime_error(
            fmt::format("{} and {} share no channel that was asked for; add one that both make to --channels",
                        left.name, right.name));
    std::atomic<std::size_t> done{0};
    tbb::parallel_for(std::size_t{0}, comparison.channels.size(), [&](std::size_t i) {
        ChannelDiff& channel = comparison.channels[i];
        if (channel.verdict != Verdict::forward_only) channel = diffChannel(*channel.mode, pair, options);
        for (const Frame* frame : {&left, &right, pair.explaining})
            if (frame) letGo(*frame, channel.mode->number);
        options.progress.at(static_cast<double>(++done) / static_cast<double>(comparison.channels.size()),
                            "compare " + std::string(channel.mode->name));
    });

    for (const Frame* frame : {&left, &right}) {
        readCounters(*frame, comparison);
        readNoise(*frame, cpu, options.allow_noise, comparison);
    }
    if (std::ranges::any_of(comparison.channels,
                            [](const ChannelDiff& c) { return c.footprints.has_value(); }))
        comparison.notes.push_back(
            fmt::format("mode scene: tight is the share of pixels whose surroundings are smooth in both "
                        "pictures, which are held to a bound each; the others are held to a mean FLIP of {}",
                        detailFlip));
    std::vector<std::string> names;
    for (const ChannelDiff& channel : comparison.channels) names.emplace_back(channel.mode->name);
    for (const std::string& line : idleRules(options.rules, names)) comparison.notes.push_back(line);
    if (!comparison.coverage.known)
        comparison.notes.push_back(
            "neither material_id nor depth is there: background pixels count in every mean");
    else if (comparison.coverage.count == 0)
        comparison.notes.push_back("no surface is in view: every pixel is background");
    return comparison;
}

Report makeReport(std::vector<Frame> frames, const std::vector<Requirements>& needs, ReportDevice device,
                  const CompareOptions& options, std::vector<std::vector<FeatureChecks>> checks) {
    const auto start = std::chrono::steady_clock::now();
    Report report;
    report.device = std::move(device);
    report.frames = std::move(frames);
    for (std::size_t i = 0; i + 1 < report.frames.size(); i += 2) {
        const bool swapped = report.frames[i + 1].settings.path == options.baseline;
        CompareOptions here = options;
        const auto all = static_cast<double>(report.frames.size() / 2 * 2), done = static_cast<double>(i);
        here.progress = options.progress.part(done / all, (done + 2) / all).about(report.frames[i].scene);
        report.comparisons.push_back(compareFrames(report, i + swapped, i + !swapped, needs.at(i), here));
        const Frame& left = report.baseline(report.comparisons.back());
        std::vector<std::string> command =
            withWords(commandWords("compare", left.scene, left.settings), options.words);
        if (options.baseline != Path::deferred)
            command = withOption(command, "--baseline", std::string(nameOf(options.baseline)));
        report.comparisons.back().command = std::move(command);
        if (!checks.empty()) report.comparisons.back().visual_checks = std::move(checks.at(i / 2));
    }
    report.diff_ms =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    return report;
}

Report makeReferenceReport(std::vector<Frame> frames, const std::vector<Requirements>& needs,
                           ReportDevice device, const CompareOptions& options,
                           std::vector<std::vector<FeatureChecks>> checks,
                           const std::vector<std::vector<std::string>>& materials) {
    const auto start = std::chrono::steady_clock::now();
    Report report;
    report.device = std::move(device);
    report.frames = std::move(frames);
    for (std::size_t i = 0; i + 2 < report.frames.size(); i += 3) {
        const auto all = static_cast<double>(report.frames.size());
        int pairs = 0;
        for (const auto& [left, right] : {std::pair{i, i + 1}, {i, i + 2}, {i + 1, i + 2}}) {
            CompareOptions here = options;
            const double done = static_cast<double>(i) + pairs++;
            here.progress = options.progress.part(done / all, (done + 1) / all).about(report.frames[i].scene);
            report.comparisons.push_back(compareFrames(report, left, right, needs.at(i), here));
            const Frame& reference = report.frames[i];
            const Settings settings = withReferenceOf(report.frames[right].settings, reference.settings);
            report.comparisons.back().command =
                withOption(withWords(commandWords("compare", reference.scene, settings), options.words),
                           "--baseline", "reference");
        }
        Comparison& between = report.comparisons.back();
        if (!checks.empty()) between.visual_checks = std::move(checks.at(i / 3));
        report.closer_paths.push_back(
            closerPathOf(report.frames, i, {i + 1, i + 2}, between.coverage, materials.at(i / 3)));
    }
    report.diff_ms =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    return report;
}

namespace {

// An earlier Frame of forward+ has no images drawn through the G-buffer. Those of today's forward+ stand in
// for them, but only in channels where forward+ still draws the same picture; in other channels no difference
// is explained.
void explainAsNow(Frame& baseline, const std::vector<Frame>& frames, bool cpu) {
    if (baseline.settings.path != Path::forward_plus) return;
    for (const Frame& frame : frames)
        for (const auto& [mode, through] : frame.through_gbuffer) {
            const auto then = std::as_const(baseline).channels.find(mode), now = frame.channels.find(mode);
            if (then != baseline.channels.end() && now != frame.channels.end() &&
                then->second.width == now->second.width && then->second.height == now->second.height &&
                unequalPixels(then->second, now->second, cpu ? 0 : gpuUlps) == 0) {
                baseline.through_gbuffer[mode] = through;
                if (const auto bound = frame.encoding_bound.find(mode); bound != frame.encoding_bound.end())
                    baseline.encoding_bound[mode] = bound->second;
            }
        }
}

}  // namespace

Report makeBaselineReport(Frame baseline, std::vector<Frame> frames, const Requirements& needs,
                          ReportDevice device, const CompareOptions& options,
                          const std::vector<std::string>& mismatches) {
    const auto start = std::chrono::steady_clock::now();
    Report report;
    report.device = std::move(device);
    report.frames.push_back(std::move(baseline));
    std::ranges::move(frames, std::back_inserter(report.frames));
    explainAsNow(report.frames[0], report.frames, report.device.bitExact());
    for (const auto& [left, right] : {std::pair<std::size_t, std::size_t>{0, 1}, {0, 2}, {1, 2}}) {
        CompareOptions here = options;
        const auto done = static_cast<double>(report.comparisons.size());
        here.progress = options.progress.part(done / 3, (done + 1) / 3);
        report.comparisons.push_back(compareFrames(report, left, right, needs, here));
        const Frame& drawn = report.test(report.comparisons.back());
        report.comparisons.back().command =
            withWords(commandWords("compare", drawn.scene, drawn.settings), options.words);
    }
    report.first_notes = mismatches;
    report.diff_ms =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    return report;
}

}  // namespace diptych
