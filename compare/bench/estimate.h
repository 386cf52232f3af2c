// SPDX-License-Identifier: MIT
// On paper: what a counted frame should take on a GPU that is not here, by the figures of its data sheet. The
// roofline model (Williams, Waterman and Patterson 2009) with several roofs: a pass takes as long as the one
// of its demands that takes longest, and passes follow each other.
#pragma once

#include "compare/render/compiled_plan.h"
#include "compare/render/frame_work.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace diptych::bench {

// Of a data sheet, in 1e9 a second: bytes of memory, triangles set up, pixels written (a target each), texels
// filtered bilinearly, float32 operations of draws and of compute shaders (a multiply-add is two).
struct GpuFigures {
    std::string_view name;
    double bytes, triangles, outputs, texels, draw_flops, compute_flops;
    std::string_view family = {};  // as RADV calls it: "navi31"
    double simd_cycles = 0;        // of all SIMD units together
};
std::span<const GpuFigures> estimatedGpus();
// Whether a device of this name, which says its family ("... (RADV NAVI31)"), is of the GPU's.
bool isOfFamily(const GpuFigures& gpu, std::string_view device);

// What a pass demands, and how long that takes by itself, ms.
struct Demand {
    std::string_view name;  // "memory"
    double ms = 0;
};
struct PassEstimate {
    std::string name;
    double ms = 0;
    std::string_view
        bound;  // the demand that takes longest; "launch" where that is less than starting a pass
};
// The compiler's mean over the pipelines of a pass: a SIMD unit's cycles for a wave of 64 threads, without
// lights and for each light. RADV's "Inverse Throughput" hides latency by the other resident waves, so
// occupancy is in it and EstimateAssumptions::reached is not applied. A loop of unknown length counts as 8
// turns, so each pipeline is compiled without lights too, and `light` is an eighth of the difference.
struct PassCycles {
    std::string pass;
    double vertex = 0, fragment = 0, compute = 0, light = 0;
};
std::vector<PassCycles> passCycles(const CompiledPath& path);

struct FrameEstimate {
    Path path = Path::deferred;
    const GpuFigures* gpu = nullptr;
    double ms = 0;
    std::vector<PassEstimate> passes;
};

// Assumptions, not validated on a GPU: the share of a data sheet's figure that is reached; operations a light
// (counted in kernel_avx2.cpp, a multiply-add is two), fragment, vertex and compute invocation; and ms to
// begin a pass.
struct EstimateAssumptions {
    double reached = 0.6;
    double light_flops = 120, fragment_flops = 200, vertex_flops = 100, compute_flops = 100;
    double bilinear_a_texel = 2;  // a trilinear sample is two bilinear ones
    double launch_ms = 0.005;
};

// `cycles`: of the pass; nullptr: arithmetic is assumed.
std::vector<Demand> demandsOf(const PassWork& work, const GpuFigures& gpu,
                              const EstimateAssumptions& assumed = {}, const PassCycles* cycles = nullptr);
// `cycles`: of the passes that a compiler of the GPU's family has compiled; others are assumed.
FrameEstimate estimate(const FrameWork& frame, const GpuFigures& gpu, const EstimateAssumptions& assumed = {},
                       std::span<const PassCycles> cycles = {});

// "deferred on NVIDIA GeForce RTX 3060: 0.42 ms; G-buffer 0.21 (memory), ..."
std::string inWords(const FrameEstimate& estimate);

}  // namespace diptych::bench
