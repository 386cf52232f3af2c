// SPDX-License-Identifier: MIT
// Every metric of two images from its definition, on errors that give each metric a different value.
#include "compare/verdict/measurement.h"
#include "tests/support/error_spread.h"

#include <gtest/gtest.h>

#include <set>

namespace diptych {

using namespace error_spread;

namespace {

Metrics standardMetrics(const Errors& e) {
    const double mse = rootMeanSquareOf(e.components) * rootMeanSquareOf(e.components);
    return {{"mse", mse},
            {"mae", meanOf(e.components)},
            {"relative_mse", meanOf(e.relative_squares)},
            {"relative_max", errorOfRank(e.relative, counted)},
            {"relative_mean", meanOf(e.relative)},
            {"relative_p99", errorOfRank(e.relative, 1981)},
            {"relative_p999", errorOfRank(e.relative, 1999)},
            {"psnr", 10 * std::log10(9 / mse)},  // the reference's largest component is 3
            {"ulp_max", errorOfRank(e.ulps, e.ulps.size())},
            {"ulp_mean", meanOf(e.ulps)}};
}

// Relative errors are computed in float32.
double boundOf(const std::string& metric, double value) {
    return (metric.starts_with("relative_m") || metric.starts_with("relative_p") ? 0x1p-22 : 1e-12) *
           std::abs(value);
}

void expectMetrics(const Measurement& m, const Metrics& expected, const std::set<std::string>& elsewhere) {
    std::set<std::string> found;
    for (const auto& [name, value] : m.all()) {
        found.insert(name);
        if (elsewhere.contains(name)) continue;
        ASSERT_TRUE(expected.contains(name)) << name << " is not tested";
        EXPECT_NEAR(value, expected.at(name), boundOf(name, expected.at(name))) << name;
        EXPECT_EQ(m(Quantity{name, 0}), value) << name;
    }
    for (const auto& [name, value] : expected) EXPECT_TRUE(found.contains(name)) << name;
}

TEST(Metrics, NoTwoOfTheSpreadAreAlike) {
    const Errors e = errorsOf(spread());
    Metrics all = standardMetrics(e);
    for (const auto& [errorKind, errors] : {std::pair{"absolute", &e.absolute}, {"angular", &e.angles}})
        for (const auto& [name, value] : ofPixels(*errors)) all[std::string(errorKind) + " " + name] = value;
    for (const auto& [a, x] : all)
        for (const auto& [b, y] : all)
            if (a < b) {
                EXPECT_GT(std::abs(x - y), 3 * boundOf("relative_max", x)) << a << " and " << b;
            }
    for (const std::size_t rank : {1981u, 1999u})
        for (const std::size_t other : {rank - 1, rank + 1})
            for (const std::vector<double>* errors : {&e.absolute, &e.relative, &e.angles})
                EXPECT_GT(std::abs(errorOfRank(*errors, rank) - errorOfRank(*errors, other)),
                          1e-5 * errorOfRank(*errors, rank));
}

TEST(Metrics, OfAChannelFollowTheirDefinitions) {
    const Spread s = spread();
    const Errors e = errorsOf(s);
    for (const auto& [errorKind, errors] : {std::pair{ErrorKind::absolute, &e.absolute},
                                            {ErrorKind::relative, &e.relative},
                                            {ErrorKind::angular, &e.angles}}) {
        const ChannelStats stats =
            channelStats(errorKind, ChannelKind::vector, s.reference, s.test, s.covered);
        const Metrics expected = ofPixels(*errors);
        for (const auto& [name, value] : {std::pair{"max", stats.max},
                                          {"mean", stats.mean},
                                          {"rmse", stats.rmse},
                                          {"p99", stats.p99},
                                          {"p999", stats.p999}})
            EXPECT_NEAR(value, expected.at(name), 1e-12 * value) << nameOf(errorKind) << " " << name;
        EXPECT_EQ(stats.different, counted);
        const auto worst = static_cast<std::size_t>(std::ranges::max_element(*errors) - errors->begin());
        EXPECT_EQ(stats.worst_x, spreadPixel(worst) % wide) << nameOf(errorKind);
        EXPECT_EQ(stats.worst_y, spreadPixel(worst) / wide) << nameOf(errorKind);
    }
}

// Largest difference in length between two covered vectors.
double longestApart(const Spread& s) {
    double max = 0;
    for (std::size_t i = 0; i < s.reference.pixels(); ++i) {
        const float *r = s.reference.pixel(i), *t = s.test.pixel(i);
        const double apart =
            std::abs(std::sqrt(double{r[0]} * r[0] + double{r[1]} * r[1] + double{r[2]} * r[2]) -
                     std::sqrt(double{t[0]} * t[0] + double{t[1]} * t[1] + double{t[2]} * t[2]));
        if (s.covered.covered[i] && std::isfinite(apart)) max = std::max(max, apart);
    }
    return max;
}

TEST(Metrics, AreGivenByTheirNames) {
    const Spread s = spread();
    const Errors e = errorsOf(s);
    Metrics vectors = standardMetrics(e);
    vectors.merge(Metrics{{"angle_max", errorOfRank(e.angles, counted)},
                          {"angle_mean", meanOf(e.angles)},
                          {"length_max", longestApart(s)}});
    vectors.merge(ofPixels(e.angles));
    const Measurement angular(
        {ErrorKind::angular, ChannelKind::vector, false, s.reference, s.test, &s.covered});
    expectMetrics(angular, vectors, {});

    // For absolute errors, mean and RMSE are over components, as in other programs.
    Metrics colors = standardMetrics(e), pixels = ofPixels(e.absolute);
    pixels["mean"] = meanOf(e.components);
    pixels["rmse"] = rootMeanSquareOf(e.components);
    colors.merge(pixels);
    const Measurement absolute(
        {ErrorKind::absolute, ChannelKind::color, false, s.reference, s.test, &s.covered});
    ASSERT_NE(absolute.flip(), nullptr);
    const HdrFlipResult& flip = *absolute.flip();
    colors.merge(Metrics{{"flip", flip.mean}, {"flip_median", flip.weighted_median}, {"flip_max", flip.max}});
    EXPECT_NE(flip.mean, flip.weighted_median);
    EXPECT_LT(flip.weighted_median, flip.max);
    expectMetrics(absolute, colors, {"ssim"});

    // Statistics that were computed before are used, whatever the metric.
    ChannelStats known =
        channelStats(ErrorKind::absolute, ChannelKind::color, s.reference, s.test, s.covered);
    const Measurement measurement(
        {ErrorKind::absolute, ChannelKind::color, false, s.reference, s.test, &s.covered, &known});
    for (const auto& [name, value] : ofPixels(e.absolute))
        EXPECT_NEAR(measurement({name, 0}).value_or(-1), value, 1e-12 * value) << name;
}

TEST(Metrics, OfPlainMetricsArePixelsToo) {
    const Spread s = spread();
    const StandardMetrics m =
        standardMetrics(s.reference, s.test, ChannelKind::color, Range::linear, s.covered);
    EXPECT_EQ(m.pixels, counted);
    EXPECT_EQ(m.different, counted);
}

// FLIP uses the exposure range and the display's pixels per degree.
TEST(Metrics, FlipIsToldItsOptions) {
    const Spread s = spread();
    const auto mean = [&](const HdrFlipOptions& flip, bool display) {
        return Measurement({ErrorKind::absolute, ChannelKind::color, display, s.reference, s.test, &s.covered,
                            nullptr, flip})({"flip", 0})
            .value_or(-1);
    };
    HdrFlipOptions defaults, near, one;
    near.pixels_per_degree = 20;
    one.start_exposure = one.stop_exposure = 0;
    one.exposures = 1;
    EXPECT_NE(mean(defaults, false), mean(near, false));
    EXPECT_NE(mean(defaults, true), mean(defaults, false));
    EXPECT_NE(mean(defaults, false), mean(one, false));
}

// A fraction of failing pixels: an error equal to the bound passes.
TEST(Metrics, AFractionIsOfTheCountedPixelsBeyond) {
    const Spread s = spread();
    const Measurement m({ErrorKind::absolute, ChannelKind::color, false, s.reference, s.test, &s.covered});
    for (const std::size_t i : {std::size_t{0}, std::size_t{1000}, counted - 2, counted - 1})
        EXPECT_EQ(m({FAILING, stepOf(i)}), static_cast<double>(counted - 1 - i) / counted) << i;
    EXPECT_EQ(m({FAILING, stepOf(0) / 2}), 1.0);
}

// Pixels that are left out affect no metric but SSIM, although FLIP's filters would reach them.
TEST(Metrics, ExcludedPixelsAffectNone) {
    const Image reference(24, 24, 3, 0.5f);
    const auto all = [&](float excluded) {
        Image test = reference;
        test.at(12, 12, 1) = 0.75f;
        Coverage covered = everyPixel(test.pixels());
        for (int y = 0; y < 24; ++y) {
            covered.covered[test.offset(13, y) / 3] = 0;
            for (int c = 0; c < 3; ++c) test.at(13, y, c) = excluded;
        }
        covered.count -= 24;
        const Measurement m({ErrorKind::absolute, ChannelKind::color, true, reference, test, &covered});
        Metrics found;
        for (const auto& [name, value] : m.all())
            if (name != "ssim") found[name] = value;  // its windows reach them
        return found;
    };
    const auto some = all(0.5f);
    EXPECT_EQ(all(0), some);
    EXPECT_EQ(all(1), some);
    EXPECT_GT(some.at("flip"), 0);
}

// SSIM clamps negative values, so where they differ they fail a bound on it.
TEST(Metrics, WhatSsimCannotSeeFails) {
    Image a(16, 16, 3, 0.5f), b = a;
    a.data[0] = -1;
    b.data[0] = -3;
    const Coverage covered = everyPixel(a.pixels());
    for (const auto& [metric, level] : {std::pair{"ssim", Level::fail}, {"mae", Level::pass}}) {
        Rule rule;
        rule.fail = {Condition::Kind::bound, {metric, 0}, metric[0] == 's' ? 0.5 : 100, {}};
        EXPECT_EQ(
            decide(rule, Measurement({ErrorKind::absolute, ChannelKind::color, false, a, b, &covered})).level,
            level);
        EXPECT_EQ(
            decide(rule, Measurement({ErrorKind::absolute, ChannelKind::color, false, a, a, &covered})).level,
            Level::pass);
    }
}

}  // namespace
}  // namespace diptych
