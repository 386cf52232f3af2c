// SPDX-License-Identifier: MIT
// Kernels of bench_kernels: the cost of one listed point light at one pixel. The shaders' functions, in
// full-screen draws, and the same arithmetic hand-written for the CPU.
#pragma once

#include "tests/bench/kernel_workload.h"

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace diptych {
class Device;
}

namespace diptych::kernels {

struct DeviceKernel {
    const char* name;
    std::string_view shader;     // file name
    bool subgroups;              // needs ballots in fragment shaders
    std::optional<double> goal;  // upper limit of its time over the CPU's
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
    virtual Image image() = 0;                // of the last draw, W x H x 3
};
std::unique_ptr<DrawnKernel> makeDrawnKernel(Device& device, const KernelWorkload& workload,
                                             const DeviceKernel& kernel);

// Whether the CPU has AVX2 and FMA, required by runCpuKernel().
bool hasCpuKernel();
// The same image by hand-written AVX2 on all cores. W x H x 3.
void runCpuKernel(const KernelWorkload& workload, int listLength, Image& image);

}  // namespace diptych::kernels
