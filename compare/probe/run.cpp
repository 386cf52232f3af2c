// SPDX-License-Identifier: MIT
#include "compare/probe/run.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <mutex>

namespace diptych::probe {
namespace {

constexpr std::size_t chunk_rows = 1u << 17;  // per submit
constexpr std::size_t task_rows = 1u << 12;   // evaluated by one thread

std::size_t wholeLines(std::size_t rows, std::size_t line) {
    return std::max(rows / line, std::size_t{1}) * line;
}

}  // namespace

Result concluded(const Probe& probe, Tally tally) {
    Result result;
    result.probe = &probe;
    auto& errors = tally.errors;
    const auto quantile = [&](double fraction) {
        if (errors.empty()) return 0.0;
        const auto at =
            errors.begin() + static_cast<std::ptrdiff_t>(fraction * static_cast<double>(errors.size() - 1));
        std::nth_element(errors.begin(), at, errors.end());
        return double{*at};
    };
    result.median = quantile(0.5);
    result.p999 = quantile(0.999);
    const auto inputOf = [&](const Worst& worst) {
        return worst.any ? inputsOf(probe, worst.row, 1) : std::vector<float>{};
    };
    result.worst_input = inputOf(tally.worst);
    result.tight_input = inputOf(tally.tightest);
    result.passed = tally.failures == 0 && tally.nonfinite == 0 && tally.results > 0 &&
                    !(probe.strict && tally.backward > 0);
    errors.clear();
    errors.shrink_to_fit();
    result.tally = std::move(tally);
    return result;
}

Result runProbe(DeviceRows& device, const Probe& probe, std::size_t max_rows) {
    const std::size_t rows = wholeLines(std::min(probe.rows, max_rows), probe.line);
    const std::size_t chunk = wholeLines(chunk_rows, probe.line), task = wholeLines(task_rows, probe.line);
    Tally all;
    for (std::size_t first = 0; first < rows; first += chunk) {
        const std::size_t count = std::min(chunk, rows - first), tasks = (count + task - 1) / task;
        std::vector<float> in(count * probe.ins);
        const auto each = [&](const auto& work) {
            tbb::parallel_for(std::size_t{0}, tasks,
                              [&](std::size_t i) { work(i * task, std::min(task, count - i * task)); });
        };
        const auto at = [](std::vector<float>& values, std::size_t from) {
            return values.begin() + static_cast<std::ptrdiff_t>(from);
        };
        each([&](std::size_t from, std::size_t n) {
            std::ranges::copy(inputsOf(probe, first + from, n), at(in, from * probe.ins));
        });
        std::vector<float> out = device.run(probe, in);
        std::mutex mutex;
        each([&](std::size_t from, std::size_t n) {
            const std::vector<float> a(at(in, from * probe.ins), at(in, (from + n) * probe.ins));
            const std::vector<float> b(at(out, from * probe.outs), at(out, (from + n) * probe.outs));
            const Tally part = evaluated(probe, first + from, a, b);
            const std::lock_guard lock(mutex);
            all.add(part);
        });
    }
    return concluded(probe, std::move(all));
}

bool allPassed(std::span<const Result> results) {
    return std::ranges::all_of(results, &Result::passed);
}

std::vector<Result> runProbes(Device& device, std::span<const Probe> probes, const Stage& progress) {
    DeviceRows rows(device);
    std::vector<Result> results;
    for (std::size_t i = 0; i < probes.size(); ++i) {
        progress.at(static_cast<double>(i) / static_cast<double>(probes.size()), probes[i].name);
        results.push_back(runProbe(rows, probes[i]));
    }
    return results;
}

}  // namespace diptych::probe
