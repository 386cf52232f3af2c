// SPDX-License-Identifier: MIT
// What a device does, operation by operation.
#include "compare/probe/groups.h"

namespace diptych::probe {
namespace {

Probe operation(const char* name, std::uint32_t function, const char* inputs, const char* because) {
    Probe probe;
    probe.group = "operations";
    probe.name = name;
    probe.inputs = inputs;
    probe.unit = "ULP";
    probe.because = because;
    probe.shader = "operations.comp";
    probe.function = function;
    probe.rows = 1u << 17;
    return probe;
}

float signedMagnitude(Random& random, double from, double to) {
    const double x = random.logarithmic(from, to);
    return static_cast<float>(random.coin() ? x : -x);
}

Probe division() {
    Probe p = operation("a / b", 0, "|a|, |b| in 2^-60 to 2^60, every magnitude alike", "Vulkan: 2.5 ULP");
    p.ins = 2;
    p.make = [](Random& random, std::size_t, float* in) {
        in[0] = signedMagnitude(random, 0x1p-60, 0x1p60);
        in[1] = signedMagnitude(random, 0x1p-60, 0x1p60);
    };
    p.definition = [](const float* in, double* out) { out[0] = double{in[0]} / double{in[1]}; };
    follow(p, [](const auto* in, auto* out) { out[0] = in[0] / in[1]; });
    return p;
}

Probe exp2Probe() {
    Probe p = operation("exp2(a)", 3, "a in -126 to 127", "Vulkan: 3 + 2 |a| ULP");
    p.make = [](Random& random, std::size_t, float* in) {
        in[0] = random.coin() ? static_cast<float>(random.uniform(-126, 127))
                              : signedMagnitude(random, 0x1p-20, 64);
    };
    p.definition = [](const float* in, double* out) { out[0] = std::exp2(double{in[0]}); };
    follow(p, [](const auto* in, auto* out) { out[0] = powerOfTwo(in[0]); });
    return p;
}

}  // namespace

std::vector<Probe> operationProbes() {
    return {division(), exp2Probe()};
}

}  // namespace diptych::probe
