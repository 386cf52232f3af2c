// SPDX-License-Identifier: MIT
#include "compare/verdict/channel_diff.h"

#include "compare/metrics/pixel.h"
#include "compare/verdict/device_bounds.h"
#include "compare/verdict/encoding_bits.h"
#include "compare/verdict/encoding_use.h"
#include "compare/verdict/measurement.h"
#include "shared/contract/debug_mode.h"
#include "shared/text/counted.h"
#include "shared/text/digits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace diptych {
namespace {

// Whether no error exceeds the largest bound of the bits, but some pixel's own.
bool isBeyondItsBits(const ChannelDiff& channel) {
    return channel.encoding_use && channel.encoding_use->beyond > 0 &&
           channel.stats.max <= channel.tolerance.max;
}

// The criterion of the derived tolerance. `beyond`: as from evaluatePaths().
Criterion criterionOf(const ChannelDiff& channel, std::optional<std::uint64_t> beyond,
                      const Measurement& measurement) {
    if (const auto& pixels = channel.unexplained_pixels)
        return {.metric = "pixels unexplained", .measured = static_cast<double>(*pixels), .pixels = *pixels};
    if (const auto& use = isBeyondItsBits(channel) ? channel.encoding_use : channel.device_use)
        return {.metric = "times the bounds", .measured = use->used, .limit = 1, .pixels = use->beyond};
    if (const auto& f = channel.footprints) {
        if (f->used >= f->flip / detailFlip)
            return {.metric = "times the bounds", .measured = f->used, .limit = 1, .pixels = f->beyond};
        return {.metric = "flip of detail",
                .measured = f->flip,
                .limit = detailFlip,
                .pixels = channel.stats.different,
                .differing = true};
    }
    const bool max = channel.tolerance.max_pixels;
    return {.metric = !max                   ? "max"
                      : channel.certain_p999 ? "p99.9 of the excess"
                                             : "p99.9",
            .measured = max ? channel.certain_p999.value_or(channel.stats.p999) : channel.stats.max,
            .limit = channel.tolerance.max,
            .pixels = beyond ? *beyond : measurement.pixelsAbove(channel.tolerance.max)};
}

// Error message of the criterion; empty if it passes.
std::string faultOf(const ChannelDiff& channel) {
    const Criterion& c = *channel.criterion;
    const std::string fraction = percentText(c.fraction);
    if (channel.unexplained_pixels.value_or(0) > 0)
        return fmt::format("the encoding does not explain the difference at {} ({})",
                           counted(*channel.unexplained_pixels, "pixel"), fraction);
    if (isBeyondItsBits(channel)) {
        const BoundUse& use = *channel.encoding_use;
        return fmt::format(
            "the G-buffer's bits do not explain the difference at {} ({}): {:.3g} times their bound at "
            "{},{}",
            counted(use.beyond, "pixel"), fraction, use.used, use.x, use.y);
    }
    if (const auto& use = channel.device_use)
        return use->beyond == 0 ? std::string()
                                : fmt::format(
                                      "the two devices' precision does not explain the difference at {} ({}) "
                                      "of the same surface: {:.3g} times the bound at {},{}",
                                      counted(use->beyond, "pixel"), fraction, use->used, use->x, use->y);
    if (const auto& f = channel.footprints) {
        if (!(f->used <= 1))
            return fmt::format(
                "the error exceeds its bound at {} ({}) with smooth surroundings: p99.9 is {:.3g} times the "
                "bound, the largest at {},{}",
                counted(f->beyond, "pixel"), fraction, f->used, f->x, f->y);
        if (!(f->flip <= detailFlip))
            return fmt::format("mean FLIP {:.3g} over {} with detail exceeds {}", f->flip,
                               counted(f->detailed, "pixel"), detailFlip);
        return {};
    }
    if (c.measured <= c.limit) return {};
    const std::string measured = distinguishingDigits(c.measured, c.limit, 4),
                      limit = distinguishingDigits(c.limit, c.measured, 4);
    // At most 0.1 % of the pixels exceed the tolerance if and only if p99.9 does not.
    return channel.tolerance.max_pixels
               ? fmt::format("{} of the pixels exceed {}, and at most 0.1 % may: {} is {}{}", fraction, limit,
                             c.metric, measured,
                             channel.certain_p999 ? "; excess: the error minus the reference's uncertainty "
                                                    "and the encoding's change"
                                                  : "")
               : fmt::format("max {} exceeds {} at {} of the pixels", measured, limit, fraction);
}

// If NaN or infinity contributes to a channel's failure, mentions it before any metric, because no mean
// shows it.
void leadWithNonfinite(ChannelDiff& channel, const FramePair& pair) {
    const ChannelStats& s = channel.stats;
    if (channel.reason.empty() || s.infinite == 0) return;
    if (s.nonfinite_baseline + s.nonfinite_test == 0) {
        channel.reason += fmt::format("; the error is infinite at {}: the baseline is 0 everywhere",
                                      counted(s.infinite, "pixel"));
        return;
    }
    std::string who;
    for (const auto& [count, frame] :
         {std::pair{s.nonfinite_baseline, &pair.baseline}, {s.nonfinite_test, &pair.test}})
        if (count > 0)
            who +=
                fmt::format("{}{} of {}", who.empty() ? "" : " and ", counted(count, "pixel"), frame->name);
    channel.reason = fmt::format("NaN or infinity at {}; {}", who, channel.reason);
}

// Shows certainErrors() instead of the channel's own errors, and the largest of them.
void showExcess(ChannelDiff& channel, const FramePair& pair, const std::vector<double>& excess) {
    const Image& like = pair.baseline.channels.at(channel.mode->channel);
    auto shown = std::make_shared<Image>(like.width, like.height, 1);
    std::size_t next = 0;
    for (std::size_t i = 0; i < shown->pixels(); ++i)
        if (pair.coverage.covered[i]) shown->data[i] = static_cast<float>(excess[next++]);
    if (const auto max = std::ranges::max_element(shown->data); max != shown->data.end() && *max > 0) {
        const auto at = static_cast<int>(max - shown->data.begin());
        channel.stats.worst_x = at % like.width;
        channel.stats.worst_y = at / like.width;
    }
    channel.shown_error = std::move(shown);
    channel.shown_error_name = "excess";
    channel.shown_error_top = channel.tolerance.max;
}

// Sum of both paths' differences between two runs.
double noiseOf(const FramePair& pair, Channel mode) {
    double sum = 0;
    for (const Frame* frame : {&pair.baseline, &pair.test})
        if (const auto noise = frame->noise.find(mode); noise != frame->noise.end()) sum += noise->second.max;
    return sum;
}

// How far a pixel is out of range, and its value; 0: inside.
struct Outside {
    double by = 0, value = 0;
};

Outside outside(Domain domain, const float* p, int components) {
    Outside worst;
    const auto consider = [&](double value, double by) {
        if (by > worst.by) worst = {by, value};
    };
    if (domain == Domain::unit || domain == Domain::unit_or_zero) {
        const double length = std::hypot(double{p[0]}, double{p[1]}, double{p[2]});
        if (domain == Domain::unit || length != 0) consider(length, std::abs(length - 1));
        return worst;
    }
    for (int c = 0; c < components; ++c) {
        consider(p[c], -double{p[c]});
        if (domain == Domain::ratio) consider(p[c], double{p[c]} - 1);
    }
    return worst;
}

const char* faultOf(Domain domain) {
    return domain == Domain::unit           ? "vectors are not of unit length"
           : domain == Domain::unit_or_zero ? "vectors are neither 0 nor of unit length"
           : domain == Domain::ratio        ? "values are not between 0 and 1"
                                            : "values are negative";
}

// Pixels of a channel outside its valid range (DebugMode::domain), beyond float32 rounding: "3 pixel(s)
// are no unit vectors, length 1.02 at 5,7"; empty if there are none. Only counts covered pixels that are
// no background (`ids`: the image's material_id; nullptr: no background). Ignores NaN and infinity, which
// the metrics handle.
std::string outsideDomain(const DebugMode& mode, const Image& image, const Coverage& coverage,
                          const Image* ids) {
    if (mode.domain == Domain::any) return {};
    std::uint64_t count = 0;
    std::size_t index = 0;
    Outside worst;
    for (std::size_t i = 0; i < image.pixels(); ++i) {
        if (!coverage.covered[i] || (ids && *ids->pixel(i) < 0)) continue;
        if (!metrics::finite(image.pixel(i), image.components)) continue;
        const Outside here = outside(mode.domain, image.pixel(i), image.components);
        if (here.by <= lengthBound) continue;
        ++count;
        if (here.by > worst.by) {
            worst = here;
            index = i;
        }
    }
    if (count == 0) return {};
    const auto width = static_cast<std::size_t>(image.width);
    return fmt::format("{} at {}, the worst {:.6g} at {},{}", faultOf(mode.domain), counted(count, "pixel"),
                       worst.value, index % width, index / width);
}

// Finds the tolerance between two paths, or a path and a reference, and how much of it a channel uses.
// Returns the number of covered pixels whose certainErrors() exceed it; empty without these.
std::optional<std::uint64_t> evaluatePaths(ChannelDiff& channel, const FramePair& pair, bool allowNoise) {
    const DebugMode& mode = *channel.mode;
    channel.tolerance = derivedTolerance(mode, pair);
    const double noise = allowNoise && !pair.cpu ? noiseOf(pair, mode.channel) : 0;
    if (noise > 0) {
        channel.tolerance.max += noise;
        channel.tolerance.because +=
            fmt::format("; plus {:.3g}, the difference of two runs of one path", noise);
    }
    channel.unexplained_pixels = unexplainedPixels(mode, pair);
    channel.encoding_use = encodingUse(
        mode, pair, noise + (pair.cpu ? 0 : gpuSlack(mode, pair.baseline.channels.at(mode.channel))));
    channel.footprints = footprints(mode, pair);
    if (channel.footprints) channel.tolerance = footprintTolerance(*channel.footprints);
    std::optional<std::vector<double>> certain = certainErrors(mode, pair);
    if (!certain) return {};
    if (!channel.footprints) showExcess(channel, pair, *certain);
    const auto beyond =
        std::ranges::count_if(*certain, [&](double e) { return !(e <= channel.tolerance.max); });
    channel.certain_p999 = nearestRank(std::move(*certain), 0.999);
    return static_cast<std::uint64_t>(beyond);
}

// Compares by the derived tolerance.
void evaluate(ChannelDiff& channel, const FramePair& pair, const Measurement& measurement, bool allowNoise) {
    const DebugMode& mode = *channel.mode;
    std::optional<std::uint64_t> beyond;
    if (isInformative(mode, pair)) {
        channel.tolerance = informativeTolerance(pair);
    } else if (pair.across) {
        channel.device_use = deviceUse(mode, pair);
        channel.tolerance = deviceTolerance(mode, pair, *channel.device_use);
    } else {
        beyond = evaluatePaths(channel, pair, allowNoise);
    }
    if (!isInformative(mode, pair)) {
        channel.criterion = criterionOf(channel, beyond, measurement);
        channel.criterion->fraction = std::min(1.0, measurement.fractionOf(channel.criterion->pixels));
        channel.reason = faultOf(channel);
        leadWithNonfinite(channel, pair);
    }
    // This program's images must be in their valid range, whatever they are compared with.
    for (const Frame* frame : {&pair.baseline, &pair.test}) {
        if (!channel.reason.empty() || !frame->origin.file.empty()) continue;
        const std::string fault = outsideDomain(mode, frame->channels.at(mode.channel), pair.coverage,
                                                findChannel(*frame, Channel::material_id));
        if (!fault.empty()) channel.reason = frame->name + ": " + fault;
    }
}

// Compares by a rule of the user.
void evaluate(ChannelDiff& channel, const Rule& rule, const Measurement& measurement) {
    const Decision decision = decide(rule, measurement);
    channel.tolerance = {boundOn(rule.fail, "max").value_or(std::numeric_limits<double>::infinity()),
                         rule.because};
    channel.rule = fmt::format("{}: {}", rule.origin, conditionText(rule.fail));
    channel.criterion = decision.criterion;
    (decision.level == Level::warn ? channel.warning : channel.reason) = decision.reason;
}

}  // namespace

bool isInformative(const DebugMode& mode, const FramePair& pair) {
    // Light lists, shadows, terms of lit, haze.
    return !pair.light_differs.empty() && sourceOf(mode.channel).stage >= ChannelStage::list;
}

Tolerance informativeTolerance(const FramePair& pair) {
    return {std::numeric_limits<double>::infinity(),
            fmt::format("the Settings of the two sides change the light ({}), so this channel does not "
                        "count; a rule in --tolerances makes it count",
                        pair.light_differs)};
}

double usedFraction(const ChannelDiff& channel) {
    constexpr double endless = std::numeric_limits<double>::infinity();
    if (!isCompared(channel.verdict) || channel.stats.max == 0) return 0;
    if (channel.verdict == Verdict::fail && channel.unexplained_pixels.value_or(0) > 0) return endless;
    return channel.criterion ? usedOf(*channel.criterion) : 0;
}

ChannelDiff diffChannel(const DebugMode& mode, const FramePair& pair, std::span<const Rule> rules,
                        bool allowNoise) {
    ChannelDiff channel;
    channel.mode = &mode;
    channel.stats = channelStats(mode.error_kind, mode.kind, pair.baseline.channels.at(mode.channel),
                                 pair.test.channels.at(mode.channel), pair.coverage);
    if (mode.channel == Channel::lit) channel.approximation_errors = approximationErrors(mode, pair);
    ChannelPair images{mode.error_kind,
                       mode.kind,
                       false,
                       pair.baseline.channels.at(mode.channel),
                       pair.test.channels.at(mode.channel),
                       &pair.coverage,
                       &channel.stats};
    if (isPathAgainstReference(pair) && mode.channel == Channel::lit)
        images.approximation_error = meanApproximationError(channel.approximation_errors);
    const Measurement measurement(images);
    if (mode.kind == ChannelKind::color) channel.flip = measurement({"flip", 0});
    channel.metrics = measurement.all();
    const Rule* const rule = ruleFor(rules, mode.name);
    // A rule on `granted` applies in addition to the derived tolerance.
    const bool derived = !rule || boundsOnly(rule->fail, "granted");
    if (derived) evaluate(channel, pair, measurement, allowNoise);
    if (rule && channel.reason.empty()) evaluate(channel, *rule, measurement);
    channel.verdict = !channel.reason.empty()                ? Verdict::fail
                      : derived && isInformative(mode, pair) ? Verdict::informative
                                                             : Verdict::pass;
    return channel;
}

}  // namespace diptych
