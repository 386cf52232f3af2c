// SPDX-License-Identifier: MIT
// The bound of what an encoding may do to light: how it is gathered, what a verdict makes of it, and what is
// outside of a channel's domain.
#include "compare/render/encoding_bound.h"
#include "compare/verdict/domain.h"
#include "compare/verdict/encoding_use.h"
#include "compare/verdict/measurement.h"
#include "compare/verdict/pair_reports.h"
#include "tests/support/report_maker.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <utility>

namespace diptych {
namespace {

Image oneGrey(float value) {
    return Image(1, 1, 3, value);
}

// |c - own| + r + n + n r / |c| with own 1, c 1.1, normals at most 0.3 and roughnesses at most 0.2 from it.
TEST(EncodingBound, AddsWhatEachFieldMoves) {
    const Image own = oneGrey(1);
    EncodingBound bound(own);
    bound.add(gpu::SURFACE_RAISED, oneGrey(1.1f));
    for (const float normal : {1.0f, 0.8f, 1.2f, 1.3f})
        bound.add(gpu::SURFACE_NORMAL + (normal > 1), oneGrey(normal));
    bound.add(gpu::SURFACE_ROUGHNESS, oneGrey(0.9f));
    bound.add(gpu::SURFACE_ROUGHNESS + 1, oneGrey(1.15f));
    EXPECT_NEAR(*bound.take().pixel(0), 0.1 + 0.2 + 0.3 + 0.3 * 0.2 / 1.1, 1e-6);
}

// The largest component counts, wherever it is; and the second pixel is not the first.
TEST(EncodingBound, IsOfEachPixelAndItsLargestComponent) {
    Image own(2, 1, 3, 1.0f), raised = own, normal = own;
    normal.pixel(0)[2] = 1.5f;
    normal.pixel(1)[0] = 0.75f;
    EncodingBound bound(own);
    bound.add(gpu::SURFACE_RAISED, raised);
    bound.add(gpu::SURFACE_NORMAL + 3, normal);
    const Image all = bound.take();
    EXPECT_FLOAT_EQ(*all.pixel(0), 0.5f);
    EXPECT_FLOAT_EQ(*all.pixel(1), 0.25f);
}

TEST(EncodingBound, NeitherNanNorInfinityWidensIt) {
    const Image own = oneGrey(1);
    EncodingBound bound(own);
    bound.add(gpu::SURFACE_RAISED, oneGrey(1));
    bound.add(gpu::SURFACE_NORMAL, oneGrey(std::numeric_limits<float>::quiet_NaN()));
    bound.add(gpu::SURFACE_ROUGHNESS, oneGrey(std::numeric_limits<float>::infinity()));
    EXPECT_EQ(*bound.take().pixel(0), 0.0f);
    EncodingBound dark(own);
    EXPECT_THROW(dark.add(gpu::SURFACE_NORMAL, oneGrey(1)), std::logic_error) << "without what it moves from";
}

const ChannelDiff& firstOf(const Report& report) {
    return report.comparisons.at(0).channels.at(0);
}

// What deferred reads back explains the whole difference, and is yet eleven times what the bits can do.
TEST(EncodingUse, BeyondTheBitsFailsByName) {
    std::vector<Frame> frames = bothFrames();
    for (auto& [mode, bound] : frames[1].encoding_bound) bound = Image(4, 3, 1, 0.01f);
    frames[0].channels[0].at(1, 2, 1) = frames[1].through_gbuffer[0].at(1, 2, 1) = 0.5f + 0.11f;
    const Report report = reportOf(frames);
    const ChannelDiff& lit = firstOf(report);
    EXPECT_EQ(lit.unexplained_pixels, 0u);
    EXPECT_EQ(lit.verdict, Verdict::fail);
    EXPECT_NE(lit.reason.find("10.9 times the bound at 1,2"), std::string::npos) << lit.reason;
    EXPECT_NE(lit.reason.find("at 1 pixel ("), std::string::npos);
    frames[1].encoding_bound[0] = Image(4, 3, 1, 0.12f);
    EXPECT_EQ(firstOf(reportOf(frames)).verdict, Verdict::pass) << "the control";
}

// The bound is each pixel's own: a large one elsewhere excuses nothing here.
TEST(EncodingUse, IsJudgedPixelByPixel) {
    std::vector<Frame> frames = bothFrames();
    for (Frame& frame : frames)
        for (auto& [mode, image] : frame.channels)
            for (int c = 0; c < image.components; ++c) image.at(2, 2, c) = image.at(1, 2, c);
    frames[1].through_gbuffer[0] = frames[0].channels[0];
    frames[1].encoding_bound[0].at(1, 2) = 0.01f;
    frames[1].encoding_bound[0].at(2, 2) = 100;
    frames[0].channels[0].at(1, 2, 0) = frames[1].through_gbuffer[0].at(1, 2, 0) = 0.52f;
    const Report report = reportOf(frames);
    EXPECT_EQ(firstOf(report).verdict, Verdict::fail);
    EXPECT_EQ(firstOf(report).encoding_use->beyond, 1u);
    EXPECT_GT(firstOf(report).tolerance.max, 100) << "which the largest difference is far below";
}

// In a dark pixel the integrals over area lights round as light of a tenth of the mean luminance does, and
// nothing else.
TEST(EncodingUse, OnlyAreaLightsRoundAsBrighterLight) {
    const auto beyond = [](std::uint32_t tubes, float apart) {
        Frame deferred, forward;
        deferred.settings.path = Path::deferred;
        forward.settings.path = Path::forward_plus;
        forward.encoding_bound[0] = Image(2, 1, 1, 0.0f);
        forward.channels[0] = deferred.channels[0] = Image(2, 1, 3, 1.0f);
        for (int c = 0; c < 3; ++c) forward.channels[0].at(1, 0, c) = 1e-5f;
        for (int c = 0; c < 3; ++c) deferred.channels[0].at(1, 0, c) = 1e-5f + apart;
        Requirements needs;
        needs.tube_lights = tubes;
        const Coverage both = everyPixel(2);
        return encodingUse(debugMode(0), FramePair{deferred, forward, needs, both}).value().beyond;
    };
    EXPECT_EQ(beyond(0, 3e-8f), 0u) << "of the metric's floor";
    EXPECT_EQ(beyond(0, 3e-6f), 1u);
    EXPECT_EQ(beyond(1, 3e-6f), 0u);
    EXPECT_EQ(beyond(1, 8e-6f), 1u);
}

// Of two pixels, of radiance 1 and of 1e-6, whose surfaces no bits move.
struct TwoPixels {
    Frame deferred, forward;

    explicit TwoPixels(const std::function<void(Settings&)>& set) {
        for (Frame* frame : {&deferred, &forward}) set(frame->settings);
        deferred.settings.path = Path::deferred;
        forward.settings.path = Path::forward_plus;
        for (const int mode : litModes) {
            forward.encoding_bound[mode] = Image(2, 1, 1, 0.0f);
            forward.channels[mode] = deferred.channels[mode] = Image(2, 1, 3, 1.0f);
            for (Frame* frame : {&deferred, &forward})
                for (int c = 0; c < 3; ++c) frame->channels[mode].at(1, 0, c) = 1e-6f;
        }
    }
    // What is used where deferred is off by so much at one of them.
    double used(int pixel, float apart, int mode = 0) {
        Frame& off = deferred;
        const float before = off.channels[mode].at(pixel, 0, 0);
        off.channels[mode].at(pixel, 0, 0) += apart;
        const double used = use(mode).used;
        off.channels[mode].at(pixel, 0, 0) = before;
        return used;
    }
    EncodingUse use(int mode = 0) const {
        const Requirements needs;
        const Coverage both = everyPixel(2);
        return encodingUse(debugMode(mode), FramePair{deferred, forward, needs, both}).value();
    }
};

// Two pictures and seven moved ones, each rounded by a step of lit's format: of 10 bits of mantissa in 16
// bits, of 5 in the blue of 11.11.10; below 2^-14 steps are no smaller. Where something was blended over
// them, of up to eight layers, nine times that.
TEST(EncodingUse, AFormatOfFewerBitsGrantsItsStepsAndNoMore) {
    for (const auto& [format, step] :
         {std::pair(LitFormat::fp32, 0.0), {LitFormat::fp16, 0x1p-10}, {LitFormat::b10g11r11, 0x1p-5}}) {
        TwoPixels pixels([&](Settings& settings) { settings.lit_format = format; });
        const auto granted = [&](double at) { return 9 * step * at + 1e-4 * at; };
        EXPECT_LE(pixels.used(0, static_cast<float>(0.99 * granted(1))), 1) << nameOf(format);
        EXPECT_GT(pixels.used(0, static_cast<float>(1.4 * granted(1))), 1) << nameOf(format);
        if (step > 0) {
            EXPECT_LE(pixels.used(1, static_cast<float>(0.99 * 9 * step * 0x1p-14)), 1) << nameOf(format);
            EXPECT_GT(pixels.used(1, static_cast<float>(1.4 * 9 * step * 0x1p-14)), 1) << nameOf(format);
            EXPECT_NE(pixels.use().beside.find("9 steps"), std::string::npos) << pixels.use().beside;
        } else {
            EXPECT_EQ(pixels.use().beside, "");
        }
        const int diffuse = static_cast<int>(gpu::DEBUG_lit_diffuse);
        EXPECT_GT(pixels.used(0, 2e-4f, diffuse), 1) << "only lit is drawn to that format";
        pixels.forward.unblended = pixels.forward.channels[0];
        EXPECT_GT(pixels.used(0, static_cast<float>(1.4 * granted(1))), 1) << "nothing is blended there";
        pixels.forward.unblended.at(0, 0, 1) = 0.5f;
        if (step > 0) {
            EXPECT_LE(pixels.used(0, static_cast<float>(0.99 * 9 * granted(1))), 1) << nameOf(format);
        }
        // Of the blue of 11.11.10 81 steps are more than the pixel itself: of what is blended to it the bound
        // says nothing, and what deferred reads back must be forward+'s bit for bit all the more.
        if (step == 0x1p-10) {
            EXPECT_GT(pixels.used(0, static_cast<float>(1.4 * 9 * granted(1))), 1) << nameOf(format);
        }
    }
}

// Three pictures of floats of 16 bits, which round to 2^-11: of a lobe in 52 roundings, of diffuse light
// in 21. Ambient light is no part of that, and what is dark is granted little.
TEST(EncodingUse, FloatsOf16BitsGrantTheirRoundingsAndNoMore) {
    TwoPixels half([](Settings& settings) { settings.shading_precision = ShadingPrecision::fp16; });
    const int diffuse = static_cast<int>(gpu::DEBUG_lit_diffuse),
              specular = static_cast<int>(gpu::DEBUG_lit_specular),
              ambient = static_cast<int>(gpu::DEBUG_lit_ambient);
    for (const auto& [mode, roundings] :
         {std::pair(0, 52.0), {specular, 52.0}, {diffuse, 21.0}, {ambient, 0.0}}) {
        const double granted = 3 * roundings * 0x1p-11 + 1e-4;
        EXPECT_LE(half.used(0, static_cast<float>(0.99 * granted), mode), 1) << debugMode(mode).name;
        EXPECT_GT(half.used(0, static_cast<float>(1.2 * granted), mode), 1) << debugMode(mode).name;
    }
    EXPECT_GT(half.used(1, 1e-6f), 1) << "a dark pixel twice as bright";
    EXPECT_NE(half.use().beside.find("16 bits"), std::string::npos) << half.use().beside;
    EXPECT_EQ(half.use(ambient).beside, "");
}

// NaN is infinitely far from a number, further than any bits move it.
TEST(EncodingUse, WhatIsNoNumberIsBeyondEveryBound) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    for (const float bound : {0.5f, infinity})
        for (const float wrong : {std::numeric_limits<float>::quiet_NaN(), infinity}) {
            std::vector<Frame> frames = bothFrames();
            frames[1].encoding_bound[0] = Image(4, 3, 1, bound);
            const Requirements needs;
            const Coverage covered = coverage(frames[0], frames[1]);
            const FramePair pair{frames[0], frames[1], needs, covered};
            EXPECT_EQ(encodingUse(debugMode(0), pair)->beyond, 0u);
            frames[0].channels[0].at(1, 2, 1) = wrong;
            EXPECT_EQ(encodingUse(debugMode(0), pair)->beyond, 1u) << bound << " " << wrong;
            frames[0].channels[0].at(0, 0, 1) = wrong;
            EXPECT_EQ(encodingUse(debugMode(0), pair)->beyond, 1u) << "the background does not count";
        }
}

// A packed deferred path against the reference, by the bounds of forward+ at the same encoding; no other pair
// and no other channel.
TEST(EncodingUse, OnlyAPackedPathIsGrantedBits) {
    std::vector<Frame> frames = bothFrames();
    frames.push_back(frames[1]);
    frames[2].settings.path = Path::reference;
    const Frame &deferred = frames[0], &forward = frames[1], &traced = frames[2];
    const Requirements needs;
    const Coverage covered = coverage(deferred, forward);
    const auto bits = [&](const Frame& a, const Frame& b, const Frame* explaining, int mode = 0) {
        return allowedByBits(debugMode(mode), FramePair{a, b, needs, covered, true, explaining});
    };
    EXPECT_EQ(bits(traced, deferred, &forward), &forward.encoding_bound.at(0));
    EXPECT_EQ(bits(deferred, traced, &forward), &forward.encoding_bound.at(0));
    EXPECT_EQ(bits(traced, forward, &forward), nullptr) << "nothing of it is packed";
    EXPECT_EQ(bits(forward, traced, &forward), nullptr);
    EXPECT_EQ(bits(deferred, forward, &forward), nullptr) << "that is encodingUse()'s";
    EXPECT_EQ(bits(traced, deferred, nullptr), nullptr);
    EXPECT_EQ(bits(traced, deferred, &forward, static_cast<int>(gpu::DEBUG_albedo)), nullptr);
    frames[1].settings.gbuffer = GBufferEncoding::compact;
    EXPECT_EQ(bits(traced, deferred, &forward), nullptr) << "bounds of other bits";
    frames[0].settings.gbuffer = GBufferEncoding::compact;
    EXPECT_NE(bits(traced, deferred, &forward), nullptr);
    for (const int frame : {0, 1})
        frames[static_cast<std::size_t>(frame)].settings.gbuffer = GBufferEncoding::full;
    EXPECT_EQ(bits(traced, deferred, &forward), nullptr) << "float32 whole";
}

// Against the reference a packed path is granted its bits and float32's shading, 1e-4, and no more.
TEST(EncodingUse, AgainstTheReferenceTheBitsAreGrantedAndNoMore) {
    const auto verdictOf = [](float deferred, float bound, const char* camera = "") {
        std::vector<Frame> frames = bothFrames();
        frames.insert(frames.begin(), frames[1]);
        frames[0].name = "reference";
        frames[0].settings.path = Path::reference;
        frames[0].through_gbuffer.clear();
        frames[0].encoding_bound.clear();
        frames[2].settings.camera = camera;
        frames[2].encoding_bound[0] = Image(4, 3, 1, bound);
        for (int c = 0; c < 3; ++c)
            frames[1].channels[0].at(1, 2, c) = frames[2].through_gbuffer[0].at(1, 2, c) = deferred;
        const Report report =
            makeReferenceReport(frames, std::vector<Requirements>(3), {"a CPU", "1.0", "cpu"}, {}, {}, {{}});
        return firstOf(report).verdict;
    };
    EXPECT_EQ(verdictOf(0.5f, 0), Verdict::pass);
    EXPECT_EQ(verdictOf(0.5f * 1.00009f, 0), Verdict::pass) << "float32";
    EXPECT_EQ(verdictOf(0.5f * 1.00012f, 0), Verdict::fail);
    EXPECT_EQ(verdictOf(0.51f, 0.01f), Verdict::pass) << "its bits";
    EXPECT_EQ(verdictOf(0.5102f, 0.01f), Verdict::fail)
        << "the decoded surfaces explain it, their bits do not";
    EXPECT_EQ(verdictOf(0.51f, 0.01f, "eye=1,2,3"), Verdict::fail) << "another camera's bits explain nothing";
}

std::string faultIn(gpu::uint mode, std::vector<float> values) {
    const DebugMode& m = debugMode(static_cast<int>(mode));
    Image image(static_cast<int>(values.size()) / m.width, 1, m.width);
    std::ranges::copy(values, image.data.begin());
    return outsideDomain(m, image, everyPixel(image.pixels()));
}

TEST(Domain, UnitVectorsAreUnit) {
    EXPECT_EQ(faultIn(gpu::DEBUG_normals, {0, 0, 1, 0.6f, 0, 0.8f, 0, -1, 0}), "");
    EXPECT_NE(faultIn(gpu::DEBUG_normals, {0, 0, 1, 0.6f, 0, 0.80001f}), "");
    EXPECT_EQ(faultIn(gpu::DEBUG_geometric_normal, {0, 0, 1, 0, 0, 0.5f}),
              "vectors are not of unit length at 1 pixel, the worst 0.5 at 1,0");
    EXPECT_EQ(faultIn(gpu::DEBUG_position, {5, 6, 7}), "") << "a vector of any length";
}

TEST(Domain, SharesAndRadianceStayWithin) {
    for (const gpu::uint mode :
         {gpu::DEBUG_metallic, gpu::DEBUG_roughness, gpu::DEBUG_occlusion, gpu::DEBUG_dielectric_f90}) {
        EXPECT_EQ(faultIn(mode, {0, 1, 0.5f}), "");
        EXPECT_EQ(faultIn(mode, {0, 1.25f, 2}),
                  "values are not between 0 and 1 at 2 pixels, the worst 2 at 2,0");
        EXPECT_EQ(faultIn(mode, {-0.5f}), "values are not between 0 and 1 at 1 pixel, the worst -0.5 at 0,0");
    }
    EXPECT_NE(faultIn(gpu::DEBUG_albedo, {0, 0, 1.01f}), "");
    EXPECT_NE(faultIn(gpu::DEBUG_specular, {0, -0.01f, 1}), "");
    EXPECT_NE(faultIn(gpu::DEBUG_emission, {0, -1, 1e9f}), "");
    EXPECT_EQ(faultIn(gpu::DEBUG_emission, {0, 1, 1e9f}), "");
}

// A channel that both paths draw wrong alike shows no difference, and fails all the same.
TEST(Domain, AFaultOfBothPathsFails) {
    std::vector<Frame> frames = bothFrames();
    EXPECT_TRUE(reportOf(frames).passed());
    for (Frame& frame : frames)
        for (int c = 0; c < 3; ++c) frame.channels[2].at(1, 2, c) *= 1.5f;
    const Report report = reportOf(frames);
    EXPECT_FALSE(report.passed());
    for (const ChannelDiff& channel : report.comparisons.at(0).channels)
        if (channel.mode->number == 2) {
            EXPECT_EQ(channel.stats.max, 0);
            EXPECT_EQ(channel.reason,
                      "deferred: vectors are not of unit length at 1 pixel, the worst 1.5 at 1,2");
        }
    for (Frame& frame : frames) frame.origin.file = "theirs.exr";
    EXPECT_TRUE(reportOf(frames).passed()) << "another renderer's file may hold what it likes";
}

// The angle does not see a length; the figure beside it does.
TEST(Domain, LengthStandsBesideTheAngle) {
    const Image unit(1, 1, 3, 0.0f);
    Image reference = unit, test = unit;
    reference.data = {0, 0, 1};
    test.data = {0, 0, 0.25f};
    const Coverage covered = everyPixel(1);
    const Measurement measured({Metric::angular, ChannelKind::vector, false, reference, test, &covered});
    EXPECT_EQ(measured({"angle_max", 0}), 0);
    EXPECT_EQ(measured({"length_max", 0}), 0.75);
}

}  // namespace
}  // namespace diptych
