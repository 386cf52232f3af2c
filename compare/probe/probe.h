// SPDX-License-Identifier: MIT
// A probe runs a function of shaders/lib, or a device operation, on many inputs and compares each result
// with a definition in double precision.
#pragma once

#include "compare/probe/inexact.h"
#include "compare/probe/interval.h"
#include "compare/probe/random.h"
#include "compare/probe/tally.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace diptych::probe {

// The largest row of inputs or outputs, floats.
inline constexpr std::size_t widest = 48;

struct Probe {
    std::string group;    // "operations"
    std::string name;     // "a / b"
    std::string inputs;   // description of the inputs and their distribution
    std::string unit;     // of errors: "ULP"
    std::string because;  // reason for the allowed error
    // A shader of compare/probe/shaders and the index of its function; empty: runs `host`.
    std::string shader;
    std::uint32_t function = 0;
    // Specialization constants: index and value.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> features{};
    std::function<void(const float* in, float* out)> host{};

    std::size_t ins = 1, outs = 1;  // floats in a row
    std::size_t rows = 1u << 16;
    std::size_t line = 1;  // number of rows evaluated together

    std::function<void(Random&, std::size_t row, float* in)> make{};
    // The exact outputs in double, for inputs already rounded to float.
    std::function<void(const float* in, double* expected)> definition{};
    // The allowed error of each output.
    std::function<void(const float* in, double* allowed)> allowance{};
    // Outputs of a device as inexact as Vulkan allows; for tests.
    std::function<void(const float* in, float* out)> inexact{};
    // The unit of an output's error; empty: the ULP of the expected value.
    std::function<double(const float* in, std::size_t output, double expected)> step{};
    // Evaluates a line of rows, instead of definition and allowance.
    std::function<void(const float* in, const float* out, Tally&)> evaluate{};

    // Along a line, output 0 only grows (1) or only falls (-1); 0: not checked.
    int monotone = 0;
    // All operations preserve order on any device, so a step back is a failure. Otherwise steps back are
    // only counted.
    bool strict = false;
};

// Sets allowance and inexact from the shader's operations, `operations(const N* in, N* out)`, for N =
// Interval and N = Inexact. The interval contains both the device's and the exact result, so its width
// limits their difference.
template <class Operations>
void setOperations(Probe& probe, Operations operations) {
    probe.allowance = [operations, n = probe.ins, m = probe.outs](const float* in, double* allowed) {
        std::array<Interval, widest> from, to;
        for (std::size_t i = 0; i < n; ++i) from[i] = in[i];
        operations(from.data(), to.data());
        for (std::size_t i = 0; i < m; ++i) allowed[i] = to[i].width();
    };
    probe.inexact = [operations, n = probe.ins, m = probe.outs](const float* in, float* out) {
        std::array<Inexact, widest> from, to;
        for (std::size_t i = 0; i < n; ++i) from[i] = in[i];
        operations(from.data(), to.data());
        for (std::size_t i = 0; i < m; ++i) out[i] = to[i].value;
    };
}

// A value that grows along a line of `line` rows: evenly over [from, to], or in every second line float by
// float from a random start.
float onLine(std::size_t row, std::size_t line, double from, double to);

// Inputs of `rows` rows, starting at row `first`.
std::vector<float> inputsOf(const Probe& probe, std::size_t first, std::size_t rows);

// Evaluates complete lines of results.
Tally evaluated(const Probe& probe, std::size_t first, const std::vector<float>& in,
                const std::vector<float>& out);

}  // namespace diptych::probe
