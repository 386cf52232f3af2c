// SPDX-License-Identifier: MIT
#include "compare/bench/estimate.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace diptych::bench {
namespace {

// NVIDIA Ampere GA102 and Ada AD102 white papers (2020, 2022), AMD RDNA 3 data sheet (2023), NVIDIA H100
// white paper (2022). Of an H100 two of 66 texture processing clusters, four multiprocessors, run the shaders
// of draws: its draws are a small GPU's, its memory and compute shaders a large one's.
constexpr GpuFigures gpus[] = {
    {"NVIDIA GeForce RTX 3060", 360, 5.3, 85, 199, 12'740, 12'740},
    {"NVIDIA GeForce RTX 4090", 1008, 27.7, 443, 1290, 82'600, 82'600},
    {"AMD Radeon RX 7600", 288, 5.3, 170, 340, 21'750, 21'750},
    {"NVIDIA H100 SXM", 3350, 1.8, 43, 32, 2'030, 66'900},
};

// Demands are in units, figures in 1e9 units a second.
double msOf(double units, double giga, double reached) {
    return units / (giga * reached * 1e6);
}

}  // namespace

std::span<const GpuFigures> estimatedGpus() {
    return gpus;
}

std::vector<Demand> demandsOf(const PassWork& work, const GpuFigures& gpu,
                              const EstimateAssumptions& assumed) {
    const PassCounts& n = work.counts;
    const auto real = [](std::uint64_t count) { return static_cast<double>(count); };
    const double operations = work.lights * assumed.light_flops + real(n.fragments) * assumed.fragment_flops +
                              real(n.vertices) * assumed.vertex_flops;
    const double r = assumed.reached;
    return {{"memory", msOf(real(n.read + n.written) + work.vertex_bytes, gpu.bytes, r)},
            {"triangles", msOf(real(n.triangles), gpu.triangles, r)},
            {"outputs", msOf(real(n.outputs), gpu.outputs, r)},
            {"texels", msOf(work.texels * assumed.bilinear_a_texel, gpu.texels, r)},
            {"arithmetic", msOf(operations, gpu.draw_flops, r) +
                               msOf(real(n.compute) * assumed.compute_flops, gpu.compute_flops, r)}};
}

FrameEstimate estimate(const FrameWork& frame, const GpuFigures& gpu, const EstimateAssumptions& assumed) {
    FrameEstimate result{frame.path, &gpu, 0, {}};
    for (const PassWork& work : frame.passes) {
        const std::vector<Demand> demands = demandsOf(work, gpu, assumed);
        const Demand& longest = *std::ranges::max_element(demands, {}, &Demand::ms);
        const bool short_one = longest.ms < assumed.launch_ms;
        result.passes.push_back(
            {work.counts.name, longest.ms + assumed.launch_ms, short_one ? "launch" : longest.name});
        result.ms += result.passes.back().ms;
    }
    return result;
}

std::string inWords(const FrameEstimate& estimate) {
    std::vector<std::string> passes;
    for (const PassEstimate& pass : estimate.passes)
        passes.push_back(fmt::format("{} {:.3f} ({})", pass.name, pass.ms, pass.bound));
    return fmt::format("{} on {}: {:.3g} ms; {}", nameOf(estimate.path), estimate.gpu->name, estimate.ms,
                       fmt::join(passes, ", "));
}

}  // namespace diptych::bench
