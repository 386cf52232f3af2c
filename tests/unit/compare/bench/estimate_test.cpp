// SPDX-License-Identifier: MIT
// Estimated GPU time of a frame, from made-up counts.
#include "compare/bench/estimate.h"

#include <gtest/gtest.h>

#include <iterator>
#include <utility>

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

// Data sheets give memory in GB/s, and units and a boost clock; rates follow, rounded to three digits. Of the
// H100's clusters, two draw.
TEST(BenchEstimate, RatesFollowFromUnitsAndClock) {
    struct Sheet {
        const char* name;
        double ghz, bytes, rasterizers, rops, samplers, lanes;  // lanes: two operations a clock each
        const char* family;
        double simds;
    };
    const Sheet sheets[] = {
        {"NVIDIA GeForce RTX 3060", 1.777, 360, 3, 48, 112, 3584, "", 0},
        {"NVIDIA GeForce RTX 4090", 2.52, 1008, 11, 176, 512, 16384, "", 0},
        {"AMD Radeon RX 7600", 2.655, 288, 2, 64, 128, 2 * 2048, "navi33", 64},  // dual issue
        {"NVIDIA H100 SXM", 1.98, 3350, 0, 0, 0, 4 * 128, "", 0},
        {"AMD Radeon RX Vega 64", 1.546, 484, 4, 64, 256, 4096, "vega10", 256},
        {"AMD Radeon RX 6800 XT", 2.25, 512, 4, 128, 288, 4608, "navi21", 144},
        {"AMD Radeon RX 7900 XTX", 2.5, 960, 6, 192, 384, 2 * 6144, "navi31", 192},
        {"AMD Radeon RX 9070 XT", 2.97, 640, 4, 128, 256, 2 * 4096, "gfx1201", 128}};
    ASSERT_EQ(estimatedGpus().size(), std::size(sheets));
    for (std::size_t i = 0; i < std::size(sheets); ++i) {
        const GpuRates& gpu = estimatedGpus()[i];
        const Sheet& sheet = sheets[i];
        const auto near = [&](double rate, double units) {
            if (units > 0) {
                EXPECT_NEAR(rate / (units * sheet.ghz), 1, 0.007) << gpu.name;
            }
        };
        EXPECT_EQ(gpu.name, sheet.name);
        EXPECT_EQ(gpu.bytes, sheet.bytes);
        near(gpu.triangles, sheet.rasterizers);
        near(gpu.outputs, sheet.rops);
        near(gpu.texels, sheet.samplers);
        near(gpu.draw_flops, 2 * sheet.lanes);
        if (gpu.name == "NVIDIA H100 SXM") {
            near(gpu.compute_flops, 2 * 132 * 128);
            EXPECT_EQ(gpu.triangles, 1.8);
            EXPECT_EQ(gpu.outputs, 43);
            EXPECT_EQ(gpu.texels, 32);
        } else {
            EXPECT_EQ(gpu.compute_flops, gpu.draw_flops) << gpu.name;
        }
        EXPECT_EQ(gpu.family, sheet.family);
        EXPECT_DOUBLE_EQ(gpu.simd_cycles, sheet.simds * sheet.ghz) << gpu.name;
    }
    const EstimateAssumptions usual;
    EXPECT_EQ(usual.reached, 0.6);
    EXPECT_EQ(usual.light_flops, 120);
    EXPECT_EQ(usual.fragment_flops, 200);
    EXPECT_EQ(usual.vertex_flops, 100);
    EXPECT_EQ(usual.compute_flops, 100);
    EXPECT_EQ(usual.bilinear_a_texel, 2);
    EXPECT_EQ(usual.launch_ms, 0.005);
}

// Each demand has its own rate; half of each is reached.
TEST(BenchEstimate, EveryRateCountsForItsDemand) {
    const GpuRates gpu{"gpu", 2, 4, 8, 16, 32, 64};
    EstimateAssumptions half = exactly;
    half.reached = 0.5;
    PassWork work = busyPass();
    work.counts.compute = 6'400'000;
    const std::vector<Demand> demands = demandsOf(work, gpu, half);
    const std::pair<const char*, double> expected[] = {{"memory", 19.0 / 2 / 0.5},
                                                       {"triangles", 2.0 / 4 / 0.5},
                                                       {"outputs", 4.0 / 8 / 0.5},
                                                       {"texels", 14.0 / 16 / 0.5},
                                                       {"arithmetic", 13.0 / 32 / 0.5 + 32.0 / 64 / 0.5}};
    ASSERT_EQ(demands.size(), std::size(expected));
    for (std::size_t i = 0; i < demands.size(); ++i) {
        EXPECT_EQ(demands[i].name, expected[i].first);
        EXPECT_DOUBLE_EQ(demands[i].ms, expected[i].second) << demands[i].name;
    }
}

// A pass whose work takes just as long as its start is bound by the work.
TEST(BenchEstimate, AStartBoundsOnlyWhatIsShorter) {
    FrameWork frame{Path::forward_plus, {{}}};
    frame.passes[0].counts.name = "depth";
    frame.passes[0].counts.triangles = 500'000;
    EstimateAssumptions assumed = exactly;
    for (const auto& [launch, bound] : {std::pair{0.5, "triangles"}, {0.500001, "launch"}}) {
        assumed.launch_ms = launch;
        const FrameEstimate estimated = estimate(frame, plainGpu, assumed);
        EXPECT_EQ(estimated.passes.at(0).bound, bound);
        EXPECT_DOUBLE_EQ(estimated.ms, 0.5 + launch);
    }
    EXPECT_EQ(estimate(frame, plainGpu, assumed).path, Path::forward_plus);
}

}  // namespace
}  // namespace diptych
