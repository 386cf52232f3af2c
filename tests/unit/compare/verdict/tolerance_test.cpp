// SPDX-License-Identifier: MIT
// Derived error bounds, compared with the encodings (reimplemented in double from the G-buffer's
// description) and with a table of measured errors.
#include "compare/verdict/tolerance.h"
#include "compare/verdict/encoding_bits.h"
#include "compare/verdict/encoding_use.h"
#include "compare/verdict/pair_reports.h"
#include "shared/contract/constants.h"
#include "shared/contract/debug_mode.h"
#include "shared/contract/gbuffer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

namespace diptych {
namespace {

double quantised(double x, unsigned bits) {
    const double top = (1u << bits) - 1;
    return std::floor(x * top + 0.5) / top;
}
double quantisedSqrt(double x, unsigned bits) {
    const double root = quantised(std::sqrt(x), bits);
    return root * root;
}

using Vector = std::array<double, 3>;

double length(const Vector& v) {
    return std::hypot(v[0], v[1], v[2]);
}
double degreesBetween(const Vector& a, const Vector& b) {
    const Vector cross{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    return std::atan2(length(cross), a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) * 180 / std::numbers::pi;
}
Vector throughOctahedron(const Vector& n, unsigned bits) {
    const double top = (1u << (bits - 1)) - 1, sum = std::abs(n[0]) + std::abs(n[1]) + std::abs(n[2]);
    const auto sign = [](double v) { return v >= 0 ? 1.0 : -1.0; };
    double x = n[0] / sum, y = n[1] / sum;
    const auto wrap = [&] {
        const double old = x;
        x = (1 - std::abs(y)) * sign(x);
        y = (1 - std::abs(old)) * sign(y);
    };
    if (n[2] < 0) wrap();
    x = std::floor(x * top + 0.5) / top;
    y = std::floor(y * top + 0.5) / top;
    const double z = 1 - std::abs(x) - std::abs(y);
    if (z < 0) wrap();
    return {x, y, z};
}

// Largest error of many directions; half of them are around a face's centre, where the error reaches the
// bound.
double worstOctahedral(unsigned bits) {
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    double worst = 0;
    for (int i = 0; i < 400'000; ++i) {
        Vector n{normal(random), normal(random), normal(random)};
        if (i % 2 == 1)
            for (double& c : n) c = (c < 0 ? -1 : 1) * (1 + 0.01 * c);
        worst = std::max(worst, degreesBetween(n, throughOctahedron(n, bits)));
    }
    return worst;
}

TEST(Tolerance, OctahedralBoundHoldsAndIsTight) {
    for (const unsigned bits : {8u, gpu::COMPACT_NORMAL_BITS, gpu::STANDARD_NORMAL_BITS}) {
        const double worst = worstOctahedral(bits);
        EXPECT_LE(worst, octahedralBound(bits)) << bits;
        EXPECT_GE(worst, 0.95 * octahedralBound(bits))
            << bits << ": a bound that is never neared hides errors";
    }
}

TEST(Tolerance, OctahedralBoundIsThatOfTheMeasuredTable) {
    // Largest error over uniform directions: 8+8 0.9496, 12+12 0.0589, 16+16 0.00370 degrees. A sampled
    // maximum is up to 1 % below the bound; float32 adds 0.00015.
    EXPECT_NEAR(octahedralBound(8), 0.9496, 0.01 * 0.9496 + 2e-4);
    EXPECT_NEAR(octahedralBound(12), 0.0589, 0.01 * 0.0589 + 2e-4);
    EXPECT_NEAR(octahedralBound(16), 0.00370, 0.01 * 0.00370 + 2e-4);
    for (const auto& [bits, measured] : {std::pair{8u, 0.9496}, {12u, 0.0589}, {16u, 0.00370}})
        EXPECT_GE(octahedralBound(bits), measured);
}

TEST(Tolerance, HalfStepsOfEachPackedNumber) {
    OnePixelPair p;
    EXPECT_NEAR(p.encoding(GBufferEncoding::standard).of(Channel::metallic).max, 0.5 / 255, 1e-6);
    EXPECT_NEAR(p.of(Channel::roughness).max, 0.5 / 4095, 1e-6);
    EXPECT_NEAR(p.of(Channel::occlusion).max, 0.5 / 255, 1e-6);
    EXPECT_NEAR(p.encoding(GBufferEncoding::compact).of(Channel::metallic).max, 0.5 / 63, 1e-6);
    EXPECT_NEAR(p.of(Channel::roughness).max, 0.5 / 255, 1e-6);
    EXPECT_NEAR(p.of(Channel::normals).max, 0.0589, 1e-3);
}

TEST(Tolerance, HalfStepsOfEachLayer) {
    for (const GBufferEncoding e : {GBufferEncoding::compact, GBufferEncoding::standard}) {
        OnePixelPair p;
        p.encoding(e).needs.surface_layers = gpu::LAYER_CLEARCOAT | gpu::LAYER_ANISOTROPY;
        for (const Channel mode : {Channel::clearcoat, Channel::clearcoat_roughness, Channel::anisotropy})
            EXPECT_NEAR(p.of(mode).max, 0.5 / 4095, 1e-6) << debugMode(mode).name;
        EXPECT_NEAR(p.of(Channel::clearcoat_normal).max, 0.00370, 2e-4);
        EXPECT_GT(p.of(Channel::anisotropy_direction).max, p.of(Channel::normals).max);
    }
}

TEST(Tolerance, AnAbsentLayerIsNotStored) {
    OnePixelPair p;
    p.encoding(GBufferEncoding::compact).needs.surface_layers = gpu::LAYER_ANISOTROPY;
    EXPECT_EQ(p.of(Channel::clearcoat).max, 0);
    EXPECT_GT(p.of(Channel::anisotropy).max, 0);
    p.needs.surface_layers = gpu::LAYER_CLEARCOAT;
    EXPECT_GT(p.of(Channel::clearcoat).max, 0);
    EXPECT_EQ(p.of(Channel::anisotropy_direction).max, 0);
}

// A unit direction perpendicular to n, through an angle of its projection onto the decoded normal's plane.
Vector throughAngle(const Vector& d, const Vector& decoded, unsigned bits) {
    const auto cross = [](const Vector& a, const Vector& b) {
        return Vector{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    };
    const auto dot = [](const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
    const auto unit = [](Vector v) {
        const double size = length(v);
        for (double& c : v) c /= size;
        return v;
    };
    const Vector n = unit(decoded),
                 x = unit(cross(std::abs(n[0]) < 0.7 ? Vector{1, 0, 0} : Vector{0, 1, 0}, n)),
                 y = cross(n, x);
    const double step = std::numbers::pi / (1u << bits);
    const double angle = std::floor(std::atan2(dot(d, y), dot(d, x)) / step + 0.5) * step;
    return {std::cos(angle) * x[0] + std::sin(angle) * y[0], std::cos(angle) * x[1] + std::sin(angle) * y[1],
            std::cos(angle) * x[2] + std::sin(angle) * y[2]};
}

TEST(Tolerance, LineBoundHoldsAndIsTight) {
    constexpr unsigned bits = gpu::ANISOTROPY_ANGLE_BITS;
    for (const unsigned normal_bits : {gpu::COMPACT_NORMAL_BITS, gpu::STANDARD_NORMAL_BITS}) {
        std::mt19937 random(11);
        std::normal_distribution<double> normal;
        double worst = 0;
        for (int i = 0; i < 200'000; ++i) {
            // Around a face's centre, where the normal turns most.
            Vector n{normal(random), normal(random), normal(random)};
            for (double& c : n) c = (c < 0 ? -1 : 1) * (1 + 0.01 * c);
            const Vector decoded = throughOctahedron(n, normal_bits);
            // The direction in which the normal turned, perpendicular to it; or any other.
            Vector d = decoded;
            if (i % 2 == 1) d = {normal(random), normal(random), normal(random)};
            const double along = (d[0] * n[0] + d[1] * n[1] + d[2] * n[2]) / (length(n) * length(n));
            for (std::size_t c = 0; c < 3; ++c) d.at(c) -= along * n.at(c);
            const double size = length(d);
            if (size == 0) continue;
            for (double& c : d) c /= size;
            const double apart = degreesBetween(d, throughAngle(d, decoded, bits));
            worst = std::max(worst, std::min(apart, 180 - apart));
        }
        EXPECT_LE(worst, lineBound(bits, normal_bits)) << normal_bits;
        EXPECT_GE(worst, 0.9 * lineBound(bits, normal_bits))
            << normal_bits << ": a bound that is never neared hides errors";
    }
}

TEST(Tolerance, AlbedoAndSpecularBoundsHoldAndAreTight) {
    OnePixelPair p;
    p.needs.dielectric_specular = true;
    double worstAlbedo = 0;
    for (int i = 0; i <= 1'000'000; ++i) {
        const double x = i / 1e6;
        worstAlbedo = std::max(worstAlbedo, std::abs(x - quantisedSqrt(x, gpu::ALBEDO_BITS)));
    }
    EXPECT_LE(worstAlbedo, p.of(Channel::albedo).max);
    EXPECT_GE(worstAlbedo, 0.99 * p.of(Channel::albedo).max);

    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform;
    for (const GBufferEncoding e : {GBufferEncoding::compact, GBufferEncoding::standard})
        for (const bool stored : {false, true}) {
            p.encoding(e).needs.dielectric_specular = stored;
            const unsigned metallicBits =
                e == GBufferEncoding::compact ? gpu::COMPACT_METALLIC_BITS : gpu::STANDARD_METALLIC_BITS;
            double worst = 0;
            for (int i = 0; i < 300'000; ++i) {
                // Corner cases matter most: bright albedo, dark F0, any metallic.
                const double a = 1 - 0.05 * uniform(random), m = uniform(random),
                             f = stored ? 0.02 * uniform(random) : double{gpu::DEFAULT_DIELECTRIC_F0};
                const double qa = quantisedSqrt(a, gpu::ALBEDO_BITS), qm = quantised(m, metallicBits),
                             qf = stored ? quantisedSqrt(f, gpu::SPECULAR_BITS) : f;
                worst = std::max(worst, std::abs(std::lerp(f, a, m) - std::lerp(qf, qa, qm)));
            }
            EXPECT_LE(worst, p.of(Channel::specular).max);
            EXPECT_GE(worst, 0.8 * p.of(Channel::specular).max);
            EXPECT_EQ(p.of(Channel::specular).because.find(" and F0") != std::string::npos, stored);
        }
}

TEST(Tolerance, EmissionIsHalfOfNineBits) {
    OnePixelPair p;
    p.needs.emission = true;
    p.needs.min_emission = p.needs.max_emission = 1;
    EXPECT_NEAR(p.of(Channel::emission).max, 0.5 / 256, 0.01 * 0.5 / 256);
    p.needs.max_emission = 70000;
    EXPECT_EQ(p.of(Channel::emission).max, 0) << "float32 beyond the packed range";
    p.needs.max_emission = 1;
    p.needs.min_emission = 1e-6f;
    EXPECT_EQ(p.of(Channel::emission).max, 0);
    p.needs = {};
    EXPECT_EQ(p.of(Channel::emission).max, 0) << "nothing emits";
}

TEST(Tolerance, EmissionDarkerThanTheLastExponentIsStillBound) {
    // Textures can darken emission to where 9.9.9.e5 has a fixed step of 2^-24. A mean of 2^-20 gives a
    // smallest denominator of 1e-3 x 2^-20, so half a step is up to 2^-25 / (1e-3 x 2^-20) of it.
    OnePixelPair p;
    p.needs.emission = true;
    p.needs.min_emission = p.needs.max_emission = 1;
    p.deferred.channels[Channel::emission] = Image(1, 1, 3, 0x1p-20f);
    EXPECT_NEAR(p.of(Channel::emission).max, 0x1p-25 / (1e-3 * 0x1p-20), 1e-6);
    EXPECT_EQ(p.of(Channel::emission).because,
              "half of 9.9.9.e5's smallest step, 2^-25, at the darkest pixel");
}

TEST(Tolerance, WhatIsNotPackedMustBeEqual) {
    for (const GBufferEncoding e :
         {GBufferEncoding::compact, GBufferEncoding::standard, GBufferEncoding::full}) {
        OnePixelPair p;
        p.encoding(e);
        for (const Channel mode : {Channel::material_id, Channel::depth, Channel::position,
                                   Channel::lightmapped, Channel::light_count, Channel::list_overflow})
            EXPECT_EQ(p.of(mode).max, 0) << debugMode(mode).name;
    }
}

TEST(Tolerance, FullIsExactOnACpuAndSixteenUlpOnAGpu) {
    OnePixelPair p;
    p.encoding(GBufferEncoding::full).needs.emission = true;
    for (const DebugMode& mode : debugModes()) {
        if (mode.supported_by == SupportedBy::forward_only) continue;
        p.cpu = true;
        EXPECT_EQ(derivedTolerance(mode, p.pair()).max, 0) << mode.name;
        p.cpu = false;
        const double fraction = 16 * 0x1p-23,
                     expected = mode.error_kind == ErrorKind::relative   ? fraction
                                : mode.error_kind == ErrorKind::absolute ? 0.5 * fraction
                                : isAngle(mode.error_kind)
                                    ? std::sqrt(3.0) * fraction * 180 / std::numbers::pi
                                    : 0;
        EXPECT_DOUBLE_EQ(derivedTolerance(mode, p.pair()).max, expected) << mode.name;
    }
}

// Only with a pre-pass does forward+ shade with the stored depth. Only on a GPU may it differ from a
// fragment's depth.
TEST(Tolerance, ADepthThatWasNotStoredIsNamedOnAGpu) {
    for (const bool cpu : {true, false})
        for (const Switch prepass : {Switch::on, Switch::off, Switch::automatic})
            for (const Channel mode : {Channel::depth, Channel::position, Channel::albedo}) {
                OnePixelPair p;
                p.cpu = cpu;
                p.encoding(GBufferEncoding::full);
                p.forward.settings.prepass = prepass;
                const bool named = p.of(mode).because.find("the fragment's own depth") != std::string::npos;
                EXPECT_EQ(named, !cpu && prepass != Switch::on && mode != Channel::albedo)
                    << cpu << nameOf(prepass) << debugMode(mode).name;
            }
}

// lit: only changes that the encoding's bits can cause are tolerated.
OnePixelPair litPair() {
    OnePixelPair p;
    p.forward.channels[Channel::lit] = Image(1, 1, 3, 1.0f);
    p.forward.through_gbuffer[Channel::lit] = p.deferred.channels[Channel::lit] = Image(1, 1, 3, 1.25f);
    return p;
}

TEST(Tolerance, LitIsGrantedWhatDecodedSurfacesChange) {
    const OnePixelPair p = litPair();
    // 0.25 of 1.25, with deferred as the baseline.
    EXPECT_NEAR(p.of(Channel::lit).max, 0.2, 1e-9);
    EXPECT_EQ(p.of(Channel::lit).because,
              "decoded surfaces change lit by up to 0.2 (mean 0.2): forward+ shades its own surfaces through "
              "the standard G-buffer's encoding; deferred must equal that bit for bit, and each surface "
              "channel must be within its bits");
    const FramePair turned{p.forward, p.deferred, p.needs, p.covered, true};
    EXPECT_NEAR(derivedTolerance(debugMode(Channel::lit), turned).max, 0.25, 1e-9)
        << "forward+ being the baseline";
    EXPECT_EQ(unexplainedPixels(debugMode(Channel::lit), p.pair()), 0u);
}

TEST(Tolerance, LitThatTheEncodingDoesNotExplainIsFound) {
    OnePixelPair p = litPair();
    // Closer to forward+ than the tolerance, yet different from the encoding's result.
    p.deferred.channels[Channel::lit].data[1] = std::nextafter(1.25f, 2.0f);
    EXPECT_EQ(unexplainedPixels(debugMode(Channel::lit), p.pair()), 1u);
    p.cpu = false;
    EXPECT_EQ(unexplainedPixels(debugMode(Channel::lit), p.pair()), 0u) << "16 ULP on a GPU";
    p.deferred.channels[Channel::lit].data[1] = 1.25f * (1 + 20 * 0x1p-23f);
    EXPECT_EQ(unexplainedPixels(debugMode(Channel::lit), p.pair()), 1u);
    EXPECT_EQ(encodingExplains(debugMode(Channel::lit), p.pair(), 0), false);
    EXPECT_EQ(encodingExplains(debugMode(Channel::lit), litPair().pair(), 0), true);
    EXPECT_EQ(encodingExplains(debugMode(Channel::albedo), p.pair(), 0), std::nullopt);
}

TEST(Tolerance, LitWithoutTheEncodedImageIsNotExcused) {
    OnePixelPair p = litPair();
    p.forward.through_gbuffer.clear();
    EXPECT_EQ(p.of(Channel::lit).max, 0);
    EXPECT_NE(p.of(Channel::lit).because.find("so it explains no difference"), std::string::npos);
    EXPECT_FALSE(unexplainedPixels(debugMode(Channel::lit), p.pair()).has_value());
    p = litPair();
    p.deferred.settings.gbuffer = GBufferEncoding::compact;
    EXPECT_EQ(p.of(Channel::lit).max, 0) << "another encoding explains nothing";
}

Report reportOf(const OnePixelPair& p) {
    Report report;
    report.device.type = p.cpu ? "cpu" : "discrete";
    report.frames = {p.deferred, p.forward};
    return report;
}
const ChannelDiff& channelOf(const Comparison& comparison, Channel wanted) {
    return *std::ranges::find_if(comparison.channels,
                                 [&](const ChannelDiff& c) { return c.mode->channel == wanted; });
}

TEST(Diff, EqualFramesPassAndForwardOnlyNeverCounts) {
    const OnePixelPair p;
    const Comparison c = compareFrames(reportOf(p), 0, 1, p.needs);
    EXPECT_TRUE(c.passed());
    EXPECT_EQ(c.channels.size(), debugModes().size());
    EXPECT_EQ(channelOf(c, Channel::texcoords).verdict, Verdict::forward_only);
    EXPECT_EQ(channelOf(c, Channel::shaded_samples).verdict, Verdict::deferred_only);
}

TEST(Diff, EveryChannelCanFail) {
    for (const DebugMode& mode : debugModes()) {
        if (mode.supported_by == SupportedBy::forward_only || mode.supported_by == SupportedBy::deferred_only)
            continue;
        OnePixelPair p;
        float& value = p.forward.channels[mode.channel].data[0];
        value = mode.error_kind == ErrorKind::exact ? value + 1 : -value;
        const Comparison c = compareFrames(reportOf(p), 0, 1, p.needs);
        EXPECT_FALSE(c.passed()) << mode.name;
        EXPECT_EQ(std::ranges::count(c.channels, Verdict::fail, &ChannelDiff::verdict), 1) << mode.name;
        EXPECT_FALSE(channelOf(c, mode.channel).reason.empty());

        OnePixelPair bad;
        bad.deferred.channels[mode.channel].data[0] = std::numeric_limits<float>::quiet_NaN();
        EXPECT_FALSE(compareFrames(reportOf(bad), 0, 1, bad.needs).passed()) << mode.name << ": NaN";
    }
}

TEST(Diff, TheUnexplainedFailsWithinTheTolerance) {
    OnePixelPair p = litPair();
    p.deferred.channels[Channel::lit].data = {1.2f, 1.2f, 1.2f};
    const Comparison c = compareFrames(reportOf(p), 0, 1, p.needs);
    const ChannelDiff& lit = channelOf(c, Channel::lit);
    EXPECT_LT(lit.stats.max, lit.tolerance.max);
    EXPECT_EQ(lit.unexplained_pixels, 1u);
    EXPECT_EQ(lit.verdict, Verdict::fail);
    EXPECT_NE(lit.reason.find("the encoding does not explain the difference at 1 pixel (100 %)"),
              std::string::npos)
        << lit.reason;
}

TEST(Diff, AFrameThatItsCaptureDoesNotReproduceFails) {
    OnePixelPair p;
    p.forward.counters.unreproduced_pixels = 1;
    const Comparison c = compareFrames(reportOf(p), 0, 1, p.needs);
    EXPECT_FALSE(c.passed());
    ASSERT_EQ(c.failures.size(), 1u);
    EXPECT_NE(c.failures[0].find("forward_plus"), std::string::npos);
}

TEST(Diff, NonFiniteLitFailsThoughBothAgree) {
    OnePixelPair p;
    for (Frame* frame : {&p.deferred, &p.forward}) {
        frame->channels[Channel::lit].data[0] = std::numeric_limits<float>::infinity();
        frame->counters.nonfinite_pixels = 1;
    }
    const Comparison c = compareFrames(reportOf(p), 0, 1, p.needs);
    EXPECT_FALSE(c.passed());
    EXPECT_EQ(c.failures.size(), 2u);
}

TEST(Diff, OtherSizesAndNoCommonChannelAreErrors) {
    OnePixelPair p;
    p.forward.settings.size.width = 7;
    EXPECT_THROW(compareFrames(reportOf(p), 0, 1, p.needs), std::runtime_error);
    OnePixelPair q;
    q.deferred.channels.clear();
    EXPECT_THROW(compareFrames(reportOf(q), 0, 1, q.needs), std::runtime_error);
}

TEST(Diff, TheBaselineIsOnTheLeft) {
    for (const Path baseline : {Path::deferred, Path::forward_plus}) {
        const OnePixelPair p;
        const Report report = makeReport({{{p.forward, p.deferred}, p.needs}}, {},
                                         {.baseline = baseline, .rules = {}, .selection = {}, .words = {}});
        ASSERT_EQ(report.comparisons.size(), 1u);
        EXPECT_EQ(report.baseline(report.comparisons[0]).settings.path, baseline);
    }
}

}  // namespace
}  // namespace diptych
