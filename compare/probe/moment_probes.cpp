// SPDX-License-Identifier: MIT
// Moment shadow maps and their visibility.
#include "compare/probe/groups.h"
#include "compare/probe/vec.h"
#include "shared/contract/features.h"
#include "shared/contract/shadow.h"

namespace diptych::probe {
namespace {

Probe momentProbe(const char* name, std::uint32_t function, const char* inputs, const char* because) {
    Probe probe;
    probe.group = "moments";
    probe.name = name;
    probe.inputs = inputs;
    probe.unit = "ULP";
    probe.because = because;
    probe.shader = "moments.comp";
    probe.function = function;
    return probe;
}

// exponent, the other warp's, nearest depth, bleed, smallest variance, bias; 32-bit depths.
void makeShadowLight(Random& random, float* in) {
    in[0] = static_cast<float>(random.uniform(1, 40));
    in[1] = static_cast<float>(random.uniform(1, 10));
    in[2] = random.coin() ? 0 : -1;
    in[3] = random.coin() ? 0 : static_cast<float>(random.uniform(0, 0.5));
    in[4] = static_cast<float>(random.logarithmic(1e-8, 1e-3));
    in[5] = static_cast<float>(random.logarithmic(3e-5, 1e-2));
}

// Converts the map's depth, 1 toward the light, to one that grows away from it, up to 1.
double away(double depth, double nearest) {
    return 1 - (1 - nearest) * std::clamp(depth, 0.0, 1.0);
}
template <class N>
N awaySequence(N depth, N nearest) {
    const N one(1.0f), t = one - min(max(depth, N(0.0f)), one);
    return nearest * (one - t) + one * t;
}

Probe warpProbe() {
    Probe p =
        momentProbe("EVSM, four moments of a depth", 0,
                    "exponents 1 to 40 and 1 to 10; depths -0.1 to 1.1 including 0 and 1; sequences of 256",
                    "rounding in warpedMoments(): two exp()");
    p.ins = 7;
    p.outs = 4;
    p.line = 256;
    p.monotone = -1;
    p.make = [](Random&, std::size_t row, float* in) {
        Random line(row / 256);
        makeShadowLight(line, in);
        in[6] = onLine(row, 256, -0.1, 1.1);
    };
    p.definition = [](const float* in, double* out) {
        const double d = away(double{in[6]}, double{in[2]});
        out[0] = std::exp(double{in[0]} * d), out[1] = std::exp(2 * double{in[0]} * d);
        out[2] = -std::exp(-double{in[1]} * d), out[3] = std::exp(-2 * double{in[1]} * d);
    };
    setOperations(p, []<class N>(const N* in, N* out) {
        const N d = awaySequence(in[6], in[2]), w = exponential(in[0] * d), n = -exponential(-in[1] * d);
        out[0] = w, out[1] = w * w, out[2] = n, out[3] = n * n;
    });
    return p;
}

// Cantelli 1928: the fraction of a distribution at least `far` above its mean is at most var / (var +
// far^2).
Probe chebyshevProbe() {
    Probe p = momentProbe("Chebyshev's bound", 1,
                          "receivers behind the mean by 1e-12 to 1e12 standard deviations, in front of it, "
                          "and on it; variances 1e-20 to 1e20",
                          "rounding in chebyshev()");
    p.ins = 2;
    p.make = [](Random& random, std::size_t, float* in) {
        in[1] = static_cast<float>(random.logarithmic(1e-20, 1e20));
        in[0] = static_cast<float>(std::sqrt(double{in[1]}) * random.logarithmic(1e-12, 1e7));
        if (random.bits() % 8 == 0) in[0] = random.coin() ? -in[0] : 0;
    };
    p.definition = [](const float* in, double* out) {
        const double t = double{in[0]} / std::sqrt(double{in[1]});
        out[0] = t > 0 ? 1 / (1 + t * t) : 1;
    };
    setOperations(p, []<class N>(const N* in, N* out) {
        out[0] = select(isLess(N(0.0f), in[0]), in[1] / (in[1] + in[0] * in[0]), N(1.0f));
    });
    return p;
}

Probe quantisedProbe() {
    Probe p =
        momentProbe("MSM, d to d^4 and back", 2, "depths 0 to 1 including both ends; sequences of 256",
                    "rounding in both matrices, whose terms are up to 82, and their ten decimal digits");
    p.outs = 4;
    p.line = 256;
    p.unit = "ULP of 1";
    p.step = [](const float*, std::size_t, double) { return ulpOf(1); };
    p.make = [](Random&, std::size_t row, float* in) { in[0] = onLine(row, 256, 0, 1); };
    p.definition = [](const float* in, double* out) {
        const double d = 1 - double{in[0]};  // away from the light
        for (int i = 0; i < 4; ++i) out[i] = std::pow(d, i + 1);
    };
    // Peters and Klein 2015, section 4.3. Each quantised moment is a sum of terms of these sizes. Each
    // moment is a sum of quantised moments in [0, 1] with factors below 1. Each term has five roundings;
    // the matrices' product differs from the identity by up to 2e-8 of the terms.
    p.allowance = [](const float* in, double* allowed) {
        constexpr double terms[4][4] = {{2.073, 32.24, 68.58, 39.38},
                                        {13.8, 59.47, 82.04, 35.37},
                                        {0.106, 1.908, 9.35, 6.66},
                                        {9.793, 33.77, 47.95, 23.98}};
        constexpr double back[4][4] = {{0.223, 0.0772, 0.793, 0.032},
                                       {0.155, 0.1395, 0.797, 0.173},
                                       {0.146, 0.213, 0.726, 0.276},
                                       {0.164, 0.26, 0.654, 0.338}};
        const double d = 1 - double{in[0]};
        for (int i = 0; i < 4; ++i) {
            allowed[i] = 5 * 0x1p-23;
            for (int j = 0; j < 4; ++j)
                for (int k = 0; k < 4; ++k)
                    allowed[i] += back[i][j] * terms[j][k] * std::pow(d, k + 1) * (5 * 0x1p-23 + 2e-8);
        }
    };
    return p;
}

// A filter over two depths.
struct Filter {
    double near, far, fraction;
};
Filter makeFilter(Random& random) {
    const double a = random.ends(0, 1),
                 b = random.coin() ? random.ends(0, 1) : a + random.logarithmic(1e-6, 0.1);
    return {std::min(a, 1.0), std::min(b, 1.0), random.ends(0, 1)};
}

Probe visibilityProbe(bool four) {
    Probe p = momentProbe(
        four ? "EVSM, four moments: visibility" : "EVSM, two moments: visibility", 3,
        "filters over two depths, 1e-6 to 1 apart, with any weights; receivers anywhere and near them",
        "rounding in momentVisibility(); the variance suffers from cancellation");
    p.ins = 11;
    p.unit = "ULP of 1";
    p.step = [](const float*, std::size_t, double) { return ulpOf(1); };
    p.features = {{gpu::FEATURE_shadows, four ? gpu::SHADOWS_EVSM4 : gpu::SHADOWS_EVSM}};
    p.make = [](Random& random, std::size_t, float* in) {
        makeShadowLight(random, in);
        const Filter f = makeFilter(random);
        for (int i = 0; i < 4; ++i) {
            const double rate = i < 2 ? double{in[0]} * (i + 1) : -double{in[1]} * (i - 1),
                         sign = i == 2 ? -1 : 1;
            const auto w = [&](double depth) { return sign * std::exp(rate * away(depth, double{in[2]})); };
            in[6 + i] = static_cast<float>(w(f.near) * f.fraction + w(f.far) * (1 - f.fraction));
        }
        const double between = f.near + (f.far - f.near) * random.uniform(-0.5, 1.5);
        in[10] = static_cast<float>(random.coin() ? random.uniform(0, 1) : std::clamp(between, 0.0, 1.0));
    };
    // From the moments and the receiver's warped depth: a mean, a variance, and Chebyshev's bound.
    p.definition = [four](const float* in, double* out) {
        const double d = away(double{in[10]}, double{in[2]}), range = 1 - double{in[2]};
        const auto bound = [&](double mean, double square, double rate, double w) {
            const double slope = rate * range * w;
            const double variance = std::max(square - mean * mean, double{in[4]} * slope * slope);
            return w <= mean ? 1 : variance / (variance + (w - mean) * (w - mean));
        };
        const double c = double{in[0]}, k = double{in[1]};
        double fraction = 1;
        const double w = std::exp(c * d), n = -std::exp(-k * d);
        // The receiver is behind the mean if its warped depth is larger.
        fraction = bound(double{in[6]}, double{in[7]}, c, w);
        if (four) fraction = std::min(fraction, bound(double{in[8]}, double{in[9]}, k, n));
        out[0] = std::clamp((fraction - double{in[3]}) / (1 - double{in[3]}), 0.0, 1.0);
    };
    setOperations(p, [four]<class N>(const N* in, N* out) {
        const N one(1.0f), zero(0.0f), max_variance(1e30f);
        const N d = awaySequence(in[10], in[2]), range = one - in[2];
        const auto bound = [&](N behind, N variance) {
            return select(isLess(zero, behind), variance / (variance + behind * behind), one);
        };
        const N per_w = exponential(-in[0] * d), mean = in[6] * per_w, square = in[7] * per_w * per_w;
        N slope = in[0] * range;
        N fraction = bound(one - mean, min(max(square - mean * mean, in[4] * slope * slope), max_variance));
        if (four) {
            const N per_mean = one / in[8], n = -exponential(-in[1] * d) * per_mean;
            slope = in[1] * range * n;
            const N variance = max(in[9] * per_mean * per_mean - one, in[4] * slope * slope);
            fraction = min(fraction, bound(one - n, min(variance, max_variance)));
        }
        out[0] = min(max((fraction - in[3]) / (one - in[3]), zero), one);
    });
    return p;
}

// The smallest fraction before `depth` over all distributions with moments b (Akhiezer 1965, "The
// Classical Moment Problem"). Its polynomial is orthogonal to 1 and d under (d - depth) times the
// distribution. The roots are the other two positions; weights follow from moments 0, 1 and 2.
double minBefore(const std::array<double, 4>& b, double depth) {
    // Moments of (d - depth) times the distribution, and q = d^2 + u d + v with <q, 1> = <q, d> = 0.
    const double m0 = b[0] - depth, m1 = b[1] - depth * b[0], m2 = b[2] - depth * b[1],
                 m3 = b[3] - depth * b[2];
    const double det = m1 * m1 - m0 * m2, u = (m0 * m3 - m1 * m2) / det, v = (m2 * m2 - m1 * m3) / det;
    const double root = std::sqrt(std::max(u * u / 4 - v, 0.0)), x = -u / 2 - root, y = -u / 2 + root;
    const auto weight = [&](double at, double other, double third) {
        return (other * third - (other + third) * b[0] + b[1]) / ((at - other) * (at - third));
    };
    double before = 0;
    if (x < depth) before += weight(x, y, depth);
    if (y < depth) before += weight(y, x, depth);
    return std::clamp(before, 0.0, 1.0);
}

Probe hamburgerProbe() {
    Probe p = momentProbe(
        "MSM, least shadow of four moments", 4,
        "filters over three depths, at least 0.3 apart, with weights of at least 0.2, so that the moments "
        "are well conditioned; receivers at least 0.05 from them; biases 3e-5 to 1e-2",
        "rounding in threePlaces(), by interval arithmetic");
    p.ins = 6;
    p.unit = "ULP of 1";
    p.step = [](const float*, std::size_t, double) { return ulpOf(1); };
    p.make = [](Random& random, std::size_t, float* in) {
        const double a = random.uniform(0, 0.1), b = random.uniform(0.4, 0.6), c = random.uniform(0.9, 1);
        const double p0 = random.uniform(0.2, 0.4), p1 = random.uniform(0.2, 0.4), p2 = 1 - p0 - p1;
        for (int i = 0; i < 4; ++i)
            in[i] = static_cast<float>(p0 * std::pow(a, i + 1) + p1 * std::pow(b, i + 1) +
                                       p2 * std::pow(c, i + 1));
        double depth = random.uniform(0, 1);
        for (const double position : {a, b, c})
            if (std::abs(depth - position) < 0.05) depth = position + 0.075;
        in[4] = static_cast<float>(depth);
        in[5] = static_cast<float>(random.logarithmic(3e-5, 1e-2));
    };
    p.definition = [](const float* in, double* out) {
        std::array<double, 4> b{};
        for (std::size_t i = 0; i < 4; ++i) b[i] = double{in[i]} * (1 - double{in[5]}) + 0.5 * double{in[5]};
        out[0] = minBefore(b, double{in[4]});
    };
    setOperations(p, []<class N>(const N* in, N* out) {
        const N one(1.0f), zero(0.0f), half(0.5f), tiny(1e-20f), depth = in[4];
        N b[4];
        for (int i = 0; i < 4; ++i) b[i] = in[i] * (one - in[5]) + half * in[5];
        const N l32_d22 = b[2] - b[0] * b[1], d22 = max(b[1] - b[0] * b[0], N(1e-9f));
        const N d33_d22 = max((b[3] - b[1] * b[1]) * d22 - l32_d22 * l32_d22, tiny), l32 = l32_d22 / d22;
        N c1 = depth - b[0];
        const N c2 = (depth * depth - b[1] - l32 * c1) * (d22 / d33_d22);
        c1 = c1 / d22 - l32 * c2;
        const N c0 = one - c1 * b[0] - c2 * b[1];
        const N scale = select(isLess(tiny, size(c2)), c2, tiny), q = half * c1 / scale;
        const N r = root(max(q * q - c0 / scale, zero)), x = -q - r, y = -q + r;
        const N at = (x * y - b[0] * (x + y) + b[1]) / ((depth - x) * (depth - y));
        const N first = (depth * y - b[0] * (depth + y) + b[1]) / ((y - x) * (depth - x));
        const N before = select(isLess(y, depth), one - at, select(isLess(x, depth), first, zero));
        out[0] = min(max(before, zero), one);
    });
    return p;
}

// For any stored and filtered moments, even impossible ones, the result is a fraction.
Probe anyMomentsProbe(const char* name, std::uint32_t shadows) {
    Probe p = momentProbe(name, 3,
                          "moments of no distribution: 0, 1, numbers from 0 to 1 and of all magnitudes, four "
                          "at a time; receivers 0 to 1 including both ends",
                          "visibility is from 0 to 1, never NaN");
    p.ins = 11;
    p.rows = 1u << 15;
    p.features = {{gpu::FEATURE_shadows, shadows}};
    p.make = [shadows](Random& random, std::size_t, float* in) {
        makeShadowLight(random, in);
        for (int i = 0; i < 4; ++i) {
            const double max_value = shadows == gpu::SHADOWS_MSM4 ? 1 : 1e34;
            in[6 + i] =
                static_cast<float>(random.coin() ? random.ends(0, 1) : random.logarithmic(1e-30, max_value));
        }
        in[8] = shadows == gpu::SHADOWS_EVSM4 ? -in[8] : in[8];
        in[10] = static_cast<float>(random.ends(0, 1));
    };
    p.evaluate = [](const float*, const float* out, Tally& tally) {
        tally.value(tally.first_row, 0, out[0], std::clamp(double{out[0]}, 0.0, 1.0), 0, 1);
    };
    return p;
}

}  // namespace

std::vector<Probe> momentProbes() {
    return {warpProbe(),
            chebyshevProbe(),
            visibilityProbe(false),
            visibilityProbe(true),
            anyMomentsProbe("EVSM of any two moments", gpu::SHADOWS_EVSM),
            anyMomentsProbe("EVSM of any four moments", gpu::SHADOWS_EVSM4),
            quantisedProbe(),
            hamburgerProbe(),
            anyMomentsProbe("MSM of any moments", gpu::SHADOWS_MSM4)};
}

}  // namespace diptych::probe
