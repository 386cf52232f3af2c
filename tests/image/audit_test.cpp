// SPDX-License-Identifier: MIT
// Both paths where they used to break: far from the origin, tiny, behind thick air. Errors are measured as
// in an audit.
#include "compare/audit/audit.h"
#include "compare/audit/quantities.h"
#include "tests/image/square.h"

#include <array>

namespace diptych::tests {
namespace {

using audit::Measurer;
using audit::Outcome;
using audit::Series;
using audit::Step;
using audit::Subject;

Subject auditedScene(const Scene& scene) {
    Settings settings;
    settings.size = {64, 36};
    settings.shadows = Shadows::off;
    settings.gbuffer = GBufferEncoding::full;
    return audit::makeSubject(scene, settings);
}

// The errors of both paths with float32 encodings.
std::vector<Outcome> errorsAt(Measurer& measurer, const std::string& name, double magnitude) {
    const audit::Quantity& quantity = *audit::quantitiesOf(std::array{name}).front();
    const std::array<Series, 2> both{Series{Path::deferred, {}}, Series{Path::forward_plus, {}}};
    const Step step = measurer.measure(quantity, both, magnitude);
    for (const Outcome& outcome : step.outcomes) {
        EXPECT_EQ(outcome.failed, "") << name << " " << magnitude;
        EXPECT_EQ(outcome.whole(audit::Measure::nonfinite_pixels), 0u) << name << " " << magnitude;
    }
    return step.outcomes;
}

void expectHolds(Measurer& measurer, const std::string& name, std::initializer_list<double> magnitudes) {
    // Float32 shading of the default scene is within 2e-5 of double (compare/reference/MEASURED.md). A
    // tenth of an audit's smallest criterion allows for GPUs, whose division and square roots are less
    // exact.
    constexpr double max = 1e-4;
    for (const double magnitude : magnitudes)
        for (const Outcome& outcome : errorsAt(measurer, name, magnitude)) {
            EXPECT_LE(outcome[audit::Measure::light_p99], max)
                << name << " " << magnitude << " worst at " << outcome.worst_x << "," << outcome.worst_y;
            EXPECT_LE(outcome[audit::Measure::depth_p99], max) << name << " " << magnitude;
            EXPECT_LE(outcome[audit::Measure::light_p999], 1e-2) << name << " " << magnitude;
        }
}

TEST(AuditImages, AnImageIsTheSameWhereverItsSceneIsAndHoweverLarge) {
    const Scene scene = makeBuiltin("spots");
    const Subject subject = auditedScene(scene);
    Measurer measurer(device(), subject, {});
    expectHolds(measurer, "offset", {0, 1e4, 1e8});
    expectHolds(measurer, "vertex", {1e3, 1e5, 1e7});
    expectHolds(measurer, "scale", {1e-6, 1, 1e6});
    expectHolds(measurer, "near", {1e3, 1e9});
    expectHolds(measurer, "fov", {0.01, 170});
    expectHolds(measurer, "grazing", {0.001});
    expectHolds(measurer, "intensity", {1e-12, 1e12});
    expectHolds(measurer, "scale", {1e-4, 1e5});
    expectHolds(measurer, "intensity", {1e-8, 1e9});
    expectHolds(measurer, "grazing", {0.01});
    expectHolds(measurer, "roughness", {0, 1e-3, 1});
}

// Approximations have errors of their own in the unstressed scene. At an extreme they exceed those by at
// most 1e-2.
TEST(AuditImages, WhatApproximatesIsNoWorseAtAnExtreme) {
    struct Row {
        const char* scene;
        std::vector<std::pair<const char*, const char*>> settings;
    };
    for (const Row& row : {Row{"areas", {}},
                           {"suns", {{"shadows", "evsm"}}},
                           {"spots", {{"shadows", "pcf"}, {"shadow-lights", "2"}}},
                           {"suns", {{"haze", "on"}, {"haze-density", "100"}}},
                           {"spheres", {{"env", "scene"}}},
                           {"glass", {}},
                           {"motion", {{"time", "0.4"}}},
                           {"spots", {{"msaa", "4"}}},
                           {"spots", {{"gbuffer", "compact"}}}}) {
        Scene scene = makeBuiltin(row.scene);
        Settings settings;
        settings.size = {48, 27};
        settings.shadows = Shadows::off;
        settings.gbuffer = GBufferEncoding::full;
        std::string what = row.scene;
        for (const auto& [option, value] : row.settings) {
            settings.set(option, value);
            what += std::string(" ") + option + " " + value;
        }
        if (settings.env == "scene") {
            // A sky with one brighter half and a small sun.
            Image sky(32, 16, 3, 0.3f);
            for (std::size_t i = 0; i < sky.pixels() / 2; ++i) sky.pixel(i)[2] = 1;
            for (int c = 0; c < 3; ++c) sky.pixel(32 * 4 + 9)[c] = 50;
            scene.environment = Environment{.name = "sky", .radiance = sky};
        }
        const Subject subject = audit::makeSubject(scene, settings);
        Measurer measurer(device(), subject, {});
        const std::vector<Outcome> rest = errorsAt(measurer, "scale", 1);
        // Not with vertices offset by 1e7 m in their mesh: float32 puts them on a grid of 1 m, another
        // scene.
        for (const auto& [name, magnitude] :
             {std::pair("offset", 1e7), {"scale", 1e-4}, {"scale", 1e5}, {"intensity", 1e9}}) {
            const std::vector<Outcome> changed = errorsAt(measurer, name, magnitude);
            for (std::size_t path = 0; path < 2; ++path)
                EXPECT_LE(changed[path][audit::Measure::light_p99],
                          rest[path][audit::Measure::light_p99] + 1e-2)
                    << what << ", " << name << " " << magnitude << ", path " << path << ": "
                    << rest[path][audit::Measure::light_p99] << " at rest";
        }
    }
}

// Measured until the paths' light underflows at optical depth 87, not where the reference once gave up.
TEST(AuditImages, ThickAirIsMeasuredUntilItsLightEnds) {
    const Scene scene = makeBuiltin("spots");
    const Subject subject = auditedScene(scene);
    ASSERT_TRUE(subject.has_surface);
    Measurer measurer(device(), subject, {});
    // For red, which the air attenuates least. The farthest point is twice as far, within float32's range.
    const double depth_35 = 35 / (2.58e-5 * subject.nearest);
    expectHolds(measurer, "haze", {depth_35});
}

// Squared lengths underflow float32; nothing may become NaN.
TEST(AuditImages, AScene30OrdersTooSmallIsLitByNumbers) {
    Scene scene = square();
    for (Node& node : scene.nodes) node.parent_from_node = glm::scale(glm::dmat4(1), glm::dvec3(1e-30));
    scene.cameras[0].world_from_camera[3] = {0, 0, 1e-30, 1};
    scene.cameras[0].near = 1e-32;
    Settings settings;
    settings.size = {64, 36};
    settings.gbuffer = GBufferEncoding::full;
    settings.ambient = {1, 1, 1};
    settings.haze = true;
    const Subject subject = audit::makeSubject(scene, settings);
    Measurer measurer(device(), subject, {});
    for (const Outcome& outcome : errorsAt(measurer, "exposure", 1))
        EXPECT_LE(outcome[audit::Measure::light_p99], 1e-2);
}

}  // namespace
}  // namespace diptych::tests
