// SPDX-License-Identifier: MIT
// The predicted limits of arithmetic, as formulas of number formats.
#include "compare/audit/audit.h"
#include "compare/audit/quantities.h"
#include "tests/support/light_kinds.h"

#include <gtest/gtest.h>

#include <glm/trigonometric.hpp>

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace diptych::audit {

namespace {

constexpr double never = Predicted::never;
constexpr double largestFloat = std::numeric_limits<float>::max(),
                 smallestFloat = std::numeric_limits<float>::min();

const Quantity& quantityNamed(const std::string& name) {
    return *quantitiesOf(std::array{name}).front();
}

Predicted predictionOf(const std::string& name, const Subject& subject, double error = 1e-3) {
    return quantityNamed(name).predict(subject, subject.original.settings, error);
}

// The eye at the origin sees a surface 8 m away, in the middle of a scene with a radius of 6 m. No lights.
Subject seenFromOrigin() {
    Subject subject;
    subject.bounds = {{-2, -4, -12}, {2, 4, -4}};
    subject.has_surface = true;
    subject.point = {0, 0, -8};
    subject.normal = {0, 0, 1};
    subject.nearest = 4;
    subject.original.scene.cameras.push_back(subject.view.camera);
    return subject;
}

Light shining(LightKind kind, float intensity, const glm::dvec3& position = {}) {
    Light light;
    light.kind = kind;
    light.intensity = intensity;
    light.position = position;
    return light;
}

void expectNever(const Predicted& predicted) {
    EXPECT_EQ(predicted.up, never);
    EXPECT_EQ(predicted.down, 0);
    EXPECT_FALSE(predicted.at_most);
}

}  // namespace

// Doubles have 53 bits: at the predicted offset, their step is the allowed part of the viewing distance.
TEST(AuditPredictions, AnOffsetTakesBitsFromTheViewingDistance) {
    Subject subject = seenFromOrigin();
    for (const double error : {1e-3, 1e-2})
        for (const bool surface : {true, false}) {
            subject.has_surface = surface;
            const Predicted predicted = predictionOf("offset", subject, error);
            EXPECT_DOUBLE_EQ(predicted.up * 0x1p-53, error * (surface ? 8 : 6));
            EXPECT_EQ(predicted.down, 0);
            EXPECT_FALSE(predicted.at_most);
            EXPECT_EQ(predicted.because,
                      "positions relative to the camera are computed in double, with 53 bits for the offset");
        }
}

// Candela scale with the square of lengths. Neither the dimmest candela nor the squared viewing distance may
// fall below float32; coordinates end at maxCoordinate.
TEST(AuditPredictions, AScaleEndsWithCandelaOrSquaredLengths) {
    Subject subject = seenFromOrigin();
    std::vector<Light>& lights = subject.original.scene.lights;
    const auto down = [&] { return predictionOf("scale", subject).down; };
    EXPECT_DOUBLE_EQ(down() * down() * 8 * 8, 0x1p-126) << "without lights";
    subject.has_surface = false;
    EXPECT_DOUBLE_EQ(down() * down() * 6 * 6, 0x1p-126) << "the scene's radius, if no surface is in view";
    // These are not in candela, or dark at any scale.
    for (const LightKind kind : everyLightKind())
        lights.push_back(
            shining(kind, kind == LightKind::point || kind == LightKind::spot ? 0.0f : 0x1p-10f));
    EXPECT_DOUBLE_EQ(down() * down() * 6 * 6, 0x1p-126);
    lights.push_back(shining(LightKind::spot, 0x1p-3f));
    EXPECT_DOUBLE_EQ(down() * down() * 0x1p-3, smallestFloat);
    lights.push_back(shining(LightKind::point, 0x1p-4f));
    EXPECT_DOUBLE_EQ(down() * down() * 0x1p-4, smallestFloat);
    lights.push_back(shining(LightKind::spot, 8));
    const Predicted predicted = predictionOf("scale", subject);
    EXPECT_DOUBLE_EQ(predicted.down * predicted.down * 0x1p-4, smallestFloat);
    EXPECT_DOUBLE_EQ(predicted.up * 6, maxCoordinate);
    EXPECT_FALSE(predicted.at_most);
    EXPECT_EQ(predicted.because,
              "squared lengths and candela are float32, 1e-38 to 3e38, and candela grow with the square of "
              "the factor");
}

// Depth z = f / (f - n) (1 - n / d), or 1 minus that, of a surface at distance d. At the predicted ratio, an
// error of the format moves the farthest surface by the error that the criterion allows; less, if light from
// a lamp nearby changes more.
TEST(AuditPredictions, ANearPlaneLeavesOneStepOfDepth) {
    const Quantity& near = quantityNamed("near");
    Subject subject = seenFromOrigin();
    std::vector<Light>& lights = subject.original.scene.lights;
    const double distance = 8, d = 8 + 6;
    Case changed = subject.original;
    struct Row {
        DepthFormat format;
        double step;
        const char* because;
    };
    for (const double far : {never, 3 * d})
        for (const double lamp_at : {never, 4 * distance, distance / 5}) {  // from the surface
            subject.view.camera.far = far;
            lights.clear();
            if (std::isfinite(lamp_at))
                lights.push_back(shining(LightKind::point, 1, subject.point + glm::dvec3(0, lamp_at, 0)));
            for (const auto& [format, step, because] :
                 {Row{DepthFormat::d32f_standard, 0x1p-24,
                      "depth is stored near 1 at any distance, with two rounding errors of 24 bits"},
                  Row{DepthFormat::d24, 0.5 * 0x1p-24, "depth has a rounding error of half a 24-bit step"},
                  Row{DepthFormat::d16, 0.5 / 65535, "depth has a rounding error of half a 16-bit step"}})
                for (const double error : {1e-3, 1e-2}) {
                    Settings settings;
                    settings.depth_format = format;
                    const Predicted predicted = near.predict(subject, settings, error);
                    near.apply(changed, subject, predicted.up);
                    const double n = changed.camera().near, f = changed.camera().far,
                                 z = f / (f - n) * (1 - n / d) + step,
                                 moved = n / (1 - z * (f - n) / f) / d - 1;
                    EXPECT_NEAR(moved, lamp_at < distance ? error / 10 : error, 0.02 * error)
                        << nameOf(format) << ", far " << far << ", lamp at " << lamp_at;
                    EXPECT_DOUBLE_EQ(f / n, predicted.up);
                    EXPECT_EQ(predicted.down, 0);
                    EXPECT_FALSE(predicted.at_most);
                    EXPECT_EQ(predicted.because, because);
                }
        }
    Settings reversed;
    reversed.depth_format = DepthFormat::d32f;
    const Predicted predicted = near.predict(subject, reversed, 1e-3);
    expectNever(predicted);
    EXPECT_EQ(predicted.because,
              "reversed float32 depth has 24 bits wherever the planes are, and one division turns it into a "
              "position");
}

// A picture of this angle is as wide as the rounding error of a vertex, seen along the surface: the picture
// grows by 1 / sin of the grazing angle, as far as 100.
TEST(AuditPredictions, AFieldOfViewEndsAtTheStepOfAVertex) {
    Subject subject = seenFromOrigin();
    struct Row {
        double grazing;  // degrees
        double longer;
    };
    for (const auto& [grazing, longer] :
         {Row{90, 1}, Row{30, 2}, Row{1, 57.2987}, Row{0.5, 100}, Row{0, 100}})
        for (const double side : {1, -1}) {
            const double angle = glm::radians(grazing);
            subject.normal = {std::cos(angle), 0, side * std::sin(angle)};
            const Predicted predicted = predictionOf("fov", subject);
            EXPECT_NEAR(glm::radians(predicted.down) / longer, 0x1p-24, 1e-5 * 0x1p-24) << grazing;
            EXPECT_EQ(predicted.up, never);
            EXPECT_FALSE(predicted.at_most);
            EXPECT_EQ(predicted.because,
                      "a vertex is accurate to 2^-24 of its distance: at that angle the whole picture is no "
                      "larger");
        }
    subject.has_surface = false;
    EXPECT_DOUBLE_EQ(glm::radians(predictionOf("fov", subject).down), 0x1p-24);
}

// The brightest light stays ten binary orders below the end of float32 (2^128), and the dimmest as far above
// its smallest normal number.
TEST(AuditPredictions, LightsMayHaveTheRangeOfFloats) {
    Subject subject = seenFromOrigin();
    std::vector<Light>& lights = subject.original.scene.lights;
    const char* because = "light is float32 from its source to the picture: 1e-38 to 3e38";
    for (const bool black : {false, true}) {
        if (black) lights.push_back(shining(LightKind::point, 0));
        const Predicted none = predictionOf("intensity", subject);
        expectNever(none);
        EXPECT_EQ(none.because, because);
    }
    for (const LightKind kind : everyLightKind()) {
        lights.resize(1);
        for (const float intensity : {0.5f, 32.0f, 0.125f, 4.0f}) lights.push_back(shining(kind, intensity));
        const Predicted predicted = predictionOf("intensity", subject);
        EXPECT_DOUBLE_EQ(predicted.up * 32 * 0x1p10, 0x1p128) << nameOf(kind);
        EXPECT_DOUBLE_EQ(predicted.down * 0.125, 0x1p10 * smallestFloat) << nameOf(kind);
        EXPECT_FALSE(predicted.at_most);
        EXPECT_EQ(predicted.because, because);
    }
}

// A position in float32 has an error of half a step, 2^-25 of the distance from the camera, which is the
// allowed part of the light's height. Any other light hides it.
TEST(AuditPredictions, ALightNearASurfaceHasTheErrorOfItsPosition) {
    const Subject subject = seenFromOrigin();
    const auto expectHeight = [](const Subject& lit, const char* other) {
        for (const double error : {1e-3, 1e-2}) {
            const Predicted predicted = predictionOf("distance", lit, error);
            EXPECT_DOUBLE_EQ(predicted.down * error, 8 * 0x1p-25) << other;
            EXPECT_EQ(predicted.up, never);
            EXPECT_FALSE(predicted.at_most);
            EXPECT_EQ(predicted.because,
                      "a light's position is float32 relative to the camera: its height above a surface has "
                      "an error of 2^-25 of their distance from the camera");
        }
    };
    expectHeight(subject, "none");
    Subject local = subject;
    for (const LightKind kind : everyLightKind())
        local.original.scene.lights.push_back(shining(kind, kind == LightKind::directional ? 0.0f : 1.0f));
    expectHeight(local, "local ones, and a black sun");
    std::array<Subject, 5> outshone;
    outshone.fill(local);
    outshone[0].original.scene.lights.push_back(shining(LightKind::directional, 1e-6f));
    outshone[1].original.scene.environment.emplace();
    outshone[2].original.settings.ambient.r = 1e-6f;
    outshone[3].original.settings.ambient.g = 1e-6f;
    outshone[4].original.settings.ambient.b = 1e-6f;
    for (const Subject& lit : outshone) {
        const Predicted predicted = predictionOf("distance", lit);
        expectNever(predicted);
        EXPECT_EQ(predicted.because,
                  "a light near a surface only lights an area as wide as its height, less than 1 % of the "
                  "picture; other light outshines it elsewhere");
    }
}

// The sum of the brightest pixel's components stays ten binary orders below the end of float32.
TEST(AuditPredictions, AnEnvironmentEndsWithItsBrightestPixel) {
    Subject subject = seenFromOrigin();
    Environment& environment = subject.original.scene.environment.emplace();
    environment.radiance = Image(2, 2, 3);
    const auto fill = [&](const std::array<float, 12>& values) {
        for (std::size_t i = 0; i < values.size(); ++i) environment.radiance.pixel(i / 3)[i % 3] = values[i];
    };
    // The largest component is of another pixel, and so are the largest sums of two components.
    for (const auto& values : {std::array<float, 12>{14, 0, 1, 3, 4, 9, 0, 7, 7, 8, 6, 0},
                               std::array<float, 12>{0, 7, 7, 15, 0, 0, 8, 7, 0, 8, 3, 5}}) {
        fill(values);
        const Predicted predicted = predictionOf("environment", subject);
        EXPECT_DOUBLE_EQ(predicted.up * 16 * 0x1p10, 0x1p128);
        EXPECT_EQ(predicted.down, 0);
        EXPECT_TRUE(predicted.at_most);
        EXPECT_EQ(
            predicted.because,
            "radiance is float32 from the environment to the picture, up to 3e38; maps and samples only "
            "approximate a single bright pixel, and their error depends on all other pixels");
    }
    fill({});
    EXPECT_EQ(predictionOf("environment", subject).up, never);
}

// Moments span 24 bits of the range that the caster lengthens; reversed depth spans the scene alone.
TEST(AuditPredictions, AFarCasterTakesBitsFromMoments) {
    Subject subject = seenFromOrigin();
    for (const EnumName<Shadows>& row : enum_names<Shadows>) {
        subject.original.settings.shadows = row.value;
        const Predicted predicted = predictionOf("shadow_depth", subject);
        const bool moments = row.name.find("vsm") != row.name.npos || row.name.find("msm") != row.name.npos;
        EXPECT_EQ(predicted.up, moments ? 6 * 0x1p24 : never) << row.name;
        EXPECT_EQ(predicted.down, 0);
        EXPECT_EQ(predicted.at_most, moments) << row.name;
        EXPECT_EQ(
            predicted.because,
            moments
                ? "moments use depths from 0 to 1, and float32 resolves 2^-24: a range of that many scene "
                  "radii makes the scene one depth; a moment filter may fail earlier"
                : "shadow-map depth is reversed: float32 is finest at the scene's far end, with steps "
                  "relative "
                  "to the scene's size wherever the range begins")
            << row.name;
    }
}

// Transmittance exp(-density * extinction * distance) of the nearest surface is float32's smallest normal
// number, in the component that haze dims least.
TEST(AuditPredictions, HazeEndsWhenTheNearestSurfaceIsBlack) {
    Subject subject = seenFromOrigin();
    Settings& settings = subject.original.settings;
    settings.haze_rayleigh = {0.25f, 0.125f, 0.5f};
    for (const Rgb& mie : {Rgb{0.125f, 0.75f, 0.5f}, Rgb{0.5f, 0.25f, 0.5f}, Rgb{0.75f, 0.5f, -0.125f}}) {
        settings.haze_mie = mie;
        const Predicted predicted = predictionOf("haze", subject);
        EXPECT_NEAR(predicted.up * 0.375 * 4, -std::log(smallestFloat), 0.5);
        EXPECT_EQ(predicted.down, 0);
        EXPECT_FALSE(predicted.at_most);
        EXPECT_EQ(
            predicted.because,
            "float32 transmittance is 0 beyond an optical depth of 87, which the nearest surface reaches "
            "there");
    }
    // No prediction: marching has an error of its own, and without a surface nothing is compared.
    settings.haze_march_steps = 1;
    EXPECT_EQ(predictionOf("haze", subject).because, "");
    settings.haze_march_steps = 0;
    subject.has_surface = false;
    EXPECT_EQ(predictionOf("haze", subject).because, "");
}

// N equal terms have a relative error of N 2^-26; N counts copies of the lights that reach the surface.
TEST(AuditPredictions, CopiesOfLightsAddTheirRounding) {
    Subject subject = seenFromOrigin();
    std::vector<Light>& lights = subject.original.scene.lights;
    const auto add = [&](LightKind kind, const glm::dvec3& from_surface, float range) {
        lights.push_back(shining(kind, 1, subject.point + from_surface));
        lights.back().range = range;
    };
    const auto expectReaching = [&](double reaching) {
        for (const double error : {1e-3, 1e-2}) {
            const Predicted predicted = predictionOf("lights", subject, error);
            EXPECT_DOUBLE_EQ(predicted.up * reaching * 0x1p-26, error);
            EXPECT_EQ(predicted.down, 0);
            EXPECT_FALSE(predicted.at_most);
            EXPECT_EQ(predicted.because,
                      "float32 sums one light after another: N equal terms have a relative error of N 2^-26");
        }
    };
    expectReaching(1);  // of none, the first copy
    add(LightKind::point, {0, 2, 0}, 2);
    add(LightKind::point, {0, 0, 7}, 3);  // near the eye
    add(LightKind::directional, {0, 0, 0}, 1);
    expectReaching(1);
    add(LightKind::point, {0, 2, 0}, 2.125f);
    expectReaching(1);
    double reaching = 1;
    for (const LightKind kind : everyLightKind()) {
        add(kind, {0, 0, 3}, 4);
        if (kind != LightKind::directional) ++reaching;
        expectReaching(reaching);
    }
}

// Limits that depend on no scene end where their formula leaves float32.
TEST(AuditPredictions, OtherLimitsAreTheEndOfFloats) {
    for (const Quantity& quantity : quantities()) {
        EXPECT_NE(quantity.predict == nullptr, quantity.because.empty()) << quantity.name;
        EXPECT_EQ(quantity.predicts_formats, quantity.name == "near") << quantity.name;
        const double limit = quantity.fails_at;
        if (quantity.name == "emission") {
            EXPECT_NEAR(limit / largestFloat, 1, 1e-3);
        } else if (quantity.name == "normal_map") {  // x^2 + y^2
            EXPECT_LE(2 * limit * limit, largestFloat);
            EXPECT_GT(2 * (2 * limit) * (2 * limit), largestFloat);
        } else if (quantity.name == "evsm_exponent") {  // exp(c)^2
            EXPECT_LE(std::exp(2 * limit), largestFloat);
            EXPECT_GT(std::exp(2 * (limit + 0.01)), largestFloat);
        } else {
            EXPECT_EQ(limit, never) << quantity.name;
        }
    }
}

// Predictions are of arithmetic alone: a format that rounds more makes its own error.
TEST(AuditPredictions, OnlyPreciseSeriesArePredicted) {
    Settings settings;
    for (const Path path : drawn_paths) {
        settings.path = path;
        settings.gbuffer = GBufferEncoding::full;
        EXPECT_TRUE(isPrecise(settings)) << nameOf(path);
        for (const GBufferEncoding packed : {GBufferEncoding::compact, GBufferEncoding::standard}) {
            settings.gbuffer = packed;
            EXPECT_EQ(isPrecise(settings), path == Path::forward_plus) << nameOf(path);
        }
        settings.gbuffer = GBufferEncoding::full;
        Settings rounding = settings;
        rounding.depth_format = DepthFormat::d32f_standard;
        EXPECT_FALSE(isPrecise(rounding));
        rounding = settings;
        rounding.lit_format = LitFormat::fp16;
        EXPECT_FALSE(isPrecise(rounding));
        rounding = settings;
        rounding.shading_precision = ShadingPrecision::fp16;
        EXPECT_FALSE(isPrecise(rounding));
    }
    Subject subject = seenFromOrigin();
    subject.original.settings.gbuffer = GBufferEncoding::compact;
    for (const char* name : {"offset", "near", "emission"}) {
        const Quantity& quantity = quantityNamed(name);
        const QuantityAudit audit =
            auditQuantity(quantity, subject, [](std::span<const Series> series, double magnitude) {
                Step step{magnitude, {}};
                step.outcomes.resize(series.size());
                return step;
            });
        for (std::size_t c = 0; c < audit.predicted.size(); ++c) {
            ASSERT_EQ(audit.predicted[c].size(), audit.series.size()) << name;
            for (std::size_t s = 0; s < audit.series.size(); ++s) {
                Settings applied = audit.series[s].applied(subject.original.settings);
                const Predicted& predicted = audit.predicted[c][s];
                const std::string what = std::string(name) + ", " + audit.series[s].describe();
                const DepthFormat format = applied.depth_format;
                if (quantity.predicts_formats) applied.depth_format = DepthFormat::d32f;
                EXPECT_EQ(predicted.because.empty(), !isPrecise(applied)) << what;
                if (predicted.because.empty()) {
                    expectNever(predicted);
                } else if (quantity.predict == nullptr) {
                    EXPECT_EQ(predicted.up, quantity.fails_at) << what;
                    EXPECT_EQ(predicted.because, quantity.because) << what;
                } else {
                    applied.depth_format = format;
                    EXPECT_EQ(predicted.up, quantity.predict(subject, applied, c == 0 ? 1e-3 : 1e-2).up)
                        << what;
                }
            }
        }
    }
}

}  // namespace diptych::audit
