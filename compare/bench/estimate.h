// SPDX-License-Identifier: MIT
// Estimates frame times on other GPUs from their data sheets: the roofline model (Williams, Waterman and
// Patterson 2009) with several roofs. A pass takes as long as its longest demand; passes do not overlap.
#pragma once

#include "compare/render/compiled_plan.h"
#include "compare/render/frame_work.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace diptych::bench {

// Data sheet values, 1e9 per second: bytes of memory traffic, triangles set up, pixels written per target,
// bilinear texels. Also float32 operations of draws and of compute shaders; a multiply-add is two.
struct GpuRates {
    std::string_view name;
    double bytes, triangles, outputs, texels, draw_flops, compute_flops;
    std::string_view family = {};  // RADV's name: "navi31"
    double simd_cycles = 0;        // all SIMD units, 1e9 cycles per second
};
std::span<const GpuRates> estimatedGpus();
// Whether the device's name contains the GPU's family, as in "... (RADV NAVI31)".
bool isOfFamily(const GpuRates& gpu, std::string_view device);

// One demand of a pass, and the time it takes alone, ms.
struct Demand {
    std::string_view name;  // "memory"
    double ms = 0;
};
struct PassEstimate {
    std::string name;
    double ms = 0;
    std::string_view bound;  // longest demand; "launch" if starting the pass takes longer
};
// Means over a pass's compiled pipelines: SIMD cycles per 64 threads, without lights and per light. RADV's
// "Inverse Throughput" includes latency hiding by occupancy, so EstimateAssumptions::reached does not
// apply. A loop of unknown length counts as 8 iterations, so `light` is an eighth of the difference to a
// pipeline without lights.
struct PassCycles {
    std::string pass;
    double vertex = 0, fragment = 0, compute = 0, light = 0;
};
std::vector<PassCycles> passCycles(const CompiledPath& path);

struct FrameEstimate {
    Path path = Path::deferred;
    const GpuRates* gpu = nullptr;
    double ms = 0;
    std::vector<PassEstimate> passes;
};

// Assumptions, not validated on a GPU: the reached fraction of data sheet values, and operations per
// light, fragment, vertex and compute invocation. Light operations are counted in
// tests/bench/kernel_avx2.cpp; a multiply-add is two. The overhead of a pass is in ms.
struct EstimateAssumptions {
    double reached = 0.6;
    double light_flops = 120, fragment_flops = 200, vertex_flops = 100, compute_flops = 100;
    double bilinear_a_texel = 2;  // a trilinear sample is two bilinear ones
    double launch_ms = 0.005;
};

// `cycles`: of the pass; nullptr: uses the assumed operation counts.
std::vector<Demand> demandsOf(const PassWork& work, const GpuRates& gpu,
                              const EstimateAssumptions& assumed = {}, const PassCycles* cycles = nullptr);
// `cycles`: passes compiled for the GPU's family; the others use assumed operation counts.
FrameEstimate estimate(const FrameWork& frame, const GpuRates& gpu, const EstimateAssumptions& assumed = {},
                       std::span<const PassCycles> cycles = {});

// "deferred on NVIDIA GeForce RTX 3060: 0.42 ms; G-buffer 0.21 (memory), ..."
std::string describe(const FrameEstimate& estimate);

}  // namespace diptych::bench
