// SPDX-License-Identifier: MIT
// Irradiance of point and spot lights: KHR_lights_punctual.
#include "compare/probe/groups.h"
#include "compare/probe/vec.h"
#include "shared/contract/constants.h"

namespace diptych::probe {
namespace {

Probe lightsProbe(const char* name, std::uint32_t function, const char* inputs, const char* because) {
    Probe probe;
    probe.group = "lights";
    probe.name = name;
    probe.inputs = inputs;
    probe.unit = "ULP";
    probe.because = because;
    probe.shader = "light.comp";
    probe.function = function;
    return probe;
}

// max(1 - (d / range)^4, 0) / d^2.
double attenuation(Vec<double> to_light, double inverse_range_squared) {
    const double d = std::max(length(to_light), std::sqrt(double{gpu::MIN_LIGHT_DISTANCE_SQUARED}));
    return std::max(1 - std::pow(d * std::sqrt(inverse_range_squared), 4), 0.0) / (d * d);
}

template <class N>
N attenuationSequence(Vec<N> to_light, N inverse_range_squared, N& inverse) {
    const N one(1.0f), d2 = max(dot(to_light, to_light), N(gpu::MIN_LIGHT_DISTANCE_SQUARED));
    const N x = d2 * inverse_range_squared;
    inverse = inverseRoot(d2);
    return select(isLess(x, one), one - x * x, N(0.0f)) * (inverse * inverse);
}

// No range, one far beyond the distance, or one close to it.
float randomRange(Random& random, double distance) {
    if (random.bits() % 4 == 0) return 0;
    const double ratio = random.coin() ? random.logarithmic(1, 1e3) : random.uniform(0.9, 1.1),
                 inverse = 1 / (distance * ratio);
    return static_cast<float>(std::clamp(inverse * inverse, 1e-37, 1e37));
}

Probe pointProbe() {
    Probe p = lightsProbe(
        "a point's irradiance, direction", 0,
        "distances 1e-9 to 1e17 m; no range, a range of 1 to 1000 distances, or within 10 % of the distance",
        "rounding in fromPointLight()");
    p.ins = 4;
    p.outs = 4;
    p.rows = 1u << 17;
    // Near the range's end the result is mostly rounding, so errors are in ULP of the irradiance without a
    // range. Components of the direction are in ULP of its length.
    p.unit = "ULP of 1/d2";
    p.step = [](const float* in, std::size_t output, double) {
        return ulpOf(output > 0 ? 1 : attenuation(exactVec(in), 0));
    };
    p.make = [](Random& random, std::size_t, float* in) {
        const double distance = random.logarithmic(1e-9, 1e17);
        put(randomDirection(random) * distance, in);
        in[3] = randomRange(random, distance);
    };
    p.definition = [](const float* in, double* out) {
        const Vec<double> to = exactVec(in), direction = unit(to);
        out[0] = attenuation(to, double{in[3]});
        out[1] = direction.x, out[2] = direction.y, out[3] = direction.z;
    };
    setOperations(p, []<class N>(const N* in, N* out) {
        N inverse{};
        out[0] = attenuationSequence(vecAt(in), in[3], inverse);
        for (int i = 0; i < 3; ++i) out[1 + i] = in[i] * inverse;
    });
    return p;
}

Probe fallOffProbe() {
    Probe p = lightsProbe(
        "irradiance falls with distance", 0,
        "1 mm to 1 km along an axis; no range, or a range of 1 to 1000 distances; sequences of 256",
        "rounding in fromPointLight()");
    p.ins = 4;
    p.line = 256;
    p.monotone = -1;
    p.unit = "ULP of 1/d2";
    p.step = [](const float* in, std::size_t, double) { return ulpOf(attenuation(exactVec(in), 0)); };
    p.make = [](Random&, std::size_t row, float* in) {
        Random line(row / 256);
        in[0] = in[1] = 0;
        in[2] = onLine(row, 256, 1e-3, row / 256 % 3 ? 10 : 1000);
        in[3] = line.coin() ? 0 : static_cast<float>(1 / std::pow(line.logarithmic(0.5, 1000), 2));
    };
    p.definition = [](const float* in, double* out) { out[0] = attenuation(exactVec(in), double{in[3]}); };
    setOperations(p, []<class N>(const N* in, N* out) {
        N inverse{};
        out[0] = attenuationSequence(vecAt(in), in[3], inverse);
    });
    return p;
}

Probe spotProbe() {
    Probe p = lightsProbe("a spot's irradiance", 1,
                          "as for a point light, up to 1e9 m; cones of 0.1 to 180 degrees, soft edges of "
                          "1e-4 to 1 of the cosine range",
                          "rounding in fromSpotLight()");
    p.ins = 9;
    p.make = [](Random& random, std::size_t, float* in) {
        const double distance = random.logarithmic(1e-6, 1e9);
        const Vec<double> axis = randomDirection(random);
        const double outer = std::cos(random.logarithmic(1e-3, 0.5 * std::numbers::pi));
        const double inner = outer + (1 - outer) * random.logarithmic(1e-4, 1);
        const double angle = random.coin() ? std::acos(random.uniform(outer, inner)) : random.uniform(0, 1.6);
        // The vector to the light is opposite to the light's direction.
        put(rotatedTo(axis * -1.0, atAngle(random, angle)) * distance, in);
        in[3] = randomRange(random, distance);
        put(axis, in + 4);
        in[7] = static_cast<float>(1 / std::max(0.001, inner - outer));
        in[8] = static_cast<float>(-outer * double{in[7]});
    };
    // The cone's two parameters: 1 / (cos inner - cos outer), and -cos outer times that.
    p.definition = [](const float* in, double* out) {
        const double c = -dot(unit(exactVec(in)), exactVec(in + 4));
        const double fraction = std::clamp(c * double{in[7]} + double{in[8]}, 0.0, 1.0);
        out[0] = attenuation(exactVec(in), double{in[3]}) * fraction * fraction;
    };
    // At the cone's edge the result is mostly rounding, so errors are in ULP of a point light's
    // irradiance.
    p.unit = "ULP of point";
    p.step = [](const float* in, std::size_t, double) {
        const double point = attenuation(exactVec(in), double{in[3]});
        return point == 0 ? 0 : ulpOf(point);
    };
    setOperations(p, []<class N>(const N* in, N* out) {
        N inverse{};
        const Vec<N> to = vecAt(in);
        const N point = attenuationSequence(to, in[3], inverse);
        const N cosine = dot(to * inverse, vecAt(in + 4));
        const N fraction = min(max(in[8] - cosine * in[7], N(0.0f)), N(1.0f));
        out[0] = point * (fraction * fraction);
    });
    return p;
}

}  // namespace

std::vector<Probe> lightProbes() {
    return {pointProbe(), fallOffProbe(), spotProbe()};
}

}  // namespace diptych::probe
