// SPDX-License-Identifier: MIT
// Cost of one listed point light at one pixel: bench_kernels [RUNS]
// The shipped light loop in full-screen draws, lights in each kind of buffer, and the same arithmetic by
// hand-written AVX2. RUNS (15) draws of each list length, all kernels interleaved; the fastest count. CPU
// kernels and software devices: CPU time per thread. Other devices: times of PassList.
#include "tests/bench/kernels.h"

#include "shared/text/counted.h"
#include "shared/vulkan/device/device.h"

#include <fmt/format.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

using namespace diptych;
using namespace diptych::kernels;

namespace {

constexpr Size size{640, 352};
constexpr int short_list = 16, long_list = 48;  // lights per tile

struct TimedKernel {
    std::string name;
    std::optional<double> goal;
    std::function<double(int)> ms;  // of a draw with this list length
    double short_ms = 1e300, long_ms = 1e300;

    // Per light and pixel: slope between the list lengths.
    double ns() const {
        return (long_ms - short_ms) * 1e6 /
               (static_cast<double>(size.width) * size.height * (long_list - short_list));
    }
};

// CPU time of this process during `work` per thread, ms. Equals wall-clock time on an idle machine, and
// changes little when other programs run.
double cpuMs(int threads, const std::function<void()>& work) {
    const std::clock_t used = std::clock();
    work();
    return 1e3 * static_cast<double>(std::clock() - used) / CLOCKS_PER_SEC / threads;
}

void measure(std::vector<TimedKernel>& timed, int runs) {
    for (int run = -1; run < runs; ++run)  // drivers compile during the first run: discard it
        for (TimedKernel& kernel : timed) {
            const double few = kernel.ms(short_list), many = kernel.ms(long_list);
            if (run < 0) continue;
            kernel.short_ms = std::min(kernel.short_ms, few);
            kernel.long_ms = std::min(kernel.long_ms, many);
        }
}

// The CPU's kernel is the first if `compares`.
void print(const std::vector<TimedKernel>& timed, bool compares) {
    const auto orDash = [](std::optional<double> value, int digits) {
        return value ? fmt::format("{:.{}f}", *value, digits) : "-";
    };
    fmt::print("{:<34} {:>6} {:>12} {:>5}\n", "kernel", "ns", "ratio to CPU", "goal");
    for (const TimedKernel& kernel : timed) {
        const bool compared = compares && &kernel != &timed.front();
        fmt::print("{:<34} {:>6.3f} {:>12} {:>5}\n", kernel.name, kernel.ns(),
                   orDash(compared ? std::optional(kernel.ns() / timed.front().ns()) : std::nullopt, 2),
                   orDash(compared ? kernel.goal : std::nullopt, 1));
    }
}

}  // namespace

int main(int count, char** arguments) try {
    const int runs = count > 1 ? std::atoi(arguments[1]) : 15;
    if (count > 2 || runs < 1) throw std::runtime_error("usage: bench_kernels [RUNS], at least 1");
    Device device(DeviceOptions{});
    const int threads =
        static_cast<int>(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
    const KernelWorkload workload = makeWorkload(size, maxKernelLights, long_list, 1);

    std::vector<TimedKernel> timed;
    std::vector<std::string> notes;
    Image image(size.width, size.height, 3);
    if (hasCpuKernel())
        timed.push_back({"this CPU, hand-written AVX2", {}, [&](int length) {
                             return cpuMs(threads, [&] { runCpuKernel(workload, length, image); });
                         }});
    else
        notes.emplace_back("this CPU lacks AVX2 or FMA: no CPU time to compare the shaders with");
    for (const DeviceKernel& kernel : deviceKernels()) {
        if (const std::string missing = whyNotDrawn(device, kernel); !missing.empty()) {
            notes.push_back(fmt::format("{}: {}", kernel.name, missing));
            continue;
        }
        timed.push_back({kernel.name, kernel.goal,
                         [&, drawn = std::shared_ptr(makeDrawnKernel(device, workload, kernel))](int length) {
                             double ms = 0;
                             const double cpu = cpuMs(threads, [&] { ms = drawn->draw(length); });
                             return device.profile().software ? cpu : ms;
                         }});
    }
    measure(timed, runs);
    fmt::print(
        "{}, one listed point light at one pixel: the difference between lists of {} and {} out of "
        "{} lights, {}x{}, {}, {}\n",
        device.info().name, short_list, long_list, maxKernelLights, size.width, size.height,
        counted(static_cast<std::uint64_t>(runs), "run"),
        counted(static_cast<std::uint64_t>(threads), "thread"));
    print(timed, hasCpuKernel());
    for (const std::string& note : notes) fmt::print("{}\n", note);
    return 0;
} catch (const std::exception& e) {
    std::fprintf(stderr, "bench_kernels: %s\n", e.what());
    return 2;
}
