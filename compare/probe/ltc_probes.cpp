// SPDX-License-Identifier: MIT
// Polygonal lights under linearly transformed cosines.
#include "compare/probe/groups.h"
#include "compare/probe/vec.h"
#include "shared/contract/constants.h"

namespace diptych::probe {
namespace {

Probe ltcProbe(const char* name, std::uint32_t function, const char* inputs, const char* because) {
    Probe probe;
    probe.group = "area lights";
    probe.name = name;
    probe.inputs = inputs;
    probe.unit = "ULP of 1";
    probe.because = because;
    probe.shader = "ltc.comp";
    probe.function = function;
    probe.step = [](const float*, std::size_t, double) { return ulpOf(1); };
    return probe;
}

// arcRatio() of angles.glsl: accurate to 6e-7, plus seven sums and seven products of up to one ULP each.
constexpr double arc_promise = 6e-7 + 14 * 0x1p-23;
constexpr auto exact_arc = [](double x) {
    return x >= 1 ? 1 : std::acos(std::max(x, 0.0)) / std::sqrt(1 - std::max(x, 0.0) * std::max(x, 0.0));
};

template <class N>
N ratioSequence(N cosine, N sine) {
    const N ratio = monotoneOf(min(size(cosine), N(1.0f)), exact_arc, arc_promise);
    return select(isLess(cosine, N(0.0f)), N(gpu::PI) / max(sine, N(1e-15f)) - ratio, ratio);
}

Probe angleProbe() {
    Probe p =
        ltcProbe("angle of a cosine and sine", 0, "angles 0 to 3.14, half of them near an end, down to 1e-6",
                 "6e-7, the error bound of arcRatio()'s polynomial, and its sums and products");
    p.unit = "ULP";
    p.step = {};
    p.ins = p.outs = 2;
    p.make = [](Random& random, std::size_t, float* in) {
        const double small = random.logarithmic(1e-6, 3.14),
                     angle = random.coin() ? random.uniform(0, 3.14) : small;
        in[0] = static_cast<float>(std::cos(angle)), in[1] = static_cast<float>(std::sin(angle));
    };
    p.definition = [](const float* in, double* out) {
        const double angle = std::atan2(double{in[1]}, double{in[0]});
        out[0] = angle;
        out[1] = angle / double{in[1]};
    };
    // The pair is rounded: both functions use the component that determines the angle best, the definition
    // uses both.
    setOperations(p, []<class N>(const N* in, N* out) {
        const N small = monotoneOf(min(size(in[0]), N(1.0f)), exact_arc, arc_promise) * in[1];
        const N angle = select(isLess(in[0], N(0.0f)), N(gpu::PI) - small, small);
        out[0] = approximating(angle, 0x1p-22);
        out[1] = approximating(ratioSequence(in[0], in[1]), 0x1p-22);
    });
    return p;
}

template <class N>
Vec<N> unitSequence(Vec<N> v) {
    return v * inverseRoot(max(dot(v, v), N(1e-37f)));
}
template <class N>
Vec<N> edgeSequence(Vec<N> from, Vec<N> to) {
    const Vec<N> p = unitSequence(from), q = unitSequence(to), c = cross(p, q);
    return c * (ratioSequence(dot(p, q), root(dot(c, c))) * N(0.5f) * N(gpu::INVERSE_PI));
}

// Lambert 1760: the angle between the vectors, along their common normal, over 2 pi.
Vec<double> edgeByDefinition(Vec<double> from, Vec<double> to) {
    const Vec<double> c = cross(from, to);
    const double l = length(c);
    return l > 0 ? c * (std::atan2(l, dot(from, to)) / (l * 2 * std::numbers::pi)) : Vec<double>{0, 0, 0};
}

Probe edgeProbe() {
    Probe p = ltcProbe("an edge of an outline", 1, "directions of length 1e-6 to 1e6, from 1e-5 to 3.1 apart",
                       "rounding in edgeFactor()");
    p.ins = 6;
    p.outs = 3;
    p.make = [](Random& random, std::size_t, float* in) {
        const Vec<double> from = randomDirection(random);
        const double apart = random.coin() ? random.uniform(0, 3.1) : random.logarithmic(1e-5, 3.1);
        put(from * random.logarithmic(1e-6, 1e6), in);
        put(rotatedTo(from, atAngle(random, apart)) * random.logarithmic(1e-6, 1e6), in + 3);
    };
    p.definition = [](const float* in, double* out) {
        const Vec<double> e = edgeByDefinition(exactVec(in), exactVec(in + 3));
        out[0] = e.x, out[1] = e.y, out[2] = e.z;
    };
    setOperations(p, []<class N>(const N* in, N* out) {
        const Vec<N> e = edgeSequence(vecAt(in), vecAt(in + 3));
        out[0] = e.x, out[1] = e.y, out[2] = e.z;
    });
    return p;
}

Vec<double> toCosine(const float* m, Vec<double> l) {
    return {(l.x - double{m[2]} * l.z) * double{m[0]}, l.y * double{m[1]}, l.z};
}
template <class N>
Vec<N> toCosineSequence(const N* m, Vec<N> l) {
    return {(l.x - m[2] * l.z) * m[0], l.y * m[1], l.z};
}

// Clips at the horizon (Sutherland and Hodgman 1974), then applies Lambert's sum.
Vec<double> parallelogramByDefinition(const float* in) {
    const Vec<double> c = toCosine(in, exactVec(in + 3)), x = toCosine(in, exactVec(in + 6)),
                      y = toCosine(in, exactVec(in + 9));
    const std::array corners{c - x - y, c + x - y, c + x + y, c - x + y};
    std::vector<Vec<double>> above;
    for (std::size_t i = 0; i < 4; ++i) {
        const Vec<double> a = corners[i], b = corners[(i + 1) % 4];
        if (a.z > 0) above.push_back(a);
        if ((a.z > 0) != (b.z > 0)) above.push_back(a + (b - a) * (a.z / (a.z - b.z)));
    }
    Vec<double> sum{};
    for (std::size_t i = 0; i < above.size(); ++i)
        sum = sum + edgeByDefinition(above[i], above[(i + 1) % above.size()]);
    return sum;
}

template <class N, class T>
Vec<N> selectVec(T condition, Vec<N> a, Vec<N> b) {
    return {select(condition, a.x, b.x), select(condition, a.y, b.y), select(condition, a.z, b.z)};
}

template <class N>
Vec<N> parallelogramSequence(const N* in) {
    const N zero(0.0f), one(1.0f);
    const Vec<N> c = toCosineSequence(in, vecAt(in + 3)), x = toCosineSequence(in, vecAt(in + 6)),
                 y = toCosineSequence(in, vecAt(in + 9)), none{zero, zero, zero};
    const Vec<N> corners[4] = {c - x - y, c + x - y, c + x + y, c - x + y};
    Vec<N> sum = none, leaves = none, returns = none;
    for (int i = 0; i < 4; ++i) {
        const Vec<N> p = corners[i], q = corners[(i + 1) % 4];
        const auto p_above = isLess(zero, p.z), q_above = isLess(zero, q.z);
        const N side = select(p_above, one, -one);
        Vec<N> crossing = (q * p.z - p * q.z) * side;
        crossing.z = zero;
        const Vec<N> edge = edgeSequence(selectVec(p_above, p, crossing), selectVec(q_above, q, crossing));
        sum = sum + selectVec(p_above, edge, selectVec(q_above, edge, none));
        leaves = selectVec(p_above, selectVec(q_above, leaves, crossing), leaves);
        returns = selectVec(q_above, selectVec(p_above, returns, crossing), returns);
    }
    return sum + edgeSequence(leaves, returns);
}

Probe parallelogramProbe(bool plain) {
    Probe p = ltcProbe(
        plain ? "parallelogram, cosine" : "parallelogram, transformed", 2,
        plain ? "0.1 to 10 m away, sides of 1 cm to 10 m, any rotation, half of them across the horizon"
              : "as for the cosine; M^-1 for roughness 0.2 to 1 and any view",
        "rounding in parallelogramFactor(), edge by edge; none so far that it is treated as a point");
    p.ins = 12;
    p.outs = 3;
    p.make = [plain](Random& random, std::size_t, float* in) {
        in[0] = in[1] = 1, in[2] = 0;
        if (!plain) {
            const double alpha = std::pow(random.uniform(0.2, 1), 2), mu = random.uniform(0.1, 1);
            const double sine = std::sqrt(1 - mu * mu), m = std::hypot(mu, alpha * sine);
            in[0] = static_cast<float>(m * m / (2 * alpha));
            in[1] = static_cast<float>(1 / (2 * alpha));
            in[2] = static_cast<float>(0.5 * sine / m);
        }
        const double distance = random.logarithmic(0.1, 10);
        Vec<double> c = randomDirection(random) * distance;
        c.z = std::abs(c.z);
        const Vec<double> normal = randomDirection(random);
        // Smaller lights are nearly points: 128 times their size away.
        const double min_side = std::max(0.01, distance * 0.05);
        Vec<double> x = rotatedTo(normal, {1, 0, 0}) * random.logarithmic(min_side, 10);
        const Vec<double> y = rotatedTo(normal, {0, 1, 0}) * random.logarithmic(min_side, 10);
        // cross(x, y) points away from the surface.
        if (dot(cross(x, y), c) < 0) x = x * -1.0;
        // A light whose plane contains the surface is not tested.
        if (std::abs(dot(unit(cross(x, y)), c)) < 0.02 * distance) c = c * 0.0 + Vec<double>{0, 0, distance};
        put(c, in + 3), put(x, in + 6), put(y, in + 9);
        if (dot(cross(exactVec(in + 6), exactVec(in + 9)), exactVec(in + 3)) < 0) put(x * -1.0, in + 6);
    };
    p.definition = [](const float* in, double* out) {
        const Vec<double> f = parallelogramByDefinition(in);
        out[0] = f.x, out[1] = f.y, out[2] = f.z;
    };
    setOperations(p, []<class N>(const N* in, N* out) {
        const Vec<N> f = parallelogramSequence(in);
        out[0] = f.x, out[1] = f.y, out[2] = f.z;
    });
    return p;
}

}  // namespace

std::vector<Probe> ltcProbes() {
    return {angleProbe(), edgeProbe(), parallelogramProbe(true), parallelogramProbe(false)};
}

}  // namespace diptych::probe
