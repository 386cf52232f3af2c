// SPDX-License-Identifier: MIT
#include "compare/bench/kernels.h"

#include "compare/bench/kernel_avx2.h"
#include "shared/vulkan/device.h"

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <ctime>
#include <functional>
#include <memory>

namespace diptych::bench {

static_assert(sizeof(gpu::Light) == 8 * sizeof(float));

bool hasCpuKernel() {
#if defined(__x86_64__)
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#else
    return false;
#endif
}

void runCpuKernel(const KernelWorkload& workload, int listLength, Image& picture) {
    const int across = workload.tilesAcross(), side = KernelWorkload::tile;
    const std::size_t stride = static_cast<std::size_t>(picture.width) * 3;
    tbb::parallel_for(0, across * workload.tilesDown(), [&](int tile) {
        const int x = tile % across * side, y = tile / across * side;
        shadeTileAvx2(
            {&workload.lights.front().position.x,
             workload.indices.data() +
                 static_cast<std::size_t>(tile) * static_cast<std::size_t>(workload.list_capacity),
             listLength, x, y,
             picture.data.data() + static_cast<std::size_t>(y) * stride + static_cast<std::size_t>(x) * 3,
             stride});
    });
}

namespace {

// CPU time of this process during `work` per thread, ms. Equals wall-clock time on an idle machine, and
// changes little when other programs run.
double cpuMs(int threads, const std::function<void()>& work) {
    const std::clock_t used = std::clock();
    work();
    return 1e3 * static_cast<double>(std::clock() - used) / CLOCKS_PER_SEC / threads;
}

}  // namespace

KernelReport measureKernels(Device& device, int runs, const Stage& progress) {
    KernelReport report{{640, 352}, 16, 48, static_cast<int>(mostKernelLights), runs, 0, {}, {}};
    report.threads =
        static_cast<int>(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
    const KernelWorkload workload = makeWorkload(report.size, mostKernelLights, report.long_list, 1);

    // Functions from list length to milliseconds.
    std::vector<std::pair<KernelRow, std::function<double(int)>>> kernels;
    Image picture{report.size.width, report.size.height, 3, {}};
    picture.data.resize(picture.pixels() * 3);
    const bool hasCpu = hasCpuKernel();
    if (hasCpu)
        kernels.emplace_back(KernelRow{"this CPU, hand-written AVX2", 0, {}, {}}, [&](int length) {
            return cpuMs(report.threads, [&] { runCpuKernel(workload, length, picture); });
        });
    else
        report.notes.emplace_back("this CPU lacks AVX2 or FMA: no CPU time to compare the shaders with");
    std::vector<std::unique_ptr<DrawnKernel>> drawn;
    for (const DeviceKernel& kernel : deviceKernels()) {
        if (const std::string missing = whyNotDrawn(device, kernel); !missing.empty()) {
            report.notes.push_back(fmt::format("{}: {}", kernel.name, missing));
            continue;
        }
        drawn.push_back(makeDrawnKernel(device, workload, kernel));
        kernels.emplace_back(KernelRow{kernel.name, 0, {}, kernel.goal},
                             [&, one = drawn.back().get()](int length) {
                                 double ms = 0;
                                 const double cpu = cpuMs(report.threads, [&] { ms = one->draw(length); });
                                 return device.profile().software ? cpu : ms;
                             });
    }

    std::vector<std::pair<double, double>> least(kernels.size(), {1e300, 1e300});
    for (int run = -1; run < runs; ++run)  // drivers compile during the first run: discard it
        for (std::size_t i = 0; i < kernels.size(); ++i) {
            progress.at(static_cast<double>(run + 1) / (runs + 1), kernels[i].first.name);
            const double few = kernels[i].second(report.short_list),
                         many = kernels[i].second(report.long_list);
            if (run < 0) continue;
            least[i] = {std::min(least[i].first, few), std::min(least[i].second, many)};
        }
    const double evaluations =
        static_cast<double>(report.size.width) * report.size.height * (report.long_list - report.short_list);
    for (std::size_t i = 0; i < kernels.size(); ++i) {
        KernelRow row = kernels[i].first;
        row.ns = (least[i].second - least[i].first) * 1e6 / evaluations;
        if (hasCpu && i > 0 && report.rows.front().ns > 0) row.ratio = row.ns / report.rows.front().ns;
        if (!hasCpu) row.goal.reset();
        report.rows.push_back(std::move(row));
    }
    return report;
}

}  // namespace diptych::bench
