// SPDX-License-Identifier: MIT
// Specular anti-aliasing, multiple scattering, spherical harmonics, and the tone curve of images.
#include "compare/image/channel_image.h"
#include "compare/probe/groups.h"
#include "compare/probe/vec.h"
#include "shared/contract/constants.h"
#include "shared/contract/environment.h"
#include "shared/contract/features.h"
#include "shared/contract/multiscatter.h"

namespace diptych::probe {
namespace {

Probe surfaceProbe(const char* group, const char* name, const char* shader, std::uint32_t function,
                   const char* inputs, const char* because) {
    Probe probe;
    probe.group = group;
    probe.name = name;
    probe.inputs = inputs;
    probe.unit = "ULP";
    probe.because = because;
    probe.shader = shader;
    probe.function = function;
    return probe;
}

// Tokuyoshi and Kaplanyan 2019: alpha'^2 = alpha^2 + min(2 sigma^2 (|dn/dx|^2 + |dn/dy|^2), kappa).
Probe roughnessProbe() {
    constexpr float variance = 0.15915494f, limit = 0.18f;
    Probe p = surfaceProbe("surfaces", "roughness, specular anti-aliasing", "surface.comp", 0,
                           "roughness 0 to 1 including both ends; normals that change by 1e-6 to 10 per "
                           "pixel, partly by rounding; sequences of 64 with growing change",
                           "rounding in filteredRoughness(), including two square roots");
    p.ins = 9;
    p.line = 64;
    p.monotone = 1;
    p.features = {{gpu::FEATURE_specular_aa_variance, std::bit_cast<std::uint32_t>(variance)}};
    p.make = [](Random&, std::size_t row, float* in) {
        Random line(row / 64);
        const double change = 1e-6 * std::pow(1e7, static_cast<double>(row % 64) / 63);
        in[0] = static_cast<float>(line.ends(0, 1));
        put(randomDirection(line) * change * line.unit(), in + 1);
        put(randomDirection(line) * change, in + 4);
        in[7] = line.coin() ? 0 : static_cast<float>(line.logarithmic(1e-12, 1e-6));
        in[8] = limit;
    };
    p.definition = [](const float* in, double* out) {
        const double x = length(exactVec(in + 1)), y = length(exactVec(in + 4)), change = x * x + y * y;
        const double r = std::max(double{in[0]}, double{gpu::MIN_PERCEPTUAL_ROUGHNESS});
        const double kernel = std::min(2 * double{variance} * change, double{limit});
        const double widened = std::pow(std::min(std::pow(r, 4) + kernel, 1.0), 0.25);
        out[0] = change > double{in[7]} ? std::max(widened, double{in[0]}) : double{in[0]};
    };
    setOperations(p, []<class N>(const N* in, N* out) {
        const Vec<N> x = vecAt(in + 1), y = vecAt(in + 4);
        const N change = dot(x, x) + dot(y, y), zero(0.0f);
        const N kernel = select(isLess(in[7], change), min(N(2.0f) * N(variance) * change, N(limit)), zero);
        N alpha = max(in[0], N(gpu::MIN_PERCEPTUAL_ROUGHNESS));
        alpha = alpha * alpha;
        const N filtered = root(root(min(alpha * alpha + kernel, N(1.0f))));
        out[0] = select(isLess(zero, kernel), max(filtered, in[0]), in[0]);
    });
    return p;
}

// Turquin 2019 and Fdez-Aguera 2019 (shaders/lib/shading/multiscatter.glsl).
Probe betweenProbe(bool energy) {
    Probe p = surfaceProbe(
        "surfaces", energy ? "between microfacets, energy" : "between microfacets, Fdez-Aguera",
        "surface.comp", 1,
        "F0 and F90 0 to 1 including both ends; lobes that reflect 0.3 to 1 of white light, split in any way",
        "rounding in specularFactors()");
    p.ins = 4;
    p.outs = 3;
    p.features = {{gpu::FEATURE_multiscatter, energy ? gpu::MULTISCATTER_ENERGY : gpu::MULTISCATTER_FDEZ}};
    p.make = [](Random& random, std::size_t, float* in) {
        const double all = random.ends(0.3, 1), part = random.ends(0, 1);
        in[0] = static_cast<float>(random.ends(0, 1)), in[1] = static_cast<float>(random.ends(0, 1));
        in[2] = static_cast<float>(all * part), in[3] = static_cast<float>(all * (1 - part));
    };
    // If a lobe reflects nearly everything, the loss is rounding, so errors are in ULP of 1.
    p.unit = "ULP of 1";
    p.step = [](const float*, std::size_t, double) { return ulpOf(1); };
    p.definition = [energy](const float* in, double* out) {
        const double f0 = double{in[0]}, f90 = double{in[1]}, x = double{in[2]}, y = double{in[3]};
        const double lost = std::max(1 - x - y, 0.0), gain = energy ? 1 + f0 * lost / (x + y) : 1;
        out[0] = f0 * gain, out[1] = f90 * gain, out[2] = 0;
        if (energy) return;
        const double mean = f0 * 20 / 21 + f90 / 21;
        out[2] = (f0 * x + f90 * y) * mean * lost / (std::numbers::pi * (1 - mean * lost));
    };
    setOperations(p, [energy]<class N>(const N* in, N* out) {
        const N one(1.0f), all = in[2] + in[3], lost = max(one - all, N(0.0f));
        const N gain = energy ? one + in[0] * (lost / all) : one;
        out[0] = in[0] * gain, out[1] = in[1] * gain, out[2] = N(0.0f);
        if (energy) return;
        const N mean = in[0] + (in[1] - in[0]) * N(1.0f / 21.0f), again = mean * lost;
        out[2] = (in[0] * in[2] + in[1] * in[3]) * again * N(gpu::INVERSE_PI) / (one - again);
    });
    return p;
}

// Nodes and weights of Gauss-Legendre quadrature on [0, 1].
template <std::size_t Count>
std::array<std::array<double, 2>, Count> gaussLegendre() {
    std::array<std::array<double, 2>, Count> nodes{};
    for (std::size_t i = 0; i < Count; ++i) {
        double x = std::cos(std::numbers::pi * (static_cast<double>(i) + 0.75) / (Count + 0.5)), slope = 1;
        for (int step = 0; step < 20; ++step) {
            double before = 1, p = x;  // Legendre polynomials by recurrence
            for (std::size_t k = 2; k <= Count; ++k) {
                const double n = static_cast<double>(k), next = ((2 * n - 1) * x * p - (n - 1) * before) / n;
                before = p, p = next;
            }
            slope = Count * (x * p - before) / (x * x - 1);
            x -= p / slope;
        }
        nodes[i] = {0.5 + 0.5 * x, 1 / ((1 - x * x) * slope * slope)};
    }
    return nodes;
}

// The cosine-weighted mean of (1 - v.h)^5 over uniform light.
double meanWeight(double mu) {
    constexpr int sectors = 32;
    static const auto rings = gaussLegendre<24>();
    const double sine = std::sqrt(std::max(1 - mu * mu, 0.0));
    double sum = 0;
    for (const auto& [s, weight] : rings) {
        // z = s^2 is dense near the horizon, where l may be opposite to a grazing view.
        const double z = s * s, across = std::sqrt(1 - z * z);
        for (int j = 0; j < sectors; ++j) {
            const double v_dot_l = mu * z + sine * across * std::cos(std::numbers::pi * (j + 0.5) / sectors);
            const double x = 1 - std::sqrt(std::max(0.5 + 0.5 * v_dot_l, 0.0));
            sum += weight * x * x * x * x * x * 2 * z * 2 * s / sectors;
        }
    }
    return sum;
}

Probe meanWeightProbe() {
    Probe p = surfaceProbe("surfaces", "mean of Schlick's weight", "surface.comp", 2,
                           "n.v 0 to 1 including both ends",
                           "the polynomial is within 5e-6 of the integral, the quadrature within 4e-7");
    p.rows = 1u << 12;
    p.unit = "ULP of 1";
    p.step = [](const float*, std::size_t, double) { return ulpOf(1); };
    p.make = [](Random& random, std::size_t, float* in) { in[0] = static_cast<float>(random.ends(0, 1)); };
    p.definition = [](const float* in, double* out) { out[0] = meanWeight(double{in[0]}); };
    p.allowance = [](const float*, double* allowed) { allowed[0] = 5e-6 + 4e-7 + 8 * 0x1p-27; };
    return p;
}

Probe unitProbe() {
    Probe p =
        surfaceProbe("surfaces", "unit vector of any length", "surface.comp", 3,
                     "lengths 1e-30 to 1e30, any direction; the zero vector", "rounding in unitVector()");
    p.ins = p.outs = 3;
    p.unit = "ULP of 1";
    p.step = [](const float*, std::size_t, double) { return ulpOf(1); };
    p.make = [](Random& random, std::size_t, float* in) {
        put(randomDirection(random) * (random.bits() % 64 ? random.logarithmic(1e-30, 1e30) : 0), in);
    };
    p.definition = [](const float* in, double* out) {
        const Vec<double> v = exactVec(in), n = length(v) > 0 ? unit(v) : v;
        out[0] = n.x, out[1] = n.y, out[2] = n.z;
    };
    setOperations(p, []<class N>(const N* in, N* out) {
        const Vec<N> v = vecAt(in);
        const N largest = max(size(v.x), max(size(v.y), size(v.z))), zero(0.0f);
        const auto there = isLess(zero, largest);
        const Vec<N> scaled = v / select(there, largest, N(1.0f));
        const N l = select(there, root(dot(scaled, scaled)), N(1.0f));
        out[0] = scaled.x / l, out[1] = scaled.y / l, out[2] = scaled.z / l;
    });
    return p;
}

// Nine coefficients of three colours each, then a unit normal.
void makeHarmonics(Random& random, std::size_t coefficients, float* in) {
    const double scale = random.logarithmic(1e-3, 1e3);
    for (std::size_t i = 0; i < coefficients; ++i) in[i] = static_cast<float>(scale * random.uniform(-1, 1));
    put(random.bits() % 8 ? randomDirection(random) : Vec<double>{0, random.coin() ? 1.0 : -1.0, 0},
        in + coefficients);
}

// Errors are in ULP of the sum of the coefficients' magnitudes: a sum with terms of both signs.
void countTerms(Probe& p, std::size_t coefficients) {
    p.unit = "ULP of sum";
    p.step = [coefficients](const float* in, std::size_t, double) {
        double sum = 0;
        for (std::size_t i = 0; i < coefficients; ++i) sum += std::abs(double{in[i]}) / 3;
        return ulpOf(sum);
    };
}

Probe environmentHarmonicsProbe() {
    Probe p = surfaceProbe("surfaces", "harmonics of an environment", "harmonics.comp", 0,
                           "coefficients of both signs, 1e-3 to 1e3; any normal",
                           "rounding in environmentIrradiance()");
    constexpr std::size_t texels = 32;
    p.ins = texels + 3;
    p.outs = 3;
    p.features = {{gpu::FEATURE_environment, gpu::ENVIRONMENT_LIT}};
    p.make = [](Random& random, std::size_t, float* in) { makeHarmonics(random, texels, in); };
    countTerms(p, texels);
    // shared/contract/environment.h: texels 1 to 7, with the last two coefficients in fourth components.
    const auto sum = []<class N>(const N* in, const auto& basis, int c) {
        N total(0.0f);
        for (int i = 0; i < 7; ++i) total = total + in[4 * (i + 1) + c] * basis[static_cast<std::size_t>(i)];
        return total + in[4 * (1 + c) + 3] * basis[7] + in[4 * (4 + c) + 3] * basis[8];
    };
    p.definition = [sum](const float* in, double* out) {
        std::array<double, texels> wide;
        std::copy_n(in, texels, wide.begin());
        const Vec<double> n = exactVec(in + texels);
        const std::array basis{
            1.0, n.y, n.z, n.x, n.x * n.y, n.y * n.z, 3 * n.z * n.z - 1, n.x * n.z, n.x * n.x - n.y * n.y};
        for (int c = 0; c < 3; ++c) out[c] = std::max(sum(wide.data(), basis, c), 0.0);
    };
    setOperations(p, [sum]<class N>(const N* in, N* out) {
        const Vec<N> n = vecAt(in + texels);
        const N one(1.0f);
        const std::array<N, 9> basis{one,
                                     n.y,
                                     n.z,
                                     n.x,
                                     n.x * n.y,
                                     n.y * n.z,
                                     N(3.0f) * n.z * n.z - one,
                                     n.x * n.z,
                                     n.x * n.x - n.y * n.y};
        for (int c = 0; c < 3; ++c) out[c] = max(sum(in, basis, c), N(0.0f));
    });
    return p;
}

Probe objectHarmonicsProbe() {
    Probe p = surfaceProbe("surfaces", "harmonics of a draw's lights", "harmonics.comp", 1,
                           "coefficients of both signs, 1e-3 to 1e3; any normal",
                           "rounding in harmonicIrradiance()");
    constexpr std::size_t coefficients = 27;
    p.ins = coefficients + 3;
    p.outs = 3;
    p.make = [](Random& random, std::size_t, float* in) { makeHarmonics(random, coefficients, in); };
    countTerms(p, coefficients);
    // Constant, x, y, z, xx, yy, xy, yz, xz (shared/contract/object_lights.h).
    p.definition = [](const float* in, double* out) {
        const Vec<double> n = exactVec(in + coefficients);
        const std::array basis{
            1.0,           n.x,           n.y,          n.z, n.x * n.x - n.z * n.z, n.y * n.y - n.z * n.z,
            2 * n.x * n.y, 2 * n.y * n.z, 2 * n.x * n.z};
        for (std::size_t c = 0; c < 3; ++c) {
            double sum = 0;
            for (std::size_t i = 0; i < 9; ++i) sum += double{in[3 * i + c]} * basis[i];
            out[c] = std::max(sum, 0.0);
        }
    };
    setOperations(p, []<class N>(const N* in, N* out) {
        const Vec<N> n = vecAt(in + coefficients);
        for (int c = 0; c < 3; ++c) {
            const auto e = [&](int i) { return in[3 * i + c]; };
            const N linear = e(1) * n.x + e(2) * n.y + e(3) * n.z;
            const N mixed = e(6) * (n.x * n.y) + e(7) * (n.y * n.z) + e(8) * (n.x * n.z);
            const N squares = e(4) * (n.x * n.x - n.z * n.z) + e(5) * (n.y * n.y - n.z * n.z);
            out[c] = max(e(0) + linear + squares + N(2.0f) * mixed, N(0.0f));
        }
    });
    return p;
}

Probe maskingProbe() {
    Probe p =
        surfaceProbe("surfaces", "Smith's Lambda", "harmonics.comp", 2,
                     "alpha 0.002 to 1, cosines 1e-6 to 1, including both ends", "rounding in smithLambda()");
    p.ins = 2;
    p.make = [](Random& random, std::size_t, float* in) {
        in[0] = static_cast<float>(std::pow(random.logarithmic(0.002, 1), 2));
        in[1] = static_cast<float>(random.coin() ? random.logarithmic(1e-6, 1) : random.ends(1e-6, 1));
    };
    p.unit = "ULP of 1+L";
    p.step = [](const float*, std::size_t, double expected) { return ulpOf(1 + expected); };
    // From the projected length of an ellipsoid with half axes alpha, alpha, 1 (Walter et al. 2007).
    p.definition = [](const float* in, double* out) {
        const double c = double{in[1]}, s2 = std::max(1 - c * c, 0.0);
        out[0] = (std::sqrt(c * c + double{in[0]} * s2) - c) / (2 * c);
    };
    setOperations(p, []<class N>(const N* in, N* out) {
        const N one(1.0f), c2 = in[1] * in[1];
        out[0] = N(0.5f) * (root(one + in[0] * max(one - c2, N(0.0f)) / c2) - one);
    });
    return p;
}

Probe levelProbe() {
    Probe p = surfaceProbe("surfaces", "level of a GGX width", "harmonics.comp", 3,
                           "alpha from the smallest shaded value to 1; sequences of 256",
                           "rounding in specularLevel(), including three log2()");
    p.line = 256;
    p.monotone = 1;
    p.unit = "ULP of 1";
    p.step = [](const float*, std::size_t, double) { return ulpOf(1); };
    const double first_alpha = double{gpu::ENVIRONMENT_FIRST_ALPHA},
                 min_roughness = double{gpu::MIN_PERCEPTUAL_ROUGHNESS};
    p.make = [min_roughness](Random&, std::size_t row, float* in) {
        in[0] = onLine(row, 256, min_roughness * min_roughness, row / 256 % 3 ? 1 : 0.02);
    };
    p.definition = [=](const float* in, double* out) {
        const double a = double{in[0]}, min_alpha = min_roughness * min_roughness;
        out[0] = a < first_alpha ? std::log(a / min_alpha) / std::log(first_alpha / min_alpha)
                                 : 1 + gpu::ENVIRONMENT_LEVELS_AN_OCTAVE * std::log2(a / first_alpha);
    };
    setOperations(p, []<class N>(const N* in, N* out) {
        const N first = binaryLogarithm(N(gpu::ENVIRONMENT_FIRST_ALPHA)),
                lowest = N(2.0f) * binaryLogarithm(N(gpu::MIN_PERCEPTUAL_ROUGHNESS)),
                octaves = binaryLogarithm(in[0]);
        // At the seam both branches give 1.
        out[0] =
            select(isLess(octaves, first), (octaves - lowest) / (first - lowest),
                   N(1.0f) + N(static_cast<float>(gpu::ENVIRONMENT_LEVELS_AN_OCTAVE)) * (octaves - first));
    });
    return p;
}

// Khronos PBR Neutral (Khronos Group 2024): host code in float32.
Probe toneProbe() {
    Probe p = surfaceProbe("pictures", "tone curve, on the host", "", 0,
                           "radiance 1e-6 to 1e6, grey and coloured; sequences of 256 of growing brightness",
                           "rounding in pbrNeutral(), in this machine's float32");
    p.ins = p.outs = 3;
    p.line = 256;
    p.monotone = 1;
    p.unit = "ULP of 1";
    p.step = [](const float*, std::size_t, double) { return ulpOf(1); };
    p.host = [](const float* in, float* out) {
        const std::array<float, 3> rgb = pbrNeutral({in[0], in[1], in[2]});
        std::copy_n(rgb.begin(), 3, out);
    };
    p.make = [](Random&, std::size_t row, float* in) {
        Random line(row / 256);
        const double brightness = line.logarithmic(1e-6, 1e-2) *
                                  std::pow(line.coin() ? 1e2 : 1e8, static_cast<double>(row % 256) / 255);
        const bool grey = line.coin();
        for (int i = 0; i < 3; ++i)
            in[i] = static_cast<float>(brightness * (grey || i == 0 ? 1 : line.uniform(0, 1)));
    };
    p.definition = [](const float* in, double* out) {
        const double low = std::min({double{in[0]}, double{in[1]}, double{in[2]}}), f90 = double{0.04f};
        const double start = double{0.8f} - f90, toe = low < 2 * f90 ? low - low * low / (4 * f90) : f90;
        const double peak = std::max({double{in[0]}, double{in[1]}, double{in[2]}}) - toe;
        for (int i = 0; i < 3; ++i) out[i] = double{in[i]} - toe;
        if (peak < start) return;
        const double compressed = 1 - (1 - start) * (1 - start) / (peak + 1 - 2 * start);
        const double white = 1 - 1 / (double{0.15f} * (peak - compressed) + 1);
        for (int i = 0; i < 3; ++i) out[i] = (out[i] * compressed / peak) * (1 - white) + compressed * white;
    };
    setOperations(p, []<class N>(const N* in, N* out) {
        const N one(1.0f), f90(0.04f), start = N(0.8f) - f90, low = min(in[0], min(in[1], in[2]));
        const N toe = select(isLess(low, N(0.08f)), low - low * low / (N(4.0f) * f90), f90);
        N rgb[3];
        for (int i = 0; i < 3; ++i) rgb[i] = in[i] - toe;
        const N peak = max(rgb[0], max(rgb[1], rgb[2])), room = one - start;
        const N safe = max(peak, N(0.5f)), compressed = one - room * room / (safe + room - start);
        const N white = one - one / (N(0.15f) * (safe - compressed) + one);
        for (int i = 0; i < 3; ++i) {
            const N curved = rgb[i] * compressed / safe;
            out[i] = select(isLess(peak, start), rgb[i], curved + white * (compressed - curved));
        }
    });
    return p;
}

}  // namespace

std::vector<Probe> surfaceProbes() {
    return {roughnessProbe(), betweenProbe(true), betweenProbe(false),         meanWeightProbe(),
            maskingProbe(),   unitProbe(),        environmentHarmonicsProbe(), objectHarmonicsProbe(),
            levelProbe(),     toneProbe()};
}

}  // namespace diptych::probe
