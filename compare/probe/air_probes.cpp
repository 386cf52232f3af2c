// SPDX-License-Identifier: MIT
// Haze: the medium along a ray, its transmittance and in-scattering.
#include "compare/probe/groups.h"
#include "compare/probe/vec.h"
#include "shared/contract/features.h"
#include "shared/contract/haze.h"

namespace diptych::probe {
namespace {

Probe airProbe(const char* name, std::uint32_t function, const char* inputs, const char* because) {
    Probe probe;
    probe.group = "haze";
    probe.name = name;
    probe.inputs = inputs;
    probe.unit = "ULP";
    probe.because = because;
    probe.shader = "air.comp";
    probe.function = function;
    return probe;
}

// exponential() of air.glsl is accurate to 2e-7 of its value, and uses only sums, products and a floor. If
// these round up or down instead of to nearest, each errs by twice as much. Its last product, with a power
// of two, may be a denormal, which Vulkan may flush to 0.
constexpr double exponential_promise = 4e-7, exponential_flush = min_normal;

constexpr auto exact_exp = [](double x) { return std::exp(x); };
constexpr auto exact_expm1 = [](double x) { return std::expm1(x); };

Probe exponentialProbe() {
    Probe p = airProbe("e^x and e^x - 1", 0,
                       "x from -87 to 60 including both ends, half of them small down to 1e-12",
                       "2e-7, its polynomial's error bound; twice that if sums are rounded up or down");
    p.outs = 2;
    p.rows = 1u << 17;
    p.make = [](Random& random, std::size_t, float* in) {
        const double small = random.logarithmic(1e-12, 60);
        in[0] = static_cast<float>(random.coin() ? random.ends(-87, 60) : random.coin() ? small : -small);
    };
    p.definition = [](const float* in, double* out) {
        out[0] = std::exp(double{in[0]}), out[1] = std::expm1(double{in[0]});
    };
    setOperations(p, [](const auto* in, auto* out) {
        out[0] = monotoneOf(in[0], exact_exp, exponential_promise, exponential_flush);
        out[1] = monotoneOf(in[0], exact_expm1, exponential_promise, exponential_flush);
    });
    // The accuracy holds for exp and expm1.
    p.allowance = [](const float* in, double* allowed) {
        allowed[0] = std::exp(double{in[0]}) * exponential_promise + 2 * exponential_flush;
        allowed[1] = std::abs(std::expm1(double{in[0]})) * exponential_promise + 2 * exponential_flush;
    };
    return p;
}

// The equivalent metres of air at height 0 along `reach` metres that rise by `rise`: the integral of the
// density exp(-height / H).
double airByDefinition(double height, double rise, double reach, double inverse_height) {
    const double lower = height + std::min(rise, 0.0), x = std::abs(rise) * inverse_height;
    const double density = std::exp(std::clamp(-lower * inverse_height, -87.0, 60.0));
    const double mean = x < 1e-12 ? 1 : -std::expm1(-x) / x;
    return std::min(density * mean * reach, double{gpu::HAZE_OPAQUE_METRES});
}

Probe alongProbe() {
    Probe p = airProbe(
        "air along a ray", 1,
        "rays from -10 to 100 km, 1 mm to 1e7 m long, up, down and level; scale heights 1 m to 100 km",
        "rounding in airAlong() and exponential()'s error bound");
    p.ins = 4;
    p.make = [](Random& random, std::size_t, float* in) {
        const double reach = random.logarithmic(1e-3, 1e7), up = random.coin() ? random.uniform(-1, 1) : 0;
        const double slight = (random.coin() ? 1 : -1) * random.logarithmic(1e-12, 1);
        in[0] = static_cast<float>(random.coin() ? random.uniform(-1e4, 1e5) : random.logarithmic(1e-3, 1e5));
        in[1] = static_cast<float>(reach * (random.bits() % 4 ? up : slight));
        in[2] = static_cast<float>(reach);
        in[3] = static_cast<float>(1 / random.logarithmic(1, 1e5));
    };
    // Denormal intermediate results have fewer bits.
    p.step = [](const float*, std::size_t, double expected) {
        return expected < 1e-30 ? 0 : ulpOf(expected);
    };
    p.definition = [](const float* in, double* out) {
        out[0] = airByDefinition(double{in[0]}, double{in[1]}, double{in[2]}, double{in[3]});
    };
    setOperations(p, []<class N>(const N* in, N* out) {
        const N low = in[0] + min(in[1], N(0.0f)), x = max(size(in[1]) * in[3], N(1e-30f));
        const N whole = monotoneOf(min(max(-low * in[3], N(-87.0f)), N(60.0f)), exact_exp,
                                   exponential_promise, exponential_flush);
        const N lost = monotoneOf(-min(x, N(87.0f)), exact_expm1, exponential_promise, exponential_flush);
        out[0] = min(in[2] * (whole * (-lost / x)), N(gpu::HAZE_OPAQUE_METRES));
    });
    return p;
}

Probe beyondProbe() {
    Probe p = airProbe("air of an endless ray", 2,
                       "rays from -10 to 100 km, elevations from level (infinite) to the zenith; scale "
                       "heights 1 m to 100 km",
                       "rounding in airBeyond() and exponential()'s error bound");
    p.ins = 3;
    p.make = [](Random& random, std::size_t, float* in) {
        in[0] = static_cast<float>(random.coin() ? random.uniform(-1e4, 1e5) : random.logarithmic(1e-3, 1e5));
        in[1] = static_cast<float>(random.bits() % 8 ? random.logarithmic(1e-10, 1) : random.uniform(-1, 0));
        in[2] = static_cast<float>(1 / random.logarithmic(1, 1e5));
    };
    p.definition = [](const float* in, double* out) {
        const double density = std::exp(std::clamp(-double{in[0]} * double{in[2]}, -87.0, 60.0));
        const double opaque = double{gpu::HAZE_OPAQUE_METRES};
        out[0] = in[1] > 0 ? std::min(density / (double{in[1]} * double{in[2]}), opaque) : opaque;
    };
    setOperations(p, []<class N>(const N* in, N* out) {
        const N whole = monotoneOf(min(max(-in[0] * in[2], N(-87.0f)), N(60.0f)), exact_exp,
                                   exponential_promise, exponential_flush);
        const N opaque(gpu::HAZE_OPAQUE_METRES);
        out[0] = select(isLess(N(0.0f), in[1]), min(whole / max(in[1] * in[2], N(1e-30f)), opaque), opaque);
    });
    return p;
}

Probe hazeProbe() {
    Probe p = airProbe("transmittance, scattered light", 3,
                       "extinctions 1e-7 to 1 1/m, path lengths 1 mm to 1e8 m, any direction including the "
                       "sun's; aerosol forward scattering 0 to 0.95; sequences of 64 with growing length",
                       "rounding in hazeOfAir() and exponential()'s error bound; a float32 direction is only "
                       "nearly of length 1");
    p.ins = 24;
    p.outs = 6;
    p.line = 64;
    p.monotone = -1;
    p.features = {{gpu::FEATURE_haze, gpu::HAZE_THERE | gpu::HAZE_SUN | gpu::HAZE_AMBIENT}};
    p.make = [](Random&, std::size_t row, float* in) {
        Random line(row / 64);
        for (int i = 0; i < 24; ++i) in[i] = static_cast<float>(line.uniform(0, 1));
        for (int i = 0; i < 3; ++i) in[i] = static_cast<float>(line.logarithmic(1e-7, 1));
        const Vec<double> sun = randomDirection(line);
        put(sun, in + 4);
        const double g = line.uniform(0, 0.95);
        in[11] = static_cast<float>((1 - g) * (1 - g)), in[15] = static_cast<float>(g);
        put(line.coin() ? randomDirection(line) : rotatedTo(sun, atAngle(line, line.logarithmic(1e-6, 1))),
            in + 20);
        in[23] = static_cast<float>(1e-3 * std::exp2(static_cast<double>(row % 64) * 36.5 / 63));
    };
    p.step = [](const float*, std::size_t, double expected) {
        return expected < min_normal ? 0 : ulpOf(expected);
    };
    // Beer-Lambert, Rayleigh's phase function, and that of Cornette and Shanks 1992, by the angle.
    p.definition = [](const float* in, double* out) {
        const double cosine = dot(unit(exactVec(in + 20)), unit(exactVec(in + 4)));
        // phase_0 is (1 - g)^2, so 1 + g^2 - 2 g cos is phase_0 + 2 g (1 - cos).
        const double k = double{in[11]} + 2 * double{in[15]} * (1 - cosine), both = 1 + cosine * cosine;
        for (int c = 0; c < 3; ++c) {
            const double depth = std::min(double{in[c]} * double{in[23]}, 87.0);
            const double source =
                double{in[8 + c]} * both + double{in[12 + c]} * both * std::pow(k, -1.5) + double{in[16 + c]};
            out[c] = std::exp(-depth), out[3 + c] = source * -std::expm1(-depth);
        }
    };
    setOperations(p, []<class N>(const N* in, N* out) {
        const N one(1.0f);
        const Vec<N> apart = nearlyUnit(vecAt(in + 20)) - nearlyUnit(vecAt(in + 4));
        const N d2 = dot(apart, apart), cosine = one - N(0.5f) * d2, k = in[11] + in[15] * d2;
        const N both = one + cosine * cosine, lobe = both / (k * root(k));
        for (int c = 0; c < 3; ++c) {
            const N depth = -min(in[c] * in[23], N(87.0f));
            out[c] = monotoneOf(depth, exact_exp, exponential_promise, exponential_flush);
            const N source = in[8 + c] * both + in[12 + c] * lobe + in[16 + c];
            out[3 + c] = source * -monotoneOf(depth, exact_expm1, exponential_promise, exponential_flush);
        }
    });
    return p;
}

Probe logRatioProbe() {
    Probe p =
        airProbe("-ln(1 - z) / z", 4,
                 "z from 0 to 0.9999999 including both ends, half of them down to 1e-9; sequences of 256",
                 "below 0.01 a series truncated at 0.01^4 / 5; above it a logarithm");
    p.line = 256;
    p.monotone = 1;
    p.make = [](Random&, std::size_t row, float* in) {
        in[0] = onLine(row, 256, 0, row / 256 % 3 ? 0.9999999 : 0.02);
    };
    p.definition = [](const float* in, double* out) {
        const double z = std::min(double{in[0]}, double{0.9999999f});
        out[0] = z < 1e-12 ? 1 : -std::log1p(-z) / z;
    };
    setOperations(p, []<class N>(const N* in, N* out) {
        const N one(1.0f), w = min(in[0], N(0.9999999f));
        const N series = one + w * (N(0.5f) + w * (N(0.33333333f) + w * N(0.25f)));
        const N ratio = -naturalLogarithm(one - w) / max(w, N(0.0099f));
        out[0] = select(isLess(w, N(0.01f)), approximating(series, 0.01 * 0.01 * 0.01 * 0.01 / 5), ratio);
    });
    return p;
}

}  // namespace

std::vector<Probe> airProbes() {
    return {exponentialProbe(), alongProbe(), beyondProbe(), hazeProbe(), logRatioProbe()};
}

}  // namespace diptych::probe
