// SPDX-License-Identifier: MIT
// FLIP's options and what it refuses, its statistics and its tone curves.
#include "compare/metrics/flip.h"
#include "compare/metrics/flip_filters.h"
#include "tests/support/errors.h"
#include "tests/support/test_images.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

namespace diptych {
namespace {

TEST(FlipLimits, WhatIsRefusedSaysWhy) {
    const Image image = flat(3, 2, 1, 1, 1);
    const auto why = [&](const HdrFlipOptions& options) {
        return faultOf([&] { hdrFlip(image, image, options); });
    };
    const auto ofPair = [](const Image& a, const Image& b) { return faultOf([&] { ldrFlip(a, b); }); };
    const std::string must = "FLIP compares two colour images of the same size, not ";
    EXPECT_EQ(ofPair(image, flat(2, 2, 1, 1, 1)),
              must + "3x2 of 3 components and 2x2 of 3; crop or resize one");
    EXPECT_EQ(ofPair(image, flat(3, 3, 1, 1, 1)),
              must + "3x2 of 3 components and 3x3 of 3; crop or resize one");
    EXPECT_EQ(ofPair(Image(3, 2, 1), image), must + "3x2 of 1 components and 3x2 of 3; crop or resize one");
    EXPECT_EQ(ofPair(image, Image(3, 2, 4)), must + "3x2 of 3 components and 3x2 of 4; crop or resize one");
    EXPECT_EQ(ofPair(Image(0, 2, 3), Image(0, 2, 3)),
              must + "0x2 of 3 components and 0x2 of 3; crop or resize one");
    HdrFlipOptions options;
    const std::vector<std::uint8_t> five(5, 1), six(6, 1);
    options.covered = five;
    EXPECT_EQ(why(options), "FLIP of 3x2 pixels: 5 coverage values; give one per pixel");
    options.covered = six;
    EXPECT_EQ(why(options), "");
    for (const auto& [value, text] :
         {std::pair{0.5, "0.5"}, {0.99, "0.99"}, {1.0, ""}, {1000.0, ""}, {1001.0, "1001"}}) {
        options = {};
        options.pixels_per_degree = value;
        EXPECT_EQ(why(options),
                  *text ? "FLIP with " + std::string(text) + " pixels per degree: give 1 to 1000" : "");
    }
    for (const auto& [value, text] :
         {std::pair{-126.5, "-126.5"}, {-126.0, ""}, {126.0, ""}, {127.0, "127"}}) {
        options = {};
        options.start_exposure = options.stop_exposure = value;
        options.exposures = 1;
        EXPECT_EQ(why(options), *text ? "exposure " + std::string(text) +
                                            ": float32 has 2^-126 to 2^126; give stops in between"
                                      : "");
    }
    options = {};
    options.start_exposure = 1.5;
    options.stop_exposure = 1;
    EXPECT_EQ(why(options), "exposures from 1.5 to 1: the first must be the lower one; swap them");
    options = {};
    options.exposures = 0;
    EXPECT_EQ(why(options), "0 exposures: give 1 or more");
    options.exposures = 1;
    EXPECT_EQ(why(options), "");
}

// At least two; one for each begun stop. Each end that is not given follows from the reference.
TEST(FlipLimits, ExposuresAreStopsApart) {
    const Image image = flat(3, 2, 1, 1, 1);
    for (const auto& [stop, count] : {std::pair{0.0, 2}, {2.0, 2}, {2.01, 3}, {3.0, 3}, {3.5, 4}}) {
        HdrFlipOptions options;
        options.start_exposure = 0;
        options.stop_exposure = stop;
        const HdrFlipResult result = hdrFlip(image, image, options);
        EXPECT_EQ(result.exposures, count) << stop;
        EXPECT_EQ(result.start_exposure, 0);
        EXPECT_EQ(result.stop_exposure, stop);
    }
    const ExposureRange range = exposureRange(image, ToneMapper::aces);
    HdrFlipOptions options;
    options.stop_exposure = 10;
    EXPECT_EQ(hdrFlip(image, image, options).start_exposure, range.start);
    EXPECT_EQ(hdrFlip(image, image, options).stop_exposure, 10);
    options.stop_exposure.reset();
    options.start_exposure = -10;
    EXPECT_EQ(hdrFlip(image, image, options).start_exposure, -10);
    EXPECT_EQ(hdrFlip(image, image, options).stop_exposure, range.stop);
    EXPECT_EQ(HdrFlipOptions().tone_mapper, ToneMapper::aces);
}

// Each luminance of Rec.709, negative components as 0.
TEST(FlipLimits, ExposuresAreOfTheLuminance) {
    const double bright = inverseToneCurve(ToneMapper::reinhard, 0.85);
    const float components[][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, -5, 0}, {-5, 1, 0}, {0, -1, 1}};
    const double lumas[] = {0.2126, 0.7152, 0.0722, 0.2126, 0.7152, 0.0722};
    for (std::size_t i = 0; i < 6; ++i) {
        const auto& c = components[i];
        const ExposureRange range = exposureRange(flat(2, 1, c[0], c[1], c[2]), ToneMapper::reinhard);
        EXPECT_NEAR(range.start, std::log2(bright / lumas[i]), 1e-6) << i;
        EXPECT_NEAR(range.stop, range.start, 1e-12);
    }
    EXPECT_EQ(exposureRange(flat(2, 1, -1, -1, -1), ToneMapper::aces).start, 0) << "nothing shines";
}

TEST(FlipLimits, AViewersPixelsPerDegree) {
    EXPECT_DOUBLE_EQ(pixelsPerDegree(1, 0.5, 1000), 2000 * std::numbers::pi / 180);
    EXPECT_DOUBLE_EQ(pixelsPerDegree(2, 0.5, 1000), 4000 * std::numbers::pi / 180);
}

// ---- Statistics ----

// Every second pixel of several pieces of values, by sorting them.
TEST(FlipLimits, StatisticsAreThoseOfTheSortedErrors) {
    const Image a = noise(110, 90, 1), b = noise(110, 90, 2);
    std::vector<std::uint8_t> covered(a.pixels());
    for (std::size_t i = 0; i < covered.size(); i += 2) covered[i] = 1;
    covered[3] = 1;
    Image test = b;
    test.pixel(4)[1] = nan;  // counts as 1
    FlipOptions options;
    options.covered = covered;
    Image reference = a;
    for (const bool both : {false, true}) {
        if (both)  // and now not at all
            for (int c = 0; c < 3; ++c) reference.pixel(4)[c] = test.pixel(4)[c] = nan;
        const FlipResult r = ldrFlip(reference, test, options);
        std::vector<float> errors;
        for (std::size_t i = 0; i < covered.size(); ++i)
            if (covered[i] && !(both && i == 4)) errors.push_back(r.error.data[i]);
        std::ranges::sort(errors);
        const double sum = std::accumulate(errors.begin(), errors.end(), 0.0);
        const auto quantile = [&](double fraction) {
            double below = 0;
            for (const float e : errors)
                if ((below += double{e}) >= fraction * sum) return e;
            return errors.back();
        };
        EXPECT_EQ(r.pixels, 4951u - both);
        EXPECT_EQ(errors.back() == 1, !both);
        EXPECT_NEAR(r.mean, sum / static_cast<double>(errors.size()), 1e-12);
        EXPECT_EQ(r.min, errors.front());
        EXPECT_EQ(r.max, errors.back());
        EXPECT_EQ(r.weighted_first_quartile, quantile(0.25));
        EXPECT_EQ(r.weighted_median, quantile(0.5));
        EXPECT_EQ(r.weighted_third_quartile, quantile(0.75));
        HdrFlipOptions hdr;
        hdr.covered = covered;
        hdr.exposures = 1;
        const HdrFlipResult whole = hdrFlip(reference, test, hdr);
        const HdrFlipAgainst::Mean mean = HdrFlipAgainst(reference, hdr).mean(test);
        EXPECT_EQ(mean.mean, whole.mean);
        EXPECT_EQ(mean.pixels, whole.pixels);
    }
}

// ---- What it cannot see ----

// Half an 8-bit step: of black on sRGB's line, at the highest exposure; of white, at the lowest. Reinhard's
// curve x / (1 + x) has its ends at half / 12.92 and 1 - half.
TEST(FlipLimits, BlackAndWhiteAreWithinHalfAStep) {
    const double half = 0.5 / 255, black = half / 12.92 / (1 - half / 12.92), white = (1 - half) / half;
    const auto unseen = [](double reference, double test, double start, double stop) {
        Image dark = flat(6, 5, 1e-3f, 1e-3f, 1e-3f), other = dark;
        set(dark, 2, 2, static_cast<float>(reference));
        set(other, 2, 2, static_cast<float>(test));
        HdrFlipOptions options;
        options.tone_mapper = ToneMapper::reinhard;
        options.start_exposure = start;
        options.stop_exposure = stop;
        const HdrFlipResult r = hdrFlip(dark, other, options);
        EXPECT_EQ(r.unseen_different == 1, r.error.at(2, 2) == 1);
        return r.unseen_different;
    };
    EXPECT_EQ(unseen(0, 0.999 * black, -3, 0), 1u);
    EXPECT_EQ(unseen(0.999 * black, 0, -3, 0), 1u);
    EXPECT_EQ(unseen(0, 1.001 * black, -3, 0), 0u);
    EXPECT_EQ(unseen(0, 0.999 * black / 4, -3, 2), 1u) << "two stops more show a quarter";
    EXPECT_EQ(unseen(0, 1.001 * black / 4, -3, 2), 0u);
    EXPECT_EQ(unseen(1.001 * white, 2 * white, 0, 1), 1u);
    EXPECT_EQ(unseen(0.999 * white, 2 * white, 0, 1), 0u);
    EXPECT_EQ(unseen(2 * white, 0.999 * white, 0, 1), 0u);
    EXPECT_EQ(unseen(1.001 * 8 * white, 16 * white, -3, 1), 1u)
        << "three stops less show eight times as much";
    EXPECT_EQ(unseen(0.999 * 8 * white, 16 * white, -3, 1), 0u);
}

// More than a thousandth of the mean luminance. LDR has a range of 0 to 1, HDR no upper end.
TEST(FlipLimits, UnseenDifferencesCountAboveAThousandth) {
    const auto unseen = [](float from, float to, bool display) {
        Image a = flat(10, 10, 1, 1, 1), b = a;
        set(a, 4, 4, from);
        b = a;
        b.at(4, 4, 2) = to;
        return display ? ldrFlip(a, b).unseen_different : hdrFlip(a, b).unseen_different;
    };
    // The mean of 99 ones and a negative pixel, which counts as 0.
    for (const bool display : {false, true}) {
        EXPECT_EQ(unseen(-1, -1 - 0.00098f, display), 0u);
        EXPECT_EQ(unseen(-1, -1 - 0.001f, display), 1u);
        EXPECT_EQ(unseen(-1, 0.5f, display), 1u) << "one side is enough";
        EXPECT_EQ(unseen(0.5f, -1, display), 1u);
        EXPECT_EQ(unseen(0.5f, 0.6f, display), 0u) << "seen";
        EXPECT_EQ(unseen(1.5f, 1.7f, display), display ? 1u : 0u);
        EXPECT_EQ(unseen(1, 1.1f, display), display ? 1u : 0u);
        EXPECT_EQ(unseen(1.1f, 1, display), display ? 1u : 0u);
    }
}

// ---- Tone curves and filters ----

TEST(FlipLimits, ToneCurvesAreThePublishedOnes) {
    const auto curve = [](ToneMapper mapper, double x) {
        const ToneCurve k = toneCurve(mapper);
        return (double{k.k0} * x * x + double{k.k1} * x) /
               (double{k.k2} * x * x + double{k.k3} * x + double{k.k4});
    };
    const auto narkowicz = [](double x) { return x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14); };
    const auto hable = [](double x) {
        constexpr double a = 0.15, b = 0.5, c = 0.1, d = 0.2, e = 0.02, f = 0.3;
        return (x * (a * x + c * b) + d * e) / (x * (a * x + b) + d * f) - e / f;
    };
    for (const double x : {0.001, 0.1, 0.5, 1.0, 2.0, 20.0}) {
        EXPECT_NEAR(curve(ToneMapper::aces, x), narkowicz(0.6 * x), 1e-6) << x;
        EXPECT_NEAR(curve(ToneMapper::reinhard, x), x / (1 + x), 1e-6) << x;
        EXPECT_NEAR(curve(ToneMapper::hable, x), hable(2 * x) / hable(11.2), 1e-6) << x;
        for (const ToneMapper mapper : {ToneMapper::aces, ToneMapper::reinhard, ToneMapper::hable})
            EXPECT_NEAR(inverseToneCurve(mapper, curve(mapper, x)) / x, 1, 1e-4) << x;
    }
}

// Three deviations of the widest filter: of yellow-blue, sqrt(0.04 / 2) / pi degrees, or of the detectors,
// 0.041 degrees. Even filters add up to 1 over both sides, a derivative's positive weights to 1.
TEST(FlipLimits, FiltersReachThreeDeviations) {
    for (const double ppd : {20.0, 67.0206, 300.0}) {
        const FlipFilters f(ppd);
        const double widest = std::sqrt(0.02) / std::numbers::pi;
        EXPECT_EQ(f.radius(), std::ceil(3 * widest * ppd));
        EXPECT_EQ(f.cz[0].size(), static_cast<std::size_t>(f.radius()) + 1);
        const auto bothSides = [](const HalfKernel& kernel) {
            return 2 * std::accumulate(kernel.begin(), kernel.end(), 0.0) - double{kernel[0]};
        };
        for (const HalfKernel* kernel : {&f.y, &f.cx, &f.cz[0], &f.cz[1], &f.smooth})
            EXPECT_NEAR(bothSides(*kernel), 1, 1e-6) << ppd;
        EXPECT_NEAR(bothSides(f.point), 0, 1e-6) << ppd;
        EXPECT_EQ(f.edge[0], 0);
        EXPECT_NEAR(std::accumulate(f.edge.begin(), f.edge.end(), 0.0), 1, 1e-6);
        EXPECT_EQ(f.edge.size(), static_cast<std::size_t>(std::ceil(3 * 0.041 * ppd)) + 1);
        EXPECT_FLOAT_EQ(f.cz_fraction[0] + f.cz_fraction[1], 1);
    }
    // Gaussians: exp(-pi^2 d^2 / b), d in degrees; ratios to the middle.
    const FlipFilters f(100);
    const std::pair<const HalfKernel*, double> gaussians[] = {
        {&f.y, 0.0047}, {&f.cx, 0.0053}, {&f.cz[0], 0.04}, {&f.cz[1], 0.025}};
    for (const auto& [kernel, b] : gaussians)
        EXPECT_NEAR((*kernel)[2] / (*kernel)[0], std::exp(-std::pow(std::numbers::pi * 0.02, 2) / b), 1e-6);
    EXPECT_NEAR(f.smooth[2] / f.smooth[0], std::exp(-0.5 * std::pow(2 / 4.1, 2)), 1e-6);
    EXPECT_NEAR(f.edge[2] / f.edge[1], 2 * std::exp(-1.5 / (4.1 * 4.1)), 1e-6);
    EXPECT_NEAR(f.point[2] / f.point[0], (1 - std::pow(2 / 4.1, 2)) * std::exp(-0.5 * std::pow(2 / 4.1, 2)),
                1e-6);
}

}  // namespace
}  // namespace diptych
