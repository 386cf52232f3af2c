// SPDX-License-Identifier: MIT
// The reference's uncertainty survives its EXR: a path gets the same verdict against the file as against
// the Frame.
#include "compare/files/frame_exr.h"
#include "compare/render/reference_frame.h"
#include "compare/verdict/baseline.h"
#include "compare/verdict/comparison.h"
#include "compare/verdict/tolerance.h"
#include "shared/contract/debug_mode.h"
#include "shared/image/exr.h"
#include "tests/support/errors.h"
#include "tests/support/files.h"
#include "tests/support/frames.h"

#include <cmath>
#include <limits>
#include <stdexcept>

namespace diptych {
namespace {

const ReportDevice device{"a device", "1.0", "cpu"};

// Two grey pixels.
Frame frameOf(Path path, float left, float right) {
    Frame frame = flatFrame(path, 2, 1);
    frame.scene = "builtin:one";
    frame.camera.far = std::numeric_limits<double>::infinity();
    frame.channels[Channel::lit].data = {left, left, left, right, right, right};
    return frame;
}

// A sampled reference with uncertainties of 1/3 and 1/100.
Frame sampled() {
    Frame referenceFrame = frameOf(Path::reference, 1, 2);
    referenceFrame.uncertainty = Image(2, 1, 1);
    referenceFrame.uncertainty.data = {1.0f / 3, 0.01f};
    referenceFrame.relative_uncertainty = 0.1 + 0.2;
    return referenceFrame;
}

Frame throughExr(const Frame& frame) {
    const std::filesystem::path file = folder() / "reference.exr";
    writeFrameExr(file, frame, device);
    return frameFromExr(file);
}

ChannelDiff evaluated(const Frame& referenceFrame, const Frame& path) {
    Report report;
    report.device = device;
    report.frames = {referenceFrame, path};
    return compareFrames(report, 0, 1, Requirements()).channels.front();
}

TEST(Uncertainty, ComesBackAsItWas) {
    const Frame referenceFrame = sampled(), back = throughExr(referenceFrame);
    ASSERT_TRUE(isReferenceFrame(back));
    EXPECT_EQ(back.uncertainty.width, 2);
    EXPECT_EQ(back.uncertainty.height, 1);
    EXPECT_EQ(back.uncertainty.components, 1);
    EXPECT_EQ(back.uncertainty.data, referenceFrame.uncertainty.data);
    EXPECT_EQ(back.relative_uncertainty, referenceFrame.relative_uncertainty);
    EXPECT_EQ(back.notes, std::vector<std::string>{uncertaintyNote(referenceFrame.relative_uncertainty)});
    EXPECT_EQ(back.channels.size(), 2u) << "it is no channel";
    EXPECT_EQ(back.channels.at(Channel::lit).data, referenceFrame.channels.at(Channel::lit).data);
}

// Infinite and NaN uncertainties are read back, too: a reader accepts everything that diptych writes.
TEST(Uncertainty, OfAnySizeComesBack) {
    for (const double relative : {0.0, 1e-300, 5e-324, 1e300, std::numeric_limits<double>::infinity()}) {
        Frame referenceFrame = sampled();
        referenceFrame.relative_uncertainty = relative;
        referenceFrame.uncertainty.data = {std::numeric_limits<float>::infinity(), 0};
        const Frame back = throughExr(referenceFrame);
        EXPECT_EQ(back.relative_uncertainty, relative);
        EXPECT_EQ(back.uncertainty.data, referenceFrame.uncertainty.data);
    }
}

TEST(Uncertainty, TheVerdictAgainstTheFileIsThatAgainstTheFrame) {
    const Frame referenceFrame = sampled(), back = throughExr(referenceFrame);
    for (const float right : {2.0f, 2.02f, 2.2f}) {
        const Frame path = frameOf(Path::forward_plus, 1.5f, right);
        const ChannelDiff now = evaluated(referenceFrame, path), stored = evaluated(back, path);
        ASSERT_EQ(now.mode->channel, Channel::lit);
        EXPECT_EQ(now.verdict, right > 2.1f ? Verdict::fail : Verdict::pass) << right;
        EXPECT_EQ(stored.verdict, now.verdict) << right;
        ASSERT_TRUE(stored.certain_p999.has_value());
        EXPECT_EQ(stored.certain_p999, now.certain_p999);
        EXPECT_EQ(stored.tolerance.max, now.tolerance.max);
        EXPECT_EQ(stored.tolerance.because, now.tolerance.because);
        EXPECT_EQ(stored.reason, now.reason);
    }
    Frame bare = back;
    bare.uncertainty = {};
    EXPECT_EQ(evaluated(bare, frameOf(Path::forward_plus, 1.5f, 2)).verdict, Verdict::fail);
}

std::vector<double> certainOf(const Frame& a, const Frame& b) {
    const Requirements needs;
    const Coverage covered = coverage(a, b);
    return certainErrors(debugMode(Channel::lit), FramePair{a, b, needs, covered}).value();
}

// Relative to the pixel, like the error, however dark it is; with the reference on either side.
TEST(Uncertainty, IsTakenOffThePixelsError) {
    Frame traced = frameOf(Path::reference, 1, 0.01f);
    traced.uncertainty = Image(2, 1, 1, 0.001f);
    const Frame path = frameOf(Path::forward_plus, 1.01f, 0.02f);
    std::vector<double> errors = certainOf(traced, path);
    ASSERT_EQ(errors.size(), 2u);
    EXPECT_NEAR(errors[0], 0.01 - 2.29 * 0.001, 1e-6);
    EXPECT_NEAR(errors[1], 1 - 2.29 * 0.1, 1e-6);
    errors = certainOf(path, traced);
    EXPECT_NEAR(errors[0], (0.01 - 2.29 * 0.001) / 1.01, 1e-6);
    EXPECT_NEAR(errors[1], (0.01 - 2.29 * 0.001) / 0.02, 1e-6);
    EXPECT_EQ(certainOf(traced, frameOf(Path::forward_plus, 1.002f, 0.01f)), (std::vector<double>{0, 0}))
        << "what is less than it is not known to differ";
    traced.channels[Channel::material_id].data = {-1, -1};
    Frame half = path;
    half.channels[Channel::material_id].data = {-1, 3};
    EXPECT_EQ(certainOf(traced, half).size(), 1u) << "the background does not count";
}

// Each channel of light is granted its own part of the reference's bound on rounding.
TEST(Uncertainty, RoundingIsTakenOffTheChannelsOfItsLight) {
    Frame traced = frameOf(Path::reference, 1, 1), path = frameOf(Path::forward_plus, 1.01f, 1.01f);
    traced.rounding = Image(2, 1, 4);
    traced.rounding.data = {0.001f, 0.002f, 0.003f, 0.004f, 0, 0, 0, 0};
    for (const auto& [mode, granted] : {std::pair{Channel::lit, 0.003},
                                        {Channel::lit_diffuse, 0.001},
                                        {Channel::lit_specular, 0.002},
                                        {Channel::lit_clearcoat, 0.003},
                                        {Channel::lit_sheen, 0.004},
                                        {Channel::lit_ambient, 0.0}}) {
        for (Frame* const frame : {&traced, &path}) frame->channels[mode] = frame->channels[Channel::lit];
        const Coverage covered = coverage(traced, path);
        const Requirements needs;
        const auto errors = certainErrors(debugMode(mode), FramePair{traced, path, needs, covered});
        ASSERT_TRUE(errors);
        EXPECT_NEAR(errors->at(0), 0.01 - granted, 1e-6) << debugMode(mode).name;
        EXPECT_NEAR(errors->at(1), 0.01, 1e-6) << debugMode(mode).name;
    }
}

TEST(Uncertainty, OfAnySizeExcusesNothingThatIsNoNumber) {
    for (const float known : {0.001f, std::numeric_limits<float>::infinity()})
        for (const float wrong :
             {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
            Frame traced = frameOf(Path::reference, 1, 2);
            traced.uncertainty = Image(2, 1, 1, known);
            Frame path = frameOf(Path::forward_plus, 1, 2);
            path.channels[Channel::lit].at(1, 0, 2) = wrong;
            const std::vector<double> errors = certainOf(traced, path);
            EXPECT_EQ(errors[0], 0);
            EXPECT_EQ(errors[1], std::numeric_limits<double>::infinity()) << known << " " << wrong;
            EXPECT_EQ(evaluated(traced, path).verdict, Verdict::fail);
        }
}

// Error image, worst pixel and metric name show the evaluated error. The left pixel's error is larger, but
// within the reference's uncertainty.
TEST(Uncertainty, WhatIsJudgedIsWhatIsShown) {
    const ChannelDiff fails = evaluated(sampled(), frameOf(Path::forward_plus, 1.5f, 2.5f));
    EXPECT_EQ(fails.verdict, Verdict::fail);
    ASSERT_TRUE(fails.criterion && fails.shown_error);
    EXPECT_EQ(fails.criterion->metric, "p99.9 of the excess") << "the column p99.9 is of all of the error";
    EXPECT_NE(fails.reason.find("p99.9 of the excess is"), std::string::npos) << fails.reason;
    EXPECT_EQ(fails.shown_error->data[0], 0);
    EXPECT_NEAR(fails.shown_error->data[1], 0.25 - 2.29 * 0.01 / 2, 1e-6);
    EXPECT_EQ(fails.shown_error_top, fails.tolerance.max);
    EXPECT_EQ(fails.stats.worst_x, 1);
    EXPECT_EQ(fails.stats.max, 0.5) << "the statistics stay those of the error";
    const ChannelDiff passes = evaluated(sampled(), frameOf(Path::forward_plus, 1.5f, 2));
    EXPECT_EQ(passes.verdict, Verdict::pass);
    ASSERT_TRUE(passes.shown_error);
    EXPECT_EQ(passes.shown_error->data, (PixelData{0, 0})) << "nothing of a channel that passes is beyond";
    Frame bare = sampled();
    bare.uncertainty = {};
    EXPECT_FALSE(evaluated(bare, frameOf(Path::forward_plus, 1.5f, 2)).shown_error);
}

// Relative to a black image without uncertainty, any light is an error.
TEST(Uncertainty, OfABlackReferenceExcusesNoLight) {
    Frame traced = frameOf(Path::reference, 0, 0);
    traced.uncertainty = Image(2, 1, 1, 0.0f);
    EXPECT_EQ(evaluated(traced, frameOf(Path::forward_plus, 0, 0)).verdict, Verdict::pass);
    EXPECT_EQ(evaluated(traced, frameOf(Path::forward_plus, 0, 5)).verdict, Verdict::fail);
}

TEST(Uncertainty, IsWrittenBesideLitAlone) {
    Frame referenceFrame = sampled();
    referenceFrame.requested = {Channel::material_id};
    EXPECT_TRUE(throughExr(referenceFrame).uncertainty.empty());
    referenceFrame = sampled();
    referenceFrame.uncertainty = {};
    const Frame exact = throughExr(referenceFrame);
    EXPECT_TRUE(exact.uncertainty.empty());
    EXPECT_TRUE(exact.notes.empty());
}

TEST(Uncertainty, OfAFileThatWasChangedIsRefusedInOneLine) {
    const std::filesystem::path file = folder() / "reference.exr";
    writeFrameExr(file, sampled(), device);
    const ImageFile whole = readExr(file);
    for (const char* wrong : {"", "much", "0.1 or so"}) {
        std::vector<ExrLayerView> layers;
        for (const ImageLayer& layer : whole.layers) layers.push_back({layer.channels, &layer.image});
        std::vector<ExrAttribute> attributes;
        for (const auto& [name, value] : whole.attributes)
            attributes.push_back({name, name == "relative_uncertainty" ? wrong : value});
        writeExr(file, layers, attributes);
        const std::string refusal = faultOf([&] { frameFromExr(file); });
        EXPECT_EQ(refusal,
                  file.string() + ": attribute relative_uncertainty \"" + wrong + "\" is not a number");
    }
}

}  // namespace
}  // namespace diptych
