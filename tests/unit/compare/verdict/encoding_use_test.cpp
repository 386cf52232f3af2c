// SPDX-License-Identifier: MIT
// Surface channels are judged by the encoding's error bound at each pixel, and lit by the surface
// channels.
#include "compare/verdict/encoding_use.h"

#include "compare/verdict/encoding_bits.h"
#include "compare/verdict/tolerance.h"
#include "shared/contract/gbuffer.h"
#include "tests/support/report_builder.h"

#include <gtest/gtest.h>

#include <cmath>
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
    float* read(gpu::uint mode) { return &frames[0].channels.at(static_cast<int>(mode)).at(1, 2); }
    float* own(gpu::uint mode) { return &frames[1].channels.at(static_cast<int>(mode)).at(1, 2); }
    std::optional<BoundUse> use(gpu::uint mode, double slack = 0) const {
        const Coverage covered = coverage(frames[0], frames[1]);
        return encodingUse(debugMode(static_cast<int>(mode)), FramePair{frames[0], frames[1], needs, covered},
                           slack);
    }
    Report report(const std::vector<int>& requested = {}, const CompareOptions& options = {}) const {
        std::vector<Frame> drawn = frames;
        for (Frame& frame : drawn) frame.requested = requested;
        return makeReport(drawn, {needs, needs}, {"a CPU", "1.0", "cpu"}, options);
    }

    std::vector<Frame> frames = bothFrames();
    Requirements needs;
};

TEST(EncodingUse, IsTheErrorOverTheBoundOfTheValue) {
    PackedPair p;
    *p.own(gpu::DEBUG_roughness) = 0.5f;
    *p.read(gpu::DEBUG_roughness) = 0.5f + 0.75f * 0.5f / 4095;
    EXPECT_NEAR(p.use(gpu::DEBUG_roughness)->used, 0.75, 1e-2);
    EXPECT_EQ(p.use(gpu::DEBUG_roughness)->beyond, 0u);
    EXPECT_EQ(p.use(gpu::DEBUG_roughness)->x, 1);
    EXPECT_EQ(p.use(gpu::DEBUG_roughness)->y, 2);
    *p.read(gpu::DEBUG_roughness) = 0.5f + 1.5f * 0.5f / 4095;
    EXPECT_EQ(p.use(gpu::DEBUG_roughness)->beyond, 1u);
    EXPECT_EQ(p.use(gpu::DEBUG_roughness, 0.5 / 4095)->beyond, 0u) << "slack is granted beside it";

    // A dark albedo has a narrow bound, a bright one a wide one. The largest utilization counts.
    const double h = 0.5 / 255;
    for (const double x : {0.01, 0.25, 0.81}) {
        const double bound = h * (2 * std::sqrt(x) + h);
        for (int c = 0; c < 3; ++c) p.read(gpu::DEBUG_albedo)[c] = p.own(gpu::DEBUG_albedo)[c] = 0.9f;
        p.own(gpu::DEBUG_albedo)[1] = static_cast<float>(x);
        p.read(gpu::DEBUG_albedo)[1] = static_cast<float>(x + 0.9 * bound);
        EXPECT_NEAR(p.use(gpu::DEBUG_albedo)->used, 0.9, 0.01) << x;
        p.read(gpu::DEBUG_albedo)[1] = static_cast<float>(x + 1.1 * bound);
        EXPECT_EQ(p.use(gpu::DEBUG_albedo)->beyond, 1u) << x;
    }
    // Both ends have exact codes.
    for (const float end : {0.0f, 1.0f}) {
        *p.own(gpu::DEBUG_metallic) = end;
        *p.read(gpu::DEBUG_metallic) = end == 0 ? 1e-5f : 1 - 1e-5f;
        EXPECT_EQ(p.use(gpu::DEBUG_metallic)->beyond, 1u) << end;
    }
    // Radiance is bounded relative to its largest component, or by the smallest step.
    for (const float size : {1e-6f, 3.0f}) {
        const double bound = std::max(size * radianceBound(), leastRadianceBound);
        for (const double share : {0.9, 1.1}) {
            for (int c = 0; c < 3; ++c)
                p.read(gpu::DEBUG_emission)[c] = p.own(gpu::DEBUG_emission)[c] = c == 2 ? size : 0;
            p.read(gpu::DEBUG_emission)[0] = static_cast<float>(share * bound);
            EXPECT_EQ(p.use(gpu::DEBUG_emission)->beyond, share > 1 ? 1u : 0u) << size << " " << share;
        }
    }
    // Directions are compared by angle.
    const double angle = octahedralBound(gpu::STANDARD_NORMAL_BITS) / 180 * std::numbers::pi;
    for (const gpu::uint mode :
         {gpu::DEBUG_normals, gpu::DEBUG_geometric_normal, gpu::DEBUG_clearcoat_normal})
        for (const double share : {0.9, 1.1}) {
            float *n = p.own(mode), *m = p.read(mode);
            n[0] = 1, n[1] = n[2] = 0;
            m[0] = static_cast<float>(std::cos(share * angle)), m[1] = 0;
            m[2] = static_cast<float>(std::sin(share * angle));
            EXPECT_EQ(p.use(mode)->beyond, share > 1 ? 1u : 0u) << share;
        }
}

// A step of (n - 1) / (n + 1) changes a large index more.
TEST(EncodingUse, AFilmsIndexIsJudgedAtItsValue) {
    for (const double n : {1.0, 1.3, 2.5}) {
        PackedPair p;
        const double bound = (n + 1) * (n + 1) / 2 * 0.5 / 510;
        *p.own(gpu::DEBUG_iridescence_ior) = static_cast<float>(n);
        for (const double share : {0.9, 1.1}) {
            *p.read(gpu::DEBUG_iridescence_ior) = static_cast<float>(n + share * bound);
            EXPECT_EQ(p.use(gpu::DEBUG_iridescence_ior)->beyond, share > 1 ? 1u : 0u) << n << " " << share;
        }
    }
}

TEST(EncodingUse, AFilmsThicknessIsJudgedRelativeToIt) {
    for (const double thickness : {1e-6, 0.5, 400.0}) {
        PackedPair p;
        const double bound = std::max(thickness * 0x1p-11, 0x1p-25);
        *p.own(gpu::DEBUG_iridescence_thickness) = static_cast<float>(thickness);
        for (const double share : {0.9, 1.1}) {
            *p.read(gpu::DEBUG_iridescence_thickness) = static_cast<float>(thickness + share * bound);
            EXPECT_EQ(p.use(gpu::DEBUG_iridescence_thickness)->beyond, share > 1 ? 1u : 0u)
                << thickness << " " << share;
        }
    }
}

// A sheen's colour is stored as an albedo is.
TEST(EncodingUse, ADarkSheenHasANarrowBound) {
    constexpr double h = 0.5 / 255;
    for (const double x : {0.01, 0.81}) {
        PackedPair p;
        const double bound = h * (2 * std::sqrt(x) + h);
        p.own(gpu::DEBUG_sheen_color)[2] = static_cast<float>(x);
        for (const double share : {0.9, 1.1}) {
            p.read(gpu::DEBUG_sheen_color)[2] = static_cast<float>(x + share * bound);
            EXPECT_EQ(p.use(gpu::DEBUG_sheen_color)->beyond, share > 1 ? 1u : 0u) << x << " " << share;
        }
    }
}

// A line's decoded direction may have either sign.
TEST(EncodingUse, ALineIsJudgedWithoutItsSign) {
    PackedPair p;
    const double angle =
        lineBound(gpu::ANISOTROPY_ANGLE_BITS, gpu::STANDARD_NORMAL_BITS) / 180 * std::numbers::pi;
    float *d = p.own(gpu::DEBUG_anisotropy_direction), *e = p.read(gpu::DEBUG_anisotropy_direction);
    d[0] = 1, d[1] = d[2] = 0;
    for (const float sign : {1.0f, -1.0f})
        for (const double share : {0.9, 1.1}) {
            e[0] = sign * static_cast<float>(std::cos(share * angle)), e[1] = 0;
            e[2] = sign * static_cast<float>(std::sin(share * angle));
            EXPECT_EQ(p.use(gpu::DEBUG_anisotropy_direction)->beyond, share > 1 ? 1u : 0u) << sign << share;
        }
    EXPECT_TRUE(p.report({static_cast<int>(gpu::DEBUG_anisotropy)}).passed());
}

// Where a layer is absent, exactly 0 is stored.
TEST(EncodingUse, AnAbsentLayerIsExactlyZero) {
    for (const gpu::uint mode :
         {gpu::DEBUG_clearcoat, gpu::DEBUG_clearcoat_roughness, gpu::DEBUG_clearcoat_normal,
          gpu::DEBUG_anisotropy, gpu::DEBUG_anisotropy_direction, gpu::DEBUG_sheen_color,
          gpu::DEBUG_sheen_roughness, gpu::DEBUG_iridescence, gpu::DEBUG_iridescence_ior,
          gpu::DEBUG_iridescence_thickness, gpu::DEBUG_diffuse_transmission,
          gpu::DEBUG_diffuse_transmission_color}) {
        PackedPair p;
        for (int c = 0; c < debugMode(static_cast<int>(mode)).width; ++c)
            p.own(mode)[c] = p.read(mode)[c] = 0;
        EXPECT_EQ(p.use(mode)->beyond, 0u) << mode;
        *p.read(mode) = 1e-6f;
        EXPECT_EQ(p.use(mode)->beyond, 1u) << mode;
    }
}

// Frames of scenes without a layer lack its channels.
TEST(EncodingUse, AChannelThatAPathLacksIsNotJudged) {
    const std::vector<int> lit{static_cast<int>(gpu::DEBUG_lit)};
    for (const bool both : {false, true}) {
        PackedPair p;
        p.frames[0].channels.erase(static_cast<int>(gpu::DEBUG_clearcoat));
        if (both) p.frames[1].channels.erase(static_cast<int>(gpu::DEBUG_clearcoat));
        EXPECT_FALSE(p.use(gpu::DEBUG_clearcoat)) << both;
        EXPECT_TRUE(p.report(lit).passed()) << both;
    }
}

// A decoded direction of another length points the same way, yet scales light.
TEST(EncodingUse, LayersDirectionsHaveUnitLengthOrNone) {
    for (const gpu::uint mode : {gpu::DEBUG_clearcoat_normal, gpu::DEBUG_anisotropy_direction}) {
        PackedPair p;
        const std::vector<int> requested{static_cast<int>(mode)};
        EXPECT_TRUE(p.report(requested).passed()) << mode;
        for (int c = 0; c < 3; ++c) p.read(mode)[c] *= 0.5f;
        EXPECT_FALSE(p.report(requested).passed()) << mode;
        for (int c = 0; c < 3; ++c) p.own(mode)[c] = p.read(mode)[c] = 0;
        EXPECT_TRUE(p.report(requested).passed()) << mode << ": absent";
    }
}

TEST(EncodingUse, ANanIsBeyondEveryBound) {
    for (const gpu::uint mode :
         {gpu::DEBUG_albedo, gpu::DEBUG_normals, gpu::DEBUG_roughness, gpu::DEBUG_emission,
          gpu::DEBUG_anisotropy_direction, gpu::DEBUG_iridescence_ior, gpu::DEBUG_iridescence_thickness}) {
        for (const bool own : {false, true}) {
            PackedPair p;
            *(own ? p.own(mode) : p.read(mode)) = std::numeric_limits<float>::quiet_NaN();
            EXPECT_EQ(p.use(mode)->beyond, 1u) << mode << " " << own;
        }
    }
}

TEST(EncodingUse, OnlyStoredFieldsHaveBounds) {
    PackedPair p;
    for (const gpu::uint mode :
         {gpu::DEBUG_lit, gpu::DEBUG_position, gpu::DEBUG_material_id, gpu::DEBUG_lightmapped,
          gpu::DEBUG_specular, gpu::DEBUG_transmission, gpu::DEBUG_transmission_thickness})
        EXPECT_FALSE(p.use(mode)) << mode;
    p.needs = {};
    for (const gpu::uint mode :
         {gpu::DEBUG_emission, gpu::DEBUG_lightmap, gpu::DEBUG_dielectric_f0, gpu::DEBUG_dielectric_f90,
          gpu::DEBUG_clearcoat, gpu::DEBUG_clearcoat_normal, gpu::DEBUG_anisotropy_direction,
          gpu::DEBUG_sheen_color, gpu::DEBUG_iridescence_ior, gpu::DEBUG_iridescence_thickness,
          gpu::DEBUG_diffuse_transmission, gpu::DEBUG_diffuse_transmission_color})
        EXPECT_FALSE(p.use(mode)) << "nothing is stored of " << mode;
    EXPECT_TRUE(p.use(gpu::DEBUG_albedo));
    for (Frame& frame : p.frames) frame.settings.gbuffer = GBufferEncoding::full;
    EXPECT_FALSE(p.use(gpu::DEBUG_albedo)) << "float32 is compared as it is";
}

// With MSAA a fault at one sample alone counts, also in fields that are stored exactly.
TEST(EncodingUse, EverySampleIsJudged) {
    for (const int mode : lightingFields()) {
        PackedPair p;
        for (Frame& frame : p.frames)
            frame.further_samples[mode] = {frame.channels.at(mode), frame.channels.at(mode)};
        const auto field = static_cast<gpu::uint>(mode);
        ASSERT_TRUE(p.use(field)) << debugMode(mode).name;
        EXPECT_EQ(p.use(field)->beyond, 0u) << debugMode(mode).name;
        float& value = p.frames[0].further_samples.at(mode)[1].at(1, 2);
        value += isAngle(debugMode(mode).metric) ? 0.01f : 0.1f;
        EXPECT_EQ(p.use(field)->beyond, 1u) << debugMode(mode).name;
        EXPECT_EQ(p.use(field, 1)->beyond, 0u) << debugMode(mode).name << ": slack is granted";
        p.frames[0].further_samples.at(mode).pop_back();
        EXPECT_FALSE(p.use(field) && p.use(field)->beyond > 0) << "samples of other numbers cannot be paired";
    }
}

// lit depends on the surface fields. They are judged with it and shown if they fail; without light they
// are only judged if compared themselves.
TEST(EncodingUse, LitIsJudgedWithItsFields) {
    const std::vector<int> lit{static_cast<int>(gpu::DEBUG_lit)};
    PackedPair sound;
    EXPECT_TRUE(sound.report(lit).passed());
    EXPECT_EQ(sound.report(lit).comparisons[0].channels.size(), 1u) << "what passes is not shown";
    for (const int mode : lightingFields()) {
        PackedPair p;
        float* const value = p.read(static_cast<gpu::uint>(mode));
        value[0] += isAngle(debugMode(mode).metric) ? 0.01f : 0.1f;
        const Report report = p.report(lit);
        EXPECT_FALSE(report.passed()) << debugMode(mode).name;
        ASSERT_EQ(report.comparisons[0].channels.size(), 2u) << debugMode(mode).name;
        EXPECT_EQ(report.comparisons[0].channels[1].mode->number, mode);
        EXPECT_EQ(report.comparisons[0].channels[1].verdict, Verdict::fail);
        CompareOptions ruled;
        ruled.rules =
            rulesFromJson(R"({"rules": [{"channel": "lit", "max": 9, "because": "so"}]})", "t.json");
        EXPECT_TRUE(p.report(lit, ruled).passed()) << "a rule judges lit by itself";
        const std::vector<int> other{static_cast<int>(gpu::DEBUG_depth)};
        EXPECT_TRUE(p.report(other).passed()) << "nobody judges light";
    }
}

// Against a reference that shaded the decoded surfaces, and against one without them, where forward+ did.
TEST(EncodingUse, AgainstTheReferenceDecodedSurfacesAreShaded) {
    const DebugMode& lit = debugMode(static_cast<int>(gpu::DEBUG_lit));
    for (const bool traced : {false, true}) {
        PackedPair p;
        Frame &deferred = p.frames[0], &forward = p.frames[1], reference = forward;
        reference.settings.path = Path::reference;
        deferred.channels.at(lit.number).at(1, 2) = 0.6f;
        Frame& shows = traced ? forward : reference;
        forward.through_gbuffer.clear();
        reference.through_gbuffer.clear();
        shows.through_gbuffer[lit.number] = shows.channels.at(lit.number);
        shows.through_gbuffer.at(lit.number).at(1, 2) += 0.1f;
        const Coverage covered = coverage(reference, deferred);
        for (const bool turned : {false, true}) {
            const FramePair pair{
                turned ? deferred : reference, turned ? reference : deferred, p.needs, covered, true,
                traced ? &forward : nullptr};
            EXPECT_EQ(encodingShownBy(lit, pair), &shows);
            ASSERT_TRUE(certainErrors(lit, pair));
            EXPECT_NEAR(certainErrors(lit, pair)->at(0), 0, 1e-6);
            deferred.channels.at(lit.number).at(1, 2) = 0.61f;
            EXPECT_GT(certainErrors(lit, pair)->at(0), 0.01) << "it grants itself nothing";
            deferred.channels.at(lit.number).at(1, 2) = 0.6f;
        }
        const FramePair none{reference, forward, p.needs, covered, true, &forward};
        EXPECT_EQ(encodingShownBy(lit, none), nullptr) << "forward+ encodes nothing";
    }
}

}  // namespace
}  // namespace diptych::tests
