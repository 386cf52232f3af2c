// SPDX-License-Identifier: MIT
// D, the specular lobe and F, compared with their definitions.
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

// Squared perceptual roughness, from the smallest shaded roughness to 1, including both ends.
double randomAlpha(Random& random) {
    const double min_roughness = double{gpu::MIN_PERCEPTUAL_ROUGHNESS};
    const double r = random.coin() ? random.ends(min_roughness, 1) : random.logarithmic(min_roughness, 1);
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
    Probe p = brdfProbe(
        "D", 0,
        "roughness 0.045 to 1 including both ends; h at 1e-7 to pi/2 from n, any n; s of length 1e-3 to 2",
        "rounding in ggxDenominator() and one division");
    p.ins = 7;
    p.rows = 1u << 17;
    p.make = [](Random& random, std::size_t row, float* in) {
        in[0] = static_cast<float>(randomAlpha(random));
        const Vec<double> n = row % 2 ? randomDirection(random) : Vec<double>{0, 0, 1};
        const double angle = random.coin() ? random.uniform(0, 0.5 * std::numbers::pi)
                                           : random.logarithmic(1e-7, 0.5 * std::numbers::pi);
        put(n, in + 1);
        put(rotatedTo(n, atAngle(random, angle)) * random.logarithmic(1e-3, 2), in + 4);
    };
    p.definition = [](const float* in, double* out) {
        const Vec<double> n = unit(exactVec(in + 1)), h = unit(exactVec(in + 4));
        out[0] = ggx(double{in[0]}, dot(n, h), length(cross(n, h)));
    };
    setOperations(p, []<class N>(const N* in, N* out) {
        const Vec<N> n = nearlyUnit(vecAt(in + 1)), s = vecAt(in + 4);
        const N k = in[0] * dot(s, s) / denominator(in[0] * in[0], n, s);
        out[0] = k * k * N(gpu::INVERSE_PI);
    });
    return p;
}

// Heitz 2014, equation 72; for a cosine above 0.
double lambda(double alpha, double cosine) {
    const double tan2 = (1 - cosine * cosine) / (cosine * cosine);
    return 0.5 * (std::sqrt(1 + alpha * alpha * std::max(tan2, 0.0)) - 1);
}

// D G2 / (4 n.v n.l), with height-correlated G2 (Heitz 2014, equation 99), for the vectors as given.
double lobeByDefinition(double roughness, Vec<double> n, Vec<double> v, Vec<double> l) {
    const double r = std::max(roughness, double{gpu::MIN_PERCEPTUAL_ROUGHNESS}), alpha = r * r;
    const Vec<double> h = unit(v + l);
    const double nv = std::max(dot(n, v), double{gpu::MIN_N_DOT_V}), nl = std::min(dot(n, l), 1.0);
    return ggx(alpha, dot(n, h), length(cross(n, h))) /
           (1 + lambda(alpha, std::min(nv, 1.0)) + lambda(alpha, nl)) / (4 * nv * nl);
}

template <class N>
N lobeSequence(N roughness, Vec<N> n, Vec<N> v, Vec<N> l) {
    const N r = max(roughness, N(gpu::MIN_PERCEPTUAL_ROUGHNESS)), alpha = r * r, alpha2 = alpha * alpha;
    const N nv = max(dot(n, v), N(gpu::MIN_N_DOT_V)), nl = min(max(dot(n, l), N(0.0f)), N(1.0f));
    const N smith_v = root(nv * nv * (N(1.0f) - alpha2) + alpha2);
    const Vec<N> s = l + v;
    const N q = denominator(alpha2, n, s), smith_l = root(nl * nl * (N(1.0f) - alpha2) + alpha2);
    const N sum = nl * smith_v + nv * smith_l, a = alpha * dot(s, s);
    return a * a * N(0.5f * gpu::INVERSE_PI) / max(q * q * sum, N(1e-37f));
}

// Roughness, any n, v and l above its horizon with a cosine of at least `lowest`. Half of the l are near
// the mirrored view, where the lobe is.
void makeLobeRow(Random& random, double lowest, float* in) {
    const double alpha = randomAlpha(random);
    in[0] = static_cast<float>(std::sqrt(alpha));
    const Vec<double> n = random.coin() ? randomDirection(random) : Vec<double>{0, 0, 1};
    const auto elevated = [&] {
        const double c = random.coin() ? random.uniform(lowest, 1) : random.logarithmic(lowest, 1);
        return atAngle(random, std::acos(c));
    };
    const Vec<double> v = elevated();
    Vec<double> l = elevated();
    if (random.coin()) {
        const Vec<double> h = atAngle(random, std::atan(alpha * random.logarithmic(1e-3, 30)));
        const Vec<double> mirrored = h * (2 * dot(v, h)) - v;
        if (mirrored.z > lowest) l = unit(mirrored);
    }
    // For opposite v and l, |l + v| is only rounding: the shader returns 0 below 1e-6 and is
    // accurate above 1e-4.
    const Vec<double> sum = v + l;
    if (length(sum) < 1e-3) l = v;
    put(n, in + 1);
    put(rotatedTo(n, v), in + 4);
    put(rotatedTo(n, l), in + 7);
}

const char* const lobe_operations = "rounding in makeBrdf(), ggxDenominator() and specularLobe()";

Probe lobeProbe() {
    Probe p = brdfProbe("D V, the specular lobe", 1,
                        "roughness 0.045 to 1 including both ends; any n; n.v and n.l 1e-6 to 1; half of l "
                        "within 30 lobe widths of the mirrored view; |l + v| at least 1e-3",
                        lobe_operations);
    p.ins = 10;
    p.rows = 1u << 17;
    p.make = [](Random& random, std::size_t, float* in) { makeLobeRow(random, 1e-6, in); };
    p.definition = [](const float* in, double* out) {
        out[0] = lobeByDefinition(double{in[0]}, unit(exactVec(in + 1)), exactVec(in + 4), exactVec(in + 7));
    };
    setOperations(p, []<class N>(const N* in, N* out) {
        out[0] = lobeSequence(in[0], nearlyUnit(vecAt(in + 1)), vecAt(in + 4), vecAt(in + 7));
    });
    return p;
}

Probe reciprocityProbe() {
    Probe p = brdfProbe("D V of l and v exchanged", 1,
                        "as for the lobe, with n.v and n.l at least 1e-4, where n.v is clamped",
                        "the allowed errors of both, which are equal in exact arithmetic");
    p.ins = 10;
    p.outs = 2;
    p.make = [](Random& random, std::size_t, float* in) { makeLobeRow(random, 1.001e-4, in); };
    setOperations(p, []<class N>(const N* in, N* out) {
        const Vec<N> n = nearlyUnit(vecAt(in + 1)), v = vecAt(in + 4), l = vecAt(in + 7);
        out[0] = lobeSequence(in[0], n, v, l);
        out[1] = lobeSequence(in[0], n, l, v);
    });
    p.evaluate = [allowance = p.allowance](const float* in, const float* out, Tally& tally) {
        double allowed[2];
        allowance(in, allowed);
        tally.value(tally.first_row, 1, out[1], double{out[0]}, allowed[0] + allowed[1],
                    ulpOf(double{out[0]}));
    };
    return p;
}

// Heitz 2018, "Sampling the GGX Distribution of Visible Normals". Each half vector of a line reflects G2 /
// G1 <= 1 of its light. So the mean, the energy that the lobe sends, is at most 1 for any number of them.
constexpr std::size_t energy_line = 64, energy_side = 64;

struct EnergyRow {
    double roughness, mu;
    Vec<double> v, l;
    double density;  // of l, 1/sr
};

EnergyRow energyRow(std::size_t row) {
    const std::size_t line = row / energy_line, k = row % energy_line;
    const auto fraction = [](std::size_t i) { return static_cast<double>(i) / (energy_side - 1); };
    EnergyRow e{};
    const double min_roughness = double{gpu::MIN_PERCEPTUAL_ROUGHNESS};
    e.roughness = min_roughness + (1 - min_roughness) * fraction(line / energy_side % energy_side);
    const double down = fraction(line % energy_side);
    e.mu = std::max(1 - down * (2 - down), double{gpu::MIN_N_DOT_V});  // denser near the horizon
    const double alpha = e.roughness * e.roughness;
    e.v = {std::sqrt(1 - e.mu * e.mu), 0, e.mu};
    const Vec<double> up = unit({alpha * e.v.x, 0, e.v.z});
    const Vec<double> t1{0, 1, 0}, t2 = cross(up, t1);
    double radical = 0;
    for (std::size_t bit = 0; bit < 6; ++bit) radical += (k >> bit & 1) ? std::exp2(-1.0 - double(bit)) : 0;
    const double u = (static_cast<double>(k) + 0.5) / energy_line,
                 azimuth = 2 * std::numbers::pi * (radical + 1.0 / 128);
    const double p1 = std::sqrt(u) * std::cos(azimuth), s = 0.5 * (1 + up.z);
    const double p2 = (1 - s) * std::sqrt(1 - p1 * p1) + s * std::sqrt(u) * std::sin(azimuth);
    const Vec<double> m = t1 * p1 + t2 * p2 + up * std::sqrt(std::max(1 - p1 * p1 - p2 * p2, 0.0));
    const Vec<double> h = unit({alpha * m.x, alpha * m.y, std::max(m.z, 1e-9)});
    e.l = h * (2 * dot(e.v, h)) - e.v;
    e.density = ggx(alpha, h.z, std::hypot(h.x, h.y)) / ((1 + lambda(alpha, e.mu)) * 4 * e.mu);
    return e;
}

Probe energyProbe() {
    Probe p = brdfProbe(
        "energy of the lobe, F = 1", 1,
        "64 roughnesses x 64 n.v (1e-4 to 1), 64 half vectors each: the mean, which must not exceed 1",
        "the mean of each lobe's allowed error");
    p.ins = 10;
    p.line = energy_line;
    p.rows = energy_side * energy_side * energy_line;
    p.make = [](Random&, std::size_t row, float* in) {
        const EnergyRow e = energyRow(row);
        in[0] = static_cast<float>(e.roughness);
        put({0, 0, 1}, in + 1);
        put(e.v, in + 4);
        put(e.l, in + 7);
    };
    setOperations(p, []<class N>(const N* in, N* out) {
        out[0] = lobeSequence(in[0], vecAt(in + 1), vecAt(in + 4), vecAt(in + 7));
    });
    p.evaluate = [allowance = p.allowance](const float* in, const float* out, Tally& tally) {
        double got = 0, expected = 0, allowed = 0;
        for (std::size_t k = 0; k < energy_line; ++k) {
            const float* row = in + k * 10;
            const Vec<double> l = exactVec(row + 7);
            if (l.z < 1e-6) continue;  // points down and reflects nothing
            const double weight = l.z / energyRow(tally.first_row + k).density / energy_line;
            double off = 0;
            allowance(row, &off);
            got += weight * double{out[k]};
            expected += weight * lobeByDefinition(double{row[0]}, {0, 0, 1}, exactVec(row + 4), l);
            allowed += weight * off;
        }
        const auto energy = static_cast<float>(got);
        allowed += ulpOf(got);
        tally.value(tally.first_row, 0, energy, expected, allowed, ulpOf(expected));
        // Inputs are rounded to float too, but the density is of the unrounded direction. For a lobe of
        // width alpha^2 = 4e-6, a direction's 2^-24 is 2^-24 / 0.002 of the width.
        tally.value(tally.first_row, 0, energy, std::min(double{energy}, 1.0), allowed + 8 * 0x1p-24 / 0.002,
                    0);
    };
    return p;
}

Probe schlickProbe() {
    Probe p = brdfProbe("F, Schlick's weight", 2, "v.h from 0 to 1 including both ends; sequences of 256",
                        "a difference and three products; it decreases monotonically on any device");
    p.line = 256;
    p.make = [](Random&, std::size_t row, float* in) { in[0] = onLine(row, 256, 0, 1); };
    p.definition = [](const float* in, double* out) { out[0] = std::pow(1 - double{in[0]}, 5); };
    setOperations(p, []<class N>(const N* in, N* out) {
        const N x = min(max(N(1.0f) - in[0], N(0.0f)), N(1.0f)), x2 = x * x;
        out[0] = x2 * x2 * x;
    });
    p.monotone = -1;
    p.strict = true;
    return p;
}

Probe lightProbe() {
    Probe p = brdfProbe(
        "one light, base and lobe", 3,
        "as for the lobe, with n.l at least 1e-3; metallic, albedo, F0 and F90 0 to 1 including both ends",
        "rounding in lobesUnder(); float32 vectors are only nearly of length 1");
    p.ins = 14;
    p.outs = 2;
    p.make = [](Random& random, std::size_t, float* in) {
        makeLobeRow(random, 1e-3, in);
        for (int i = 10; i < 14; ++i) in[i] = static_cast<float>(random.ends(0, 1));
    };
    // If the layer reflects everything, the base's remainder is rounding, so errors are in ULP of the base
    // alone.
    p.step = [](const float* in, std::size_t output, double expected) {
        return ulpOf(output == 0 ? double{in[11]} * dot(exactVec(in + 1), exactVec(in + 7)) / std::numbers::pi
                                 : expected);
    };
    // glTF 2.0, appendix B, with KHR_materials_specular: a metal and a dielectric, mixed.
    p.definition = [](const float* in, double* out) {
        const Vec<double> n = unit(exactVec(in + 1)), v = unit(exactVec(in + 4)), l = unit(exactVec(in + 7));
        const double metallic = double{in[10]}, albedo = double{in[11]}, f0 = double{in[12]},
                     f90 = double{in[13]};
        const double nl = dot(n, l), weight = std::pow(1 - dot(v, unit(v + l)), 5);
        const double dielectric = f0 + (f90 - f0) * weight, metal = albedo + (1 - albedo) * weight;
        out[0] = (1 - metallic) * albedo / std::numbers::pi * (1 - dielectric) * nl;
        out[1] =
            (metallic * metal + (1 - metallic) * dielectric) * lobeByDefinition(double{in[0]}, n, v, l) * nl;
    };
    setOperations(p, []<class N>(const N* in, N* out) {
        const Vec<N> n = nearlyUnit(vecAt(in + 1)), v = nearlyUnit(vecAt(in + 4)),
                     l = nearlyUnit(vecAt(in + 7));
        const N one(1.0f), metallic = in[10], albedo = in[11], f0 = in[12], f90 = in[13];
        const auto mix = [&](N a, N b) { return a * (one - metallic) + b * metallic; };
        const N nl = min(max(dot(n, l), N(0.0f)), one);
        const Vec<N> s = l + v;
        const N x = min(max(one - N(0.5f) * root(dot(s, s)), N(0.0f)), one), x2 = x * x, weight = x2 * x2 * x;
        const N mixed = mix(f0, albedo), fresnel = mixed + (mix(f90, one) - mixed) * weight;
        const N base = one - (f0 + (f90 - f0) * weight);
        out[0] = (one - metallic) * albedo * N(gpu::INVERSE_PI) * base * nl;
        out[1] = fresnel * lobeSequence(in[0], n, v, l) * nl;
    });
    return p;
}

}  // namespace

std::vector<Probe> brdfProbes() {
    return {distribution(), lobeProbe(), schlickProbe(), lightProbe(), reciprocityProbe(), energyProbe()};
}

}  // namespace diptych::probe
