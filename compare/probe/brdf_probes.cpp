// SPDX-License-Identifier: MIT
// D, the specular lobe and F against their definitions.
#include "compare/probe/groups.h"
#include "compare/probe/vec.h"
#include "shared/contract/constants.h"

namespace diptych::probe {
namespace {

Probe brdfProbe(const char* name, std::uint32_t function, const char* inputs, const char* because) {
    Probe probe;
    probe.group = "BRDF";
    probe.name = name;
    probe.inputs = inputs;
    probe.unit = "ULP";
    probe.because = because;
    probe.shader = "brdf.comp";
    probe.function = function;
    return probe;
}

// Perceptual roughness from the least that is shaded to 1, both ends among them.
double randomAlpha(Random& random) {
    const double least_roughness = double{gpu::MIN_PERCEPTUAL_ROUGHNESS};
    const double r = random.coin() ? random.ends(least_roughness, 1) : random.logarithmic(least_roughness, 1);
    return r * r;
}

template <class N>
N denominator(N alpha2, Vec<N> n, Vec<N> s) {
    const Vec<N> c = cross(n, s);
    const N n_dot_s = dot(n, s);
    return dot(c, c) + n_dot_s * n_dot_s * alpha2;
}

// Walter et al. 2007, equation 33, by the tangent of the angle between n and h: 1 / (pi alpha^2 cos^4
// (1 + tan^2 / alpha^2)^2).
double ggx(double alpha, double cosine, double sine) {
    const double t = sine * sine / (cosine * cosine * alpha * alpha), c2 = cosine * cosine;
    return 1 / (std::numbers::pi * alpha * alpha * c2 * c2 * (1 + t) * (1 + t));
}

Probe distribution() {
    Probe p = brdfProbe("D", 0,
                        "roughness 0.045 to 1 and both ends; h at 1e-7 to pi/2 from n, n anywhere; s of any "
                        "length in 1e-3 to 2",
                        "the operations of ggxDenominator() and one division");
    p.ins = 7;
    p.rows = 1u << 17;
    p.make = [](Random& random, std::size_t row, float* in) {
        in[0] = static_cast<float>(randomAlpha(random));
        const Vec<double> n = row % 2 ? randomDirection(random) : Vec<double>{0, 0, 1};
        const double angle = random.coin() ? random.uniform(0, 0.5 * std::numbers::pi)
                                           : random.logarithmic(1e-7, 0.5 * std::numbers::pi);
        put(n, in + 1);
        put(turnedTo(n, atAngle(random, angle)) * random.logarithmic(1e-3, 2), in + 4);
    };
    p.definition = [](const float* in, double* out) {
        const Vec<double> n = unit(exactVec(in + 1)), h = unit(exactVec(in + 4));
        out[0] = ggx(double{in[0]}, dot(n, h), length(cross(n, h)));
    };
    follow(p, []<class N>(const N* in, N* out) {
        const Vec<N> n = nearlyUnit(vecAt(in + 1)), s = vecAt(in + 4);
        const N k = in[0] * dot(s, s) / denominator(in[0] * in[0], n, s);
        out[0] = k * k * N(gpu::INVERSE_PI);
    });
    return p;
}

}  // namespace

std::vector<Probe> brdfProbes() {
    return {distribution()};
}

}  // namespace diptych::probe
