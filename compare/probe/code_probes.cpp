// SPDX-License-Identifier: MIT
// Encoding and decoding of the G-buffer's bits.
#include "compare/probe/groups.h"
#include "compare/probe/vec.h"
#include "shared/contract/features.h"
#include "shared/contract/gbuffer.h"

#include <fmt/format.h>

namespace diptych::probe {
namespace {

Probe codeProbe(std::string name, std::uint32_t function, const char* inputs, const char* because) {
    Probe probe;
    probe.group = "codes";
    probe.name = std::move(name);
    probe.inputs = inputs;
    probe.unit = "steps";
    probe.because = because;
    probe.shader = "codes.comp";
    probe.function = function;
    return probe;
}

double topOf(std::uint32_t bits) {
    return std::exp2(bits) - 1;
}
// Largest code of an octahedral coordinate, which is signed.
double topOfCoordinate(std::uint32_t bits) {
    return std::exp2(bits - 1) - 1;
}

// Octahedral encoding: the direction's position on |x| + |y| + |z| = 1, with the lower half folded outward
// over the edges (Meyer et al. 2010, "On Floating-Point Normal Vectors").
std::array<double, 2> octahedralPosition(Vec<double> n) {
    const double sum = std::abs(n.x) + std::abs(n.y) + std::abs(n.z), x = n.x / sum, y = n.y / sum;
    if (n.z >= 0) return {x, y};
    return {std::copysign(1 - std::abs(y), n.x >= 0 ? 1.0 : -1.0),
            std::copysign(1 - std::abs(x), n.y >= 0 ? 1.0 : -1.0)};
}
// Octahedral decoding: the point of the octahedron above (x, y), or below if that is beyond the edges.
Vec<double> octahedralDirection(double x, double y) {
    const double z = 1 - std::abs(x) - std::abs(y);
    if (z >= 0) return unit({x, y, z});
    return unit({std::copysign(1 - std::abs(y), x >= 0 ? 1.0 : -1.0),
                 std::copysign(1 - std::abs(x), y >= 0 ? 1.0 : -1.0), z});
}

double angleBetween(Vec<double> a, Vec<double> b) {
    return std::atan2(length(cross(a, b)), dot(a, b));
}

// Half a step in both coordinates, (h, h, -2 h) on the octahedron, seen from its centre, 3^-1/2 away at
// the middle of a face: the largest change of direction. Float32 moves coordinates by up to 8 roundings.
double octahedralBound(std::uint32_t bits) {
    return std::sqrt(6.0) * std::sqrt(3.0) * (0.5 / topOfCoordinate(bits) + 8 * 0x1p-23);
}

// Random directions, axes, diagonals, and directions near the octahedron's folds.
Vec<double> foldedDirection(Random& random) {
    Vec<double> n = randomDirection(random);
    const auto near_zero = [&](double& c) {
        c = random.coin() ? 0 : (random.coin() ? 1 : -1) * random.logarithmic(1e-9, 1e-2);
    };
    const std::uint64_t kind = random.bits() & 15;
    if (kind & 1 && kind < 8) near_zero(n.z);
    if (kind & 2 && kind < 8) near_zero(n.x);
    if (kind & 4 && kind < 8) near_zero(n.y);
    return length(n) > 0.01 ? unit(n) : Vec<double>{0, 0, -1};
}

const char* const directions = "any direction; half of them on or near axes, edges and folds";

Probe octahedralProbe(std::uint32_t bits) {
    Probe p = codeProbe(fmt::format("octahedral, {} bits", bits), bits, directions,
                        "half a step, and rounding in encodeOctahedral(); for the angle, half a step in both "
                        "coordinates at the middle of a face");
    p.ins = 3;
    p.outs = 5;
    p.make = [](Random& random, std::size_t, float* in) { put(foldedDirection(random), in); };
    setOperations(p, [bits]<class N>(const N* in, N* out) {
        const N one(1.0f), inverse = one / sumOf(size(in[0]), size(in[1]), size(in[2]));
        N p0 = in[0] * inverse, p1 = in[1] * inverse;
        const auto below = isLess(in[2], N(0.0f));
        const auto wrap = [&](N c, N other) {
            return select(isLess(c, N(0.0f)), -(one - size(other)), one - size(other));
        };
        const N q0 = select(below, wrap(p0, p1), p0), q1 = select(below, wrap(p1, p0), p1);
        const N top(static_cast<float>(topOfCoordinate(bits))), half(0.5f);
        out[0] = floorOf(min(max(q0, -one), one) * top + half);
        out[1] = floorOf(min(max(q1, -one), one) * top + half);
        // Decoded as in decodedProbe(); this only generates an inexact device's result.
        const N x = out[0] * (one / top), y = out[1] * (one / top), z = one - size(x) - size(y);
        const auto under = isLess(z, N(0.0f));
        const N x2 = select(under, wrap(x, y), x), y2 = select(under, wrap(y, x), y);
        const N l = root(sumOf(x2 * x2, y2 * y2, z * z));
        out[2] = x2 / l, out[3] = y2 / l, out[4] = z / l;
    });
    p.evaluate = [bits](const float* in, const float* out, Tally& tally) {
        const Vec<double> n = exactVec(in);
        const std::array<double, 2> position = octahedralPosition(n);
        const double top = topOfCoordinate(bits);
        // A coordinate of at most 1 is off by up to 8 ULP of 1: five operations, one of them a division.
        for (std::size_t i = 0; i < 2; ++i)
            tally.value(tally.first_row, i, out[i], position[i] * top, 0.5 + 8 * 0x1p-24 * top, 1);
        const auto angle = static_cast<float>(angleBetween(n, exactVec(out + 2)));
        tally.value(tally.first_row, 2, angle, 0, octahedralBound(bits) + 8 * 0x1p-23, 0);
    };
    return p;
}

Probe decodedProbe(std::uint32_t bits) {
    Probe p = codeProbe(fmt::format("octahedral from {} bits", bits), 100 + bits,
                        bits == 8 ? "every code" : "any code, including both ends and the folds",
                        "rounding in decodeOctahedral()");
    p.unit = "ULP of 1";
    p.ins = 2;
    p.outs = 3;
    const double top = topOfCoordinate(bits);
    p.make = [bits, top](Random& random, std::size_t row, float* in) {
        if (bits == 8)
            in[0] = static_cast<float>(row % 255) - 127, in[1] = static_cast<float>(row / 255 % 255) - 127;
        else
            in[0] = static_cast<float>(std::round(random.ends(-top, top))),
            in[1] = static_cast<float>(random.coin() ? std::round(random.ends(-top, top))
                                                     : std::round(top - std::abs(double{in[0]})));
    };
    p.step = [](const float*, std::size_t, double) { return ulpOf(1); };
    p.definition = [top](const float* in, double* out) {
        const Vec<double> n = octahedralDirection(double{in[0]} / top, double{in[1]} / top);
        out[0] = n.x, out[1] = n.y, out[2] = n.z;
    };
    setOperations(p, [top]<class N>(const N* in, N* out) {
        const N one(1.0f), inverse = one / N(static_cast<float>(top));
        const N x = in[0] * inverse, y = in[1] * inverse, z = one - size(x) - size(y);
        const auto wrap = [&](N c, N other) {
            return select(isLess(c, N(0.0f)), -(one - size(other)), one - size(other));
        };
        // At the edge both halves are the same point.
        const auto under = isLess(z, N(0.0f));
        const N x2 = select(under, wrap(x, y), x), y2 = select(under, wrap(y, x), y);
        const N l = root(sumOf(x2 * x2, y2 * y2, z * z));
        out[0] = x2 / l, out[1] = y2 / l, out[2] = z / l;
    });
    return p;
}

Probe unormProbe(std::uint32_t bits) {
    Probe p = codeProbe(fmt::format("unorm, {} bits", bits), 200 + bits,
                        "-0.1 to 1.1 in sequences of 256: evenly spaced, or consecutive floats",
                        "half a step, a product and a sum; codes increase monotonically on any device");
    p.line = 256;
    p.monotone = 1;
    p.strict = true;
    p.rows = 1u << 15;
    const double top = topOf(bits);
    p.make = [](Random&, std::size_t row, float* in) { in[0] = onLine(row, 256, -0.1, 1.1); };
    p.step = [](const float*, std::size_t, double) { return 1; };
    p.definition = [top](const float* in, double* out) {
        out[0] = std::clamp(double{in[0]}, 0.0, 1.0) * top;
    };
    setOperations(p, [top]<class N>(const N* in, N* out) {
        const N x = min(max(in[0], N(0.0f)), N(1.0f));
        out[0] = floorOf(x * N(static_cast<float>(top)) + N(0.5f));
    });
    // Sum and product may each be rounded one ULP up or down.
    p.allowance = [top](const float*, double* allowed) { allowed[0] = 0.5 + 2 * ulpOf(top); };
    return p;
}

Probe unormBackProbe(std::uint32_t bits) {
    Probe p = codeProbe(fmt::format("unorm from {} bits", bits), 300 + bits, "every code",
                        "a product with a constant; codes increase monotonically on any device");
    const double top = topOf(bits);
    p.rows = std::size_t{1} << bits;
    p.line = p.rows;
    p.monotone = 1;
    p.strict = true;
    p.unit = "ULP";
    p.make = [](Random&, std::size_t row, float* in) { in[0] = static_cast<float>(row); };
    p.definition = [top](const float* in, double* out) { out[0] = double{in[0]} / top; };
    setOperations(
        p, [top]<class N>(const N* in, N* out) { out[0] = in[0] * (N(1.0f) / N(static_cast<float>(top))); });
    return p;
}

Probe rootCodeProbe() {
    Probe p = codeProbe(fmt::format("square root, {} bits", gpu::ALBEDO_BITS), 400,
                        "0 to 1, half of them small; sequences of 256",
                        "half a step, and Vulkan's error bound of sqrt()");
    const double top = topOf(gpu::ALBEDO_BITS);
    p.line = 256;
    p.monotone = 1;
    p.make = [](Random&, std::size_t row, float* in) {
        in[0] = onLine(row, 256, 0, row / 256 % 3 ? 1 : 1e-3);
    };
    p.step = [](const float*, std::size_t, double) { return 1; };
    p.definition = [top](const float* in, double* out) { out[0] = top * std::sqrt(double{in[0]}); };
    setOperations(p, [top]<class N>(const N* in, N* out) {
        out[0] = floorOf(min(max(root(in[0]), N(0.0f)), N(1.0f)) * N(static_cast<float>(top)) + N(0.5f));
    });
    p.allowance = [top](const float* in, double* allowed) {
        allowed[0] = 0.5 + top * root(Interval(in[0])).width() + 2 * ulpOf(top);
    };
    return p;
}

Probe rootBackProbe() {
    Probe p = codeProbe(fmt::format("square root from {} bits", gpu::ALBEDO_BITS), 401, "every code",
                        "a product with a constant, squared");
    const double top = topOf(gpu::ALBEDO_BITS);
    p.rows = p.line = 1u << gpu::ALBEDO_BITS;
    p.monotone = 1;
    p.strict = true;
    p.unit = "ULP";
    p.make = [](Random&, std::size_t row, float* in) { in[0] = static_cast<float>(row); };
    p.definition = [top](const float* in, double* out) { out[0] = std::pow(double{in[0]} / top, 2); };
    setOperations(p, [top]<class N>(const N* in, N* out) {
        const N x = in[0] * (N(1.0f) / N(static_cast<float>(top)));
        out[0] = x * x;
    });
    return p;
}

// Step of 9.9.9.e5 (EXT_texture_shared_exponent): from the largest component's exponent after rounding to
// the mantissa's bits; at least 2^-24.
double sharedStep(double largest) {
    const double max_value = double{gpu::EMISSION_MAX}, x = std::clamp(largest, 0.0, max_value);
    double step = std::exp2(-double{gpu::EMISSION_BIAS + gpu::EMISSION_MANTISSA_BITS});
    // Rounding decides whether one bit more is needed, so both steps are valid.
    while (x > step * (topOf(gpu::EMISSION_MANTISSA_BITS) + 0.5 - 0x1p-14)) step *= 2;
    return step;
}

void makeRadiance(Random& random, float* in) {
    const double scale =
        random.coin() ? random.logarithmic(1e-7, 1e5) : std::exp2(std::floor(random.uniform(-16, 16)));
    for (int i = 0; i < 3; ++i)
        in[i] =
            static_cast<float>(scale * (random.bits() % 4 ? random.logarithmic(1e-4, 1) : random.ends(0, 1)));
}

Probe radianceProbe() {
    Probe p = codeProbe(
        fmt::format("radiance, {0}.{0}.{0}.e{1}", gpu::EMISSION_MANTISSA_BITS, gpu::EMISSION_EXPONENT_BITS),
        402, "1e-11 to 1e5, all magnitudes; components from equal to 1e-4 of the largest; powers of two",
        "half a step of the largest component's exponent; products with powers of two are exact");
    p.ins = p.outs = 3;
    p.rows = 1u << 17;
    p.make = [](Random& random, std::size_t, float* in) { makeRadiance(random, in); };
    const auto step = [](const float* in) { return sharedStep(double{std::max({in[0], in[1], in[2]})}); };
    p.step = [step](const float* in, std::size_t, double) { return step(in); };
    p.definition = [](const float* in, double* out) {
        for (int i = 0; i < 3; ++i) out[i] = std::clamp(double{in[i]}, 0.0, double{gpu::EMISSION_MAX});
    };
    // Adding 1/2 may round to the next integer: half a ULP of 512.
    p.allowance = [step](const float* in, double* allowed) {
        for (int i = 0; i < 3; ++i) allowed[i] = step(in) * (0.5 + 0x1p-14);
    };
    return p;
}

struct Layout {
    const char* name;
    std::uint32_t encoding, normal, geometric, roughness, metallic, ids;  // bits; 0: float32
};
constexpr Layout compact_layout{"G-buffer, compact",         gpu::GBUFFER_compact,
                                gpu::COMPACT_NORMAL_BITS,    gpu::COMPACT_GEOMETRIC_NORMAL_BITS,
                                gpu::COMPACT_ROUGHNESS_BITS, gpu::COMPACT_METALLIC_BITS,
                                gpu::COMPACT_ID_BITS};
constexpr Layout standard_layout{"G-buffer, standard",         gpu::GBUFFER_standard,
                                 gpu::STANDARD_NORMAL_BITS,    gpu::STANDARD_GEOMETRIC_NORMAL_BITS,
                                 gpu::STANDARD_ROUGHNESS_BITS, gpu::STANDARD_METALLIC_BITS,
                                 gpu::STANDARD_ID_BITS};
constexpr Layout full_layout{"G-buffer, full", gpu::GBUFFER_full, 0, 0, 0, 0, 20};

void makeSurface(Random& random, std::uint32_t id_bits, float* in) {
    put(foldedDirection(random), in);
    put(foldedDirection(random), in + 3);
    for (int i = 6; i < 22; ++i) in[i] = static_cast<float>(random.ends(0, 1));
    makeRadiance(random, in + 9);
    makeRadiance(random, in + 12);
    in[22] = static_cast<float>(random.bits() % (1u << id_bits));
}

void evaluateSurface(const Layout& layout, const float* in, const float* out, Tally& tally) {
    const std::size_t row = tally.first_row;
    const bool full = layout.encoding == gpu::GBUFFER_full;
    const auto field = [&](std::size_t i, double allowed, double step) {
        tally.value(row, i, out[i], std::clamp(double{in[i]}, 0.0, double{gpu::EMISSION_MAX}),
                    full ? 0 : allowed, full ? ulpOf(double{in[i]}) : step);
    };
    // Half a step, plus float32 rounding of a product, a sum, and a product back.
    const auto unorm = [&](std::size_t i, std::uint32_t bits) {
        const double step = 1 / topOf(bits);
        field(i, 0.5 * step + 4 * 0x1p-23, step);
    };
    for (std::size_t i = 0; i < 6; i += 3) {
        if (full)
            for (std::size_t k = i; k < i + 3; ++k) tally.value(row, k, out[k], double{in[k]}, 0, ulpOf(1));
        else
            tally.value(row, i, static_cast<float>(angleBetween(exactVec(in + i), exactVec(out + i))), 0,
                        octahedralBound(i == 0 ? layout.normal : layout.geometric) + 8 * 0x1p-23, 0);
    }
    for (const auto& [first, bits] : {std::pair{std::size_t{6}, gpu::ALBEDO_BITS}, {15, gpu::SPECULAR_BITS}})
        for (std::size_t i = first; i < first + 3; ++i) {
            const double h = 0.5 / topOf(bits), x = double{in[i]},
                         r = std::sqrt(x);  // |(r + h)^2 - r^2|, in steps at r
            field(i, h * (2 * r + h) + 4.5 * 0x1p-22, 2 * h * (2 * r + h));
        }
    for (const std::size_t first : {std::size_t{9}, std::size_t{12}}) {
        const double step = sharedStep(double{std::max({in[first], in[first + 1], in[first + 2]})});
        for (std::size_t i = first; i < first + 3; ++i)
            if (full)
                tally.value(row, i, out[i], double{in[i]}, 0, ulpOf(double{in[i]}));
            else
                field(i, step * (0.5 + 0x1p-14), step);
    }
    unorm(18, full ? 8 : layout.roughness);
    unorm(19, full ? 8 : layout.metallic);
    unorm(20, gpu::OCCLUSION_BITS);
    unorm(21, gpu::SPECULAR_F90_BITS);
    tally.value(row, 22, out[22], double{in[22]}, 0, 1);
    tally.value(row, 23, out[23], 1, 0, 1);
}

Probe layoutProbe(const Layout& layout) {
    const bool full = layout.encoding == gpu::GBUFFER_full;
    Probe p = codeProbe(layout.name, 0,
                        "surfaces: any normal, including on the folds, fractions 0 to 1 including both ends, "
                        "radiance of all magnitudes, every material index",
                        full ? "float32: bitwise equal" : "half a step of each field's bits");
    p.shader = "gbuffer.comp";
    p.unit = full ? "ULP" : "steps";
    p.ins = 23;
    p.outs = 24;
    p.rows = 1u << 15;
    p.features = {{gpu::FEATURE_gbuffer_encoding, layout.encoding},
                  {gpu::FEATURE_emission, 1},
                  {gpu::FEATURE_lightmap, 1},
                  {gpu::FEATURE_dielectric_specular, 1},
                  {gpu::FEATURE_captured, 1}};
    p.make = [layout](Random& random, std::size_t, float* in) { makeSurface(random, layout.ids, in); };
    p.evaluate = [layout](const float* in, const float* out, Tally& tally) {
        evaluateSurface(layout, in, out, tally);
    };
    return p;
}

}  // namespace

std::vector<Probe> codeProbes() {
    std::vector<Probe> all;
    for (const std::uint32_t bits : {8u, 12u, 16u}) all.push_back(octahedralProbe(bits));
    for (const std::uint32_t bits : {8u, 12u, 16u}) all.push_back(decodedProbe(bits));
    for (const std::uint32_t bits : {6u, 8u, 12u}) all.push_back(unormProbe(bits));
    for (const std::uint32_t bits : {6u, 8u, 12u}) all.push_back(unormBackProbe(bits));
    for (Probe (*make)() : {rootCodeProbe, rootBackProbe, radianceProbe}) all.push_back(make());
    for (const Layout& layout : {compact_layout, standard_layout, full_layout})
        all.push_back(layoutProbe(layout));
    return all;
}

}  // namespace diptych::probe
