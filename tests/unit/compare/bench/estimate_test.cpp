// SPDX-License-Identifier: MIT
// Estimated GPU time of a frame, from made-up counts.
#include "compare/bench/estimate.h"

#include <gtest/gtest.h>

namespace diptych {

using namespace bench;

namespace {

// 1e9 of everything per second, fully used, and no launch time.
constexpr GpuRates plainGpu{"plain", 1, 1, 1, 1, 1, 1};
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

TEST(BenchEstimate, EachDemandIsItsUnitsOverItsRate) {
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

// Arithmetic time: waves of 64 threads times their cycles, over the cycles of all SIMD units. The data
// sheet's FLOPS and the assumed utilization do not count.
TEST(BenchEstimate, ArithmeticIsTheCompilersWhereItSaysAny) {
    GpuRates gpu = plainGpu;
    gpu.simd_cycles = 2;
    PassWork work = busyPass();
    work.lights = 6'400'000;
    work.counts.compute = 640'000;
    const PassCycles cycles{.pass = "G-buffer", .vertex = 20, .fragment = 300, .compute = 50, .light = 7};
    EstimateAssumptions half = exactly;
    half.reached = 0.5;
    const std::vector<Demand> demands = demandsOf(work, gpu, half, &cycles);
    EXPECT_EQ(demands.back().name, "arithmetic");
    EXPECT_NEAR(demands.back().ms, (3e6 * 20 + 1e6 * 300 + 6.4e5 * 50 + 6.4e6 * 7) / 64 / 2e6, 1e-9);
    const FrameWork frame{Path::deferred, {busyPass()}};
    const PassCycles slow{.pass = "G-buffer", .fragment = 1e6};
    EXPECT_EQ(estimate(frame, gpu, exactly, std::span(&slow, 1)).passes[0].bound, "arithmetic");
    const PassCycles other{.pass = "shade", .fragment = 1e6};
    EXPECT_EQ(estimate(frame, gpu, exactly, std::span(&other, 1)).passes[0].bound, "memory");
}

TEST(BenchEstimate, AGpuIsOfTheFamilyThatItsDeviceNames) {
    GpuRates gpu = plainGpu;
    EXPECT_FALSE(isOfFamily(gpu, "Null hardware (RADV NAVI31)")) << "of none";
    gpu.family = "navi31";
    EXPECT_TRUE(isOfFamily(gpu, "Null hardware (RADV NAVI31)"));
    EXPECT_TRUE(isOfFamily(gpu, "AMD Radeon RX 7900 XTX (RADV NAVI31)"));
    EXPECT_FALSE(isOfFamily(gpu, "AMD Radeon RX 7600 (RADV NAVI33)"));
    for (const GpuRates& known : estimatedGpus()) EXPECT_EQ(known.family.empty(), known.simd_cycles == 0);
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
    EXPECT_EQ(describe(estimated),
              "deferred on plain: 20 ms; G-buffer 19.500 (memory), empty 0.500 (launch)");
    assumed.reached = 0.5;
    EXPECT_NEAR(estimate(frame, plainGpu, assumed).ms, 38 + 1, 1e-12)
        << "half of a figure takes twice as long";
}

TEST(BenchEstimate, RatesOfGpusAreThere) {
    ASSERT_FALSE(estimatedGpus().empty());
    for (const GpuRates& gpu : estimatedGpus())
        for (const double rate :
             {gpu.bytes, gpu.triangles, gpu.outputs, gpu.texels, gpu.draw_flops, gpu.compute_flops})
            EXPECT_GT(rate, 0) << gpu.name;
}

}  // namespace
}  // namespace diptych
