// SPDX-License-Identifier: MIT
// Runs probes and reports results as text and JSON.
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
    std::vector<float> worst_input;  // input of the worst error, in the unit
    std::vector<float> tight_input;  // input of the largest fraction of the allowed error
    bool passed = false;
};

// Generates inputs, runs the probe and evaluates the results; at most `max_rows` rows.
Result runProbe(DeviceRows& rows, const Probe& probe, std::size_t max_rows = SIZE_MAX);
Result concluded(const Probe& probe, Tally tally);

// How the device rounds where Vulkan leaves a choice: denormals, sums, fused products, halves.
std::vector<DeviceProperty> roundingProperties(Device& device);

std::vector<Result> runProbes(Device& device, std::span<const Probe> probes, const Stage& progress);

bool allPassed(std::span<const Result> results);

// A table with one line per probe; a failing probe has more lines, with its input. `verbose`: also the
// reason for the allowed error, and the distribution of errors.
std::string tableOf(std::span<const Result> results, bool verbose);
nlohmann::ordered_json jsonOf(std::span<const Result> results);

}  // namespace diptych::probe
