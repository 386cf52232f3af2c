// SPDX-License-Identifier: MIT
// Error bounds of a sheen's and a film's channels, compared with their codes, reimplemented in double from
// the G-buffer's description.
#include "compare/verdict/encoding_bits.h"
#include "compare/verdict/tolerance.h"
#include "shared/contract/debug_mode.h"
#include "shared/contract/gbuffer.h"
#include "tests/support/layer_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace diptych {
namespace {

// Both paths' pixel, 0.5 in every channel of a layer.
struct LayerPair {
    Frame deferred, forward;
    Requirements needs;
    Coverage covered = everyPixel(1);

    LayerPair() {
        deferred.settings.path = Path::deferred;
        forward.settings.path = Path::forward_plus;
        for (const DebugMode& mode : debugModes())
            if (layerOf(mode.channel) != 0)
                for (Frame* frame : {&deferred, &forward})
                    frame->channels[mode.channel] = Image(1, 1, mode.width, 0.5f);
    }
    LayerPair& encoding(GBufferEncoding e) {
        deferred.settings.gbuffer = forward.settings.gbuffer = e;
        return *this;
    }
    void decoded(Channel mode, float value) { deferred.channels.at(mode).data[0] = value; }
    void own(Channel mode, float value) { forward.channels.at(mode).data[0] = value; }
    Tolerance of(Channel mode) const {
        return derivedTolerance(debugMode(mode), {deferred, forward, needs, covered, true});
    }
};

TEST(LayerTolerance, HalfStepsOfASheenAFilmsWeightAndDiffuseTransmission) {
    for (const GBufferEncoding e : {GBufferEncoding::compact, GBufferEncoding::standard}) {
        LayerPair p;
        p.encoding(e).needs.surface_layers =
            gpu::LAYER_SHEEN | gpu::LAYER_IRIDESCENCE | gpu::LAYER_DIFFUSE_TRANSMISSION;
        for (const Channel mode :
             {Channel::sheen_roughness, Channel::iridescence, Channel::diffuse_transmission})
            EXPECT_NEAR(p.of(mode).max, 0.5 / 255, 1e-6) << debugMode(mode).name;
        constexpr double h = 0.5 / 255;
        for (const Channel mode : {Channel::sheen_color, Channel::diffuse_transmission_color})
            EXPECT_NEAR(p.of(mode).max, 2 * h - h * h, 2e-6)
                << debugMode(mode).name << ": the root is stored";
    }
}

// (n - 1) / (n + 1) in 9 bits without code 0.
double throughIndexCode(double n) {
    const double code = 1 + std::floor((n - 1) / (n + 1) * 510 + 0.5), x = (code - 1) / 510;
    return (1 + x) / (1 - x);
}

TEST(LayerTolerance, IndexBoundHoldsAndIsTight) {
    for (const double first : {1.0, 1.3, 2.0, 5.0, 20.0}) {
        double worst = 0;
        for (int i = 0; i <= 100'000; ++i) {
            const double n = first * (1 + 0.2 * i / 1e5);
            worst =
                std::max(worst, std::abs(n - throughIndexCode(n)) / indexBound(n, gpu::IRIDESCENCE_IOR_BITS));
        }
        EXPECT_LE(worst, 1) << first;
        EXPECT_GE(worst, 0.99) << first << ": a bound that is never neared hides errors";
    }
}

// Half a step below x = 1 is the index 2039.
TEST(LayerTolerance, IndicesAtTheLastCodeHaveNoBound) {
    EXPECT_LT(indexBound(2030, gpu::IRIDESCENCE_IOR_BITS), std::numeric_limits<double>::infinity());
    EXPECT_EQ(indexBound(2040, gpu::IRIDESCENCE_IOR_BITS), std::numeric_limits<double>::infinity());
}

TEST(LayerTolerance, AnIndexIsGrantedTheBoundOfTheLargest) {
    LayerPair p;
    p.needs.surface_layers = gpu::LAYER_IRIDESCENCE;
    p.own(Channel::iridescence_ior, 1.5f);
    for (const float decoded : {1.5f, 40.0f}) {
        p.decoded(Channel::iridescence_ior, decoded);
        // dn = (n + 1)^2 / 2 dx
        EXPECT_NEAR(p.of(Channel::iridescence_ior).max, 6.25 / 2 * 0.5 / 510, 1e-5)
            << decoded << ": what was decoded grants itself nothing";
        const FramePair turned{p.forward, p.deferred, p.needs, p.covered, true};
        EXPECT_NEAR(derivedTolerance(debugMode(Channel::iridescence_ior), turned).max, 6.25 / 2 * 0.5 / 510,
                    1e-5);
    }
}

// 10 bits of mantissa, exponents from -14.
double throughHalf(double t) {
    const double step = std::ldexp(1.0, std::max(std::ilogb(t), -14) - 10);
    return std::floor(t / step + 0.5) * step;
}

TEST(LayerTolerance, AThicknessHoldsTheBoundOfAHalf) {
    const auto [relative, min] = halfBound(gpu::IRIDESCENCE_THICKNESS_BITS);
    for (const double first : {1e-7, 5e-5, 64.0, 400.0}) {
        double worst = 0;
        for (int i = 0; i <= 100'000; ++i) {
            const double t = first * (1 + i / 1e5);
            worst = std::max(worst, std::abs(t - throughHalf(t)) / std::max(t * relative, min));
        }
        EXPECT_LE(worst, 1) << first;
        EXPECT_GE(worst, 0.98) << first << ": a bound that is never neared hides errors";
    }
    LayerPair p;
    p.needs.surface_layers = gpu::LAYER_IRIDESCENCE;
    EXPECT_EQ(p.of(Channel::iridescence_thickness).max, 0x1p-11) << "relative to the thickness";
}

// A mean of 2^-16 nm gives a smallest denominator of 1e-3 of it, and half a step stays 2^-25 nm.
TEST(LayerTolerance, AThicknessBelowTheLastExponentIsStillBound) {
    LayerPair p;
    p.needs.surface_layers = gpu::LAYER_IRIDESCENCE;
    p.decoded(Channel::iridescence_thickness, 0x1p-16f);
    EXPECT_NEAR(p.of(Channel::iridescence_thickness).max, 0x1p-25 / (1e-3 * 0x1p-16), 1e-6);
    EXPECT_EQ(p.of(Channel::iridescence_thickness).because, "half of a half's smallest step, 2^-25");
}

TEST(LayerTolerance, AnAbsentLayerIsNotStored) {
    for (const TestedLayer& layer : testedLayers(~gpu::LAYER_TRANSMISSION))
        for (const Channel mode : layer.channels()) {
            LayerPair p;
            p.encoding(GBufferEncoding::compact).needs.surface_layers = layer.bit;
            EXPECT_GT(p.of(mode).max, 0) << debugMode(mode).name;
            p.needs.surface_layers = ~layer.bit;
            EXPECT_EQ(p.of(mode).max, 0) << debugMode(mode).name;
        }
}

TEST(LayerTolerance, ALayerOfGlassAloneIsNotStored) {
    LayerPair p;
    p.encoding(GBufferEncoding::compact).needs.surface_layers = gpu::LAYER_SHEEN;
    p.needs.layers = gpu::LAYER_SHEEN | gpu::LAYER_TRANSMISSION;
    EXPECT_GT(p.of(Channel::sheen_roughness).max, 0);
    EXPECT_EQ(p.of(Channel::transmission).max, 0);
    p.needs.surface_layers = 0;
    EXPECT_EQ(p.of(Channel::sheen_roughness).max, 0);
}

}  // namespace
}  // namespace diptych
