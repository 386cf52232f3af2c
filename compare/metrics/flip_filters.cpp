// SPDX-License-Identifier: MIT
#include "compare/metrics/flip_filters.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace diptych {
namespace {

using Weights = std::vector<double>;

using std::numbers::pi;

// exp(-pi^2 d^2 / b), d in degrees: up to a factor, the inverse Fourier transform of a sensitivity exp(-b
// f^2), f in cycles per degree.
Weights sensitivity(double b, double pixelsPerDegree, int radius) {
    Weights w(static_cast<std::size_t>(radius) + 1);
    for (std::size_t k = 0; k < w.size(); ++k) {
        const double d = static_cast<double>(k) / pixelsPerDegree;
        w[k] = std::exp(-pi * pi * d * d / b);
    }
    return w;
}

double bothSides(const Weights& w) {
    double sum = w[0];
    for (std::size_t k = 1; k < w.size(); ++k) sum += 2 * w[k];
    return sum;
}

// Divides by `sum` and drops the tail below 1e-8 of the middle: sixteen such weights are below half a unit
// in a float's last place.
HalfKernel over(const Weights& w, double sum) {
    std::size_t last = w.size();
    while (last > 1 && w[last - 1] < 1e-8 * w[0]) --last;
    HalfKernel kernel;
    for (std::size_t k = 0; k < last; ++k) kernel.push_back(static_cast<float>(w[k] / sum));
    return kernel;
}

int up(double v) {
    return static_cast<int>(std::ceil(v));
}

// Normalizes positive and negative weights separately.
HalfKernel normalizedBySign(const Weights& w, double positive, double negative) {
    HalfKernel kernel;
    for (const double v : w) kernel.push_back(static_cast<float>(v > 0 ? v / positive : v / negative));
    return kernel;
}

}  // namespace

FlipFilters::FlipFilters(double ppd) {
    // Table 1 of the paper: a and b of a exp(-b f^2); yellow-blue has two terms.
    constexpr double by = 0.0047, bcx = 0.0053, a1 = 34.1, b1 = 0.04, a2 = 13.5, b2 = 0.025;
    // Three standard deviations of the widest filter, for all.
    const int radius = up(3 * std::sqrt(b1 / (2 * pi * pi)) * ppd);
    const Weights wy = sensitivity(by, ppd, radius), wcx = sensitivity(bcx, ppd, radius);
    const Weights w1 = sensitivity(b1, ppd, radius), w2 = sensitivity(b2, ppd, radius);
    y = over(wy, bothSides(wy));
    cx = over(wcx, bothSides(wcx));
    cz = {over(w1, bothSides(w1)), over(w2, bothSides(w2))};
    const double s1 = bothSides(w1), s2 = bothSides(w2);
    const double volume1 = a1 * std::sqrt(pi / b1) * s1 * s1, volume2 = a2 * std::sqrt(pi / b2) * s2 * s2;
    cz_fraction = {static_cast<float>(volume1 / (volume1 + volume2)),
                   static_cast<float>(volume2 / (volume1 + volume2))};

    // Half of the width of 0.082 degrees at which an edge is detected.
    const double deviation = 0.5 * 0.082 * ppd;
    const auto size = static_cast<std::size_t>(up(3 * deviation)) + 1;
    Weights g(size), first(size), second(size);
    double firstSum = 0, positive = 0, negative = 0;
    for (std::size_t k = 0; k < size; ++k) {
        const double d = static_cast<double>(k) / deviation;
        g[k] = std::exp(-0.5 * d * d);
        first[k] = d * g[k];
        second[k] = (d * d - 1) * g[k];
        firstSum += first[k];
        (second[k] > 0 ? positive : negative) += (k ? 2 : 1) * std::abs(second[k]);
    }
    smooth = over(g, bothSides(g));
    edge = normalizedBySign(first, firstSum, firstSum);
    point = normalizedBySign(second, positive, negative);
}

int FlipFilters::radius() const {
    return static_cast<int>(std::max(
               {y.size(), cx.size(), cz[0].size(), cz[1].size(), smooth.size(), edge.size(), point.size()})) -
           1;
}

}  // namespace diptych
