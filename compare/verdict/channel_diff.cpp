// SPDX-License-Identifier: MIT
#include "compare/verdict/channel_diff.h"

#include "compare/verdict/domain.h"
#include "compare/verdict/measurement.h"
#include "shared/contract/debug_mode.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

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

ChannelDiff diffChannel(const DebugMode& mode, const FramePair& pair, std::span<const Rule> rules,
                        bool allowNoise) {
    ChannelDiff channel;
    channel.mode = &mode;
    channel.stats = channelStats(mode.metric, mode.kind, pair.baseline.channels.at(mode.number),
                                 pair.test.channels.at(mode.number), pair.coverage);
    const Measurement measurement({mode.metric, mode.kind, false, &pair.baseline.channels.at(mode.number),
                                   &pair.test.channels.at(mode.number), &pair.coverage, &channel.stats});
    if (mode.kind == ChannelKind::color) channel.flip = measurement({"flip", 0});
    channel.figures = measurement.all();
    if (const Rule* rule = ruleFor(rules, mode.name))
        judge(channel, *rule, measurement);
    else
        judge(channel, pair, allowNoise);
    channel.verdict = channel.reason.empty() ? Verdict::pass : Verdict::fail;
    return channel;
}

}  // namespace diptych
