// SPDX-License-Identifier: MIT
#include "compare/verdict/comparison.h"

#include "compare/frames/frame_properties.h"
#include "compare/frames/nonfinite.h"
#include "compare/verdict/across_devices.h"
#include "compare/verdict/encoding_bits.h"
#include "compare/verdict/surface_grid.h"
#include "compare/verdict/surface_pixels.h"
#include "shared/contract/debug_mode.h"
#include "shared/frame/supported_channels.h"
#include "shared/text/counted.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <stdexcept>

namespace diptych {
namespace {

// Adds failures and notes from the Frame's counters, which no channel shows.
void readCounters(const Frame& frame, Comparison& comparison) {
    const FrameCounters& counters = frame.counters;
    if (counters.unreproduced_pixels > 0)
        comparison.failures.push_back(
            fmt::format("{}: lit of the capture differs from the timed pipeline at {}, so its channels may "
                        "belong to another image",
                        frame.name, counted(counters.unreproduced_pixels, "pixel")));
    if (counters.overflowed_lists > 0)
        comparison.notes.push_back(
            fmt::format("{}: {} overflowed, so every light was evaluated there: exact, but slow", frame.name,
                        counted(counters.overflowed_lists, "light list")));
    if (counters.shadow_pages.fallback > 0)
        comparison.notes.push_back(fmt::format(
            "{}: {} of {} did not fit in --clipmap-pages {}; a coarser level replaces them", frame.name,
            counters.shadow_pages.fallback, counted(counters.shadow_pages.requested, "shadow page"),
            frame.settings.clipmap_pages));
    if (counters.unsorted.fragments > 0)
        comparison.notes.push_back(
            fmt::format("{}: {} of {} did not fit in --transparency-layers {}; their mean is blended as one "
                        "layer behind the others",
                        frame.name, counted(counters.unsorted.fragments, "blended fragment"),
                        counted(counters.unsorted.pixels, "pixel"), frame.settings.transparency_layers));
    if (counters.energy_cut > 0)
        comparison.notes.push_back(fmt::format(
            "{}: --light-cutoff {} removes {:.3g} % of the unshadowed flux from lights without a range",
            frame.name, frame.settings.light_cutoff, 100 * counters.energy_cut));
    if (counters.nonfinite_pixels > 0)
        comparison.failures.push_back(fmt::format("{}: lit is NaN or infinite at {}", frame.name,
                                                  counted(counters.nonfinite_pixels, "pixel")));
    for (const std::string& line : nonfiniteText(frame))
        comparison.failures.push_back(frame.name + ": " + line);
}

// Reports differences between two runs of one path: on a CPU device a race, on a GPU possibly scheduling.
// Compute shaders write the same on every device, whatever the scheduling.
void readNoise(const Frame& frame, bool cpu, bool allowed, Comparison& comparison) {
    if (!frame.changed_buffers.empty())
        comparison.failures.push_back(
            fmt::format("{}: a second run of the compute shaders left other data in {}: a race", frame.name,
                        fmt::join(frame.changed_buffers, ", ")));
    for (const auto& [mode, noise] : frame.noise) {
        if (noise.pixels == 0) continue;
        const std::string line = fmt::format("{}: two runs differ in {} at {}, by up to {:.3g}", frame.name,
                                             debugMode(mode).name, counted(noise.pixels, "pixel"), noise.max);
        if (cpu)
            comparison.failures.push_back(line + ": a race");
        else
            comparison.notes.push_back(line + (allowed ? ", which is added to the tolerance"
                                                       : "; --allow-noise adds that to the tolerance"));
    }
}

// If lit was requested, checks whether blending adds a difference. If a rule covers lit, the rule decides
// and this is only a note.
void readBlending(const FramePair& pair, std::span<const Rule> rules, Comparison& comparison) {
    const DebugMode& lit = debugMode(Channel::lit);
    if (!pair.baseline.isRequested(lit.channel) || !pair.test.isRequested(lit.channel)) return;
    if (isInformative(lit, pair) && !ruleFor(rules, lit.name)) return;
    comparison.after_blending = afterBlending(pair);
    if (!comparison.after_blending) return;
    const std::string fault = faultOf(*comparison.after_blending);
    if (!fault.empty()) (ruleFor(rules, lit.name) ? comparison.notes : comparison.failures).push_back(fault);
}

// Notes Settings in which two paths differ.
void noteSides(const Frame& left, const Frame& right, Comparison& comparison) {
    for (const Frame* frame : {&left, &right})
        if (isReferenceFrame(*frame) || frame->origin.external || !frame->origin.file.empty()) return;
    comparison.differing = settingDifferences(left.settings, right.settings);
    if (!comparison.differing.empty())
        comparison.notes.push_back(fmt::format("{} and {} have different Settings: {}", left.name, right.name,
                                               describe(comparison.differing)));
}

// The forward+ Frame of the pair's scene and camera that shows the effect of the encoding.
const Frame* explaining(const Report& report, const Frame& left, const Frame& right) {
    if (!isReferenceFrame(left) && !isReferenceFrame(right)) return nullptr;
    Settings wanted = right.settings;
    wanted.path = unencoded_path;
    for (const Frame& frame : report.frames) {
        // Deferred ignores prepass.
        wanted.prepass = frame.settings.prepass;
        if (shadesFragments(frame.settings.path) && !frame.through_gbuffer.empty() &&
            frame.scene == right.scene && effectiveSettings(frame.settings) == effectiveSettings(wanted))
            return &frame;
    }
    return nullptr;
}

// Surface channels that were not requested but on which a compared lit channel depends. If deferred
// decodes them within their bounds, lit differs by no more than the bits allow.
std::vector<Channel> provingChannels(const Comparison& comparison, const FramePair& pair,
                                     std::span<const Rule> rules) {
    const Frame *deferred = pair.of(hasGBuffer), *forward = pair.of(shadesFragments);
    if (!deferred || !forward || !isPacked(deferred->settings)) return {};
    const bool evaluatesLit = std::ranges::any_of(comparison.channels, [&](const ChannelDiff& channel) {
        const DebugMode& mode = *channel.mode;
        return isLit(mode.channel) && isCompared(channel.verdict) && !isInformative(mode, pair) &&
               !ruleFor(rules, mode.name);
    });
    if (!evaluatesLit) return {};
    std::vector<Channel> modes;
    for (const Channel mode : lightingFields())
        if (deferred->channels.contains(mode) && forward->channels.contains(mode) &&
            std::ranges::none_of(comparison.channels,
                                 [&](const ChannelDiff& c) { return c.mode->channel == mode; }))
            modes.push_back(mode);
    return modes;
}

// Counts pixels that show another surface on the other device, and excludes them from the comparison.
void leaveOutOtherSurfaces(const FramePair& pair, Comparison& comparison) {
    const SurfacePixels surfaces = surfacePixels(pair);
    if (std::string fault = surfaces.fault(); !fault.empty())
        comparison.failures.push_back(std::move(fault));
    else
        comparison.notes.push_back(surfaces.describe());
    std::ranges::transform(comparison.coverage.covered, surfaces.others, comparison.coverage.covered.begin(),
                           [](auto covered, auto other) { return other != 0 ? 0 : covered; });
    comparison.coverage.count -= surfaces.count();
}

// Why agreement of two images says little: no surface, hardly any, or no light is visible. Else empty.
// `shown`: fraction of pixels that show a surface, before the command line's exclusions.
std::string emptinessOf(const Frame& left, const Frame& right, const Coverage& coverage, double shown) {
    // Below these, background or black pixels decide most of the verdict.
    constexpr double min = 0.01, min_lit = 0.05;
    if (coverage.known && shown == 0) return "both images are empty: no surface is in view";
    if (coverage.known && shown < min)
        return fmt::format("only {} of the image shows the scene", percentText(shown));
    const auto litOf = [&](const Frame& frame) {
        const Image* const lit = findChannel(frame, Channel::lit);
        return lit && frame.isRequested(Channel::lit) ? litFraction(*lit, coverage) : 1.0;
    };
    const double lit = std::max(litOf(left), litOf(right));
    if (lit == 0) return "both images are black: no light reaches a visible surface";
    return lit < min_lit ? fmt::format("light reaches only {} of the visible surfaces", percentText(lit))
                         : std::string();
}

// In mode scene: how many pixels of which channel are compared in which way; else empty.
std::string waysOfEvaluating(const std::vector<ChannelDiff>& channels) {
    std::vector<const ChannelDiff*> evaluated;
    for (const ChannelDiff& channel : channels)
        if (channel.footprints) evaluated.push_back(&channel);
    if (evaluated.empty()) return {};
    const auto smooth = [](const ChannelDiff* channel) { return channel->footprints->smooth; };
    const auto of = [](const ChannelDiff* channel) {
        const Footprints& f = *channel->footprints;
        return fmt::format("{} of {} in {}", f.smooth, f.pixels(), channel->mode->name);
    };
    return fmt::format(
        "--reference-mode scene: each pixel with smooth surroundings has its own bound (from {} to {}); the "
        "others together may have a mean FLIP of {}; each channel's section has its numbers",
        of(*std::ranges::min_element(evaluated, {}, smooth)),
        of(*std::ranges::max_element(evaluated, {}, smooth)), detailFlip);
}

// Channels for which a reference in mode scene gives hardly any pixel a bound of its own. Empty if there
// are none.
std::string looselyEvaluated(const std::vector<ChannelDiff>& channels) {
    std::vector<std::string> items;
    for (const ChannelDiff& channel : channels)
        if (const auto& f = channel.footprints; f && f->closeFraction() < minCloseFraction)
            items.push_back(fmt::format(
                "{} ({} of {} pixels{})", channel.mode->name, f->smooth, f->pixels(),
                f->detailed > 0 ? fmt::format(", the others by a mean FLIP of {}", detailFlip) : ""));
    return items.empty()
               ? std::string()
               : fmt::format("almost no pixel has a bound of its own in {}", fmt::join(items, ", "));
}

// Whether both images were rendered on devices without rounding differences; a file only if by this device.
bool isBitExact(const Report& report, const Frame& left, const Frame& right) {
    return std::ranges::all_of(std::array{&left, &right}, [&](const Frame* frame) {
        const bool here = frame->origin.file.empty() || (frame->origin.device == report.device.name &&
                                                         frame->origin.driver == report.device.driver);
        return here && deviceOf(report, *frame).bitExact();
    });
}

// Reports settings that another renderer did not apply, and its channels that Diptych lacks.
void readOrigins(const Frame& left, const Frame& right, bool strict, Comparison& comparison) {
    std::vector<std::string>& lines = strict ? comparison.failures : comparison.notes;
    for (const Frame* frame : {&left, &right})
        for (const std::string& line : frame->origin.not_applied)
            lines.push_back(fmt::format("{}: {}", frame->name, line));
    for (const Frame* frame : {&left, &right})
        if ((frame->requested.empty() || frame->origin.external) && !frame->origin.omitted_channels.empty())
            lines.push_back(fmt::format("{} of {}: not compared, Diptych has no such channel",
                                        fmt::join(frame->origin.omitted_channels, ", "), frame->name));
}

// Adds a channel that `lacking` does not have: as forward-only or deferred-only, or as a note or failure.
void addUnmatched(const DebugMode& mode, const Frame& having, const Frame& lacking,
                  const ChannelDemands& demands, Comparison& comparison) {
    const Rule* rule = ruleFor(demands.rules, mode.name);
    const Path path = lacking.settings.path;
    const bool forward_only = mode.supported_by == SupportedBy::forward_only && hasGBuffer(path),
               deferred_only = mode.supported_by == SupportedBy::deferred_only && shadesFragments(path);
    if ((!forward_only && !deferred_only) || (rule && namesChannels(*rule)))
        return evaluateOneSided(std::string(mode.name), having.name, demands, comparison.failures,
                                comparison.notes);
    ChannelDiff& channel = comparison.channels.emplace_back();
    channel.mode = &mode;
    channel.tolerance = {0, forward_only
                                ? "the G-buffer does not store it, so only forward+ has it"
                                : "forward+ shades each triangle as it is drawn, so only deferred has it"};
    channel.verdict = forward_only ? Verdict::forward_only : Verdict::deferred_only;
}

// Adds the requested channels of both sides, not yet compared. Returns the names of those that at least one
// side has.
std::vector<std::string> pairChannels(const FramePair& pair, const CompareOptions& options,
                                      Comparison& comparison) {
    const Frame &left = pair.baseline, &right = pair.test;
    // A path's other channels are of its first sample, the reference's of the pixel's centre.
    const bool lit_alone = pair.hasReference() && pair.path().settings.msaa > 1;
    if (lit_alone)
        comparison.notes.push_back(
            "only lit is compared with the reference: with MSAA, a path's other channels show one sample, "
            "the reference's the pixel centre");
    readOrigins(left, right, options.strict, comparison);
    ChannelDemands demands{options.rules, {}, options.strict};
    for (const Channel mode : options.required) demands.names.emplace_back(debugMode(mode).name);
    std::vector<std::string> names,
        lacking_channels;  // missing in another renderer, which need not have them
    for (const DebugMode& mode : debugModes()) {
        const bool onLeft = left.channels.contains(mode.channel) && left.isRequested(mode.channel),
                   onRight = right.channels.contains(mode.channel) && right.isRequested(mode.channel);
        if (!onLeft && !onRight) continue;
        names.emplace_back(mode.name);
        if (lit_alone && mode.channel != Channel::lit) continue;
        const bool paths = !isSupportedByReference(mode);
        if (onLeft && onRight) {
            if (paths && left.settings.assign != right.settings.assign)
                comparison.notes.push_back(
                    fmt::format("{} was not compared: --assign {} and {} evaluate different lights",
                                mode.name, nameOf(left.settings.assign), nameOf(right.settings.assign)));
            else
                comparison.channels.emplace_back().mode = &mode;
            continue;
        }
        const Frame &having = onLeft ? left : right, &lacking = onLeft ? right : left;
        if (paths && isReferenceFrame(lacking)) continue;
        if (lacking.origin.external && !options.strict)
            lacking_channels.emplace_back(mode.name);
        else
            addUnmatched(mode, having, lacking, demands, comparison);
    }
    if (std::ranges::none_of(comparison.channels, isCompared, &ChannelDiff::verdict))
        throw std::runtime_error(
            fmt::format("{} and {} share no requested channel; add one that both support to --channels",
                        left.name, right.name));
    if (!lacking_channels.empty())
        comparison.notes.push_back(fmt::format("{} does not have {}: not compared",
                                               (left.origin.external ? left : right).name,
                                               fmt::join(lacking_channels, ", ")));
    return names;
}

// Compares the matched channels, and those that prove lit; of these, keeps only the failing ones.
void diffChannels(const FramePair& pair, const CompareOptions& options, Comparison& comparison) {
    const std::vector<Channel> proving = provingChannels(comparison, pair, options.rules);
    for (const Channel mode : proving) comparison.channels.emplace_back().mode = &debugMode(mode);
    std::atomic<std::size_t> done{0};
    tbb::parallel_for(std::size_t{0}, comparison.channels.size(), [&](std::size_t i) {
        ChannelDiff& channel = comparison.channels[i];
        if (isCompared(channel.verdict))
            channel = diffChannel(*channel.mode, pair, options.rules, options.allow_noise);
        for (const Frame* frame : {&pair.baseline, &pair.test, pair.explaining})
            if (frame) letGo(*frame, channel.mode->channel);
        options.progress.at(static_cast<double>(++done) / static_cast<double>(comparison.channels.size()),
                            "compare " + std::string(channel.mode->name));
    });
    std::erase_if(comparison.channels, [&](const ChannelDiff& channel) {
        return channel.verdict == Verdict::pass && std::ranges::count(proving, channel.mode->channel) > 0;
    });
    std::ranges::sort(comparison.channels, {}, [](const ChannelDiff& c) { return c.mode->channel; });
}

// Warns if agreement says little; a failure with --strict. `shown` as for emptinessOf().
void readEmptiness(const FramePair& pair, double shown, const CompareOptions& options,
                   Comparison& comparison) {
    const auto weaken = [&](const std::string& why, const char* hint = "; --strict does not accept that") {
        if (options.strict)
            comparison.failures.push_back(why + hint);
        else
            comparison.emptiness += (comparison.emptiness.empty() ? "" : "; ") + why;
    };
    const std::string emptiness = emptinessOf(pair.baseline, pair.test, comparison.coverage, shown);
    if (!emptiness.empty() && options.allow_empty)
        comparison.notes.push_back(emptiness);
    else if (!emptiness.empty())
        weaken(emptiness, "; --allow-empty accepts that");
    if (const std::string loose = looselyEvaluated(comparison.channels); !loose.empty()) weaken(loose);
    for (const ChannelDiff& channel : comparison.channels) {
        if (channel.approximation_errors.empty()) continue;
        const std::string text = approximationErrorText(*channel.mode, channel.approximation_errors);
        if (meanApproximationError(channel.approximation_errors) > maxApproximationError &&
            channel.rule.empty() && channel.verdict == Verdict::pass)
            weaken(text);
        else
            comparison.notes.push_back(text);
    }
}

}  // namespace

const ReportDevice& deviceOf(const Report& report, const Frame& frame) {
    const bool other = frame.origin.file.empty() && !report.against.name.empty() &&
                       frame.origin.device == report.against.name;
    return other ? report.against : report.device;
}

bool Comparison::passed() const {
    return failures.empty() &&
           std::ranges::none_of(channels, [](const ChannelDiff& c) { return c.verdict == Verdict::fail; });
}

bool Report::passed() const {
    return failures.empty() && std::ranges::all_of(comparisons, &Comparison::passed);
}

Comparison compareFrames(const Report& report, std::size_t baseline, std::size_t test,
                         const Requirements& needs, const CompareOptions& options) {
    Comparison comparison;
    comparison.baseline = baseline;
    comparison.test = test;
    const Frame &left = report.baseline(comparison), &right = report.test(comparison);
    if (left.settings.size != right.settings.size)
        throw std::runtime_error(fmt::format("{} is {}x{} and {} is {}x{}: images must have the same size",
                                             left.name, left.settings.size.width, left.settings.size.height,
                                             right.name, right.settings.size.width,
                                             right.settings.size.height));
    comparison.coverage = coverage(left, right);
    const double shown = static_cast<double>(comparison.coverage.count) /
                         static_cast<double>(std::max<std::size_t>(comparison.coverage.covered.size(), 1));
    applySelection(comparison.coverage, left.settings.size.width, left.settings.size.height,
                   options.selection,
                   {{findChannel(left, Channel::material_id), findChannel(right, Channel::material_id)},
                    {findChannel(left, Channel::depth), findChannel(right, Channel::depth)}},
                   comparison.notes);
    FramePair pair{left,
                   right,
                   needs,
                   comparison.coverage,
                   isBitExact(report, left, right),
                   explaining(report, left, right),
                   options.texels ? &*options.texels : nullptr,
                   options.across};
    if (!options.across) pair.light_differs = options.light_differs;
    noteSides(left, right, comparison);
    std::optional<SurfaceGrid> grid;
    if (options.across) {
        pair.grid = &grid.emplace(pair);
        leaveOutOtherSurfaces(pair, comparison);
    }

    const std::vector<std::string> names = pairChannels(pair, options, comparison);
    diffChannels(pair, options, comparison);
    // Two devices blend surfaces that each has sampled and placed in its own way.
    if (!options.across) readBlending(pair, options.rules, comparison);
    for (const Frame* frame : {&left, &right}) {
        readCounters(*frame, comparison);
        readNoise(*frame, deviceOf(report, *frame).bitExact(), options.allow_noise, comparison);
    }
    if (const std::string ways = waysOfEvaluating(comparison.channels); !ways.empty())
        comparison.notes.push_back(ways);
    for (const Rule* rule : idleRules(options.rules, names))
        comparison.notes.push_back(idleText(*rule, names));
    if (!comparison.coverage.known)
        comparison.notes.push_back("without material_id and depth, background pixels count in every mean");
    readEmptiness(pair, shown, options, comparison);
    return comparison;
}

}  // namespace diptych
