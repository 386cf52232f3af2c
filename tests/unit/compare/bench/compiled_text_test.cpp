// SPDX-License-Identifier: MIT
// What compilers say of both paths' pipelines, as text and JSON, from made-up statistics.
#include "compare/bench/compiled_text.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace diptych {
namespace {

using namespace bench;

const DeviceInfo compilerInfo{0, "a GPU", "driver 1", "discrete", "1.3.0", {}};

ShaderCost costOfShader(double vgprs, double occupancy, double cycles) {
    ShaderCost cost;
    cost.vector_registers = vgprs;
    cost.occupancy = occupancy;
    cost.cycles = cycles;
    return cost;
}

PlannedPipeline compiledAs(const std::string& pass, const std::string& shader, const ShaderCost& cost,
                           bool captures = false) {
    return {pass, captures, "name", "a variant", {{{shader, 32, {{"VGPRs", 1}, {"Colour", 2}}, cost}}, ""},
            {}};
}

// A vertex shader of both paths, one of a single path, and the captures' own at the end.
std::vector<CompiledPath> bothCompiled() {
    CompiledPath deferred{Path::deferred, {}, {}, {"an error"}, {"a spill"}},
        forward{Path::forward_plus, {}, {}, {}, {}};
    deferred.pipelines = {compiledAs("capture", "capture.comp", costOfShader(8, 16, 7), true),
                          compiledAs("shade", "a.frag", costOfShader(80, 8, 900), true),
                          compiledAs("depth", "a.vert", costOfShader(24, 16, 30)),
                          compiledAs("depth", "a.vert", costOfShader(32, 16, 40)),
                          compiledAs("depth", "a.vert", costOfShader(16, 16, 50))};
    forward.pipelines = {compiledAs("depth", "a.vert", costOfShader(24, 16, 30)),
                         compiledAs("shade", "b.frag", {})};
    deferred.features = {{"haze", "shade", "a.frag", costOfShader(80, 8, 900), costOfShader(72, 10, 900)},
                         {"glass", "shade", "a.frag", costOfShader(80, 8, 900), costOfShader(80, 8, 900)}};
    return {deferred, forward};
}

TEST(CompiledText, ATableHasARowForEachShaderOfAPass) {
    const std::string none(70, ' ');
    EXPECT_EQ(compiledText(bothCompiled(), compilerInfo),
              "  compiled for a GPU (driver 1): each shader's heaviest variant (occupancy: waves resident on "
              "a SIMD "
              "unit)\n" +
                  std::string(55, ' ') + " | deferred" + std::string(62, ' ') + " | forward_plus" +
                  std::string(58, ' ') +
                  "\n    pass                     shader                    "
                  " |  pipelines     VGPRs     SGPRs   spilled occupancy     bytes    cycles"
                  " |  pipelines     VGPRs     SGPRs   spilled occupancy     bytes    cycles\n"
                  "    depth                    a.vert                    "
                  " |          3        32         -         -        16         -        40"
                  " |          1        24         -         -        16         -        30\n"
                  "    shade                    b.frag                    "
                  " | " +
                  none +
                  " |          1         -         -         -         -         -         -\n"
                  "    capture                  capture.comp              "
                  " |          1         8         -         -        16         -         7 |\n"
                  "    shade, captured          a.frag                    "
                  " |          1        80         -         -         8         -       900 |\n"
                  "  cost of each feature in deferred's heaviest pipelines\n"
                  "    haze                       +8 VGPRs, occupancy 10 -> 8 (a.frag)\n"
                  "    glass                      different code, same cost (a.frag)\n"
                  "  error: an error\n"
                  "  warning: a spill\n");
}

// Only changes of what the table shows, and that both variants have.
TEST(CompiledText, OnlyWhatChangesIsAdded) {
    FeatureCost cost{"haze", "shade", "a.frag", costOfShader(8, 4, 100), costOfShader(8, 4, 100)};
    EXPECT_EQ(addedText(cost), "different code, same cost");
    cost.with.latency = 5;
    cost.without.latency = 4;
    EXPECT_EQ(addedText(cost), "different code, same cost") << "of a column that is not shown";
    cost.with.scalar_registers = 5;
    EXPECT_EQ(addedText(cost), "different code, same cost") << "of one variant alone";
    cost.without.code_bytes = 48;
    cost.with.code_bytes = 2096;
    cost.with.cycles = 90;
    EXPECT_EQ(addedText(cost), "+2048 bytes, -10 cycles");
    cost.with.occupancy = 5;
    EXPECT_EQ(addedText(cost), "occupancy 4 -> 5, +2048 bytes, -10 cycles");
}

TEST(CompiledText, JsonHasAllStatistics) {
    std::vector<CompiledPath> paths = bothCompiled();
    paths[0].pipelines.erase(paths[0].pipelines.begin() + 1, paths[0].pipelines.end());
    paths[0].features.pop_back();
    paths[1].pipelines.resize(1);
    paths[1].pipelines[0].compiled = {{}, "no memory"};
    EXPECT_EQ(
        compiledJson(paths, compilerInfo).dump(),
        R"({"device":{"name":"a GPU","driver":"driver 1","type":"discrete"},"paths":[{"path":"deferred",)"
        R"("pipelines":[{"pass":"capture","captures":true,"name":"name","variant":"a variant","shaders":[)"
        R"({"shader":"capture.comp","subgroup_size":32,"cost":{"vgprs":8.0,"occupancy":16.0,)"
        R"("inverse_throughput":7.0},"statistics":{"VGPRs":1.0,"Colour":2.0}}]}],"features":[{"feature":)"
        R"("haze","pass":"shade","shader":"a.frag","with":{"vgprs":80.0,"occupancy":8.0,)"
        R"("inverse_throughput":900.0},"without":{"vgprs":72.0,"occupancy":10.0,"inverse_throughput":900.0)"
        R"(}}],"errors":["an error"],"warnings":["a spill"]},{"path":"forward_plus","pipelines":[{"pass":)"
        R"("depth","captures":false,"name":"name","variant":"a variant","shaders":[],"error":"no memory"}],)"
        R"("features":[],"errors":[],"warnings":[]}]})");
}

}  // namespace
}  // namespace diptych
