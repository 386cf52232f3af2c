// SPDX-License-Identifier: MIT
// The text of `plan`, of made-up counts.
#include "compare/bench/scene_plan.h"
#include "compare/bench/estimate.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>

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

PassWork countedPass() {
    PassWork pass;
    pass.counts = {.name = "shade",
                   .vertices = 1,
                   .triangles = 2,
                   .samples = 3,
                   .fragments = 4,
                   .outputs = 5,
                   .compute = 6,
                   .read = 7,
                   .written = 8};
    pass.texels = 9;
    pass.lights = 10;
    pass.vertex_bytes = 11;
    return pass;
}

TEST(ScenePlanText, JsonIsWhole) {
    ScenePlan plan = countedPlan();
    plan.lines.clear();
    nlohmann::ordered_json json = toJson(plan);
    EXPECT_EQ(
        json.dump(),
        R"({"scene":"box.gltf","draws":2,"triangles":30,"materials":4,"textures":5,"lights":6,"modelled":[],)"
        R"("left_out":[],"notes":["a triangle has no area"],"variants":[{"name":"red","drawn":false},)"
        R"({"name":"blue","drawn":true}],"paths":[{"path":"deferred","passes":["G-buffer","shade"],)"
        R"("bytes_per_pixel":16,"samples":[{"samples":1,"bytes_per_pixel":16,"bytes_per_sample":16,)"
        R"("image_bytes_per_pixel":48},{"samples":4,"bytes_per_pixel":96,"bytes_per_sample":24,)"
        R"("image_bytes_per_pixel":176},{"samples":8,"bytes_per_pixel":192,"bytes_per_sample":24,)"
        R"("image_bytes_per_pixel":352}],"shared_bytes_per_pixel":12,"triangles_in_view":25,)"
        R"("triangles_drawn":20,"vertices_drawn":44,"instances_drawn":7,"draws":3,"notes":["6 pipelines"]}],)"
        R"("work":[]})");
    EXPECT_EQ(ScenePlan().variant, -1) << "no variant is drawn unless one is named";
}

TEST(ScenePlanText, AWorkloadIsEstimatedForEveryGpu) {
    ScenePlan plan;
    plan.work = {{Path::forward_plus, {countedPass()}}};
    nlohmann::ordered_json work = toJson(plan)["work"];
    ASSERT_EQ(work.size(), 1u);
    EXPECT_EQ(work[0]["path"], "forward_plus");
    EXPECT_EQ(
        work[0]["passes"].dump(),
        R"([{"name":"shade","vertices":1,"triangles":2,"samples":3,"fragments":4,"outputs":5,"compute":6,)"
        R"("texels":9.0,"lights":10.0,"bytes_read":7,"bytes_written":8,"vertex_bytes":11.0}])");
    ASSERT_EQ(work[0]["estimates"].size(), estimatedGpus().size());
    const std::string text = describe(plan);
    for (std::size_t i = 0; i < estimatedGpus().size(); ++i) {
        const FrameEstimate expected = estimate(plan.work[0], estimatedGpus()[i]);
        const nlohmann::ordered_json& said = work[0]["estimates"][i];
        EXPECT_EQ(said["gpu"], expected.gpu->name);
        EXPECT_EQ(said["ms"], expected.ms);
        EXPECT_EQ(
            said["passes"].dump(),
            nlohmann::ordered_json({{{"name", "shade"}, {"ms", expected.ms}, {"bound", "launch"}}}).dump());
        EXPECT_NE(text.find("\n    estimate, " + describe(expected) + "\n"), std::string::npos) << text;
    }
}

// A compiler's cycles are of its family alone, and of the path that it compiled.
TEST(ScenePlanText, ACompilersGpuIsEstimatedByItsCycles) {
    const DeviceInfo compiler{0, "Null hardware (RADV NAVI31)", "Mesa", "cpu", "1.3.0", {}};
    const auto compiledPath = [](Path path, double cycles) {
        ShaderCost cost;
        cost.cycles = cycles;
        PlannedPipeline pipeline{"shade", false, "x.frag", "", {{{"x.frag", 64, {}, cost}}, ""}, {}};
        return CompiledPath{path, {pipeline}, {}, {}, {}};
    };
    ScenePlan plan;
    PassWork pass = countedPass();
    pass.counts.fragments = 64'000'000;
    plan.work = {{Path::deferred, {pass}}, {Path::forward_plus, {pass}}};
    plan.compiled = {compiledPath(Path::deferred, 4800), compiledPath(Path::forward_plus, 9600)};
    plan.compiler = &compiler;
    const nlohmann::ordered_json json = toJson(plan), &work = json["work"];
    // 192 SIMD units of 2.5 GHz, and 0.005 ms for the start.
    for (const auto& [i, ms] : {std::pair{0, 10.0}, {1, 20.0}}) {
        ASSERT_EQ(work[i]["estimates"].size(), 1u);
        EXPECT_EQ(work[i]["estimates"][0]["gpu"], "AMD Radeon RX 7900 XTX");
        EXPECT_NEAR(work[i]["estimates"][0]["ms"].get<double>(), ms + 0.005, 1e-9);
        EXPECT_EQ(work[i]["estimates"][0]["passes"][0]["bound"], "arithmetic");
    }
    EXPECT_EQ(json["compiled"]["device"]["name"], compiler.name);
    const std::string text = describe(plan);
    EXPECT_LT(text.find("  compiled for " + compiler.name), text.find("  workload of deferred"));
    plan.compiler = nullptr;
    EXPECT_FALSE(toJson(plan).contains("compiled"));
    EXPECT_EQ(describe(plan).find("compiled for"), std::string::npos);
}

}  // namespace
}  // namespace diptych
