// SPDX-License-Identifier: MIT
// Options for comparing two paths: rules, masks, noise; and comparison with an earlier image.
#include "compare/frames/frame_properties.h"
#include "compare/verdict/encoding_bits.h"
#include "compare/verdict/footprint.h"
#include "compare/verdict/measurement.h"
#include "compare/verdict/pair_reports.h"
#include "compare/verdict/surface_pixels.h"
#include "shared/contract/debug_mode.h"
#include "tests/support/report_builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <span>

namespace diptych {
namespace {

Report compared(std::vector<Frame> frames, const CompareOptions& options, const char* device = "cpu") {
    return makeReport({{std::move(frames)}}, {"a device", "1.0", device}, options);
}

const ChannelDiff& litOf(const Report& report) {
    for (const ChannelDiff& channel : report.comparisons.at(0).channels)
        if (channel.mode->channel == Channel::lit) return channel;
    throw std::runtime_error("no lit");
}

bool says(const std::vector<std::string>& lines, const std::string& text) {
    return std::ranges::any_of(lines, [&](const std::string& l) { return l.find(text) != l.npos; });
}

// Each condition of a Frame alone adds its own line, to the notes or to the failures.
TEST(CompareOptions, EveryCounterHasItsLine) {
    using Counters = FrameCounters;
    struct Cause {
        void (*set)(Counters&);
        bool fails;
        std::string line;
    };
    const Cause causes[] = {
        {[](Counters& c) { c.nonfinite_pixels = 1; }, true, "lit is NaN or infinite at 1 pixel"},
        {[](Counters& c) { c.overflowed_lists = 1; }, false,
         "1 light list overflowed, so every light was evaluated there: exact, but slow"},
        {[](Counters& c) {
             c.shadow_pages = {600, 597, 3, 0};
         },
         false, "3 of 600 shadow pages did not fit in --clipmap-pages 512; a coarser level replaces them"},
        {[](Counters& c) {
             c.unsorted = {4, 2};
         },
         false,
         "4 blended fragments of 2 pixels did not fit in --transparency-layers 8; their mean is blended as "
         "one layer behind the others"},
        {[](Counters& c) { c.unreproduced_pixels = 2; }, true,
         "lit of the capture differs from the timed pipeline at 2 pixels, so its channels may belong to "
         "another image"},
        {[](Counters& c) { c.energy_cut = 0.125; }, false,
         "--light-cutoff 0 removes 12.5 % of the unshadowed flux from lights without a range"}};
    const std::vector<Frame> frames = bothFrames("one.glb");
    const Comparison plain = compared(frames, {}).comparisons.at(0);
    const auto sorted = [](std::vector<std::string> lines) {
        std::ranges::sort(lines);
        return lines;
    };
    for (const Cause& cause : causes)
        for (const std::size_t side : {0u, 1u}) {
            std::vector<Frame> changed = frames;
            cause.set(changed[side].counters);
            std::vector<std::string> notes = plain.notes, failures = plain.failures;
            (cause.fails ? failures : notes).push_back(frames[side].name + ": " + cause.line);
            const Comparison found = compared(changed, {}).comparisons.at(0);
            EXPECT_EQ(sorted(found.notes), sorted(notes));
            EXPECT_EQ(sorted(found.failures), sorted(failures));
        }
}

// Two paths whose lit differs by a relative 0.25 at the only covered pixel; the encoding does not account
// for it.
std::vector<Frame> framesApart() {
    std::vector<Frame> frames = bothFrames("one.glb");
    frames[0].channels.at(Channel::lit).at(1, 2) = 1;
    frames[1].channels.at(Channel::lit).at(1, 2) = 1.25f;
    frames[1].through_gbuffer.clear();
    return frames;
}

TEST(CompareOptions, ARuleDecidesInPlaceOfTheTolerance) {
    EXPECT_EQ(litOf(compared(framesApart(), {})).verdict, Verdict::fail);
    CompareOptions options;
    options.rules = rulesFromJson(
        R"({"rules": [{"channel": "lit", "max": 0.25, "warn": {"max": 0.2}, "because": "a quarter"}]})",
        "t.json");
    const ChannelDiff channel = litOf(compared(framesApart(), options));
    EXPECT_EQ(channel.verdict, Verdict::pass);
    EXPECT_EQ(channel.rule, "t.json, rule 1: max <= 0.25");
    EXPECT_EQ(channel.warning, "max 0.25 exceeds 0.2, at 100 % of the pixels");
    EXPECT_EQ(channel.tolerance.max, 0.25);
    EXPECT_EQ(channel.tolerance.because, "a quarter");
    options.rules =
        rulesFromJson(R"({"rules": [{"channel": "lit", "max": 0.2, "because": "a fifth"}]})", "t.json");
    EXPECT_EQ(litOf(compared(framesApart(), options)).reason, "max 0.25 exceeds 0.2, at 100 % of the pixels");
}

TEST(CompareOptions, PixelsThatAreLeftOutDoNotCount) {
    std::vector<Frame> frames = framesApart();
    for (Frame& frame : frames) frame.channels.at(Channel::material_id).at(0, 0) = 3;  // a second pixel
    CompareOptions options;
    options.selection.crop = Crop{0, 0, 1, 1};
    EXPECT_EQ(litOf(compared(frames, options)).stats.different, 0u);
    options.selection.crop = Crop{1, 2, 1, 1};
    EXPECT_EQ(litOf(compared(frames, options)).stats.max, 0.25);
}

TEST(CompareOptions, ColoursHaveAFlip) {
    const Report report = compared(framesApart(), {});
    EXPECT_GT(litOf(report).flip.value(), 0);
    for (const ChannelDiff& channel : report.comparisons[0].channels)
        EXPECT_EQ(channel.flip.has_value(), channel.mode->kind == ChannelKind::color) << channel.mode->name;
}

// A path's second run differs from its first by 0.3 at 2 pixels.
std::vector<Frame> noisyFrames() {
    std::vector<Frame> frames = framesApart();
    frames[0].noise[Channel::lit] = {2, 0.3};
    frames[1].noise[Channel::lit] = {0, 0};
    return frames;
}

TEST(CompareOptions, NoiseIsARaceOnACpu) {
    const Report report = compared(
        noisyFrames(), {.baseline = {}, .rules = {}, .selection = {}, .words = {}, .allow_noise = true});
    EXPECT_TRUE(
        says(report.comparisons[0].failures, "two runs differ in lit at 2 pixels, by up to 0.3: a race"));
    EXPECT_EQ(litOf(report).verdict, Verdict::fail) << "nothing is granted for a race";
}

TEST(CompareOptions, WhatKernelsLeaveMayNotChange) {
    std::vector<Frame> frames = framesApart();
    frames[1].changed_buffers = {"light lists", "posed positions"};
    EXPECT_TRUE(
        says(compared(frames, {}, "discrete").comparisons[0].failures,
             "a second run of the compute shaders left other data in light lists, posed positions: a race"));
}

TEST(CompareOptions, NoiseOfAGpuIsSaidAndGrantedOnlyWhereAsked) {
    Report report = compared(noisyFrames(), {}, "discrete");
    EXPECT_TRUE(says(report.comparisons[0].notes, "--allow-noise adds that to the tolerance"));
    EXPECT_TRUE(report.comparisons[0].failures.empty());
    EXPECT_EQ(litOf(report).verdict, Verdict::fail);
    report = compared(noisyFrames(),
                      {.baseline = {}, .rules = {}, .selection = {}, .words = {}, .allow_noise = true},
                      "discrete");
    EXPECT_EQ(litOf(report).verdict, Verdict::pass);
    EXPECT_NE(litOf(report).tolerance.because.find("plus 0.3, the difference of two runs of one path"),
              std::string::npos);
    EXPECT_GE(litOf(report).tolerance.max, 0.3);
}

TEST(CompareOptions, ABaselineIsHeldAgainstBothPaths) {
    std::vector<Frame> frames = framesApart();
    Frame baseline = frames[0];
    baseline.name = "baseline";
    baseline.origin = {"b.exr", "a device", "1.0", "abc"};
    const Report report = makeReport({{frames}}, {"a device", "1.0", "cpu"}, {}, baseline);
    ASSERT_EQ(report.comparisons.size(), 3u);
    EXPECT_EQ(report.baseline(report.comparisons[0]).name, "baseline");
    EXPECT_EQ(report.test(report.comparisons[1]).name, frames[1].name);
    EXPECT_EQ(litOf(report).stats.different, 0u) << "the same path, unchanged";
    EXPECT_FALSE(report.passed()) << "the other path";
}

// Channels that a comparison draws besides those asked for, once each, by what is compared.
TEST(CompareOptions, HelpersAreDrawnBesideTheChannels) {
    using Channels = std::vector<Channel>;
    Settings packed, full;
    packed.path = full.path = Path::deferred;
    packed.gbuffer = GBufferEncoding::standard;
    packed.shadows = full.shadows = Shadows::off;
    full.gbuffer = GBufferEncoding::full;
    Settings shadowed = full;
    shadowed.shadows = Settings().shadows;
    ASSERT_NE(shadowed.shadows, Shadows::off);
    const auto helpers = [](const Channels& asked, const Settings& settings, bool traced = false,
                            bool across = false) {
        RenderOptions options;
        options.channels = asked;
        const RenderOptions drawn =
            evaluatedOptions(options, std::span(&settings, 1), traced, across, options.twice);
        EXPECT_TRUE(drawn.through_gbuffer);
        EXPECT_TRUE(drawn.environment_errors);
        EXPECT_EQ(drawn.every_sample, Channels(lightingFields().begin(), lightingFields().end()));
        EXPECT_EQ(Channels(drawn.channels.begin(), drawn.channels.begin() + std::ssize(asked)), asked);
        const Channels added(drawn.channels.begin() + std::ssize(asked), drawn.channels.end());
        std::set<Channel> all(drawn.channels.begin(), drawn.channels.end());
        EXPECT_EQ(all.size(), drawn.channels.size()) << "no channel twice";
        return std::set<Channel>(added.begin(), added.end());
    };
    const auto setOf = [](const auto& channels) {
        return std::set<Channel>(channels.begin(), channels.end());
    };
    const std::set<Channel> ids{Channel::material_id},
        shadows{Channel::material_id, Channel::depth, Channel::cascade, Channel::page_residency};
    EXPECT_EQ(helpers({Channel::albedo}, packed), ids);
    EXPECT_EQ(helpers({Channel::albedo, Channel::material_id}, packed), std::set<Channel>{});
    EXPECT_EQ(helpers({Channel::lit}, full), ids);
    EXPECT_EQ(helpers({Channel::lit}, shadowed), shadows);
    std::set<Channel> fields = setOf(lightingFields());
    fields.insert(Channel::material_id);
    std::set<Channel> shaded = fields;
    fields.erase(Channel::geometric_normal);
    EXPECT_EQ(helpers({Channel::lit}, packed), fields) << "only shadows read the triangle's normal";
    shadowed.gbuffer = GBufferEncoding::standard;
    shaded.insert(shadows.begin(), shadows.end());
    EXPECT_EQ(helpers({Channel::lit}, shadowed), shaded);
    EXPECT_EQ(helpers({Channel::depth}, full, true), setOf(footprintChannels()));
    std::set<Channel> across = setOf(surfacePixelChannels());
    across.insert(surfaceChannels().begin(), surfaceChannels().end());
    across.insert(
        {Channel::texcoords, Channel::lightmapped, Channel::shadow_visibility, Channel::local_visibility});
    EXPECT_EQ(helpers({}, full, false, true), across);
}

// FLIP, means and SSIM stay finite for NaN, but no bound on them may let a NaN against a number pass.
TEST(Measurement, NothingPassesANan) {
    const Image a(16, 16, 3, 0.5f);
    Image b = a;
    b.data[300] = std::nanf("");
    const Coverage all = everyPixel(a.pixels());
    const Measurement same({ErrorKind::absolute, ChannelKind::color, true, b, b, &all, nullptr, {}}),
        one({ErrorKind::absolute, ChannelKind::color, true, a, b, &all, nullptr, {}}),
        other({ErrorKind::absolute, ChannelKind::color, false, b, a, &all, nullptr, {}});
    EXPECT_EQ(same({"flip", 0}), 0);
    EXPECT_EQ(one({"flip", 0}), 1.0 / 256) << "error 1 there, counted, not spread";
    EXPECT_EQ(other({"flip", 0}), 1.0 / 256) << "in the reference, too";
    EXPECT_EQ(one({"failing", 1e30}), 1.0 / 256);
    for (const Metric& metric : allMetrics()) {
        EXPECT_EQ(metric.more_is_better, metric.name == "psnr" || metric.name == "ssim") << metric.name;
        Rule rule;
        const double worst = metric.more_is_better ? -std::numeric_limits<double>::infinity() : 1e300;
        rule.fail = {Condition::Kind::bound, {std::string(metric.name), 0}, worst, {}};
        if (!same(rule.fail.quantity)) continue;
        EXPECT_EQ(decide(rule, same).level, Level::pass) << metric.name;
        EXPECT_EQ(decide(rule, one).level, Level::fail) << metric.name;
    }
    Rule fraction;
    fraction.fail = {Condition::Kind::bound, {"failing", 0}, 0.004, {}};
    EXPECT_EQ(decide(fraction, one).level, Level::pass) << "1 of 256 pixels may fail";
    fraction.fail.limit = 0.0039;
    EXPECT_EQ(decide(fraction, one).level, Level::fail);
}

}  // namespace
}  // namespace diptych
