// SPDX-License-Identifier: MIT
// Ranges in which audited series pass, with known steps; and the stress parameters.
#include "compare/audit/audit.h"
#include "compare/audit/quantities.h"
#include "compare/audit/reduce.h"
#include "compare/audit/report.h"
#include "compare/audit/small_scene.h"
#include "compare/frames/frame_properties.h"
#include "compare/output/writers.h"
#include "shared/scene/load.h"
#include "tests/support/files.h"
#include "tests/support/plain_builtin.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

namespace diptych::audit {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Step stepOf(double magnitude, double error, double flip = 0, std::uint64_t nonfinite = 0) {
    Outcome outcome;
    outcome.measured[Measure::compared_pixels] = 1;
    outcome.measured[Measure::light_p99] = error;
    outcome.measured[Measure::depth_p99] = error / 2;
    outcome.measured[Measure::flip] = flip;
    outcome.measured[Measure::nonfinite_pixels] = static_cast<double>(nonfinite);
    return {magnitude, {outcome}};
}

const Quantity& quantityOf(const std::string& name) {
    return *quantitiesOf(std::array{name}).front();
}

// Audits as if the error were `error(magnitude)`.
QuantityAudit audited(const Quantity& quantity, const Subject& subject, double (*error)(double)) {
    return auditQuantity(quantity, subject, [&](std::span<const Series> series, double magnitude) {
        Step step = stepOf(magnitude, error(magnitude));
        step.outcomes.resize(series.size(), step.outcomes.front());
        return step;
    });
}

Subject gallery() {
    Settings settings;
    settings.size = {64, 36};
    settings.shadows = Shadows::off;
    return makeSubject(plainBuiltin("gallery"), settings);
}

}  // namespace

TEST(Audit, AnErrorIsTheLargerOneAndInfiniteWithoutNumbers) {
    EXPECT_EQ(stepOf(1, 0.25).outcomes.front().error(), 0.25);
    Outcome deep;
    deep.measured[Measure::light_p99] = 0.1;
    deep.measured[Measure::depth_p99] = 0.5;
    EXPECT_EQ(deep.error(), 0.5);
    EXPECT_EQ(stepOf(1, 0.25, 0, 1).outcomes.front().error(), infinity);
}

TEST(Audit, ASeriesHoldsAsFarAsItDidWithoutABreak) {
    const std::vector<Step> steps{stepOf(0.01, 1),  stepOf(0.1, 5e-3), stepOf(1, 1e-5),
                                  stepOf(10, 2e-3), stepOf(100, 1e-4), stepOf(1000, 0.5, 0.2, 3)};
    const auto ranges = validRangesOf(steps, 1, 1);
    const ValidRange& fine = ranges[0][0];
    EXPECT_TRUE(fine.at_original);
    EXPECT_TRUE(fine.up.broken);
    EXPECT_EQ(fine.up.last, 1);
    EXPECT_EQ(fine.up.first, 10);  // a second pass at 100 does not count
    EXPECT_EQ(fine.down.last, 1);
    EXPECT_EQ(fine.down.first, 0.1);
    const ValidRange& coarse = ranges[1][0];
    EXPECT_EQ(coarse.up.last, 100);
    EXPECT_EQ(coarse.down.last, 0.1);
    EXPECT_EQ(rangeText(coarse), "0.1 to 100");
    const ValidRange& visible = ranges[visibleCriterion][0];
    EXPECT_FALSE(visible.down.broken);
    EXPECT_EQ(rangeText(visible), "up to 100");
    EXPECT_TRUE(ranges[numberCriterion][0].up.broken);
    const auto bad = validRangesOf({stepOf(1, 1)}, 1, 1);
    EXPECT_FALSE(bad[0][0].at_original);
    EXPECT_EQ(rangeText(bad[0][0]), "nowhere");
    EXPECT_EQ(rangeText(validRangesOf({stepOf(1, 0)}, 1, 1)[0][0]), "whole range");
}

TEST(Audit, ALimitIsFoundBetweenTheSteps) {
    const Subject subject = gallery();
    const QuantityAudit audit =
        audited(quantityOf("intensity"), subject, [](double m) { return m < 3.3e7 ? 1e-6 : 1.0; });
    const BreakingPoint& point = audit.valid_ranges[0][0].up;
    EXPECT_TRUE(point.broken);
    EXPECT_LE(point.last, 3.3e7);
    EXPECT_GT(point.first, 3.29e7);
    EXPECT_LE(point.first / point.last, 1.25);
    EXPECT_FALSE(audit.valid_ranges[0][0].down.broken);
    EXPECT_LE(audit.steps.size(), quantityOf("intensity").magnitudes.size() + 17);
    EXPECT_TRUE(std::ranges::is_sorted(audit.steps, {}, &Step::magnitude));
    EXPECT_EQ(audited(quantityOf("offset"), subject, [](double) { return 1e-6; }).omitted,
              seriesOf(quantityOf("offset"), subject).omitted);
}

TEST(Audit, PredictionsAgreeWithinAFactorOfTwo) {
    const BreakingPoint at_100{.last = 99, .first = 101, .broken = true};
    EXPECT_TRUE(agrees(at_100, 190, true, 1e6));
    EXPECT_TRUE(agrees(at_100, 55, true, 1e6));
    EXPECT_FALSE(agrees(at_100, 250, true, 1e6));
    EXPECT_FALSE(agrees(at_100, Predicted::never, true, 1e6));
    const BreakingPoint unbroken{.last = 1e6};
    EXPECT_TRUE(agrees(unbroken, Predicted::never, true, 1e6));
    EXPECT_TRUE(agrees(unbroken, 6e5, true, 1e6));
    EXPECT_FALSE(agrees(unbroken, 1e5, true, 1e6));
    EXPECT_TRUE(agrees(unbroken, 0, false, 1e-6));
    EXPECT_FALSE(agrees(unbroken, 1e-3, false, 1e-6));
}

TEST(Audit, ARequirementIsOfBothPathsAndTheirBestSeries) {
    const Subject subject = gallery();
    QuantityAudit audit = audited(quantityOf("offset"), subject, [](double) { return 1e-6; });
    EXPECT_TRUE(evaluate(audit, 1e8).met);
    EXPECT_FALSE(evaluate(audit, 1e9).met) << "beyond what was tried nothing is known";
    std::vector<ValidRange>& ranges = audit.valid_ranges[requiredCriterion];
    for (std::size_t s = 0; s < audit.series.size(); ++s)
        if (audit.series[s].path == Path::deferred && audit.series[s].changes.empty())
            ranges[s].at_original = false;
    EXPECT_TRUE(evaluate(audit, 1e6).met) << "with a G-buffer of float32 it does";
    for (std::size_t s = 0; s < audit.series.size(); ++s)
        if (audit.series[s].path == Path::forward_plus)
            ranges[s].up = {.last = 1e5, .first = 2e5, .broken = true};
    const Requirement requirement = evaluate(audit, 1e6);
    EXPECT_FALSE(requirement.met);
    EXPECT_NE(requirement.because.find("forward_plus: the error stays below 1e-2 as far as 1e+05"),
              std::string::npos)
        << requirement.because;
}

// A path that fails on the unchanged scene meets no requirement, in either direction.
TEST(Audit, WhatDoesNotHoldAtAllMeetsNoRequirement) {
    const Subject subject = gallery();
    const QuantityAudit audit = audited(quantityOf("scale"), subject, [](double) { return 0.5; });
    for (const double magnitude : {1e-3, 1.0, 1e3}) {
        const Requirement requirement = evaluate(audit, magnitude);
        EXPECT_FALSE(requirement.met) << magnitude;
        EXPECT_NE(requirement.because.find("the unchanged scene already has an error of 1e-2 or more"),
                  std::string::npos)
            << requirement.because;
    }
}

TEST(Audit, NothingInViewMeetsNothing) {
    const Subject subject = gallery();
    QuantityAudit audit = audited(quantityOf("offset"), subject, [](double) { return 0.0; });
    for (Step& step : audit.steps) step.outcomes.front().measured[Measure::compared_pixels] = 0;
    const Requirement requirement = evaluate(audit, 1e3);
    EXPECT_FALSE(requirement.met);
    EXPECT_EQ(requirement.because, "no surface is in view");
}

TEST(Audit, WhatADeviceRefusesIsNoFailure) {
    std::vector<Step> steps{stepOf(1, 1e-6), stepOf(10, 1e-6), stepOf(100, infinity)};
    steps.back().outcomes.front().failed = "--size 99999x9: draws up to 16384x16384";
    for (const auto& of : validRangesOf(steps, 1, 1)) {
        EXPECT_TRUE(of[0].at_original);
        EXPECT_FALSE(of[0].up.broken);
        EXPECT_EQ(of[0].up.last, 10);
    }
}

// Settings that draw the same image, or none, are not a series, and the audit reports them.
TEST(Audit, WhatIsLeftOutOfTheSeriesIsSaid) {
    const ChosenSeries offset = seriesOf(quantityOf("offset"), gallery());
    ASSERT_EQ(offset.series.size(), 3u);
    ASSERT_EQ(offset.omitted.size(), 1u);
    EXPECT_EQ(offset.omitted[0], "forward_plus, gbuffer full draws the same as forward_plus");
    Settings settings;
    settings.shadows = Shadows::evsm;
    settings.evsm_exponent = 1000;
    ASSERT_TRUE(settings.problem());
    const ChosenSeries refused =
        chosenOf({{Path::deferred, {{"shadows", "evsm"}}}}, [&](const Series&) { return settings; });
    EXPECT_TRUE(refused.series.empty());
    EXPECT_EQ(refused.omitted.at(0), "deferred, shadows evsm: " + *settings.problem());
    QuantityAudit audit;
    audit.quantity = &quantityOf("offset");
    audit.steps.emplace_back();
    audit.omitted = offset.omitted;
    EXPECT_NE(output::inText(blocksOf(audit)).find(offset.omitted[0]), std::string::npos);
}

// A bound is not a prediction of the breaking point. A failure below the bound neither agrees nor
// disagrees; a pass beyond it refutes the bound.
TEST(Audit, ABoundIsRefutedByWhatHoldsBeyondIt) {
    QuantityAudit audit;
    for (const double magnitude : {1.0, 1e6}) audit.steps.emplace_back().magnitude = magnitude;
    for (std::vector<ValidRange>& ranges : audit.valid_ranges) ranges.resize(1);
    ValidRange& range = audit.valid_ranges[0][0];
    range = {true, {100, 1000, true}, {1, 0, false}};
    audit.predicted[0] = {{.up = 1e4, .because = "it ends there", .at_most = true}};
    EXPECT_EQ(agrees(audit, 0, 0), std::nullopt) << "something else broke it";
    EXPECT_EQ(rangeText(audit.predicted[0][0], audit), "at most up to 1e+04");
    audit.predicted[0][0].at_most = false;
    EXPECT_EQ(agrees(audit, 0, 0), false);
    audit.predicted[0][0].at_most = true;
    range.up = {1e5, 2e5, true};
    EXPECT_EQ(agrees(audit, 0, 0), false) << "it held ten times as far";
    range.up = {1e6, 0, false};
    EXPECT_EQ(agrees(audit, 0, 0), false);
    audit.predicted[0][0].up = 1e7;
    EXPECT_EQ(agrees(audit, 0, 0), true);
}

TEST(Audit, WhatIsRequiredIsMeasuredItself) {
    const Subject subject = gallery();
    const std::array beside{5e9};
    const QuantityAudit audit = auditQuantity(
        quantityOf("offset"), subject,
        [](std::span<const Series> series, double magnitude) {
            Step step = stepOf(magnitude, 1e-6);
            step.outcomes.resize(series.size(), step.outcomes.front());
            return step;
        },
        beside);
    EXPECT_EQ(audit.steps.back().magnitude, 5e9);
    EXPECT_TRUE(evaluate(audit, 5e9).met);
}

TEST(Audit, StepsComeBackFromJson) {
    Step step = stepOf(2.5, infinity, 0.25, 7);
    step.outcomes.front().measured[Measure::reference_moved] = 1e-9;
    step.outcomes.front().failed = "no \"memory\"";
    const Step back = stepFromJson(nlohmann::ordered_json::parse(toJson(step).dump()));
    EXPECT_EQ(back.magnitude, 2.5);
    EXPECT_TRUE(back.isCovered());
    const Outcome& outcome = back.outcomes.front();
    EXPECT_EQ(outcome[Measure::reference_moved], 1e-9);
    EXPECT_EQ(outcome[Measure::light_p99], infinity);
    EXPECT_EQ(outcome[Measure::flip], 0.25);
    EXPECT_EQ(outcome.whole(Measure::nonfinite_pixels), 7u);
    EXPECT_EQ(outcome.failed, "no \"memory\"");
    EXPECT_THROW(stepFromJson({{"magnitude", 1}}), std::runtime_error);
}

TEST(Audit, EveryQuantityIsPushedFromWhereTheSceneIs) {
    const Subject subject = gallery();
    const std::string glb = glbOf(*flattened(subject.original)), lights = lightsFileOf(subject.original);
    const auto triangles = triangleCount(subject.original.scene);
    for (const Quantity& quantity : quantities()) {
        EXPECT_TRUE(std::ranges::is_sorted(quantity.magnitudes)) << quantity.name;
        if (!quantity.lacks(subject).empty()) continue;
        Case changed = subject.original;
        quantity.apply(changed, subject, quantity.magnitudes.back());
        const bool same =
            changed.settings == subject.original.settings && changed.exposure == 0 &&
            changed.scene.materials.front().roughness == subject.original.scene.materials.front().roughness &&
            quantity.name != "roughness" && quantity.name != "normal_map" &&
            quantity.name != "texel" &&  // this file has no texture
            triangleCount(changed.scene) == triangles && lightsFileOf(changed) == lights &&
            glbOf(*flattened(changed)) == glb;
        EXPECT_FALSE(same) << quantity.name << " changes nothing";
        EXPECT_FALSE(seriesOf(quantity, subject).series.empty()) << quantity.name;
    }
    EXPECT_EQ(quantityOf("size").original(subject), subject.view.height);
    // The quantity reports what the scene lacks.
    EXPECT_NE(quantityOf("environment").lacks(subject), "");
}

TEST(Audit, ASceneMovesAndGrowsAsAWhole) {
    const Subject subject = gallery();
    const auto relative = [](const Case& c) {
        const Pose pose = poseAt(c.scene, 0);
        return glm::dvec3(pose.instances.front().world_from_object[3]) -
               glm::dvec3(c.camera().world_from_camera[3]);
    };
    Case moved = subject.original;
    quantityOf("offset").apply(moved, subject, 1e6);
    EXPECT_NEAR(glm::distance(glm::dvec3(moved.camera().world_from_camera[3]), subject.view.eye()), 1e6,
                1e-3);
    EXPECT_NEAR(glm::distance(relative(moved), relative(subject.original)), 0, 1e-8);
    EXPECT_NEAR(
        glm::distance(moved.scene.lights.back().position, subject.original.scene.lights.back().position), 1e6,
        1e-3);
    Case grown = subject.original;
    quantityOf("scale").apply(grown, subject, 100);
    EXPECT_NEAR(glm::distance(relative(grown), 100.0 * relative(subject.original)), 0, 1e-9);
    EXPECT_NEAR(grown.camera().near, 100 * subject.original.camera().near, 1e-9);
    Case baked = subject.original;
    quantityOf("vertex").apply(baked, subject, 1e4);
    const Bounds before = worldBounds(subject.original.scene, poseAt(subject.original.scene, 0)),
                 after = worldBounds(baked.scene, poseAt(baked.scene, 0));
    EXPECT_NEAR(glm::distance(before.centre(), after.centre()), 0, 1e-2);  // rounded to float32 at 1e4 m
    Case cut = subject.original;
    quantityOf("triangles").apply(cut, subject, 1e5);
    EXPECT_GT(triangleCount(cut.scene), 5e4);
    const Bounds whole = worldBounds(cut.scene, poseAt(cut.scene, 0));
    EXPECT_NEAR(glm::distance(before.min, whole.min), 0, 1e-5);
}

// One triangle under one light suffices to show this failure.
TEST(AuditReduce, TheSmallestSceneIsFound) {
    const Subject subject = gallery();
    const Case whole = *flattened(subject.original);
    const std::size_t all = triangleCount(whole.scene);
    ASSERT_GT(all, 100u);
    ASSERT_GT(whole.scene.lights.size(), 2u);
    const glm::vec3 corner = whole.scene.meshes[3].primitives.front().positions[2];
    const glm::dmat4 transform = whole.scene.nodes[3].parent_from_node;
    const glm::dvec3 light = whole.scene.lights[1].position;
    std::size_t tried = 0;
    const auto test = [&](const Case& c) {
        ++tried;
        bool lit = false, drawn = false;
        for (const Light& one : c.scene.lights) lit = lit || one.position == light;
        for (std::size_t i = 0; i < c.scene.nodes.size(); ++i) {
            const Primitive& p = c.scene.meshes[i].primitives.front();
            for (const std::uint32_t v : p.indices)
                drawn = drawn || (p.positions[v] == corner && c.scene.nodes[i].parent_from_node == transform);
        }
        return FailingPixel{lit && drawn, 5, 5, 1.0};
    };
    const std::optional<Reduced> reduced = reduce(subject.original, test, 400);
    ASSERT_TRUE(reduced);
    EXPECT_EQ(triangleCount(reduced->smallest.scene), 1u);
    EXPECT_EQ(reduced->smallest.scene.lights.size(), 1u);
    EXPECT_EQ(reduced->smallest.scene.nodes.size(), 1u);
    EXPECT_EQ(reduced->smallest.settings.size.width, 1);
    EXPECT_LE(tried, 400u);
    EXPECT_FALSE(reduce(
        subject.original, [](const Case&) { return FailingPixel{}; }, 400));
    tried = 0;
    EXPECT_TRUE(reduce(subject.original, test, 10));
    EXPECT_EQ(tried, 10u);
}

// This failure needs two lights and two triangles, the first and the last in their lists. Everything
// between them is removed.
TEST(AuditReduce, WhatLiesBetweenTwoIsRemoved) {
    Subject subject = gallery();
    const Case whole = *flattened(subject.original);
    const auto wide = std::ranges::find_if(
        whole.scene.meshes, [](const Mesh& mesh) { return mesh.primitives.front().indices.size() >= 3 * 8; });
    ASSERT_NE(wide, whole.scene.meshes.end());
    const Primitive& all = wide->primitives.front();
    const auto cornersOf = [](const Primitive& p, std::size_t triangle) {
        std::vector<glm::vec3> corners;
        for (std::size_t k = 0; k < 3; ++k) corners.push_back(p.positions[p.indices[3 * triangle + k]]);
        return corners;
    };
    const std::vector<glm::vec3> first = cornersOf(all, 0), last = cornersOf(all, all.indices.size() / 3 - 1);
    const glm::dvec3 one = whole.scene.lights.front().position, other = whole.scene.lights.back().position;
    ASSERT_NE(one, other);
    const auto test = [&](const Case& c) {
        int lights = 0, triangles = 0;
        for (const Light& light : c.scene.lights) lights += light.position == one || light.position == other;
        for (const Mesh& mesh : c.scene.meshes) {
            const Primitive& p = mesh.primitives.front();
            if (p.positions.size() != all.positions.size() || p.positions != all.positions) continue;
            for (std::size_t t = 0; t < p.indices.size() / 3; ++t)
                triangles += cornersOf(p, t) == first || cornersOf(p, t) == last;
        }
        return FailingPixel{lights >= 2 && triangles >= 2, 5, 5, 1.0};
    };
    const std::optional<Reduced> reduced = reduce(subject.original, test, 1000);
    ASSERT_TRUE(reduced);
    EXPECT_EQ(reduced->smallest.scene.lights.size(), 2u);
    EXPECT_EQ(triangleCount(reduced->smallest.scene), 2u);
}

// The written files read back as the scene that was drawn.
TEST(AuditReduce, AReducedSceneIsAFile) {
    const Subject subject = gallery();
    Case flat = *flattened(subject.original);
    flat.scene.nodes.resize(2);
    flat.scene.meshes.resize(2);
    // All normals differ, so a swap would show.
    for (Mesh& mesh : flat.scene.meshes)
        for (std::size_t i = 0; i < mesh.primitives.front().normals.size(); ++i)
            mesh.primitives.front().normals[i] =
                glm::normalize(glm::vec3(1, 0.01f * static_cast<float>(i + 1), 0.5f));
    const std::filesystem::path out = folder(), file = out / "small.gltf", lights = out / "lights.json";
    std::ofstream(file) << gltfOf(flat);
    std::ofstream(lights) << lightsFileOf(flat);
    const Scene read = loadScene(file.string());
    EXPECT_EQ(triangleCount(read), triangleCount(flat.scene));
    const Pose pose = poseAt(read, 0);
    ASSERT_EQ(pose.instances.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(pose.instances[i].world_from_object, flat.scene.nodes[i].parent_from_node);
        const Primitive &a = primitiveOf(read, pose.instances[i]),
                        &b = flat.scene.meshes[i].primitives.front();
        for (std::size_t k = 0; k < a.indices.size(); ++k) {
            EXPECT_EQ(a.positions[a.indices[k]], b.positions[b.indices[k]]);
            // The reader normalizes again, as for any file's normals.
            EXPECT_LT(glm::distance(a.normals[a.indices[k]], b.normals[b.indices[k]]), 1e-6f);
        }
        const Material &material = read.materials[static_cast<std::size_t>(a.material)],
                       &original = flat.scene.materials[static_cast<std::size_t>(b.material)];
        EXPECT_EQ(material.roughness, original.roughness);
        EXPECT_EQ(material.base_color, original.base_color);
        EXPECT_NEAR(material.emissive.g, original.emissive.g, 1e-6 * original.emissive.g);
    }
    ASSERT_EQ(read.cameras.size(), 1u);
    Settings settings = flat.settings;
    settings.lights = lights.string();
    SceneViews views(read);
    const SceneView& view = views.at(viewRequest(settings));
    EXPECT_EQ(view.view.camera.yfov, flat.camera().yfov);
    EXPECT_NEAR(glm::distance(view.view.eye(), subject.view.eye()), 0, 1e-12);
    ASSERT_EQ(view.lights.size(), flat.scene.lights.size());
    for (std::size_t i = 0; i < view.lights.size(); ++i) {
        EXPECT_EQ(view.lights[i].kind, flat.scene.lights[i].kind);
        EXPECT_EQ(view.lights[i].intensity, flat.scene.lights[i].intensity);
    }
}

TEST(AuditOutput, ATableAPlotAndWords) {
    const Subject subject = gallery();
    Audit audit;
    audit.scene = "builtin:gallery";
    audit.quantities.push_back(
        audited(quantityOf("haze"), subject, [](double m) { return m < 1e5 ? 1e-6 : infinity; }));
    const QuantityAudit& of = audit.quantities.front();
    const std::string csv = output::inCsv(stepTable(audit));
    EXPECT_EQ(static_cast<std::size_t>(std::ranges::count(csv, '\n')),
              1 + of.steps.size() * of.series.size());
    EXPECT_NE(csv.find("haze,0.001,,deferred,gbuffer=full,1e-06,"), std::string::npos) << csv;
    const std::string plot = auditPlot(of, PlotTarget::file);
    EXPECT_NE(plot.find(">\u221e<"), std::string::npos) << "infinite errors have a lane";
    for (const Series& series : of.series) EXPECT_NE(plot.find(series.describe()), std::string::npos);
    for (const std::string& text : {output::inText(blocksOf(of)), output::inHtml(blocksOf(of))})
        EXPECT_NE(text.find("differs from the measurement"), std::string::npos) << text;
    const nlohmann::ordered_json json = toJson(audit);
    EXPECT_EQ(json["rows"].size(), of.steps.size() * of.series.size());
    EXPECT_EQ(json["quantities"][0]["series"][1]["path"], "forward_plus");
}

}  // namespace diptych::audit
