// SPDX-License-Identifier: MIT
// Positions from depth, and the froxel of a pixel.
#include "compare/probe/groups.h"
#include "compare/probe/vec.h"
#include "shared/contract/features.h"
#include "shared/contract/light_list.h"

namespace diptych::probe {
namespace {

Probe positionGroupProbe(const char* name, std::uint32_t function, const char* inputs, const char* because) {
    Probe probe;
    probe.group = "places";
    probe.name = name;
    probe.inputs = inputs;
    probe.unit = "ULP";
    probe.because = because;
    probe.shader = "position.comp";
    probe.function = function;
    return probe;
}

// The four depth parameters of shared/contract/view.h for reversed depth: 1 at the near plane, 0 at the
// far plane. Perspective: 1 / d is affine in z; orthographic: d is.
void makeDepths(Random& random, bool perspective, float* in) {
    const double near = random.logarithmic(1e-4, 1e3), far = near * random.logarithmic(1.01, 1e9);
    const bool endless_far = random.bits() % 4 == 0;
    if (!perspective)
        put({far, near - far, 1}, in), in[3] = 0;
    else if (endless_far)
        in[0] = static_cast<float>(near), in[1] = 0, in[2] = 0, in[3] = 1;
    else
        in[0] = static_cast<float>(near), in[1] = 0, in[2] = static_cast<float>(near / far),
        in[3] = static_cast<float>(1 - near / far);
}

double depthByDefinition(const float* in) {
    const double z = double{in[4]};
    return (double{in[0]} + z * double{in[1]}) / (double{in[2]} + z * double{in[3]});
}

// The sum of the terms' magnitudes, of which an orthographic depth may be a small difference.
double depthTerms(const float* in) {
    const double z = double{in[4]};
    return (std::abs(double{in[0]}) + std::abs(z * double{in[1]})) / (double{in[2]} + z * double{in[3]});
}

template <class N>
N depthSequence(const N* in) {
    return (in[0] + in[1] * in[4]) / (in[2] + in[3] * in[4]);
}

const char* const planes =
    "near planes 0.1 mm to 1 km, far planes 1.01 to 1e9 times as far, or none; every type of projection; z "
    "from 1e-9 to 1 including both ends";

Probe depthProbe() {
    Probe p = positionGroupProbe("view depth of a depth", 0, planes, "rounding in viewDepth()");
    p.ins = 5;
    p.line = 256;
    p.monotone = -1;
    p.make = [](Random&, std::size_t row, float* in) {
        Random line(row / 256);
        makeDepths(line, line.bits() % 4 != 0, in);
        in[4] = onLine(row, 256, 1e-9, 1);
    };
    p.unit = "ULP of sum";
    p.step = [](const float* in, std::size_t, double) { return ulpOf(depthTerms(in)); };
    p.definition = [](const float* in, double* out) { out[0] = depthByDefinition(in); };
    setOperations(p, [](const auto* in, auto* out) { out[0] = depthSequence(in); });
    return p;
}

Probe positionProbe(bool perspective) {
    Probe p = positionGroupProbe(perspective ? "position, perspective" : "position, orthographic", 1, planes,
                                 "rounding in positionFromDepth()");
    p.ins = 25;
    p.outs = 3;
    p.features = {{gpu::FEATURE_orthographic, perspective ? 0 : 1}};
    // Components are sums that may cancel, so errors are in ULP of the terms.
    p.unit = "ULP of sum";
    p.make = [perspective](Random& random, std::size_t, float* in) {
        makeDepths(random, perspective, in);
        in[4] = static_cast<float>(random.coin() ? random.ends(1e-9, 1) : random.logarithmic(1e-9, 1));
        const double width = std::floor(random.logarithmic(1, 16384)),
                     height = std::floor(random.logarithmic(1, 16384));
        const double step =
            (perspective ? std::tan(random.uniform(0.01, 1.4)) : random.logarithmic(0.1, 1e4)) / height;
        const Vec<double> z = randomDirection(random), x = rotatedTo(z, {1, 0, 0}),
                          y = rotatedTo(z, {0, 1, 0}), none{0, 0, 0};
        const Vec<double> corner = x * (-0.5 * width * step) + y * (-0.5 * height * step);
        put(perspective ? z + corner : z, in + 5);
        put(perspective ? x * step : none, in + 8);
        put(perspective ? y * step : none, in + 11);
        put(perspective ? none : corner, in + 14);
        put(perspective ? none : x * step, in + 17);
        put(perspective ? none : y * step, in + 20);
        in[23] = static_cast<float>(std::floor(random.uniform(0, width)) + 0.5);
        in[24] = static_cast<float>(std::floor(random.uniform(0, height)) + 0.5);
    };
    p.definition = [](const float* in, double* out) {
        const double px = double{in[23]}, py = double{in[24]};
        const Vec<double> origin = exactVec(in + 14) + exactVec(in + 17) * px + exactVec(in + 20) * py;
        const Vec<double> direction = exactVec(in + 5) + exactVec(in + 8) * px + exactVec(in + 11) * py;
        const Vec<double> x = origin + direction * depthByDefinition(in);
        out[0] = x.x, out[1] = x.y, out[2] = x.z;
    };
    p.step = [](const float* in, std::size_t, double) {
        const auto terms = [&](std::size_t i) {
            return length(exactVec(in + i)) + length(exactVec(in + i + 3)) * double{in[23]} +
                   length(exactVec(in + i + 6)) * double{in[24]};
        };
        return ulpOf(terms(14) + terms(5) * depthTerms(in));
    };
    setOperations(p, [perspective]<class N>(const N* in, N* out) {
        const N depth = depthSequence(in);
        for (int i = 0; i < 3; ++i) {
            const N along = perspective ? in[5 + i] + in[8 + i] * in[23] + in[11 + i] * in[24] : in[5 + i];
            const N from = perspective ? N(0.0f) : in[14 + i] + in[17 + i] * in[23] + in[20 + i] * in[24];
            out[i] = from + along * depth;
        }
    });
    return p;
}

// The number of floats from 0 to x: linear between powers of two.
double floatsUpTo(double x) {
    const double e = std::floor(std::log2(x));
    return (e + 126 + x / std::exp2(e)) * 0x1p23;
}
double floatOfCount(double count) {
    const double e = std::floor(count * 0x1p-23) - 127;
    return std::exp2(e) * (count * 0x1p-23 - (e + 126));
}

// A slice is a fixed number of consecutive floats of depth + offset (shared/contract/light_list.h).
void makeFroxel(Random& random, std::size_t row, float* in) {
    Random line(row / 256);
    in[0] = static_cast<float>(line.logarithmic(0.01, 100));
    in[1] = static_cast<float>(17 + line.bits() % 7);
    in[2] = static_cast<float>(2 + line.bits() % 63);
    in[3] = static_cast<float>(1 + random.bits() % 1024);
    in[4] = static_cast<float>(1 + random.bits() % 1024);
    in[5] = static_cast<float>(4 + line.bits() % 3);
    const double first = floatsUpTo(double{in[0]}), all = std::exp2(double{in[1]}) * double{in[2]};
    // Every fourth line crosses a slice's bound, float by float.
    const double bound = first + std::exp2(double{in[1]}) *
                                     static_cast<double>(1 + line.bits() % static_cast<std::uint64_t>(in[2]));
    const double position = static_cast<double>(row % 256);
    const double count = row / 256 % 4 ? first + all * 1.1 * (position + 0.5) / 256 : bound - 128 + position;
    in[6] = static_cast<float>(std::clamp(floatOfCount(count) - double{in[0]}, 0.0, 1e18));
    const auto pixel = [&](float tiles) {
        return static_cast<float>(std::floor(random.uniform(0, double{tiles} * std::exp2(double{in[5]}))) +
                                  0.5);
    };
    in[7] = pixel(in[3]), in[8] = pixel(in[4]);
}

void evaluateFroxels(const float* lines, const float* outs, Tally& tally) {
    for (std::size_t k = 0; k < 256; ++k) {
        const float *in = lines + 9 * k, *out = outs + 5 * k;
        const std::size_t row = tally.first_row + k;
        const double offset = double{in[0]}, size = std::exp2(double{in[1]}), last = double{in[2]} - 1,
                     depth = double{in[6]}, sum = depth + offset;
        const auto sliceOf = [&](double x) {
            return std::min(std::floor((floatsUpTo(x) - floatsUpTo(offset)) / size), last);
        };
        const double low = sliceOf(floatBelow(sum)), high = sliceOf(floatAbove(sum)), slice = double{out[0]};
        tally.value(row, 0, out[0], std::clamp(slice, low, high), 0, 1);
        // The slice's bounds, and that they contain the depth.
        const auto bound = [&](double i) { return floatOfCount(floatsUpTo(offset) + i * size); };
        const double from = bound(slice), to = bound(slice + 1);
        if (slice > 0)
            tally.value(row, 1, out[1], from - offset, 1e-6 * from + 3 * ulpOf(from), 0);
        else
            tally.value(row, 1, out[1], 0, 0, 0);
        if (slice < last)
            tally.value(row, 2, out[2], to - offset, 1e-6 * to + 3 * ulpOf(to), 0);
        else
            tally.value(row, 2, out[2], double{gpu::MAX_BOUND_RADIUS}, 0, 0);
        tally.value(row, 1, out[1], std::min(double{out[1]}, depth), 0, 0);
        tally.value(row, 2, out[2], std::max(double{out[2]}, depth), 0, 0);
        for (int i = 0; i < 2; ++i)
            tally.value(row, 3 + static_cast<std::size_t>(i), out[3 + i],
                        std::floor(double{in[7 + i]} / std::exp2(double{in[5]})), 0, 0);
    }
}

Probe froxelProbe() {
    Probe p = positionGroupProbe(
        "froxel of a pixel and depth", 2,
        "offsets 1 cm to 100 m, 2 to 64 slices of 2^17 to 2^23 floats; depths from 1e-3 m "
        "to beyond the last slice, and on the bounds; sequences of 256",
        "depth + offset may be rounded up or down; sliceDepths() is wider by 1e-6; integers "
        "are exact; slices increase monotonically on any device");
    p.ins = 9;
    p.outs = 5;
    p.line = 256;
    p.monotone = 1;
    p.strict = true;
    p.unit = "slices";
    p.features = {{gpu::FEATURE_light_lists, gpu::LISTS_CLUSTERED}};
    p.make = makeFroxel;
    p.evaluate = evaluateFroxels;
    return p;
}

}  // namespace

std::vector<Probe> positionProbes() {
    return {depthProbe(), positionProbe(true), positionProbe(false), froxelProbe()};
}

}  // namespace diptych::probe
