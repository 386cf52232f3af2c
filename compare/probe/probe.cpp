// SPDX-License-Identifier: MIT
#include "compare/probe/probe.h"

#include <algorithm>
#include <cmath>

namespace diptych::probe {

float onLine(std::size_t row, std::size_t line, double from, double to) {
    Random random(row / line);
    const double position = static_cast<double>(row % line), offset = random.unit(),
                 start = random.ends(from, to);
    if (row / line % 2 == 0)
        return static_cast<float>(from + (to - from) * (position + offset) / static_cast<double>(line));
    return static_cast<float>(std::min(start + position * ulpOf(start), to));
}

std::vector<float> inputsOf(const Probe& probe, std::size_t first, std::size_t rows) {
    std::uint64_t name = 0;
    for (const char c : probe.name) name = name * 131 + static_cast<unsigned char>(c);
    std::vector<float> in(rows * probe.ins);
    for (std::size_t i = 0; i < rows; ++i) {
        Random random(name * 1000003 + first + i);
        probe.make(random, first + i, &in[i * probe.ins]);
    }
    return in;
}

namespace {

void evaluateRow(const Probe& probe, std::size_t row, const float* in, const float* out, Tally& tally) {
    std::array<double, widest> expected{}, allowed{};
    probe.definition(in, expected.data());
    probe.allowance(in, allowed.data());
    for (std::size_t k = 0; k < probe.outs; ++k) {
        const double e = expected[k];
        // Values below the normal range may be flushed to 0: they are evaluated, but not counted in ULP.
        const double step = probe.step                           ? probe.step(in, k, e)
                            : std::abs(e) < min_normal && e != 0 ? 0
                                                                 : ulpOf(e);
        tally.value(row, k, out[k], e, allowed[k], step);
    }
}

void evaluateOrder(const Probe& probe, std::size_t row, const float* out, Tally& tally) {
    for (std::size_t i = 1; i < probe.line; ++i) {
        const float before = out[(i - 1) * probe.outs], after = out[i * probe.outs];
        if ((static_cast<double>(after) - static_cast<double>(before)) * probe.monotone < 0)
            tally.back(row + i, before, after);
    }
}

}  // namespace

Tally evaluated(const Probe& probe, std::size_t first, const std::vector<float>& in,
                const std::vector<float>& out) {
    Tally tally;
    const std::size_t rows = in.size() / probe.ins;
    for (std::size_t i = 0; i + probe.line <= rows; i += probe.line) {
        const float *from = &in[i * probe.ins], *to = &out[i * probe.outs];
        tally.first_row = first + i;
        if (probe.evaluate)
            probe.evaluate(from, to, tally);
        else
            for (std::size_t k = 0; k < probe.line; ++k)
                evaluateRow(probe, first + i + k, from + k * probe.ins, to + k * probe.outs, tally);
        if (probe.monotone != 0) evaluateOrder(probe, first + i, to, tally);
    }
    return tally;
}

}  // namespace diptych::probe
