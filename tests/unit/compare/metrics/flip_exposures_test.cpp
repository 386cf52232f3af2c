// SPDX-License-Identifier: MIT
// The exposures that HDR-FLIP chooses, and their effect.
#include "compare/metrics/flip.h"
#include "tests/support/test_images.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace diptych {
namespace {

TEST(FlipExposures, MapTheBrightestAndTheMedianToTheTarget) {
    // Luminances 1, 4 and 16 have the median 4. The curves reach 0.85 at the x found.
    Image image(3, 1, 3);
    for (int x = 0; x < 3; ++x) set(image, x, 0, std::exp2(2.0f * static_cast<float>(x)));
    for (const ToneMapper mapper : {ToneMapper::aces, ToneMapper::reinhard, ToneMapper::hable}) {
        const double x = inverseToneCurve(mapper, 0.85);
        const ToneCurve k = toneCurve(mapper);
        EXPECT_NEAR((k.k0 * x * x + k.k1 * x) / (k.k2 * x * x + k.k3 * x + k.k4), 0.85, 1e-6);
        const ExposureRange range = exposureRange(image, mapper);
        EXPECT_NEAR(range.start, std::log2(x / 16), 1e-6) << "a float's luminance";
        EXPECT_NEAR(range.stop, std::log2(x / 4), 1e-6);
    }
    EXPECT_NEAR(inverseToneCurve(ToneMapper::reinhard, 0.85), 0.85 / 0.15, 1e-6);
    EXPECT_NEAR(inverseToneCurve(ToneMapper::hable, 1), 5.6, 1e-5) << "white at 11.2, of twice x";
}

TEST(FlipExposures, AreFiniteWhereMostIsBlack) {
    Image image = grey(0);
    for (int x = 0; x < 5; ++x) set(image, x, 3, std::exp2(static_cast<float>(x)));
    set(image, 7, 7, nan);
    set(image, 8, 7, -4.0f);
    const double x = inverseToneCurve(ToneMapper::aces, 0.85);
    const ExposureRange range = exposureRange(image, ToneMapper::aces);
    EXPECT_NEAR(range.start, std::log2(x / 16), 1e-6);
    EXPECT_NEAR(range.stop, std::log2(x / 4), 1e-6) << "the median of 1, 2, 4, 8, 16";
    EXPECT_TRUE(std::isfinite(hdrFlip(image, grey(1)).mean));

    const HdrFlipResult black = hdrFlip(grey(0), grey(1));
    EXPECT_EQ(black.start_exposure, 0);
    EXPECT_EQ(black.stop_exposure, 0);
    EXPECT_EQ(black.exposures, 2);
    EXPECT_GT(black.mean, 0.5);
    EXPECT_EQ(hdrFlip(grey(0), grey(0)).mean, 0);
}

TEST(FlipExposures, ExtremeValuesStayNumbers) {
    for (const float v : {std::numeric_limits<float>::max(), std::numeric_limits<float>::denorm_min()})
        for (const ToneMapper mapper : {ToneMapper::aces, ToneMapper::reinhard, ToneMapper::hable}) {
            HdrFlipOptions options;
            options.tone_mapper = mapper;
            const HdrFlipResult r = hdrFlip(grey(v), noise(40, 30, 14, 0, v), options);
            EXPECT_TRUE(r.mean >= 0 && r.mean <= 1) << v;
            EXPECT_LE(std::abs(r.start_exposure), 126);
        }
}

TEST(FlipExposures, ErrorsAreTheLargestOfAllExposures) {
    // Visible at each exposure: what none shows is judged otherwise.
    const Image a = noise(300, 40, 15, 0.1f, 0.5f), b = noise(300, 40, 16, 0.1f, 0.5f);
    HdrFlipOptions options;
    options.start_exposure = -6;
    options.stop_exposure = 1;
    options.exposures = 3;
    const HdrFlipResult all = hdrFlip(a, b, options);
    Image max(300, 40, 1);
    for (int i = 0; i < 3; ++i) {
        HdrFlipOptions one;
        one.start_exposure = one.stop_exposure = -6 + 3.5 * i;
        one.exposures = 1;
        const Image error = hdrFlip(a, b, one).error;
        for (std::size_t p = 0; p < error.pixels(); ++p) max.data[p] = std::max(max.data[p], error.data[p]);
    }
    EXPECT_EQ(all.error.data, max.data);
}

}  // namespace
}  // namespace diptych
