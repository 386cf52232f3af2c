// SPDX-License-Identifier: MIT
// FLIP, compared with its authors' program and with properties that every implementation must have.
#include "compare/metrics/flip.h"

#include "compare/metrics/fast_math.h"
#include "shared/image/image_file.h"
#include "shared/image/png.h"
#include "tests/support/errors.h"
#include "tests/support/test_images.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <filesystem>
#include <stdexcept>

namespace diptych {
namespace {

namespace fs = std::filesystem;

Image part(const Image& image, int x0, int y0, int width, int height) {
    Image result(width, height, image.components);
    for (int y = 0; y < height; ++y)
        std::copy_n(&image.data[image.offset(x0, y0 + y)], width * image.components, &result.at(0, y));
    return result;
}

std::string errorOf(const Image& reference, const Image& test, const HdrFlipOptions& options) {
    return faultOf([&] { hdrFlip(reference, test, options); });
}

// The authors' program 1.6 prints six digits. Its XYZ conversion uses a white point rounded to nine
// digits, which changes black against white by 4e-6.
constexpr double digits = 1e-5;

TEST(Flip, FlatImagesAreAsTheAuthorsProgramHasThem) {
    EXPECT_NEAR(ldrFlip(grey(0), grey(1)).mean, 0.967388, digits);
    EXPECT_NEAR(ldrFlip(flat(40, 30, 0, 1, 0), flat(40, 30, 0, 0, 1)).mean, 1.0, digits);
    const std::pair<int, double> steps[] = {
        {1, 0.02986}, {2, 0.04849}, {4, 0.0787}, {8, 0.1276}, {16, 0.2065}};
    for (const auto& [step, expected] : steps) {
        const FlipResult r = ldrFlip(grey(128 / 255.0f), grey(static_cast<float>(128 + step) / 255));
        EXPECT_NEAR(r.mean, expected, 5e-5) << "of four digits, +" << step;
        EXPECT_NEAR(r.max - r.min, 0, 1e-6) << "flat";
    }
}

// Images with published results of the authors' program, in a folder beside the repository.
const fs::path published = fs::path(DIPTYCH_SOURCE_DIR) / "../shared/flip";

Image displayValues(const fs::path& file) {
    const Image8 png = readPng(file);
    Image image(png.width, png.height, 3);
    for (std::size_t i = 0; i < image.pixels(); ++i)
        for (std::size_t c = 0; c < 3; ++c)
            image.pixel(i)[c] =
                static_cast<float>(png.data[i * static_cast<std::size_t>(png.components) + c]) / 255;
    return image;
}

TEST(Flip, TreeIsAsTheAuthorsProgramHasIt) {
    if (!fs::exists(published))
        GTEST_SKIP() << "NO PICTURES at " << published << ": the authors' figures are not tried";
    const Image reference = displayValues(published / "tree-ref.png"),
                test = displayValues(published / "tree-test.png");
    const FlipResult r = ldrFlip(reference, test);
    EXPECT_NEAR(r.mean, 0.133276, digits);
    EXPECT_NEAR(r.weighted_median, 0.333201, digits);
    EXPECT_NEAR(r.max, 0.983034, digits);
    // The tolerance is small enough to notice a change of the viewing distance.
    EXPECT_GT(std::abs(ldrFlip(reference, test, {.pixels_per_degree = 66}).mean - 0.133276), 10 * digits);
}

TEST(Flip, CityIsAsTheAuthorsProgramHasIt) {
    if (!fs::exists(published))
        GTEST_SKIP() << "NO PICTURES at " << published << ": the authors' figures are not tried";
    const Image reference = readImage(published / "city-ref.exr").layers.at(0).image,
                test = readImage(published / "city-test.exr").layers.at(0).image;
    const HdrFlipResult r = hdrFlip(reference, test);
    EXPECT_NEAR(r.start_exposure, -12.8397, 5e-5) << "of four digits";
    EXPECT_NEAR(r.stop_exposure, 2.0798, 5e-5);
    EXPECT_EQ(r.exposures, 15);
    EXPECT_NEAR(r.mean, 0.109993, digits);
    EXPECT_NEAR(r.weighted_median, 0.171641, digits);
    EXPECT_NEAR(r.max, 0.768609, digits);
    HdrFlipOptions other;
    other.tone_mapper = ToneMapper::reinhard;
    EXPECT_GT(std::abs(hdrFlip(reference, test, other).mean - 0.109993), 10 * digits);
}

TEST(Flip, TheImageItselfIsExactlyZero) {
    const Image display = noise(300, 140, 1), linear = noise(300, 140, 2, 0, 1000);
    EXPECT_EQ(ldrFlip(display, display).max, 0);
    EXPECT_EQ(hdrFlip(linear, linear).max, 0);
    // 0 and -0 are equal values with different bits; comparing bits alone would report a difference.
    Image zero = display, minus = display;
    set(zero, 150, 70, 0.0f);
    set(minus, 150, 70, -0.0f);
    const FlipResult r = ldrFlip(zero, minus);
    EXPECT_EQ(r.max, 0);
    EXPECT_EQ(r.mean, 0);
    EXPECT_EQ(r.weighted_median, 0);
    EXPECT_EQ(r.pixels, 300u * 140u);
}

// No pixel of a row is treated otherwise, up to the order of sums.
TEST(Flip, MirroredImagesHaveMirroredErrorsUnderEveryToneMapper) {
    constexpr int width = 40, height = 8;
    const auto mirrored = [](const Image& image) {
        Image result(width, height, 3);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                for (int c = 0; c < 3; ++c) result.at(x, y, c) = image.at(width - 1 - x, y, c);
        return result;
    };
    const Image reference = noise(width, height, 3, 0, 20), test = noise(width, height, 4, 0, 20);
    for (const ToneMapper mapper : {ToneMapper::aces, ToneMapper::reinhard, ToneMapper::hable}) {
        HdrFlipOptions options;
        options.tone_mapper = mapper;
        const Image there = hdrFlip(reference, test, options).error,
                    back = hdrFlip(mirrored(reference), mirrored(test), options).error;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                EXPECT_NEAR(there.at(x, y), back.at(width - 1 - x, y), 1e-5) << x << "," << y;
    }
}

TEST(Flip, APartHasTheErrorsOfTheWholeAwayFromItsBorder) {
    // The widest filter has a radius of 10 pixels at 67 pixels per degree. In the crop, tiles have other
    // positions.
    const Image a = noise(700, 300, 3), b = noise(700, 300, 4);
    const Image whole = ldrFlip(a, b).error,
                cut = ldrFlip(part(a, 101, 53, 411, 199), part(b, 101, 53, 411, 199)).error;
    std::uint64_t different = 0, border = 0;
    for (int y = 0; y < cut.height; ++y)
        for (int x = 0; x < cut.width; ++x) {
            const bool inside = x >= 10 && y >= 10 && x < cut.width - 10 && y < cut.height - 10;
            (inside ? different : border) += cut.at(x, y) != whole.at(101 + x, 53 + y);
        }
    EXPECT_EQ(different, 0u);
    EXPECT_GT(border, 0u);
}

TEST(Flip, ADifferenceIsSeenWhereverItIs) {
    // Equal tiles are skipped, but differences in a corner of a tile or of the image must not be.
    const Image a = noise(600, 260, 5);
    for (const auto& [x, y] : {std::pair{0, 0}, {599, 259}, {199, 86}, {200, 87}, {299, 130}, {410, 129}}) {
        Image b = a;
        set(b, x, y, a.at(x, y) > 0.5f ? 0.0f : 1.0f);
        const FlipResult r = ldrFlip(a, b);
        EXPECT_GT(r.error.at(x, y), 0) << x << ", " << y;
        EXPECT_GT(r.error.at(x > 0 ? x - 1 : 1, y), 0) << "the pixel beside";
        EXPECT_EQ(r.error.at(x < 300 ? 500 : 100, 130), 0) << "far away";
    }
}

TEST(Flip, ThreadsDoNotChangeABit) {
    const Image a = noise(520, 300, 6, 0, 8), b = noise(520, 300, 7, 0, 8);
    const HdrFlipResult many = hdrFlip(a, b);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const HdrFlipResult single = hdrFlip(a, b);
    EXPECT_EQ(many.error.data, single.error.data);
    EXPECT_EQ(many.mean, single.mean);
    EXPECT_EQ(many.weighted_median, single.weighted_median);
}

TEST(Flip, ANanIsOnePixelsError) {
    const Image a = noise(60, 50, 8);
    Image b = a;
    b.at(30, 25, 1) = nan;
    b.at(40, 10, 0) = inf;
    const FlipResult r = ldrFlip(a, b);
    EXPECT_EQ(r.error.at(30, 25), 1);
    EXPECT_EQ(r.error.at(40, 10), 1);
    EXPECT_DOUBLE_EQ(r.mean, 2.0 / (60 * 50)) << "every other pixel is 0";
    EXPECT_EQ(r.nonfinite_reference, 0u);
    EXPECT_EQ(r.nonfinite_test, 2u);
    EXPECT_EQ(r.nonfinite_different, 2u);
    EXPECT_EQ(r.pixels, 60u * 50u);
    // Negative control: a wrong finite value changes the pixels around it.
    set(b, 30, 25, 0.0f);
    EXPECT_GT(ldrFlip(a, b).error.at(31, 25), 0);
}

TEST(Flip, NeighboursOfHolesAreMeasuredWithoutThem) {
    // Two flat images have the same error everywhere. Holes must not change it, even wide ones or those at
    // the border.
    Image a = grey(0.5f), b = grey(0.6f);
    const float expected = ldrFlip(a, b).error.at(20, 15);
    set(a, 10, 10, nan);
    set(b, 25, 20, -inf);
    for (int y = 0; y < 30; ++y) set(a, 0, y, inf);
    for (int y = 5; y < 28; ++y)
        for (int x = 30; x < 40; ++x) set(b, x, y, nan);
    const FlipResult r = ldrFlip(a, b);
    for (std::size_t i = 0; i < a.pixels(); ++i) {
        const bool hole = !std::isfinite(a.pixel(i)[0] + b.pixel(i)[0]);
        // Sums of about 400 weights, each rounded to 6e-8, divided by their own sum.
        ASSERT_NEAR(r.error.data[i], hole ? 1 : expected, 1e-4) << i;
    }
    EXPECT_EQ(r.nonfinite_reference, 31u);
    EXPECT_EQ(r.nonfinite_test, 231u);
}

TEST(Flip, WhatIsNonfiniteInBothAlikeIsNoError) {
    Image a = noise(50, 40, 9), b = noise(50, 40, 10);
    const FlipResult before = ldrFlip(a, b);
    set(a, 5, 5, nan);
    set(b, 5, 5, nan);
    set(a, 6, 5, inf);
    set(b, 6, 5, -inf);
    const FlipResult r = ldrFlip(a, b);
    EXPECT_EQ(r.error.at(5, 5), 0);
    EXPECT_EQ(r.error.at(6, 5), 1) << "two infinities of other signs";
    EXPECT_EQ(r.nonfinite_reference, 2u);
    EXPECT_EQ(r.nonfinite_test, 2u);
    EXPECT_EQ(r.nonfinite_different, 1u);
    EXPECT_EQ(r.pixels, before.pixels - 1);

    const Image nothing = flat(20, 20, nan, nan, nan);
    const HdrFlipResult none = hdrFlip(nothing, nothing);
    EXPECT_EQ(none.pixels, 0u);
    EXPECT_EQ(none.mean, 0);
    EXPECT_EQ(none.max, 0);
    EXPECT_EQ(hdrFlip(nothing, flat(20, 20, 1, 1, 1)).mean, 1);
}

TEST(Flip, StatisticsAreOfCoveredPixelsAndFiltersOfAll) {
    const Image a = noise(64, 48, 11), b = noise(64, 48, 12);
    const FlipResult all = ldrFlip(a, b);
    std::vector<std::uint8_t> covered(a.pixels());
    double sum = 0, max = 0;
    for (std::size_t i = 0; i < covered.size(); i += 3) {
        covered[i] = 1;
        sum += double{all.error.data[i]};
        max = std::max(max, double{all.error.data[i]});
    }
    FlipOptions options;
    options.covered = covered;
    const FlipResult r = ldrFlip(a, b, options);
    EXPECT_EQ(r.error.data, all.error.data);
    EXPECT_EQ(r.pixels, 1024u);
    EXPECT_NEAR(r.mean, sum / 1024, 1e-12) << "doubles in another order";
    EXPECT_EQ(r.max, max);
    EXPECT_LT(r.weighted_first_quartile, r.weighted_median);
    EXPECT_LT(r.weighted_median, r.weighted_third_quartile);
}

// FLIP shows values outside its range as the nearest that it can.
TEST(Flip, WhatItCannotSeeIsEvaluatedByTheDifference) {
    Image low = noise(40, 40, 13), wild = low;
    set(low, 9, 9, -3.0f);
    set(wild, 9, 9, -2.0f);
    set(low, 30, 30, -3.0f);
    set(wild, 30, 30, -3.0f - 1e-5f);
    const HdrFlipResult h = hdrFlip(low, wild);
    EXPECT_EQ(h.unseen_different, 1u);
    EXPECT_EQ(h.error.at(9, 9), 1.0f);
    EXPECT_EQ(h.error.at(30, 30), 0.0f) << "less than 1e-3 of the mean luminance";
    EXPECT_EQ(h.error.at(20, 20), 0.0f) << "elsewhere the images are equal";
    EXPECT_NEAR(h.mean, 1.0 / 1600, 1e-9);
    EXPECT_EQ(HdrFlipAgainst(low, {}).mean(wild).mean, h.mean);
    EXPECT_EQ(ldrFlip(low, wild).unseen_different, 1u);
    EXPECT_EQ(hdrFlip(low, low).mean, 0);

    HdrFlipOptions dark;
    dark.start_exposure = dark.stop_exposure = 20;
    Image white = grey(4.0f), whiter = grey(4.0f);
    set(whiter, 9, 9, 5.0f);
    EXPECT_EQ(hdrFlip(white, whiter, dark).unseen_different, 1u) << "white at every exposure";
    EXPECT_EQ(hdrFlip(white, whiter).unseen_different, 0u);
}

TEST(Flip, SaysWhatItCannotDo) {
    const Image image = grey(0.5f);
    EXPECT_NE(errorOf(image, noise(40, 31, 1), {}).find("40x30"), std::string::npos);
    EXPECT_NE(errorOf(Image(), Image(), {}), "");
    HdrFlipOptions options;
    options.pixels_per_degree = nan;
    EXPECT_NE(errorOf(image, image, options).find("pixels per degree"), std::string::npos);
    options = {};
    options.start_exposure = 2;
    options.stop_exposure = 1;
    EXPECT_NE(errorOf(image, image, options).find("swap"), std::string::npos);
    options = {};
    options.start_exposure = -200;
    EXPECT_NE(errorOf(image, image, options).find("-200"), std::string::npos);
    options = {};
    options.exposures = 0;
    EXPECT_NE(errorOf(image, image, options).find("1 or more"), std::string::npos);
    const std::vector<std::uint8_t> two(2);
    options = {};
    options.covered = two;
    EXPECT_NE(errorOf(image, image, options).find("coverage"), std::string::npos);
    EXPECT_EQ(errorOf(image, image, {}), "");
}

TEST(Flip, PixelsPerDegreeOfAViewer) {
    EXPECT_NEAR(pixelsPerDegree(0.7, 0.7, 3840), 67.0206, 5e-5);
    EXPECT_EQ(FlipOptions().pixels_per_degree, 67.0206);
}

TEST(FlipPowers, AreWithinTheirStatedErrors) {
    double log = 0, power = 0;
    for (double x = 1e-3; x < 200; x *= 1.0001) {
        const auto f = static_cast<float>(x);
        log = std::max(log, std::abs(double{fast::log2(f)} - std::log2(double{f})) -
                                1.2e-7 * std::abs(std::log2(double{f})));
        for (const float p : {1.0f / 3, 0.7f, 2.4f}) {
            const double exact = std::pow(double{f}, double{p});
            power = std::max(power, std::abs(double{fast::pow(f, p)} / exact - 1) /
                                        (3e-7 + 1.2e-7 * p * std::abs(std::log2(x))));
        }
    }
    EXPECT_LT(log, 3e-7);
    EXPECT_LT(power, 1);
    EXPECT_EQ(fast::pow(0, 0.7f), 0);
    EXPECT_EQ(fast::pow(0, 0), 0) << "no colour difference is no difference, whatever the features";
    EXPECT_EQ(fast::pow(1, 0.3f), 1);
}

// Keeps the reference's data for all, some or none of the exposures; with holes in the reference only, and
// in a test too.
TEST(Flip, AgainstOneReferenceIsTheSameBitForBit) {
    constexpr int width = 150, height = 70;
    for (const bool holed : {false, true}) {
        Image reference = noise(width, height, 1, 0, 4);
        if (holed) set(reference, 40, 30, nan);
        std::vector<std::uint8_t> covered(reference.pixels(), 1);
        covered[70] = 0;
        HdrFlipOptions options;
        options.exposures = 3;
        options.covered = covered;
        for (const std::size_t looks : {0u, 2u, 3u}) {
            const HdrFlipAgainst against(reference, options, looks * 20 * reference.pixels());
            for (int more = 0; more < 3; ++more) {
                Image test = noise(width, height, 2, 0, 4);
                if (holed) set(test, 40, 30, nan);
                if (more > 0) set(test, 42, 31, nan);
                if (more > 1) test = reference;
                const HdrFlipResult expected = hdrFlip(reference, test, options), result = against(test);
                EXPECT_EQ(result.error.data, expected.error.data) << looks << " " << holed << " " << more;
                EXPECT_EQ(result.weighted_median, expected.weighted_median);
                EXPECT_EQ(against.mean(test).mean, expected.mean);
                EXPECT_EQ(against.mean(test).pixels, expected.pixels);
            }
        }
    }
}

}  // namespace
}  // namespace diptych
