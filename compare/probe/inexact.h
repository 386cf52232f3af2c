// SPDX-License-Identifier: MIT
// Arithmetic of a device as inexact as Vulkan allows: each operation returns a random value from its
// Interval. Such results must pass every probe.
#pragma once

#include "compare/probe/interval.h"
#include "compare/probe/random.h"

namespace diptych::probe {

struct Inexact {
    float value = 0;
    Inexact() = default;
    Inexact(float x) : value(x) {}
};

inline Random& inexactness() {
    thread_local Random random(1);
    return random;
}

inline Inexact anyOf(Interval x) {
    // Half of them are the ends.
    const double fraction = std::clamp(inexactness().uniform(-0.5, 1.5), 0.0, 1.0);
    const double max_value = double{std::numeric_limits<float>::max()};
    const double lo = floatAbove(std::max(x.lo, -max_value)), hi = floatBelow(std::min(x.hi, max_value));
    if (hi <= lo) return static_cast<float>(lo);
    return static_cast<float>(std::clamp(double{static_cast<float>(lo + (hi - lo) * fraction)}, lo, hi));
}

inline Inexact operator+(Inexact a, Inexact b) {
    return anyOf(Interval(a.value) + Interval(b.value));
}
inline Inexact operator-(Inexact a, Inexact b) {
    return anyOf(Interval(a.value) - Interval(b.value));
}
inline Inexact operator-(Inexact a) {
    return -a.value;
}
inline Inexact operator*(Inexact a, Inexact b) {
    return anyOf(Interval(a.value) * Interval(b.value));
}
inline Inexact operator/(Inexact a, Inexact b) {
    return anyOf(Interval(a.value) / Interval(b.value));
}
inline Inexact sumOf(Inexact a, Inexact b, Inexact c) {
    return anyOf(sumOf(Interval(a.value), Interval(b.value), Interval(c.value)));
}
inline Inexact inverseRoot(Inexact x) {
    return anyOf(inverseRoot(Interval(x.value)));
}
inline Inexact root(Inexact x) {
    return anyOf(root(Interval(x.value)));
}
inline Inexact powerOfTwo(Inexact x) {
    return anyOf(powerOfTwo(Interval(x.value)));
}
inline Inexact exponential(Inexact x) {
    return anyOf(exponential(Interval(x.value)));
}
inline Inexact binaryLogarithm(Inexact x) {
    return anyOf(binaryLogarithm(Interval(x.value)));
}
inline Inexact naturalLogarithm(Inexact x) {
    return anyOf(naturalLogarithm(Interval(x.value)));
}
inline Inexact sine(Inexact x) {
    return anyOf(sine(Interval(x.value)));
}
inline Inexact cosine(Inexact x) {
    return anyOf(cosine(Interval(x.value)));
}
inline Inexact min(Inexact a, Inexact b) {
    return std::min(a.value, b.value);
}
inline Inexact max(Inexact a, Inexact b) {
    return std::max(a.value, b.value);
}
inline Inexact size(Inexact a) {
    return std::abs(a.value);
}
inline Inexact floorOf(Inexact a) {
    return std::floor(a.value);
}
inline bool isLess(Inexact a, Inexact b) {
    return a.value < b.value;
}
inline Inexact select(bool condition, Inexact a, Inexact b) {
    return condition ? a : b;
}
inline Inexact approximating(Inexact x, double relative, double absolute = 0) {
    return anyOf(approximating(Interval(x.value), relative, absolute));
}
template <class Of>
Inexact monotoneOf(Inexact x, Of of, double relative, double absolute = 0) {
    return anyOf(monotoneOf(Interval(x.value), of, relative, absolute));
}

}  // namespace diptych::probe
