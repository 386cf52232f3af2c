// SPDX-License-Identifier: MIT
// A probe: a shipped function of shaders/lib, or an operation of the device that they are made of, run on
// many inputs, each result held against a definition in double precision.
#pragma once

#include "compare/probe/interval.h"
#include "compare/probe/random.h"
#include "compare/probe/sloppy.h"
#include "compare/probe/tally.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace diptych::probe {

// The widest row of inputs or outputs, floats.
inline constexpr std::size_t widest = 48;

struct Probe {
    std::string group;    // "operations"
    std::string name;     // "a / b"
    std::string inputs;   // which, and how they are spread
    std::string unit;     // what errors are counted in: "ULP"
    std::string because;  // why so much is allowed
    // A shader of compare/probe/shaders, and which of its functions; empty: `host` is run instead.
    std::string shader;
    std::uint32_t function = 0;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> features{};  // specialization constants and values
    std::function<void(const float* in, float* out)> host{};

    std::size_t ins = 1, outs = 1;  // floats of a row
    std::size_t rows = 1u << 16;
    std::size_t line = 1;  // rows that are judged together

    std::function<void(Random&, std::size_t row, float* in)> make{};
    // Of each output what it is by definition, in double, from the inputs as they were rounded to float.
    std::function<void(const float* in, double* expected)> definition{};
    // How far from that a device may be.
    std::function<void(const float* in, double* allowed)> allowance{};
    // What a device might give that is as inexact as Vulkan allows; for tests.
    std::function<void(const float* in, float* out)> sloppy{};
    // What an error of an output is counted in; empty: the ULP of what is expected.
    std::function<double(const float* in, std::size_t output, double expected)> step{};
    // Instead of definition and allowance: judges a line of rows.
    std::function<void(const float* in, const float* out, Tally&)> judge{};

    // Along a line output 0 only grows (1) or only falls (-1); 0: nothing is asked.
    int monotone = 0;
    // Every operation on the way keeps the order on any device: a step back is a fault. Else it is counted.
    bool strict = false;
};

// The shader's sequence of operations, `sequence(const N* in, N* out)`, for N = Interval and N = Sloppy: a
// device's result and the exact one are both in the interval, so they are no farther apart than it is wide.
template <class Sequence>
void follow(Probe& probe, Sequence sequence) {
    probe.allowance = [sequence, n = probe.ins, m = probe.outs](const float* in, double* allowed) {
        std::array<Interval, widest> from, to;
        for (std::size_t i = 0; i < n; ++i) from[i] = in[i];
        sequence(from.data(), to.data());
        for (std::size_t i = 0; i < m; ++i) allowed[i] = to[i].width();
    };
    probe.sloppy = [sequence, n = probe.ins, m = probe.outs](const float* in, float* out) {
        std::array<Sloppy, widest> from, to;
        for (std::size_t i = 0; i < n; ++i) from[i] = in[i];
        sequence(from.data(), to.data());
        for (std::size_t i = 0; i < m; ++i) out[i] = to[i].value;
    };
}

// A number of a row in a line of `line` rows that only grows: over [from, to] evenly, or, of every second
// line, float after float from somewhere in it.
float onLine(std::size_t row, std::size_t line, double from, double to);

// `rows` rows of inputs from `first` on.
std::vector<float> inputsOf(const Probe& probe, std::size_t first, std::size_t rows);

// Judges whole lines of results.
Tally judged(const Probe& probe, std::size_t first, const std::vector<float>& in,
             const std::vector<float>& out);

}  // namespace diptych::probe
