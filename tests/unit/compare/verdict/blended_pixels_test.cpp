// SPDX-License-Identifier: MIT
// Tolerance of lit where the reference shows blended surfaces, or light through rough or refracting glass.
#include "compare/verdict/blended_pixels.h"

#include "compare/verdict/comparison.h"
#include "compare/verdict/footprint.h"
#include "tests/support/frames.h"
#include "tests/support/report_builder.h"

#include <gtest/gtest.h>

namespace diptych {
namespace {

constexpr int imageWidth = 40, imageHeight = 25;
constexpr std::size_t glassPixel = 12 * imageWidth + 20;

// Radiance 1 in lit and 0.5 through glass; opaque surfaces send 1, the brightest one 8. Half the light
// behind one pixel passes its glass and arrives from elsewhere.
struct Glass {
    std::vector<Frame> frames{flatFrame(Path::reference, imageWidth, imageHeight, 1, 3),
                              flatFrame(Path::forward_plus, imageWidth, imageHeight, 1, 3)};
    Requirements needs;
    Coverage coverage = everyPixel(std::size_t{imageWidth} * imageHeight);

    explicit Glass(ReferenceMode mode = ReferenceMode::surface) {
        for (Frame& frame : frames) {
            frame.scene = "a scene";
            frame.settings.gbuffer = GBufferEncoding::full;
            frame.channels[Channel::lit_transmission] = Image(imageWidth, imageHeight, 3, 0.5f);
            frame.unblended = frame.channels[Channel::lit];
        }
        frames[0].settings.reference_mode = mode;
        frames[0].unblended.pixel(0)[2] = 8;
        frames[0].blended = Image(imageWidth, imageHeight, 3);
        frames[0].blended.pixel(glassPixel)[0] = 0.5f;
        frames[0].blended.pixel(glassPixel)[1] = 0.5f;
        frames[0].blended.pixel(glassPixel)[2] = 0.5f;
    }
    double allowed(Channel mode, std::size_t pixel) const {
        return BlendedPixels({frames[0], frames[1], needs, coverage}).allowed(debugMode(mode), pixel);
    }
};

TEST(BlendedPixels, RoughOrRefractingGlassMayShowWhatTheImageHolds) {
    const Glass g;
    EXPECT_EQ(g.allowed(Channel::lit, glassPixel), 4) << "half of the brightest pixel";
    EXPECT_EQ(g.allowed(Channel::lit_transmission, glassPixel), 4);
    EXPECT_EQ(g.allowed(Channel::lit, glassPixel + 1), 4)
        << "the rasteriser's edge may lie one pixel further";
    EXPECT_EQ(g.allowed(Channel::lit, glassPixel + 2), 0);
    EXPECT_EQ(g.allowed(Channel::material_id, glassPixel), 0);
    EXPECT_TRUE(BlendedPixels({g.frames[0], g.frames[1], g.needs, g.coverage}).anyGlass());
    Glass bright;
    bright.frames[0].blended.pixel(glassPixel)[2] = 20;
    EXPECT_EQ(bright.allowed(Channel::lit, glassPixel), 20)
        << "the reference saw what the picture does not hold";
}

// A comparison may have no channel but lit.
TEST(BlendedPixels, WhatGlassReflectsIsHeldAsElsewhere) {
    Glass g;
    for (Frame& frame : g.frames) frame.channels.erase(Channel::lit_transmission);
    g.frames[0].channels[Channel::lit] = Image(imageWidth, imageHeight, 3, 20);
    g.frames[0].blended.pixel(glassPixel)[1] = 0.001f;
    EXPECT_FLOAT_EQ(static_cast<float>(g.allowed(Channel::lit, glassPixel)), 0.5f);
}

TEST(BlendedPixels, ClearThinGlassMayNot) {
    Glass g;
    g.frames[0].blended.pixel(glassPixel)[1] = 0;
    EXPECT_EQ(g.allowed(Channel::lit, glassPixel), 0);
    EXPECT_FALSE(BlendedPixels({g.frames[0], g.frames[1], g.needs, g.coverage}).anyGlass());
}

// One pixel of 1000 may be off in any case.
TEST(BlendedPixels, AVerdictSaysWhatItGrants) {
    for (const ReferenceMode mode : {ReferenceMode::surface, ReferenceMode::scene}) {
        const auto verdictOf = [&](float error, std::size_t pixel) {
            Glass g(mode);
            for (const std::size_t i : {pixel - 1, pixel, pixel + 1})
                for (int c = 0; c < 3; ++c) g.frames[1].channels[Channel::lit].pixel(i)[c] += error;
            Report report;
            report.device = {"a CPU", "1.0", "cpu"};
            report.frames = std::move(g.frames);
            for (Frame& frame : report.frames) frame.requested = {Channel::lit};
            return compareFrames(report, 0, 1, {}, {}).channels.front();
        };
        const ChannelDiff granted = verdictOf(3.5f, glassPixel);
        EXPECT_EQ(granted.verdict, Verdict::pass) << nameOf(mode);
        EXPECT_NE(granted.tolerance.because.find(throughGlassBecause), std::string::npos)
            << granted.tolerance.because;
        EXPECT_EQ(verdictOf(4.5f, glassPixel).verdict, Verdict::fail) << nameOf(mode);
        if (mode == ReferenceMode::surface)
            EXPECT_EQ(verdictOf(3.5f, glassPixel - 5).verdict, Verdict::fail) << "elsewhere";
        else
            EXPECT_EQ(granted.footprints.value().glass, 9u);
    }
}

// One pixel of 1000 may be beyond its bound, but not one of the 520 without glass.
TEST(BlendedPixels, GlassDoesNotExcuseOtherPixels) {
    for (const bool half : {false, true}) {
        Glass g(ReferenceMode::scene);
        if (!half) g.frames[0].blended = Image(imageWidth, imageHeight, 3);
        for (std::size_t i = 13 * imageWidth; half && i < g.frames[0].blended.pixels(); ++i)
            for (int c = 0; c < 3; ++c) g.frames[0].blended.pixel(i)[c] = 0.5f;
        for (int c = 0; c < 3; ++c) g.frames[1].channels[Channel::lit].pixel(2 * imageWidth + 2)[c] += 0.01f;
        Report report;
        report.device = {"a CPU", "1.0", "cpu"};
        report.frames = std::move(g.frames);
        for (Frame& frame : report.frames) frame.requested = {Channel::lit};
        const ChannelDiff lit = compareFrames(report, 0, 1, {}, {}).channels.front();
        EXPECT_EQ(lit.footprints.value().beyond, 1u);
        EXPECT_EQ(lit.verdict, half ? Verdict::fail : Verdict::pass);
    }
}

}  // namespace
}  // namespace diptych
