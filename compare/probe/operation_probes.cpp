// SPDX-License-Identifier: MIT
// Device operations.
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

// Positive, log-uniform.
void positive(Probe& p) {
    p.make = [](Random& random, std::size_t, float* in) {
        in[0] = static_cast<float>(random.logarithmic(0x1p-100, 0x1p100));
    };
}

template <class Exact, class Operations>
void unary(Probe& p, Exact exact, Operations operations) {
    p.definition = [exact](const float* in, double* out) { out[0] = exact(double{in[0]}); };
    setOperations(p, [operations](const auto* in, auto* out) { out[0] = operations(in[0]); });
}

template <class Exact, class Operations>
void binary(Probe& p, Exact exact, Operations operations) {
    p.ins = 2;
    p.make = [](Random& random, std::size_t, float* in) {
        in[0] = signedMagnitude(random, 0x1p-60, 0x1p60);
        // Half of the pairs have nearly equal magnitudes, where sums cancel.
        in[1] = random.coin() ? signedMagnitude(random, 0x1p-60, 0x1p60)
                              : static_cast<float>(-double{in[0]} * random.uniform(0.5, 2));
    };
    p.definition = [exact](const float* in, double* out) { out[0] = exact(double{in[0]}, double{in[1]}); };
    setOperations(p, [operations](const auto* in, auto* out) { out[0] = operations(in[0], in[1]); });
}

const char* const magnitudes = "|a|, |b| from 2^-60 to 2^60, log-uniform, half of them cancelling";
const char* const correct = "Vulkan: correctly rounded, up or down";

Probe sumProbe() {
    Probe p = operation("a + b", 9, magnitudes, correct);
    binary(
        p, [](double a, double b) { return a + b; }, [](auto a, auto b) { return a + b; });
    return p;
}

Probe productProbe() {
    Probe p = operation("a * b", 10, magnitudes, correct);
    binary(
        p, [](double a, double b) { return a * b; }, [](auto a, auto b) { return a * b; });
    return p;
}

Probe divisionProbe() {
    Probe p = operation("a / b", 0, magnitudes, "Vulkan: 2.5 ULP");
    binary(
        p, [](double a, double b) { return a / b; }, [](auto a, auto b) { return a / b; });
    return p;
}

Probe fmaProbe() {
    Probe p =
        operation("fma(a, b, c)", 11, "|a|, |b| from 2^-20 to 2^20; c as large as their product, or any",
                  "Vulkan: as a * b + c, correctly rounded once or twice");
    p.ins = 3;
    p.make = [](Random& random, std::size_t, float* in) {
        in[0] = signedMagnitude(random, 0x1p-20, 0x1p20);
        in[1] = signedMagnitude(random, 0x1p-20, 0x1p20);
        const double product = double{in[0]} * double{in[1]};
        in[2] = random.coin() ? signedMagnitude(random, 0x1p-20, 0x1p20)
                              : static_cast<float>(-product * random.uniform(0.5, 2));
    };
    p.definition = [](const float* in, double* out) {
        out[0] = std::fma(double{in[0]}, double{in[1]}, double{in[2]});
    };
    p.unit = "ULP of sum";
    p.step = [](const float* in, std::size_t, double) {
        return ulpOf(std::abs(double{in[0]} * double{in[1]}) + std::abs(double{in[2]}));
    };
    setOperations(p, [](const auto* in, auto* out) { out[0] = in[0] * in[1] + in[2]; });
    return p;
}

Probe dotProbe() {
    Probe p = operation("dot(a, b)", 16, "components from -1 to 1, half of the vectors nearly perpendicular",
                        "Vulkan: three products and two sums in any order");
    p.ins = 6;
    p.make = [](Random& random, std::size_t, float* in) {
        for (int i = 0; i < 6; ++i) in[i] = static_cast<float>(random.uniform(-1, 1));
        if (random.coin())
            in[5] = static_cast<float>(-(double{in[0]} * double{in[3]} + double{in[1]} * double{in[4]}) /
                                       double{in[2]} * random.uniform(0.999, 1.001));
    };
    p.definition = [](const float* in, double* out) {
        out[0] = 0;
        for (int i = 0; i < 3; ++i) out[0] += double{in[i]} * double{in[i + 3]};
    };
    p.unit = "ULP of 1";
    p.step = [](const float*, std::size_t, double) { return ulpOf(1); };
    setOperations(
        p, [](const auto* in, auto* out) { out[0] = sumOf(in[0] * in[3], in[1] * in[4], in[2] * in[5]); });
    return p;
}

Probe inverseRootProbe() {
    Probe p = operation("inversesqrt(a)", 1, "a from 2^-100 to 2^100, log-uniform", "Vulkan: 2 ULP");
    positive(p);
    unary(
        p, [](double a) { return 1 / std::sqrt(a); }, [](auto a) { return inverseRoot(a); });
    return p;
}

Probe rootProbe() {
    Probe p = operation("sqrt(a)", 2, "a from 2^-100 to 2^100, log-uniform", "Vulkan: as 1 / inversesqrt(a)");
    positive(p);
    unary(
        p, [](double a) { return std::sqrt(a); }, [](auto a) { return root(a); });
    return p;
}

void exponents(Probe& p, double from, double to) {
    p.make = [from, to](Random& random, std::size_t, float* in) {
        in[0] = random.coin() ? static_cast<float>(random.uniform(from, to))
                              : signedMagnitude(random, 0x1p-20, 64);
    };
}

Probe exp2Probe() {
    Probe p = operation("exp2(a)", 3, "a from -126 to 127, half of them small", "Vulkan: 3 + 2 |a| ULP");
    exponents(p, -126, 127);
    unary(
        p, [](double a) { return std::exp2(a); }, [](auto a) { return powerOfTwo(a); });
    return p;
}

Probe expProbe() {
    Probe p = operation("exp(a)", 4, "a from -87 to 88, half of them small", "Vulkan: 3 + 2 |a| ULP");
    exponents(p, -87, 88);
    unary(
        p, [](double a) { return std::exp(a); }, [](auto a) { return exponential(a); });
    return p;
}

void aroundOne(Probe& p) {
    p.make = [](Random& random, std::size_t, float* in) {
        in[0] = static_cast<float>(random.coin() ? random.logarithmic(0x1p-100, 0x1p100)
                                                 : random.uniform(0.5, 2));
    };
}

Probe log2Probe() {
    Probe p = operation("log2(a)", 5, "a from 2^-100 to 2^100, half of them from 0.5 to 2",
                        "Vulkan: 3 ULP; 2^-21 for a from 0.5 to 2");
    aroundOne(p);
    unary(
        p, [](double a) { return std::log2(a); }, [](auto a) { return binaryLogarithm(a); });
    return p;
}

Probe logProbe() {
    Probe p = operation("log(a)", 6, "a from 2^-100 to 2^100, half of them from 0.5 to 2",
                        "Vulkan: 3 ULP; 2^-21 for a from 0.5 to 2");
    aroundOne(p);
    unary(
        p, [](double a) { return std::log(a); }, [](auto a) { return naturalLogarithm(a); });
    return p;
}

void angles(Probe& p) {
    p.unit = "ULP of 1";
    p.step = [](const float*, std::size_t, double) { return ulpOf(1); };
    p.make = [](Random& random, std::size_t, float* in) {
        in[0] = static_cast<float>(random.uniform(-std::numbers::pi, std::numbers::pi));
    };
}

Probe sinProbe() {
    Probe p = operation("sin(a)", 7, "a from -pi to pi", "Vulkan: 2^-11");
    angles(p);
    unary(
        p, [](double a) { return std::sin(a); }, [](auto a) { return sine(a); });
    return p;
}

Probe cosProbe() {
    Probe p = operation("cos(a)", 8, "a from -pi to pi", "Vulkan: 2^-11");
    angles(p);
    unary(
        p, [](double a) { return std::cos(a); }, [](auto a) { return cosine(a); });
    return p;
}

Probe halfProbe() {
    Probe p = operation("packHalf2x16 and back", 12, "|a| from 2^-24 to 65504, log-uniform",
                        "Vulkan: rounded to either neighbour; values below 2^-14 may be 0");
    p.unit = "ULP of half";
    // Halves have eleven bits from 2^-14 on.
    const auto step = [](double x) { return std::max(ulpOf(x) * 0x1p13, 0x1p-24); };
    p.make = [](Random& random, std::size_t, float* in) { in[0] = signedMagnitude(random, 0x1p-24, 65504); };
    p.definition = [](const float* in, double* out) { out[0] = double{in[0]}; };
    p.allowance = [step](const float* in, double* allowed) {
        const double x = std::abs(double{in[0]});
        allowed[0] = x < 0x1p-14 ? std::max(x, step(x)) : step(x);
    };
    p.step = [step](const float*, std::size_t, double expected) { return step(expected); };
    return p;
}

Probe floorProbe() {
    Probe p = operation("floor(a)", 13, "|a| from 2^-20 to 2^30, log-uniform", "Vulkan: exact");
    p.make = [](Random& random, std::size_t, float* in) { in[0] = signedMagnitude(random, 0x1p-20, 0x1p30); };
    unary(
        p, [](double a) { return std::floor(a); }, [](auto a) { return floorOf(a); });
    return p;
}

Probe integerProbe() {
    Probe p = operation("uint to float", 14, "integers of up to 32 bits, every bit count equally often",
                        "Vulkan: correctly rounded, up or down");
    p.make = [](Random& random, std::size_t, float* in) {
        in[0] = std::bit_cast<float>(static_cast<std::uint32_t>(random.logarithmic(1, 4294967295.0)));
    };
    p.definition = [](const float* in, double* out) {
        out[0] = static_cast<double>(std::bit_cast<std::uint32_t>(in[0]));
    };
    p.allowance = [](const float* in, double* allowed) {
        const double x = std::bit_cast<std::uint32_t>(in[0]);
        allowed[0] = floatAbove(x) - floatBelow(x);
    };
    return p;
}

}  // namespace

std::vector<Probe> operationProbes() {
    return {sumProbe(),  productProbe(), divisionProbe(), fmaProbe(),    dotProbe(), inverseRootProbe(),
            rootProbe(), exp2Probe(),    expProbe(),      log2Probe(),   logProbe(), sinProbe(),
            cosProbe(),  halfProbe(),    floorProbe(),    integerProbe()};
}

}  // namespace diptych::probe
