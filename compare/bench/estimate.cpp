// SPDX-License-Identifier: MIT
#include "compare/bench/estimate.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>

namespace diptych::bench {
namespace {

// NVIDIA Ampere GA102 and Ada AD102 white papers (2020, 2022), NVIDIA H100 white paper (2022), AMD data
// sheets (2017, 2020, 2022, 2023, 2025). An H100 runs draws on only two of its 66 texture processing
// clusters (four multiprocessors). Its draws are those of a small GPU, its memory and compute those of a
// large one.
constexpr GpuRates gpus[] = {
    {"NVIDIA GeForce RTX 3060", 360, 5.3, 85, 199, 12'740, 12'740},
    {"NVIDIA GeForce RTX 4090", 1008, 27.7, 443, 1290, 82'600, 82'600},
    {"AMD Radeon RX 7600", 288, 5.3, 170, 340, 21'750, 21'750, "navi33", 64 * 2.655},
    {"NVIDIA H100 SXM", 3350, 1.8, 43, 32, 2'030, 66'900},
    // AMD: SIMD units x boost clock, GHz.
    {"AMD Radeon RX Vega 64", 484, 6.2, 99, 396, 12'660, 12'660, "vega10", 256 * 1.546},
    {"AMD Radeon RX 6800 XT", 512, 9, 288, 648, 20'740, 20'740, "navi21", 144 * 2.25},
    {"AMD Radeon RX 7900 XTX", 960, 15, 480, 960, 61'400, 61'400, "navi31", 192 * 2.5},
    {"AMD Radeon RX 9070 XT", 640, 11.9, 380, 760, 48'700, 48'700, "gfx1201", 128 * 2.97},
};

// RADV's "Inverse Throughput" is per 64 threads for any wave size. It counts 8 iterations for a loop of
// unknown length (Mesa, src/amd/compiler/aco_statistics.cpp).
constexpr double waveThreads = 64, loopWeight = 8;

// Time for `units` at `giga` x 1e9 units per second, ms.
double msOf(double units, double giga, double reached) {
    return units / (giga * reached * 1e6);
}

}  // namespace

std::span<const GpuRates> estimatedGpus() {
    return gpus;
}

bool isOfFamily(const GpuRates& gpu, std::string_view device) {
    std::string family(gpu.family);
    for (char& c : family) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return !family.empty() && device.find(family) != std::string_view::npos;
}

std::vector<Demand> demandsOf(const PassWork& work, const GpuRates& gpu, const EstimateAssumptions& assumed,
                              const PassCycles* cycles) {
    const PassCounts& n = work.counts;
    const auto real = [](std::uint64_t count) { return static_cast<double>(count); };
    const double operations = work.lights * assumed.light_flops + real(n.fragments) * assumed.fragment_flops +
                              real(n.vertices) * assumed.vertex_flops;
    const double r = assumed.reached;
    const double arithmetic =
        cycles != nullptr ? (real(n.vertices) * cycles->vertex + real(n.fragments) * cycles->fragment +
                             real(n.compute) * cycles->compute + work.lights * cycles->light) /
                                waveThreads / (gpu.simd_cycles * 1e6)
                          : msOf(operations, gpu.draw_flops, r) +
                                msOf(real(n.compute) * assumed.compute_flops, gpu.compute_flops, r);
    return {{"memory", msOf(real(n.read + n.written) + work.vertex_bytes, gpu.bytes, r)},
            {"triangles", msOf(real(n.triangles), gpu.triangles, r)},
            {"outputs", msOf(real(n.outputs), gpu.outputs, r)},
            {"texels", msOf(work.texels * assumed.bilinear_a_texel, gpu.texels, r)},
            {"arithmetic", arithmetic}};
}

std::vector<PassCycles> passCycles(const CompiledPath& path) {
    struct Sum {
        PassCycles cycles;
        int pipelines = 0;
    };
    std::vector<Sum> sums;
    for (const PlannedPipeline& pipeline : path.pipelines) {
        if (pipeline.captures || pipeline.cost() == nullptr || !pipeline.cost()->cycles) continue;
        auto sum = std::ranges::find(sums, pipeline.pass, [](const Sum& s) { return s.cycles.pass; });
        if (sum == sums.end()) sum = sums.insert(sum, {{.pass = pipeline.pass}, 0});
        ++sum->pipelines;
        const double all = *pipeline.cost()->cycles;
        const double unlit = std::min(pipeline.unlit_cycles.value_or(all), all);
        sum->cycles.light += (all - unlit) / loopWeight;
        for (const CompiledShader& shader : pipeline.compiled.shaders) {
            const double cycles =
                &shader == &pipeline.compiled.shaders.back() ? unlit : shader.cost.cycles.value_or(0);
            (shader.name.ends_with(".vert")   ? sum->cycles.vertex
             : shader.name.ends_with(".frag") ? sum->cycles.fragment
                                              : sum->cycles.compute) += cycles;
        }
    }
    std::vector<PassCycles> means;
    for (const auto& [sum, n] : sums)
        means.push_back({sum.pass, sum.vertex / n, sum.fragment / n, sum.compute / n, sum.light / n});
    return means;
}

FrameEstimate estimate(const FrameWork& frame, const GpuRates& gpu, const EstimateAssumptions& assumed,
                       std::span<const PassCycles> cycles) {
    FrameEstimate result{frame.path, &gpu, 0, {}};
    for (const PassWork& work : frame.passes) {
        const auto known = std::ranges::find(cycles, work.counts.name, &PassCycles::pass);
        const std::vector<Demand> demands =
            demandsOf(work, gpu, assumed, known == cycles.end() ? nullptr : &*known);
        const Demand& longest = *std::ranges::max_element(demands, {}, &Demand::ms);
        const bool short_one = longest.ms < assumed.launch_ms;
        result.passes.push_back(
            {work.counts.name, longest.ms + assumed.launch_ms, short_one ? "launch" : longest.name});
        result.ms += result.passes.back().ms;
    }
    return result;
}

std::string describe(const FrameEstimate& estimate) {
    std::vector<std::string> passes;
    for (const PassEstimate& pass : estimate.passes)
        passes.push_back(fmt::format("{} {:.3f} ({})", pass.name, pass.ms, pass.bound));
    return fmt::format("{} on {}: {:.3g} ms; {}", nameOf(estimate.path), estimate.gpu->name, estimate.ms,
                       fmt::join(passes, ", "));
}

}  // namespace diptych::bench
