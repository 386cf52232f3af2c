// SPDX-License-Identifier: MIT
// The stored table of linearly transformed cosines against the BRDF lobe that it approximates.
#include "shared/light/ltc.h"
#include "shared/contract/constants.h"
#include "shared/light/fit/fit.h"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace diptych::ltc {
namespace {

constexpr std::size_t last = gpu::LTC_CELLS - 1;
// The smoothest, common and roughest roughnesses, from normal incidence to grazing.
constexpr std::array<std::pair<std::size_t, std::size_t>, 8> some{
    {{0, 0}, {0, 40}, {13, 5}, {13, 31}, {30, 10}, {30, 50}, {last, 20}, {last, last}}};

double errorOf(const Lobe& lobe, const LtcCell& cell, const Transform& t) {
    return distance(lobe, double{cell.magnitude}, t, 96);
}
Transform transformOf(const Lobe& lobe, const LtcCell& cell) {
    return ltc::transformOf(cell, lobe.alpha(), lobe.nDotV());
}

// Integrates over the hemisphere by other directions than the fit: rings of the polar angle.
template <class F>
double hemisphere(const F& f) {
    constexpr int rings = 800, sectors = 800;
    double sum = 0;
    for (int i = 0; i < rings; ++i)
        for (int j = 0; j < sectors; ++j) {
            const double z = (i + 0.5) / rings, s = std::sqrt(1 - z * z),
                         phi = 2 * std::numbers::pi * (j + 0.5) / sectors;
            sum += f(glm::dvec3(s * std::cos(phi), s * std::sin(phi), z));
        }
    return sum * 2 * std::numbers::pi / (rings * sectors);
}

TEST(Ltc, EveryCellIsInItsRange) {
    const LtcTable& table = ltcTable();
    ASSERT_EQ(table.cells.size(), std::size_t{gpu::LTC_CELLS} * gpu::LTC_CELLS);
    for (const LtcCell& cell : table.cells) {
        EXPECT_TRUE(cell.in_plane > 0.1f && cell.in_plane < 1.2f) << cell.in_plane;
        EXPECT_TRUE(cell.across > 0.1f && cell.across < 1.2f) << cell.across;
        EXPECT_TRUE(cell.unsheared > -0.1f && cell.unsheared < 1.1f) << cell.unsheared;
        EXPECT_TRUE(cell.magnitude > 0.3f && cell.magnitude <= 1.0001f) << cell.magnitude;
        EXPECT_TRUE(cell.fresnel >= 0 && cell.fresnel < cell.magnitude) << cell.fresnel;
        EXPECT_TRUE(cell.error >= 0 && cell.error < 0.71f) << cell.error;
    }
}

// The stored error is that of the stored fit, and the stored magnitude and Fresnel terms are those of the
// lobe, computed by another quadrature, for lobes wide enough for rings.
TEST(Ltc, StoredFiguresAreTheLobes) {
    for (const auto& [i, j] : some) {
        const Lobe lobe = lobeOf(i, j);
        const LtcCell& cell = ltcTable().cell(i, j);
        const Transform t = transformOf(lobe, cell);
        EXPECT_NEAR(double{cell.error}, errorOf(lobe, cell, t), 1e-6) << i << " " << j;
        if (lobe.alpha() < 0.2 || lobe.nDotV() < 0.02) continue;
        const double magnitude = hemisphere([&](const glm::dvec3& l) { return lobe(l).lobe; });
        EXPECT_NEAR(double{cell.magnitude}, magnitude, 1e-3) << i << " " << j;
        EXPECT_NEAR(double{cell.fresnel},
                    hemisphere([&](const glm::dvec3& l) { return lobe(l).lobe * lobe(l).schlick; }), 1e-3)
            << i << " " << j;
        EXPECT_NEAR(double{cell.error}, hemisphere([&](const glm::dvec3& l) {
                        return std::abs(lobe(l).lobe / magnitude - t.density(l));
                    }),
                    3e-3)
            << i << " " << j;
    }
}

// Directional albedo at normal incidence with F = 1, as in the shader's BRDF.
TEST(Ltc, MagnitudeIsTheKnownDirectionalAlbedo) {
    EXPECT_NEAR(double{ltcTable().at(1.0, 1.0).magnitude}, 0.3069, 1e-4);
    EXPECT_NEAR(double{ltcTable().at(0.5, 1.0).magnitude}, 0.9158, 2e-4);
}

TEST(Ltc, ATransformedCosineIsADensity) {
    for (const auto& [i, j] : some) {
        const Lobe lobe = lobeOf(i, j);
        if (lobe.alpha() < 0.2) continue;  // too few rings for narrower lobes
        const Transform t = transformOf(lobe, ltcTable().cell(i, j));
        EXPECT_NEAR(hemisphere([&](const glm::dvec3& l) { return t.density(l); }), 1, 2e-3) << i << " " << j;
        EXPECT_EQ(t.density({0.6, 0, -0.8}), 0) << "the horizon stays where it is";
    }
}

// Fitting a cell again from distant starting values improves it by no more than a hundredth: the stored one
// is a minimum, for the current lobe.
TEST(Ltc, AFitComesToTheStoredCell) {
    for (const auto& [i, j] : {std::pair<std::size_t, std::size_t>{13, 31}, {30, 10}, {last, 20}}) {
        const LtcCell& stored = ltcTable().cell(i, j);
        LtcCell start = stored;
        start.in_plane *= 0.8f, start.across *= 1.2f, start.unsheared += 0.1f;
        const LtcCell again = fitCell(lobeOf(i, j), start);
        EXPECT_NEAR(double{again.error}, double{stored.error}, 0.01 * double{stored.error}) << i << " " << j;
        EXPECT_NEAR(again.in_plane, stored.in_plane, 0.02f) << i << " " << j;
        EXPECT_NEAR(again.across, stored.across, 0.02f) << i << " " << j;
        EXPECT_NEAR(again.magnitude, stored.magnitude, 1e-6f) << i << " " << j;
    }
}

// Changing any of the three numbers by a twentieth increases the error.
TEST(Ltc, AChangedCellIsWorse) {
    for (const auto& [i, j] : {std::pair<std::size_t, std::size_t>{0, 40}, {13, 31}, {30, 10}}) {
        const Lobe lobe = lobeOf(i, j);
        const LtcCell& cell = ltcTable().cell(i, j);
        const Transform t = transformOf(lobe, cell);
        for (const double factor : {0.95, 1.05}) {
            EXPECT_GT(errorOf(lobe, cell, {t.a * factor, t.b, t.c}), double{cell.error}) << i << " " << j;
            EXPECT_GT(errorOf(lobe, cell, {t.a, t.b * factor, t.c}), double{cell.error}) << i << " " << j;
            EXPECT_GT(errorOf(lobe, cell, {t.a, t.b, t.c * factor}), double{cell.error}) << i << " " << j;
        }
    }
}

TEST(Ltc, LookingUpIsBilinearAndStaysInside) {
    const LtcTable& table = ltcTable();
    const auto roughness = [](double x) {
        return std::lerp(double{gpu::MIN_PERCEPTUAL_ROUGHNESS}, 1.0, x / last);
    };
    const auto cosine = [](double y) { return std::pow(1 - y / last, 2); };
    EXPECT_NEAR(table.at(roughness(20), cosine(30)).in_plane, table.cell(20, 30).in_plane, 1e-6f);
    EXPECT_NEAR(table.at(roughness(20.5), cosine(30)).across,
                0.5f * (table.cell(20, 30).across + table.cell(21, 30).across), 1e-6f);
    EXPECT_NEAR(table.at(roughness(20), cosine(30.5)).fresnel,
                0.5f * (table.cell(20, 30).fresnel + table.cell(20, 31).fresnel), 1e-6f);
    EXPECT_EQ(table.at(2, 2).magnitude, table.cell(last, 0).magnitude);
    EXPECT_EQ(table.at(-1, -1).magnitude, table.cell(0, last).magnitude);
}

TEST(Ltc, TexelsHoldTheTableInHalves) {
    const std::vector<std::uint64_t> texels = ltcTexels(ltcTable());
    ASSERT_EQ(texels.size(), 2 * ltcTable().cells.size());
    LtcTable one;
    one.cells.resize(1);
    one.cells[0] = {
        .in_plane = 1, .across = 0.5f, .unsheared = 0, .magnitude = 2, .fresnel = 0.25f, .error = 9};
    EXPECT_EQ(ltcTexels(one), (std::vector<std::uint64_t>{0x4000'0000'3800'3c00, 0x3400}));
}

}  // namespace
}  // namespace diptych::ltc
