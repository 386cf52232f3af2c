// SPDX-License-Identifier: MIT
// Measures the cost of evaluating one listed point light at one pixel: the shaders' own functions in
// full-screen draws, compared with the same arithmetic written by hand for the CPU.
#pragma once

#include "compare/bench/workload.h"
#include "compare/run/progress.h"
#include "shared/vulkan/spirv.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace diptych {
class Device;
}

namespace diptych::bench {

struct KernelRow {
    std::string name;             // "uniform buffer, uniform base"
    double ns = 0;                // per light and pixel: the slope between two list lengths
    std::optional<double> ratio;  // ns divided by the CPU's ns; empty if that was not measured
    std::optional<double> goal;   // the ratio to stay below
};

struct KernelReport {
    Size size;
    int short_list = 0, long_list = 0;  // lights a tile
    int lights = 0, runs = 0, threads = 0;
    std::vector<KernelRow> rows;  // the CPU's first
    std::vector<std::string> notes;
};

// Times all kernels in turn, `runs` draws of either list length, and keeps the fastest of each. Kernels on a
// CPU, run directly or by a Vulkan device, are timed in CPU time divided by the threads; other devices by
// PassList.
KernelReport measureKernels(Device& device, int runs, const Stage& progress);

// A kernel of shaders/pass/bench_*.frag.
struct DeviceKernel {
    const char* name;
    Shader shader;
    bool subgroups;              // it needs ballots in fragment shaders
    std::optional<double> goal;  // KernelRow::goal
};
const std::vector<DeviceKernel>& deviceKernels();
// Why the device cannot draw the kernel; empty if it can.
std::string whyNotDrawn(const Device& device, const DeviceKernel& kernel);

// A kernel over a workload, ready to be drawn. Device and workload outlive it.
class DrawnKernel {
public:
    virtual ~DrawnKernel() = default;
    virtual double draw(int listLength) = 0;  // ms; a multiple of 4 lights, at most the workload's capacity
    virtual Image picture() = 0;              // of the last draw, W x H x 3
};
std::unique_ptr<DrawnKernel> makeDrawnKernel(Device& device, const KernelWorkload& workload,
                                             const DeviceKernel& kernel);

// Whether the CPU has AVX2 and FMA, which runCpuKernel() needs.
bool hasCpuKernel();
// The same picture by hand-written AVX2 on all cores: 8 pixels a vector. W x H x 3.
void runCpuKernel(const KernelWorkload& workload, int listLength, Image& picture);

}  // namespace diptych::bench
