// SPDX-License-Identifier: MIT
// Metamorphic relations between images: they are met by both paths, and each detects the faults it is
// meant for.
#include "compare/audit/relations.h"
#include "compare/audit/relate.h"
#include "compare/audit/report.h"
#include "compare/output/writers.h"
#include "tests/image/scenes.h"

#include <functional>
#include <map>

namespace diptych::tests {
namespace {

using audit::Case;

audit::Subject relatedScene(const std::string& name, Settings settings = {}) {
    settings.size = {64, 36};
    settings.shadows = Shadows::off;
    return audit::makeSubject(makeBuiltin(name), settings);
}

const ReportDevice& relatedDevice() {
    static const ReportDevice described{device().info().name, device().info().driver, device().info().type};
    return described;
}

void expectAllHold(const std::string& scene, std::size_t atLeast,
                   const std::vector<std::string>& names = {}) {
    const audit::Subject subject = relatedScene(scene);
    audit::RelationMeasurer measurer(device(), subject, {}, pipelines());
    std::size_t passed = 0;
    for (const audit::Relation* relation : audit::relationsOf(names)) {
        const audit::RelationResult of = measurer.measure(*relation);
        EXPECT_TRUE(of.passes()) << scene << " " << output::inText(audit::blocksOf(of, relatedDevice()));
        passed += audit::verdictOf(of) == "holds";
    }
    EXPECT_GE(passed, atLeast) << scene;
}

TEST(RelationImages, AllHoldInTheGallery) {
    expectAllHold("gallery", 27);
}
TEST(RelationImages, AllHoldUnderManyLights) {
    expectAllHold("points", 27);
    expectAllHold("spheres?lights=16", 4, {"lights_split", "turned", "mirrored", "tiles_shifted"});
}
TEST(RelationImages, AllHoldWhereTexturesCutHoles) {
    expectAllHold("cutout", 9,
                  {"turned", "mirrored", "tiles_shifted", "triangles_split", "unindexed", "draws_reversed",
                   "through_gltf", "through_glb", "materials_permuted"});
}
TEST(RelationImages, AllHoldWhereThingsMove) {
    expectAllHold("motion", 6, {"moved", "turned", "mirrored", "scaled", "tiles_shifted", "draws_reversed"});
}

// Either of two intersecting surfaces may be visible; no channel shows the edges of blended ones.
TEST(RelationImages, SurfacesInOneAnotherAreNoFault) {
    expectAllHold("coplanar", 20);
    expectAllHold("crossed", 27);
}

void dim(Case& of, float by) {
    for (Light& light : of.scene.lights) light.intensity *= by;
}
void nudge(Case& of) {
    for (Mesh& mesh : of.scene.meshes)
        for (Primitive& primitive : mesh.primitives)
            for (glm::vec3& position : primitive.positions) position += glm::vec3(1e-3f, 0, 1e-3f);
}
void stain(Case& of) {
    for (Material& material : of.scene.materials) material.base_color *= 0.98f;
}

// A small fault for each relation, of the kind that it should detect.
const std::map<std::string_view, std::function<void(Case&)>>& injectedFaults() {
    static const std::map<std::string_view, std::function<void(Case&)>> faults{
        {"lights_permuted", [](Case& of) { of.scene.lights.pop_back(); }},
        {"lights_split", [](Case& of) { dim(of, 1 - 1e-5f); }},
        {"light_doubled", [](Case& of) { dim(of, 1 + 0x1p-23f); }},
        {"light_64th", [](Case& of) { dim(of, 1 + 0x1p-23f); }},
        {"dark_lights", [](Case& of) { of.scene.lights.front().intensity = 1e-3f; }},
        {"far_lights", [](Case& of) { of.scene.lights.front().range = 1e6f; }},
        // A world transform in float32.
        {"moved",
         [](Case& of) {
             glm::dmat4& placed = of.scene.nodes.back().parent_from_node;
             placed = glm::dmat4(glm::mat4(placed));
         }},
        {"turned", [](Case& of) { of.scene.lights.front().position += glm::dvec3(0.5, 0, 0); }},
        {"quarter_turn", [](Case& of) { of.scene.lights.front().position += glm::dvec3(0.5, 0, 0); }},
        {"mirrored", [](Case& of) { of.scene.lights.front().position.x *= -1; }},
        {"scaled", [](Case& of) { dim(of, 0.5f); }},
        {"tiles_shifted", [](Case& of) { of.camera().yfov *= 1.001; }},
        {"near_halved", [](Case& of) { of.camera().yfov *= 1.0001; }},
        {"draws_reversed", [](Case& of) { of.scene.nodes.pop_back(); }},
        {"meshes_split", [](Case& of) { of.scene.nodes.pop_back(); }},
        {"unindexed", nudge},
        {"triangles_split", nudge},
        {"materials_permuted", [](Case& of) { std::ranges::reverse(of.scene.materials); }},
        {"through_gltf", [](Case& of) { dim(of, 0.98f); }},
        {"through_glb", stain},
        {"repeated", stain},
        {"assign_every", [](Case& of) { of.scene.lights.pop_back(); }},
        {"assign_tiled", [](Case& of) { of.scene.lights.pop_back(); }},
        {"light_kernel", [](Case& of) { of.scene.lights.pop_back(); }},
        {"prepass", nudge},
        {"cull", nudge},
        {"lighting", nudge},
        {"still_time", nudge}};
    return faults;
}

TEST(RelationImages, EachIsBrokenByAPlantedFault) {
    const audit::Subject subject = relatedScene("points");
    audit::RelationMeasurer measurer(device(), subject, {}, pipelines());
    for (const audit::Relation& relation : audit::relations()) {
        const auto fault = injectedFaults().find(relation.name);
        ASSERT_NE(fault, injectedFaults().end()) << relation.name << " has no injected fault";
        const audit::RelationResult of = measurer.measure(relation, fault->second);
        EXPECT_EQ(audit::verdictOf(of), "broken") << output::inText(audit::blocksOf(of, relatedDevice()));
        bool every = true;
        for (const audit::SeriesResult& series : of.series)
            every = every && (!series.lacks.empty() || series.series.path == Path::reference ||
                              !series.comparison.passes());
        EXPECT_TRUE(every) << "each path shows it: " << output::inText(audit::blocksOf(of, relatedDevice()));
    }
}

}  // namespace
}  // namespace diptych::tests
