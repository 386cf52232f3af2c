// SPDX-License-Identifier: MIT
// Measures the cost of one listed point light at one pixel. Compares the shaders' functions, in
// full-screen draws, with the same arithmetic hand-written for the CPU.
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
    double ns = 0;                // per light and pixel: slope between two list lengths
    std::optional<double> ratio;  // to the CPU's ns; empty if not measured
    std::optional<double> goal;   // upper limit of the ratio
};

struct KernelReport {
    Size size;
    int short_list = 0, long_list = 0;  // lights per tile
    int lights = 0, runs = 0, threads = 0;
    std::vector<KernelRow> rows;  // CPU first
    std::vector<std::string> notes;
};

// Times all kernels interleaved, `runs` draws per list length, and keeps the fastest of each. CPU kernels
// and software devices: CPU time per thread. Other devices: times of PassList.
KernelReport measureKernels(Device& device, int runs, const Stage& progress);

// A kernel in shaders/pass/bench_*.frag.
struct DeviceKernel {
    const char* name;
    Shader shader;
    bool subgroups;              // needs ballots in fragment shaders
    std::optional<double> goal;  // KernelRow::goal
};
const std::vector<DeviceKernel>& deviceKernels();
// Why the device cannot run the kernel; empty if it can.
std::string whyNotDrawn(const Device& device, const DeviceKernel& kernel);

// A kernel and its workload, ready to run. Device and workload must outlive it.
class DrawnKernel {
public:
    virtual ~DrawnKernel() = default;
    virtual double draw(int listLength) = 0;  // ms; lights: a multiple of 4, at most the workload's
                                              // capacity
    virtual Image picture() = 0;              // of the last draw, W x H x 3
};
std::unique_ptr<DrawnKernel> makeDrawnKernel(Device& device, const KernelWorkload& workload,
                                             const DeviceKernel& kernel);

// Whether the CPU has AVX2 and FMA, required by runCpuKernel().
bool hasCpuKernel();
// The same image by hand-written AVX2 on all cores. W x H x 3.
void runCpuKernel(const KernelWorkload& workload, int listLength, Image& picture);

}  // namespace diptych::bench
