// SPDX-License-Identifier: MIT
// Upsampling, and a row's errors.
#include "compare/experiment/errors.h"
#include "compare/experiment/upsample.h"
#include "shared/contract/debug_mode.h"
#include "tests/support/frames.h"
#include "tests/support/test_images.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace diptych::experiment {
namespace {

FrameErrors errorsBetween(const Frame& reference, const Frame& frame) {
    return ErrorsAgainst(reference)(frame.channels.at(Channel::lit));
}

// lit is grey with these values; a negative one is background.
Frame frameOf(int width, int height, const std::vector<float>& values) {
    Frame frame = flatFrame(Path::deferred, width, height);
    for (std::size_t i = 0; i < values.size(); ++i) {
        frame.channels[Channel::material_id].data[i] = values[i] < 0 ? -1.0f : static_cast<float>(i);
        for (int c = 0; c < 3; ++c) frame.channels[Channel::lit].pixel(i)[c] = std::max(values[i], 0.0f);
    }
    return frame;
}

std::vector<float> rowOf(const Image& image, int y) {
    std::vector<float> row;
    for (int x = 0; x < image.width; ++x) row.push_back(image.at(x, y, 0));
    return row;
}

TEST(ExperimentUpsample, IsBilinearBetweenPixelCentres) {
    // Two pixels to four: the new centres are at -0.25 (clamped), 0.25, 0.75 and 1.25 (clamped) of the
    // old.
    const Frame wide = upsampled(frameOf(2, 1, {0, 8}), {4, 1});
    EXPECT_EQ(rowOf(wide.channels.at(Channel::lit), 0), (std::vector<float>{0, 2, 6, 8}));
    EXPECT_EQ(rowOf(wide.channels.at(Channel::material_id), 0), (std::vector<float>{0, 0, 1, 1}));
    EXPECT_EQ(wide.settings.size, (Size{4, 1}));
    // Three to four: new centres at 0.375, 1.125, 1.875, 2.625 in old pixels from the edge.
    const Frame odd = upsampled(frameOf(3, 1, {0, 16, 32}), {4, 1});
    EXPECT_EQ(rowOf(odd.channels.at(Channel::lit), 0), (std::vector<float>{0, 10, 22, 32}));
    const Frame tall = upsampled(frameOf(2, 2, {0, 8, 16, 24}), {4, 4});
    EXPECT_EQ(rowOf(tall.channels.at(Channel::lit), 1), (std::vector<float>{4, 6, 10, 12}));
}

TEST(ExperimentUpsample, BackgroundNeitherDarkensNorGrows) {
    const Frame wide = upsampled(frameOf(3, 1, {8, -1, 4}), {6, 1});
    EXPECT_EQ(rowOf(wide.channels.at(Channel::lit), 0), (std::vector<float>{8, 8, 0, 0, 4, 4}));
    EXPECT_EQ(rowOf(wide.channels.at(Channel::material_id), 0), (std::vector<float>{0, 0, -1, -1, 2, 2}));
}

// A blended surface in front of the background is visible and must be enlarged.
TEST(ExperimentUpsample, BlendedSurfacesAreEnlargedTooBeforeAndAfter) {
    Frame frame = frameOf(3, 1, {8, -1, -1});
    frame.unblended = frame.channels.at(Channel::lit);
    for (int c = 0; c < 3; ++c) frame.channels.at(Channel::lit).pixel(1)[c] = 4;
    const Frame wide = upsampled(frame, {6, 1});
    EXPECT_EQ(rowOf(wide.channels.at(Channel::lit), 0), (std::vector<float>{8, 7, 5, 4, 0, 0}));
    EXPECT_EQ(rowOf(wide.unblended, 0), (std::vector<float>{8, 6, 2, 0, 0, 0}));
    EXPECT_EQ(wide.unblended.width, 6);
    EXPECT_EQ(coverage(wide, wide).count, 4u);
}

TEST(ExperimentUpsample, TheSameSizeIsTheSameImage) {
    const Frame frame = frameOf(2, 2, {1, -1, 3, 0.1f});
    const Frame same = upsampled(frame, {2, 2});
    EXPECT_EQ(same.channels.at(Channel::lit).data, frame.channels.at(Channel::lit).data);
    Frame without = frame;
    without.channels.erase(Channel::material_id);
    EXPECT_THROW(upsampled(without, {4, 4}), std::runtime_error);
}

// The same metrics as compare gives for the same images.
TEST(ExperimentErrors, AreThoseOfTheReport) {
    const Image reference = noise(40, 30, 1), test = noise(40, 30, 2);
    Frame a = frameOf(40, 30, std::vector<float>(1200, 1)), b = a;
    a.channels[Channel::lit] = reference;
    b.channels[Channel::lit] = test;
    for (std::size_t i = 0; i < 300; ++i)
        a.channels[Channel::material_id].data[i] = b.channels[Channel::material_id].data[i] = -1;
    const FrameErrors errors = errorsBetween(a, b);
    const ChannelStats stats =
        channelStats(ErrorKind::relative, ChannelKind::color, reference, test, coverage(a, b));
    EXPECT_EQ(errors.pixels.size(), 900u);
    EXPECT_DOUBLE_EQ(errors.errors[1], stats.rmse);
    EXPECT_DOUBLE_EQ(errors.errors[2], stats.p99);
    EXPECT_GT(errors.errors[0], 0.1);
    EXPECT_LT(errors.errors[0], 1);
    // Evaluating a single metric gives the same value.
    const ErrorsAgainst against(a);
    for (std::size_t metric = 0; metric < errorMetrics.size(); ++metric) {
        ErrorsOfCameras all, one;
        all.add(errors);
        one.add(against.forMetric(metric, test));
        EXPECT_EQ(one.errors()[metric], all.errors()[metric]) << errorMetrics[metric].name;
    }
    const FrameErrors none = errorsBetween(a, a);
    EXPECT_EQ(none.errors, (Errors{0, 0, 0}));
}

TEST(ExperimentErrors, ArePixelsThatTheReferenceShows) {
    const Frame reference = frameOf(2, 1, {1, -1}), more = frameOf(2, 1, {1, 5}),
                less = frameOf(2, 1, {-1, -1});
    EXPECT_EQ(errorsBetween(reference, more).errors[1], 0)
        << "beyond the reference's silhouette nothing is counted";
    EXPECT_EQ(errorsBetween(reference, more).pixels.size(), 1u);
    EXPECT_EQ(errorsBetween(reference, less).errors[1], 1) << "a surface that is missing is all wrong";
    const Frame second = frameOf(2, 1, {-1, 1}), both = frameOf(2, 1, {5, 1});
    for (std::size_t metric = 0; metric < errorMetrics.size(); ++metric) {
        ErrorsOfCameras errors;
        errors.add(ErrorsAgainst(second).forMetric(metric, both.channels.at(Channel::lit)));
        EXPECT_EQ(errors.errors()[metric], 0) << errorMetrics[metric].name;
    }
}

TEST(ExperimentErrors, ANanIsInfinite) {
    const Frame reference = frameOf(2, 1, {1, 1});
    Frame broken = reference;
    broken.channels[Channel::lit].data[0] = nan;
    const FrameErrors errors = errorsBetween(reference, broken);
    EXPECT_TRUE(std::isinf(errors.errors[1]));
    EXPECT_GT(errors.errors[0], 0);
}

TEST(ExperimentErrors, PercentilesAreTheNearestRank) {
    std::vector<double> errors;
    for (int i = 1; i <= 200; ++i) errors.push_back(i);
    EXPECT_EQ(relativeErrors(errors).p99, 198);
    EXPECT_DOUBLE_EQ(relativeErrors({3, 4}).rmse, std::sqrt(12.5));
    EXPECT_EQ(relativeErrors({}).rmse, 0);
}

}  // namespace
}  // namespace diptych::experiment
