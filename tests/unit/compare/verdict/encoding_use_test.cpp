// SPDX-License-Identifier: MIT
// Surface channels are evaluated by the encoding's error bound at each pixel, and lit by the surface
// channels.
#include "compare/verdict/encoding_use.h"

#include "compare/verdict/encoding_bits.h"
#include "compare/verdict/tolerance.h"
#include "shared/contract/gbuffer.h"
#include "tests/support/report_builder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

namespace diptych::tests {
namespace {

constexpr GBufferEncoding packedEncoding = GBufferEncoding::standard;

// bothFrames() with a packed G-buffer that stores all fields.
struct PackedPair {
    PackedPair() {
        for (Frame& frame : frames) frame.settings.gbuffer = packedEncoding;
        needs.emission = needs.lightmap = needs.dielectric_specular = true;
        needs.surface_layers = gpu::LAYER_CLEARCOAT | gpu::LAYER_ANISOTROPY | gpu::LAYER_SHEEN |
                               gpu::LAYER_IRIDESCENCE | gpu::LAYER_DIFFUSE_TRANSMISSION;
        needs.max_emission = needs.min_emission = needs.max_lightmap = 1;
    }
    float* read(Channel mode) { return &frames[0].channels.at(mode).at(1, 2); }
    float* own(Channel mode) { return &frames[1].channels.at(mode).at(1, 2); }
    std::optional<BoundUse> use(Channel mode, double slack = 0) const {
        const Coverage covered = coverage(frames[0], frames[1]);
        return encodingUse(debugMode(mode), FramePair{frames[0], frames[1], needs, covered}, slack);
    }
    Report report(const std::vector<Channel>& requested = {}, const CompareOptions& options = {}) const {
        std::vector<Frame> drawn = frames;
        for (Frame& frame : drawn) frame.requested = requested;
        return makeReport({{drawn, needs}}, {"a CPU", "1.0", "cpu"}, options);
    }

    std::vector<Frame> frames = bothFrames();
    Requirements needs;
};

TEST(EncodingUse, IsTheErrorOverTheBoundOfTheValue) {
    PackedPair p;
    *p.own(Channel::roughness) = 0.5f;
    *p.read(Channel::roughness) = 0.5f + 0.75f * 0.5f / 4095;
    EXPECT_NEAR(p.use(Channel::roughness)->used, 0.75, 1e-2);
    EXPECT_EQ(p.use(Channel::roughness)->beyond, 0u);
    EXPECT_EQ(p.use(Channel::roughness)->x, 1);
    EXPECT_EQ(p.use(Channel::roughness)->y, 2);
    *p.read(Channel::roughness) = 0.5f + 1.5f * 0.5f / 4095;
    EXPECT_EQ(p.use(Channel::roughness)->beyond, 1u);
    EXPECT_EQ(p.use(Channel::roughness, 0.5 / 4095)->beyond, 0u) << "slack is granted beside it";

    // A dark albedo has a narrow bound, a bright one a wide one. The largest utilization counts.
    const double h = 0.5 / 255;
    for (const double x : {0.01, 0.25, 0.81}) {
        const double bound = h * (2 * std::sqrt(x) + h);
        for (int c = 0; c < 3; ++c) p.read(Channel::albedo)[c] = p.own(Channel::albedo)[c] = 0.9f;
        p.own(Channel::albedo)[1] = static_cast<float>(x);
        p.read(Channel::albedo)[1] = static_cast<float>(x + 0.9 * bound);
        EXPECT_NEAR(p.use(Channel::albedo)->used, 0.9, 0.01) << x;
        p.read(Channel::albedo)[1] = static_cast<float>(x + 1.1 * bound);
        EXPECT_EQ(p.use(Channel::albedo)->beyond, 1u) << x;
    }
    // Both ends have exact codes.
    for (const float end : {0.0f, 1.0f}) {
        *p.own(Channel::metallic) = end;
        *p.read(Channel::metallic) = end == 0 ? 1e-5f : 1 - 1e-5f;
        EXPECT_EQ(p.use(Channel::metallic)->beyond, 1u) << end;
    }
    // Radiance is bounded relative to its largest component, or by the smallest step.
    for (const float size : {1e-6f, 3.0f}) {
        const auto [relative, min] = radianceBound(gpu::EMISSION_MANTISSA_BITS);
        const double bound = std::max(size * relative, min);
        for (const double fraction : {0.9, 1.1}) {
            for (int c = 0; c < 3; ++c)
                p.read(Channel::emission)[c] = p.own(Channel::emission)[c] = c == 2 ? size : 0;
            p.read(Channel::emission)[0] = static_cast<float>(fraction * bound);
            EXPECT_EQ(p.use(Channel::emission)->beyond, fraction > 1 ? 1u : 0u) << size << " " << fraction;
        }
    }
    // Directions are compared by angle.
    const double angle = octahedralBound(gpu::STANDARD_NORMAL_BITS) / 180 * std::numbers::pi;
    for (const Channel mode : {Channel::normals, Channel::geometric_normal, Channel::clearcoat_normal})
        for (const double fraction : {0.9, 1.1}) {
            float *n = p.own(mode), *m = p.read(mode);
            n[0] = 1, n[1] = n[2] = 0;
            m[0] = static_cast<float>(std::cos(fraction * angle)), m[1] = 0;
            m[2] = static_cast<float>(std::sin(fraction * angle));
            EXPECT_EQ(p.use(mode)->beyond, fraction > 1 ? 1u : 0u) << fraction;
        }
}

// A step of (n - 1) / (n + 1) changes a large index more; a half's rounding is relative; a sheen's colour is
// stored as an albedo is.
TEST(EncodingUse, LayersAreEvaluatedAtTheirValue) {
    struct Row {
        Channel mode;
        int component;
        std::vector<double> values;
        std::function<double(double)> bound;
    };
    constexpr double h = 0.5 / 255;
    const Row rows[] = {
        {Channel::iridescence_ior, 0, {1.0, 1.3, 2.5}, [](double n) { return (n + 1) * (n + 1) / 4 / 510; }},
        {Channel::iridescence_thickness,
         0,
         {1e-6, 0.5, 400.0},
         [](double t) { return std::max(t * 0x1p-11, 0x1p-25); }},
        {Channel::sheen_color, 2, {0.01, 0.81}, [](double x) { return h * (2 * std::sqrt(x) + h); }}};
    for (const Row& row : rows)
        for (const double value : row.values)
            for (const double fraction : {0.9, 1.1}) {
                PackedPair p;
                p.own(row.mode)[row.component] = static_cast<float>(value);
                p.read(row.mode)[row.component] = static_cast<float>(value + fraction * row.bound(value));
                EXPECT_EQ(p.use(row.mode)->beyond, fraction > 1 ? 1u : 0u)
                    << debugMode(row.mode).name << " " << value << " " << fraction;
            }
}

// A line's decoded direction may have either sign.
TEST(EncodingUse, ALineIsEvaluatedWithoutItsSign) {
    PackedPair p;
    const double angle =
        lineBound(gpu::ANISOTROPY_ANGLE_BITS, gpu::STANDARD_NORMAL_BITS) / 180 * std::numbers::pi;
    float *d = p.own(Channel::anisotropy_direction), *e = p.read(Channel::anisotropy_direction);
    d[0] = 1, d[1] = d[2] = 0;
    for (const float sign : {1.0f, -1.0f})
        for (const double fraction : {0.9, 1.1}) {
            e[0] = sign * static_cast<float>(std::cos(fraction * angle)), e[1] = 0;
            e[2] = sign * static_cast<float>(std::sin(fraction * angle));
            EXPECT_EQ(p.use(Channel::anisotropy_direction)->beyond, fraction > 1 ? 1u : 0u)
                << sign << fraction;
        }
    EXPECT_TRUE(p.report({Channel::anisotropy}).passed());
}

// Where a layer is absent, exactly 0 is stored.
TEST(EncodingUse, AnAbsentLayerIsExactlyZero) {
    for (const Channel mode :
         {Channel::clearcoat, Channel::clearcoat_roughness, Channel::clearcoat_normal, Channel::anisotropy,
          Channel::anisotropy_direction, Channel::sheen_color, Channel::sheen_roughness, Channel::iridescence,
          Channel::iridescence_ior, Channel::iridescence_thickness, Channel::diffuse_transmission,
          Channel::diffuse_transmission_color}) {
        PackedPair p;
        for (int c = 0; c < debugMode(mode).width; ++c) p.own(mode)[c] = p.read(mode)[c] = 0;
        EXPECT_EQ(p.use(mode)->beyond, 0u) << debugMode(mode).name;
        *p.read(mode) = 1e-6f;
        EXPECT_EQ(p.use(mode)->beyond, 1u) << debugMode(mode).name;
    }
}

// Frames of scenes without a layer lack its channels.
TEST(EncodingUse, AChannelThatAPathLacksIsNotEvaluated) {
    const std::vector<Channel> lit{Channel::lit};
    for (const bool both : {false, true}) {
        PackedPair p;
        p.frames[0].channels.erase(Channel::clearcoat);
        if (both) p.frames[1].channels.erase(Channel::clearcoat);
        EXPECT_FALSE(p.use(Channel::clearcoat)) << both;
        EXPECT_TRUE(p.report(lit).passed()) << both;
    }
}

// A decoded direction of another length points the same way, yet scales light.
TEST(EncodingUse, LayersDirectionsHaveUnitLengthOrNone) {
    for (const Channel mode : {Channel::clearcoat_normal, Channel::anisotropy_direction}) {
        PackedPair p;
        const std::vector<Channel> requested{mode};
        EXPECT_TRUE(p.report(requested).passed()) << debugMode(mode).name;
        for (int c = 0; c < 3; ++c) p.read(mode)[c] *= 0.5f;
        EXPECT_FALSE(p.report(requested).passed()) << debugMode(mode).name;
        for (int c = 0; c < 3; ++c) p.own(mode)[c] = p.read(mode)[c] = 0;
        EXPECT_TRUE(p.report(requested).passed()) << debugMode(mode).name << ": absent";
    }
}

TEST(EncodingUse, ANanIsBeyondEveryBound) {
    for (const Channel mode :
         {Channel::albedo, Channel::normals, Channel::roughness, Channel::emission,
          Channel::anisotropy_direction, Channel::iridescence_ior, Channel::iridescence_thickness}) {
        for (const bool own : {false, true}) {
            PackedPair p;
            *(own ? p.own(mode) : p.read(mode)) = std::numeric_limits<float>::quiet_NaN();
            EXPECT_EQ(p.use(mode)->beyond, 1u) << debugMode(mode).name << " " << own;
        }
    }
}

TEST(EncodingUse, OnlyStoredFieldsHaveBounds) {
    PackedPair p;
    for (const Channel mode : {Channel::lit, Channel::position, Channel::material_id, Channel::lightmapped,
                               Channel::specular, Channel::transmission, Channel::transmission_thickness})
        EXPECT_FALSE(p.use(mode)) << debugMode(mode).name;
    p.needs = {};
    for (const Channel mode :
         {Channel::emission, Channel::lightmap, Channel::dielectric_f0, Channel::dielectric_f90,
          Channel::clearcoat, Channel::clearcoat_normal, Channel::anisotropy_direction, Channel::sheen_color,
          Channel::iridescence_ior, Channel::iridescence_thickness, Channel::diffuse_transmission,
          Channel::diffuse_transmission_color})
        EXPECT_FALSE(p.use(mode)) << "nothing is stored of " << debugMode(mode).name;
    EXPECT_TRUE(p.use(Channel::albedo));
    for (Frame& frame : p.frames) frame.settings.gbuffer = GBufferEncoding::full;
    EXPECT_FALSE(p.use(Channel::albedo)) << "float32 is compared as it is";
}

// With MSAA a fault at one sample alone counts, also in fields that are stored exactly.
TEST(EncodingUse, EverySampleIsEvaluated) {
    for (const Channel mode : lightingFields()) {
        PackedPair p;
        for (Frame& frame : p.frames)
            frame.further_samples[mode] = {frame.channels.at(mode), frame.channels.at(mode)};
        const auto field = mode;
        ASSERT_TRUE(p.use(field)) << debugMode(mode).name;
        EXPECT_EQ(p.use(field)->beyond, 0u) << debugMode(mode).name;
        float& value = p.frames[0].further_samples.at(mode)[1].at(1, 2);
        value += isAngle(debugMode(mode).error_kind) ? 0.01f : 0.1f;
        EXPECT_EQ(p.use(field)->beyond, 1u) << debugMode(mode).name;
        EXPECT_EQ(p.use(field, 1)->beyond, 0u) << debugMode(mode).name << ": slack is granted";
        p.frames[0].further_samples.at(mode).pop_back();
        EXPECT_FALSE(p.use(field) && p.use(field)->beyond > 0) << "samples of other numbers cannot be paired";
    }
}

// lit depends on the surface fields. They are evaluated with it and shown if they fail; without light they
// are only evaluated if compared themselves.
TEST(EncodingUse, LitIsEvaluatedWithItsFields) {
    const std::vector<Channel> lit{Channel::lit};
    PackedPair sound;
    EXPECT_TRUE(sound.report(lit).passed());
    EXPECT_EQ(sound.report(lit).comparisons[0].channels.size(), 1u) << "what passes is not shown";
    for (const Channel mode : lightingFields()) {
        PackedPair p;
        float* const value = p.read(mode);
        value[0] += isAngle(debugMode(mode).error_kind) ? 0.01f : 0.1f;
        const Report report = p.report(lit);
        EXPECT_FALSE(report.passed()) << debugMode(mode).name;
        ASSERT_EQ(report.comparisons[0].channels.size(), 2u) << debugMode(mode).name;
        EXPECT_EQ(report.comparisons[0].channels[1].mode->channel, mode);
        EXPECT_EQ(report.comparisons[0].channels[1].verdict, Verdict::fail);
        CompareOptions ruled;
        ruled.rules =
            rulesFromJson(R"({"rules": [{"channel": "lit", "max": 9, "because": "so"}]})", "t.json");
        EXPECT_TRUE(p.report(lit, ruled).passed()) << "a rule judges lit by itself";
        const std::vector<Channel> other{Channel::depth};
        EXPECT_TRUE(p.report(other).passed()) << "nobody judges light";
    }
}

// Against a reference that shaded the decoded surfaces, and against one without them, where forward+ did.
TEST(EncodingUse, AgainstTheReferenceDecodedSurfacesAreShaded) {
    const DebugMode& lit = debugMode(Channel::lit);
    for (const bool traced : {false, true}) {
        PackedPair p;
        Frame &deferred = p.frames[0], &forward = p.frames[1], reference = forward;
        reference.settings.path = Path::reference;
        deferred.channels.at(lit.channel).at(1, 2) = 0.6f;
        Frame& shows = traced ? forward : reference;
        forward.through_gbuffer.clear();
        reference.through_gbuffer.clear();
        shows.through_gbuffer[lit.channel] = shows.channels.at(lit.channel);
        shows.through_gbuffer.at(lit.channel).at(1, 2) += 0.1f;
        const Coverage covered = coverage(reference, deferred);
        for (const bool turned : {false, true}) {
            const FramePair pair{
                turned ? deferred : reference, turned ? reference : deferred, p.needs, covered, true,
                traced ? &forward : nullptr};
            EXPECT_EQ(encodingFrame(lit, pair), &shows);
            ASSERT_TRUE(certainErrors(lit, pair));
            EXPECT_NEAR(certainErrors(lit, pair)->at(0), 0, 1e-6);
            deferred.channels.at(lit.channel).at(1, 2) = 0.61f;
            EXPECT_GT(certainErrors(lit, pair)->at(0), 0.01) << "it grants itself nothing";
            deferred.channels.at(lit.channel).at(1, 2) = 0.6f;
        }
        const FramePair none{reference, forward, p.needs, covered, true, &forward};
        EXPECT_EQ(encodingFrame(lit, none), nullptr) << "forward+ encodes nothing";
    }
}

}  // namespace
}  // namespace diptych::tests
