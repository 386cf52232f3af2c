// SPDX-License-Identifier: MIT
// Runs probes and says what came of it, in words and as JSON.
#pragma once

#include "compare/probe/device_rows.h"
#include "compare/run/progress.h"

#include <nlohmann/json_fwd.hpp>

#include <span>
#include <string>
#include <vector>

namespace diptych::probe {

struct Result {
    const Probe* probe = nullptr;
    Tally tally;
    double median = 0, p999 = 0;     // of the errors, in the probe's unit
    std::vector<float> worst_input;  // that of the worst error, and of what is nearest to or farthest beyond
    std::vector<float> tight_input;  // what is allowed
    bool passed = false;
};

// Inputs, the device's results and their judgement, `rows` at most of each probe.
Result runProbe(DeviceRows& rows, const Probe& probe, std::size_t most_rows = SIZE_MAX);
Result concluded(const Probe& probe, Tally tally);

// How the device rounds, which Vulkan leaves open: denormals, sums, fused products, halves.
std::vector<DeviceFact> roundingFacts(Device& device);

std::vector<Result> runProbes(Device& device, std::span<const Probe> probes, const Stage& progress);

bool allPassed(std::span<const Result> results);

// A table of one line a probe; a probe that fails has lines more, with its input. `verbose`: also why so much
// is allowed, and how the errors are spread.
std::string tableOf(std::span<const Result> results, bool verbose);
nlohmann::ordered_json jsonOf(std::span<const Result> results);

}  // namespace diptych::probe
