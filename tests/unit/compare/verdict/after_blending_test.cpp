// SPDX-License-Identifier: MIT
// A difference in lit that only blending adds fails under its own name.
#include "compare/verdict/after_blending.h"

#include "compare/report/json.h"
#include "compare/report/report.h"
#include "tests/support/frames.h"
#include "tests/support/report_builder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace diptych {
namespace {

constexpr int blendWide = 50, blendHigh = 40;
constexpr std::size_t blendPixels = 2000, blendCovered = 200;  // the first are behind glass

// Opaque radiance 1 everywhere; blended over it, 0.5 of 3.
Frame blendFrame(Path path, GBufferEncoding encoding = GBufferEncoding::full) {
    Frame frame = flatFrame(path, blendWide, blendHigh, 1, 3);
    frame.scene = "a scene";
    frame.settings.gbuffer = encoding;
    frame.unblended = frame.channels[Channel::lit];
    for (std::size_t i = 0; i < 3 * blendCovered; ++i) frame.channels[Channel::lit].data[i] = 2;
    if (path == Path::reference) {
        frame.blended = Image(blendWide, blendHigh, 3);
        for (std::size_t i = 0; i < blendCovered; ++i) *frame.blended.pixel(i) = 0.5f;
    }
    return frame;
}

// `behind`: radiance of the pixel's opaque surface. `all`: radiance after blending.
void setPixel(Frame& frame, std::size_t i, float behind, float all) {
    frame.unblended.pixel(i)[1] = behind;
    frame.channels[Channel::lit].pixel(i)[1] = all;
}

Report blendReport(Frame a, Frame b, const std::string& device = "cpu", CompareOptions options = {}) {
    Report report;
    report.device = {"a device", "1.0", device};
    report.frames = {std::move(a), std::move(b)};
    report.comparisons.push_back(compareFrames(report, 0, 1, {}, options));
    return report;
}
const Comparison& only(const Report& report) {
    return report.comparisons.front();
}
bool isNamed(const std::vector<std::string>& lines) {
    return std::ranges::any_of(lines, [](const std::string& line) {
        return line.starts_with("the transparent draw adds a difference");
    });
}

TEST(AfterBlending, EqualImagesPassAndAreCounted) {
    const Report report = blendReport(blendFrame(Path::deferred), blendFrame(Path::forward_plus));
    const std::optional<AfterBlending>& found = only(report).after_blending;
    ASSERT_TRUE(found);
    EXPECT_EQ(found->covered, blendCovered);
    EXPECT_EQ(found->pixels, 0u);
    EXPECT_EQ(found->before, 0u);
    EXPECT_TRUE(only(report).passed());
    EXPECT_EQ(faultOf(*found), "");
}

TEST(AfterBlending, ADifferenceOfItsOwnFailsByNameInAllReports) {
    Frame wrong = blendFrame(Path::forward_plus);
    setPixel(wrong, 7, 1, 2.5f);
    setPixel(wrong, 60, 1, std::nextafter(2.0f, 3.0f));
    const Report report = blendReport(blendFrame(Path::deferred), wrong);
    const std::string expected =
        "the transparent draw adds a difference in lit at 2 pixels (largest 0.25 at 7,0); blended fragments "
        "cover 200 pixels, and 0 differed before the draw";
    EXPECT_EQ(only(report).failures, std::vector<std::string>{expected});
    EXPECT_NE(reportTable(report).find("FAIL a scene"), std::string::npos);
    EXPECT_NE(reportTable(report).find(expected), std::string::npos);
    const auto json = nlohmann::json::parse(reportJson(report, nullptr));
    const auto& found = json.at("comparisons").at(0).at("after_blending");
    EXPECT_EQ(found.at("pixels"), 2);
    EXPECT_EQ(found.at("blended_pixels"), 200);
    EXPECT_EQ(found.at("pixel"), nlohmann::json({7, 0}));
    EXPECT_EQ(found.at("verdict"), "fail");
}

// A difference behind glass is weaker after blending. It fails as lit and does not count as a fault of
// blending.
TEST(AfterBlending, WhatDifferedBeforeIsNotNamed) {
    Frame other = blendFrame(Path::forward_plus);
    setPixel(other, 7, 1.5f, 2.25f);
    const Report report = blendReport(blendFrame(Path::deferred), other);
    EXPECT_FALSE(only(report).passed()) << "lit differs";
    EXPECT_FALSE(isNamed(only(report).failures));
    EXPECT_EQ(only(report).after_blending->before, 1u);
    setPixel(other, 7, 1.5f, 2.75f);
    EXPECT_TRUE(isNamed(only(blendReport(blendFrame(Path::deferred), other)).failures)) << "more than before";
}

// On a GPU, sums may be rounded differently, by 16 ULP.
TEST(AfterBlending, AGpusRoundingIsGranted) {
    Frame near = blendFrame(Path::forward_plus), far = near;
    setPixel(near, 7, 1, 2 + 8 * 0x1p-22f);
    setPixel(far, 7, 1, 2 + 40 * 0x1p-22f);
    EXPECT_FALSE(isNamed(only(blendReport(blendFrame(Path::deferred), near, "discrete GPU")).failures));
    EXPECT_TRUE(isNamed(only(blendReport(blendFrame(Path::deferred), far, "discrete GPU")).failures));
    EXPECT_TRUE(isNamed(only(blendReport(blendFrame(Path::deferred), near)).failures)) << "not on a CPU";
}

TEST(AfterBlending, ANanIsNamed) {
    Frame wrong = blendFrame(Path::forward_plus);
    setPixel(wrong, 7, 1, std::numeric_limits<float>::quiet_NaN());
    EXPECT_TRUE(isNamed(only(blendReport(blendFrame(Path::deferred), wrong)).failures));
}

// forward+ with encoded surfaces is what deferred must show, before and after blending.
TEST(AfterBlending, OfAPackedGBufferWhatItExplainsIsNoDifference) {
    const auto packed = GBufferEncoding::standard;
    Frame deferred = blendFrame(Path::deferred, packed), forward = blendFrame(Path::forward_plus, packed);
    setPixel(deferred, 7, 1.01f, 2.005f);
    forward.through_gbuffer[Channel::lit] = deferred.channels[Channel::lit];
    forward.unblended_through_gbuffer = deferred.unblended;
    EXPECT_TRUE(only(blendReport(deferred, forward)).passed());
    setPixel(deferred, 7, 1.01f, 2.004f);  // closer to forward+'s own value, but not the encoding's result
    EXPECT_TRUE(isNamed(only(blendReport(deferred, forward)).failures));
}

// Against the reference 2 of 2000 pixels may be out of tolerance, but only 1 of the 200 blended ones.
TEST(AfterBlending, AgainstTheReferenceAThousandthOfWhatIsCovered) {
    Frame wrong = blendFrame(Path::deferred);
    // Within two pixels of others the reference's own change is tolerated. So these pixels are not at the
    // end of the blended ones.
    setPixel(wrong, 20, 1, 2.2f);
    EXPECT_TRUE(only(blendReport(blendFrame(Path::reference), wrong)).passed()) << "one";
    setPixel(wrong, 24, 1, 2.2f);
    const Report report = blendReport(blendFrame(Path::reference), wrong);
    EXPECT_EQ(only(report).channels.front().verdict, Verdict::pass) << "as a whole";
    EXPECT_TRUE(isNamed(only(report).failures));
    EXPECT_FALSE(only(report).passed());
    setPixel(wrong, 20, 1.2f, 2.2f);
    EXPECT_TRUE(only(blendReport(blendFrame(Path::reference), wrong)).passed()) << "it was there before";
    setPixel(wrong, 20, 1, 2.0001f);
    EXPECT_TRUE(only(blendReport(blendFrame(Path::reference), wrong)).passed()) << "within the tolerance";
}

TEST(AfterBlending, ARuleThatEvaluatesLitTurnsItIntoANote) {
    Frame wrong = blendFrame(Path::forward_plus);
    setPixel(wrong, 7, 1, 2.5f);
    CompareOptions options;
    options.rules = rulesFromJson(R"({"rules": [{"channel": "lit", "max": 1, "because": "so"}]})", "t.json");
    const Report report = blendReport(blendFrame(Path::deferred), wrong, "cpu", options);
    EXPECT_TRUE(only(report).passed());
    EXPECT_TRUE(isNamed(only(report).notes));
}

TEST(AfterBlending, WithoutBlendingOrWithoutKnowingThereIsNothingToSay) {
    Frame a = blendFrame(Path::deferred), b = blendFrame(Path::forward_plus);
    setPixel(b, 7, 1, 2.5f);
    b.unblended = {};
    const Report report = blendReport(a, b);
    EXPECT_FALSE(only(report).after_blending);
    EXPECT_FALSE(isNamed(only(report).failures));
    EXPECT_EQ(nlohmann::json::parse(reportJson(report, nullptr)).at("comparisons").at(0).at("after_blending"),
              nullptr);
}

// Glass in front of the environment covers no opaque surface, but the pixel counts.
TEST(AfterBlending, PixelsThatOnlySomethingBlendedCoversCount) {
    for (const Path path : {Path::deferred, Path::reference}) {
        Frame a = blendFrame(path), b = blendFrame(Path::forward_plus);
        for (Frame* frame : {&a, &b}) std::ranges::fill(frame->channels[Channel::material_id].data, -1.0f);
        const Coverage covered = coverage(a, b);
        EXPECT_TRUE(covered.known);
        EXPECT_EQ(covered.count, blendCovered) << nameOf(path);
        EXPECT_TRUE(only(blendReport(a, b)).emptiness.find("no surface") == std::string::npos);
        for (const std::size_t i : {8u, 9u}) b.channels[Channel::lit].pixel(i)[0] = 2.5f;
        EXPECT_FALSE(only(blendReport(a, b)).passed()) << nameOf(path);
        a.unblended = b.unblended = {};
        if (path == Path::deferred) {
            EXPECT_EQ(coverage(a, b).count, 0u);
        }
    }
}

}  // namespace
}  // namespace diptych
