// SPDX-License-Identifier: MIT
// What evaluating one listed point light at one pixel costs: the shaders' own functions in full-screen draws,
// beside the same arithmetic written by hand for the CPU.
#pragma once

#include "compare/bench/workload.h"
#include "compare/progress.h"

#include <optional>
#include <string>
#include <vector>

namespace diptych {

class Device;

struct KernelRow {
    std::string name;             // "uniform buffer, uniform base"
    double ns = 0;                // per light and pixel: the slope between two list lengths
    std::optional<double> ratio;  // over the CPU's ns; nothing where that is not measured
    std::optional<double> goal;   // the ratio to stay below
};

struct KernelReport {
    Size size;
    int short_list = 0, long_list = 0;  // lights a tile
    int lights = 0, runs = 0, threads = 0;
    std::vector<KernelRow> rows;  // the CPU's first
    std::vector<std::string> notes;
};

// `runs` draws of either length, all kernels in turn.
KernelReport measureKernels(Device& device, int runs, const Stage& progress);

// The picture that the shader of a kernel draws, W x H x 3; `kernel` is one of deviceKernels().
struct DeviceKernel {
    const char* name;
    const char* shader;  // file of shaders/pass
    std::optional<double> goal;
};
const std::vector<DeviceKernel>& deviceKernels();
Image drawKernel(Device& device, const KernelWorkload& workload, int listLength, const DeviceKernel& kernel);

// Where the CPU has AVX2 and FMA; runCpuKernel() asks for them.
bool hasCpuKernel();
// The same picture by hand-written AVX2 on all cores: 8 pixels a vector. W x H x 3.
void runCpuKernel(const KernelWorkload& workload, int listLength, Image& picture);

}  // namespace diptych
