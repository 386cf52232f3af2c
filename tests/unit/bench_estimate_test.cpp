// SPDX-License-Identifier: MIT
// What a counted frame should take on a GPU, of made-up counts.
#include "compare/bench/estimate.h"

#include <gtest/gtest.h>

namespace diptych {

using namespace bench;

namespace {

// 1e9 of everything a second, all of it reached, and passes that begin at once.
constexpr GpuFigures plainGpu{"plain", 1, 1, 1, 1, 1, 1};
constexpr EstimateAssumptions exactly{.reached = 1,
                                      .light_flops = 100,
                                      .fragment_flops = 10,
                                      .vertex_flops = 1,
                                      .compute_flops = 5,
                                      .bilinear_a_texel = 2,
                                      .launch_ms = 0};

PassWork busyPass() {
    PassWork work;
    work.counts = {.name = "G-buffer",
                   .vertices = 3'000'000,
                   .triangles = 2'000'000,
                   .fragments = 1'000'000,
                   .outputs = 4'000'000,
                   .compute = 0,
                   .read = 5'000'000,
                   .written = 6'000'000};
    work.texels = 7'000'000;
    work.vertex_bytes = 8'000'000;
    return work;
}

double demanded(const PassWork& work, std::string_view name) {
    for (const Demand& demand : demandsOf(work, plainGpu, exactly))
        if (demand.name == name) return demand.ms;
    return -1;
}

TEST(BenchEstimate, EachDemandIsItsUnitsOverItsFigure) {
    PassWork work = busyPass();
    EXPECT_NEAR(demanded(work, "memory"), 5 + 6 + 8, 1e-12);
    EXPECT_NEAR(demanded(work, "triangles"), 2, 1e-12);
    EXPECT_NEAR(demanded(work, "outputs"), 4, 1e-12);
    EXPECT_NEAR(demanded(work, "texels"), 14, 1e-12);
    EXPECT_NEAR(demanded(work, "arithmetic"), 10 + 3, 1e-12);
    work.lights = 1'000'000;
    work.counts.compute = 1'000'000;
    EXPECT_NEAR(demanded(work, "arithmetic"), 10 + 3 + 100 + 5, 1e-12);
}

TEST(BenchEstimate, AFrameIsTheSumOfTheLongestDemands) {
    FrameWork frame{Path::deferred, {busyPass(), {}}};
    frame.passes[1].counts.name = "empty";
    EstimateAssumptions assumed = exactly;
    assumed.launch_ms = 0.5;
    const FrameEstimate estimated = estimate(frame, plainGpu, assumed);
    EXPECT_NEAR(estimated.ms, 19 + 0.5 + 0.5, 1e-12);
    EXPECT_EQ(estimated.passes[0].bound, "memory");
    EXPECT_EQ(estimated.passes[1].bound, "launch");
    EXPECT_EQ(inWords(estimated), "deferred on plain: 20 ms; G-buffer 19.500 (memory), empty 0.500 (launch)");
    assumed.reached = 0.5;
    EXPECT_NEAR(estimate(frame, plainGpu, assumed).ms, 38 + 1, 1e-12)
        << "half of a figure takes twice as long";
}

TEST(BenchEstimate, FiguresOfGpusAreThere) {
    ASSERT_FALSE(estimatedGpus().empty());
    for (const GpuFigures& gpu : estimatedGpus())
        for (const double figure :
             {gpu.bytes, gpu.triangles, gpu.outputs, gpu.texels, gpu.draw_flops, gpu.compute_flops})
            EXPECT_GT(figure, 0) << gpu.name;
}

}  // namespace
}  // namespace diptych
