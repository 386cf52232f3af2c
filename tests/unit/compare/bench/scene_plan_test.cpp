// SPDX-License-Identifier: MIT
// The text of `plan`, of made-up counts.
#include "compare/bench/scene_plan.h"

#include <gtest/gtest.h>

#include <string>

namespace diptych {
namespace {

using namespace bench;

// All counts differ, so that a swap would show.
ScenePlan countedPlan() {
    ScenePlan plan;
    plan.scene = "box.gltf";
    plan.needs.draws = 2;
    plan.needs.triangles = 30;
    plan.needs.materials = 4;
    plan.needs.textures = 5;
    plan.needs.light_counts.front() = 2;
    plan.needs.light_counts.back() = 4;
    plan.lines = {{false, "film", "no room"}, {true, "coat", "a second lobe"}, {false, "sheen", "no bits"}};
    plan.notes = {"a triangle has no area"};
    plan.variants = {"red", "blue"};
    plan.variant = 1;
    PathPlan path;
    path.path = "deferred";
    path.passes = {"G-buffer", "shade"};
    path.bytes = {{1, 16, 48}, {4, 96, 176}, {8, 192, 352}};
    path.shared_bytes_per_pixel = 12;
    path.drawn = {.in_view = 25, .drawn = 20, .vertices = 44, .instances = 7, .draws = 3};
    path.notes = {"6 pipelines"};
    plan.paths = {path};
    return plan;
}

TEST(ScenePlanText, EveryCountHasItsWord) {
    ScenePlan plan = countedPlan();
    EXPECT_EQ(describe(plan),
              "box.gltf: 2 draws, 30 triangles, 4 materials, 5 textures, 6 lights\n"
              "  modelled\n"
              "    coat                       a second lobe\n"
              "  left out\n"
              "    film                       no room\n"
              "    sheen                      no bits\n"
              "  material variants\n"
              "    0 red                      --variant 0 draws it\n"
              "    1 blue                     drawn\n"
              "  deferred: G-buffer > shade; 16 bytes per pixel, 48 with lighting; 96 and 176 with --msaa 4; "
              "192 and 352 with --msaa 8; images that share memory save 12 more\n"
              "    25 of 30 triangles are in view; 20 are drawn with 3 draws and 7 instances; vertices: 44\n"
              "    6 pipelines\n"
              "  note: a triangle has no area\n");
    // One of each, and nothing to remark.
    plan.needs.draws = plan.needs.triangles = plan.needs.materials = plan.needs.textures = 1;
    plan.needs.light_counts = {1};
    plan.lines.clear();
    plan.notes.clear();
    plan.variant = -1;
    plan.variants.resize(1);
    PathPlan& path = plan.paths.front();
    path.passes.resize(1);
    path.bytes.resize(1);
    path.shared_bytes_per_pixel = 0;
    path.drawn = {.in_view = 1, .drawn = 1, .vertices = 3, .instances = 1, .draws = 1};
    path.notes.clear();
    EXPECT_EQ(describe(plan),
              "box.gltf: 1 draw, 1 triangle, 1 material, 1 texture, 1 light\n"
              "  modelled\n"
              "  left out\n"
              "  material variants; none is drawn: primitives have their own materials\n"
              "    0 red                      --variant 0 draws it\n"
              "  deferred: G-buffer; 16 bytes per pixel, 48 with lighting\n"
              "    1 of 1 triangles are in view; 1 are drawn with 1 draw and 1 instance; vertices: 3\n");
    plan.variants.clear();
    EXPECT_EQ(describe(plan).find("variant"), std::string::npos);
}

// Bytes per pixel, triangles and lights in the workload; MB are read, written and vertex bytes.
TEST(ScenePlanText, AWorkloadHasAColumnForEachCount) {
    ScenePlan plan;
    PassWork pass;
    pass.counts.name = "shade";
    pass.counts.vertices = 11;
    pass.counts.triangles = 22;
    pass.counts.fragments = 33;
    pass.counts.compute = 44;
    pass.counts.read = 1'000'000;
    pass.counts.written = 200'000;
    pass.texels = 55;
    pass.lights = 66;
    pass.vertex_bytes = 30'000;
    plan.work = {{Path::forward_plus, {pass}}};
    const std::string text = describe(plan);
    EXPECT_NE(
        text.find("  workload of forward_plus\n"
                  "    pass                         vertices  triangles  fragments     texels     lights "
                  "   compute        MB\n"
                  "    shade                              11         22         33         55         66 "
                  "        44      1.23\n"),
        std::string::npos)
        << text;
}

TEST(ScenePlanText, JsonHasTheSameCounts) {
    const nlohmann::ordered_json json = toJson(countedPlan());
    for (const auto& [key, count] :
         {std::pair{"draws", 2}, {"triangles", 30}, {"materials", 4}, {"textures", 5}, {"lights", 6}})
        EXPECT_EQ(json[key], count) << key;
    EXPECT_EQ(json["modelled"].dump(), R"([{"what":"coat","why":"a second lobe"}])");
    EXPECT_EQ(json["left_out"].dump(),
              R"([{"what":"film","why":"no room"},{"what":"sheen","why":"no bits"}])");
    EXPECT_EQ(json["variants"].dump(), R"([{"name":"red","drawn":false},{"name":"blue","drawn":true}])");
    const nlohmann::ordered_json& path = json["paths"][0];
    for (const auto& [key, count] : {std::pair{"bytes_per_pixel", 16},
                                     {"shared_bytes_per_pixel", 12},
                                     {"triangles_in_view", 25},
                                     {"triangles_drawn", 20},
                                     {"vertices_drawn", 44},
                                     {"instances_drawn", 7},
                                     {"draws", 3}})
        EXPECT_EQ(path[key], count) << key;
    EXPECT_EQ(path["samples"][1].dump(),
              R"({"samples":4,"bytes_per_pixel":96,"bytes_per_sample":24,"image_bytes_per_pixel":176})");
}

}  // namespace
}  // namespace diptych
