// SPDX-License-Identifier: MIT
// The stored table of linearly transformed cosines, compared with the BRDF lobe it approximates.
#include "shared/light/ltc.h"
#include "shared/contract/constants.h"
#include "shared/light/fit/fit.h"
#include "tests/support/layer_formulas.h"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace diptych::ltc {
namespace {

constexpr std::size_t last = gpu::LTC_CELLS - 1;
// Smallest, common and largest roughness, from normal incidence to grazing.
constexpr std::array<std::pair<std::size_t, std::size_t>, 8> some{
    {{0, 0}, {0, 40}, {13, 5}, {13, 31}, {30, 10}, {30, 50}, {last, 20}, {last, last}}};

// Both lobes of a cell: the fitted lobe, its integral, and the fit.
struct Fitted {
    Lobe lobe;
    double all;
    LtcLobe fit;

    Transform transform() const { return transformOf(fit, lobe.alpha(), lobe.nDotV()); }
    double error(const Transform& t) const { return distance(lobe, all, t, 96); }
};
std::array<Fitted, 2> bothLobes(std::size_t i, std::size_t j) {
    constexpr double f0{gpu::LTC_LAYER_F0};
    const LtcCell& cell = ltcTable().cell(i, j);
    return {{{lobeOf(i, j), cell.reflected(1, 1), cell.even},
             {lobeOf(i, j, f0), cell.reflected(f0, 1), cell.layer}}};
}

// Integrates over the hemisphere with other directions than the fit: rings of the polar angle.
template <class F>
double hemisphere(const F& f) {
    constexpr int rings = 800, sectors = 800;
    static const auto around = [] {
        std::array<glm::dvec2, sectors> all{};
        for (int j = 0; j < sectors; ++j) {
            const double phi = 2 * std::numbers::pi * (j + 0.5) / sectors;
            all[static_cast<std::size_t>(j)] = {std::cos(phi), std::sin(phi)};
        }
        return all;
    }();
    double sum = 0;
    for (int i = 0; i < rings; ++i) {
        const double z = (i + 0.5) / rings, s = std::sqrt(1 - z * z);
        for (const glm::dvec2& at : around) sum += f(glm::dvec3(s * at, z));
    }
    return sum * 2 * std::numbers::pi / (rings * sectors);
}

TEST(Ltc, EveryCellIsInItsRange) {
    const LtcTable& table = ltcTable();
    ASSERT_EQ(table.cells.size(), std::size_t{gpu::LTC_CELLS} * gpu::LTC_CELLS);
    for (const LtcCell& cell : table.cells) {
        for (const LtcLobe& l : {cell.even, cell.layer}) {
            EXPECT_TRUE(l.in_plane > 0.1f && l.in_plane < 1.7f) << l.in_plane;
            EXPECT_TRUE(l.across > 0.1f && l.across < 1.2f) << l.across;
            EXPECT_TRUE(l.unsheared > -0.2f && l.unsheared < 1.2f) << l.unsheared;
            EXPECT_TRUE(l.tilt > -0.1f && l.tilt < 0.7f) << l.tilt;
            EXPECT_TRUE(l.error >= 0 && l.error < 0.71f) << l.error;
        }
        EXPECT_TRUE(cell.magnitude > 0.3f && cell.magnitude <= 1.0001f) << cell.magnitude;
        EXPECT_TRUE(cell.fresnel >= 0 && cell.fresnel < cell.magnitude) << cell.fresnel;
    }
}

// The stored error is that of the stored fit. Stored magnitude and Fresnel terms are the lobe's, by
// another quadrature for lobes wide enough for rings. Directions are sampled by the lobe without F, so a
// layer's error is known to half a percent.
TEST(Ltc, StoredMetricsAreTheLobes) {
    for (const auto& [i, j] : some)
        for (const Fitted& f : bothLobes(i, j)) {
            const Transform t = f.transform();
            EXPECT_NEAR(double{f.fit.error}, f.error(t), 1e-6) << i << " " << j;
            if (f.lobe.alpha() < 0.2 || f.lobe.nDotV() < 0.02) continue;
            const double all = hemisphere([&](const glm::dvec3& l) { return f.lobe(l).lobe; });
            EXPECT_NEAR(f.all, all, 1e-3) << i << " " << j;
            EXPECT_NEAR(double{f.fit.error}, hemisphere([&](const glm::dvec3& l) {
                            return std::abs(f.lobe(l).lobe / all - t.density(l));
                        }),
                        5e-3)
                << i << " " << j;
        }
}

TEST(Ltc, MagnitudeIsTheKnownDirectionalAlbedo) {
    for (const auto& [roughness, albedo] : whiteAlbedos)
        EXPECT_NEAR(double{ltcTable().at(roughness, 1.0).magnitude}, albedo, roughness < 1 ? 2e-4 : 1e-4);
}

TEST(Ltc, ATransformedCosineIsADensity) {
    for (const auto& [i, j] : some)
        for (const Fitted& f : bothLobes(i, j)) {
            if (f.lobe.alpha() < 0.2) continue;  // too few rings for narrower lobes
            const Transform t = f.transform();
            EXPECT_NEAR(hemisphere([&](const glm::dvec3& l) { return t.density(l); }), 1, 2e-3)
                << i << " " << j;
            EXPECT_NEAR(hemisphere([&](const glm::dvec3& l) { return t.upright(l); }), 1, 2e-3)
                << i << " " << j;
            EXPECT_EQ(t.density({0.6, 0, -0.8}), 0) << "the horizon stays where it is";
        }
}

// A tilted cosine is negative near the horizon behind the lobe, but only slightly.
TEST(Ltc, WhatTheTiltMakesNegativeIsLittle) {
    for (const auto& [i, j] : some)
        for (const Fitted& f : bothLobes(i, j)) {
            Transform plain;  // M does not change the integral
            plain.tilt = double{f.fit.tilt};
            EXPECT_GT(hemisphere([&](const glm::dvec3& l) { return std::min(plain.density(l), 0.0); }),
                      -0.035)
                << i << " " << j;
        }
}

// Fitting a cell again from distant starting values improves it by at most 1 %: the stored fit is a
// minimum for the current lobe.
TEST(Ltc, AFitComesToTheStoredCell) {
    for (const auto& [i, j] : {std::pair<std::size_t, std::size_t>{13, 31}, {30, 10}, {last, 20}}) {
        const LtcCell& stored = ltcTable().cell(i, j);
        LtcCell start = stored;
        for (LtcLobe* l : {&start.even, &start.layer})
            l->in_plane *= 0.8f, l->across *= 1.2f, l->unsheared += 0.1f, l->tilt -= 0.1f;
        const LtcCell again = fitCell(i, j, start);
        for (const auto& [a, b] : {std::pair{again.even, stored.even}, {again.layer, stored.layer}}) {
            EXPECT_NEAR(double{a.error}, double{b.error}, 0.01 * double{b.error}) << i << " " << j;
            EXPECT_NEAR(a.in_plane, b.in_plane, 0.03f) << i << " " << j;
            EXPECT_NEAR(a.across, b.across, 0.02f) << i << " " << j;
            EXPECT_NEAR(a.tilt, b.tilt, 0.03f) << i << " " << j;
        }
        EXPECT_NEAR(again.magnitude, stored.magnitude, 1e-6f) << i << " " << j;
    }
}

// Changing one of the first three numbers by 5 %, or the tilt by 0.02, increases the error.
TEST(Ltc, AChangedCellIsWorse) {
    for (const auto& [i, j] : {std::pair<std::size_t, std::size_t>{0, 40}, {13, 31}, {30, 10}})
        for (const Fitted& f : bothLobes(i, j)) {
            const Transform t = f.transform();
            const double min{f.fit.error};
            for (const double sign : {-1.0, 1.0}) {
                const double factor = 1 + 0.05 * sign;
                EXPECT_GT(f.error({t.a * factor, t.b, t.c, t.tilt}), min) << i << " " << j;
                EXPECT_GT(f.error({t.a, t.b * factor, t.c, t.tilt}), min) << i << " " << j;
                EXPECT_GT(f.error({t.a, t.b, t.c * factor, t.tilt}), min) << i << " " << j;
                EXPECT_GT(f.error({t.a, t.b, t.c, t.tilt + 0.02 * sign}), min) << i << " " << j;
            }
        }
}

// Interpolates by F0's share of the reflected light. A metal has the even lobe, an F0 below a layer's has
// the layer's lobe, and mixes are monotonic in between.
TEST(Ltc, AMixLiesBetweenBothLobes) {
    const LtcCell cell = ltcTable().at(0.5, 0.3);
    EXPECT_EQ(cell.lobe(1, 1).in_plane, cell.even.in_plane);
    EXPECT_EQ(cell.lobe(0.3, 0.3).tilt, cell.even.tilt);
    EXPECT_EQ(cell.lobe(double{gpu::LTC_LAYER_F0}, 1).in_plane, cell.layer.in_plane);
    EXPECT_EQ(cell.lobe(0.02, 1).in_plane, cell.layer.in_plane);
    EXPECT_EQ(cell.lobe(0, 0).in_plane, cell.layer.in_plane) << "nothing is reflected: no matter";
    float before = 0;
    for (const double f0 : {0.1, 0.3, 0.6, 0.9}) {
        const float part =
            (cell.lobe(f0, 1).in_plane - cell.layer.in_plane) / (cell.even.in_plane - cell.layer.in_plane);
        EXPECT_GT(part, before) << f0;
        before = part;
    }
    EXPECT_LT(before, 1);
}

TEST(Ltc, LookingUpIsBilinearAndStaysInside) {
    const LtcTable& table = ltcTable();
    const auto roughness = [](double x) {
        return std::lerp(double{gpu::MIN_PERCEPTUAL_ROUGHNESS}, 1.0, x / last);
    };
    const auto cosine = [](double y) { return std::pow(1 - y / last, 2); };
    EXPECT_NEAR(table.at(roughness(20), cosine(30)).even.in_plane, table.cell(20, 30).even.in_plane, 1e-6f);
    EXPECT_NEAR(table.at(roughness(20.5), cosine(30)).layer.across,
                0.5f * (table.cell(20, 30).layer.across + table.cell(21, 30).layer.across), 1e-6f);
    EXPECT_NEAR(table.at(roughness(20), cosine(30.5)).fresnel,
                0.5f * (table.cell(20, 30).fresnel + table.cell(20, 31).fresnel), 1e-6f);
    EXPECT_EQ(table.at(2, 2).magnitude, table.cell(last, 0).magnitude);
    EXPECT_EQ(table.at(-1, -1).magnitude, table.cell(0, last).magnitude);
}

TEST(Ltc, TexelsHoldTheTableInHalves) {
    const std::vector<std::uint64_t> texels = ltcTexels(ltcTable());
    ASSERT_EQ(texels.size(), gpu::LTC_BLOCKS * ltcTable().cells.size());
    LtcTable one;
    one.cells.resize(1);
    one.cells[0] = {.even = {.in_plane = 1, .across = 0.5f, .unsheared = 0, .tilt = 2, .error = 9},
                    .layer = {.in_plane = 0.25f, .across = 1, .unsheared = 1, .tilt = 0, .error = 9},
                    .magnitude = 2,
                    .fresnel = 0.25f};
    EXPECT_EQ(ltcTexels(one),
              (std::vector<std::uint64_t>{0x4000'0000'3800'3c00, 0x3c00'3c00'3400, 0x3400'4000}));
}

}  // namespace
}  // namespace diptych::ltc
