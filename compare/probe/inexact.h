// SPDX-License-Identifier: MIT
// Arithmetic of a device as inexact as Vulkan allows: each operation returns a random value from its
// Interval. Such results must pass every probe.
#pragma once

#include "compare/probe/interval.h"
#include "compare/probe/random.h"

namespace diptych::probe {

struct Sloppy {
    float value = 0;
    Sloppy() = default;
    Sloppy(float x) : value(x) {}
};

inline Random& sloppiness() {
    thread_local Random random(1);
    return random;
}

inline Sloppy anyOf(Interval x) {
    // Half of them are the ends.
    const double share = std::clamp(sloppiness().uniform(-0.5, 1.5), 0.0, 1.0);
    const double most_value = double{std::numeric_limits<float>::max()};
    const double lo = floatAbove(std::max(x.lo, -most_value)), hi = floatBelow(std::min(x.hi, most_value));
    if (hi <= lo) return static_cast<float>(lo);
    return static_cast<float>(std::clamp(double{static_cast<float>(lo + (hi - lo) * share)}, lo, hi));
}

inline Sloppy operator+(Sloppy a, Sloppy b) {
    return anyOf(Interval(a.value) + Interval(b.value));
}
inline Sloppy operator-(Sloppy a, Sloppy b) {
    return anyOf(Interval(a.value) - Interval(b.value));
}
inline Sloppy operator-(Sloppy a) {
    return -a.value;
}
inline Sloppy operator*(Sloppy a, Sloppy b) {
    return anyOf(Interval(a.value) * Interval(b.value));
}
inline Sloppy operator/(Sloppy a, Sloppy b) {
    return anyOf(Interval(a.value) / Interval(b.value));
}
inline Sloppy sumOf(Sloppy a, Sloppy b, Sloppy c) {
    return anyOf(sumOf(Interval(a.value), Interval(b.value), Interval(c.value)));
}
inline Sloppy inverseRoot(Sloppy x) {
    return anyOf(inverseRoot(Interval(x.value)));
}
inline Sloppy root(Sloppy x) {
    return anyOf(root(Interval(x.value)));
}
inline Sloppy powerOfTwo(Sloppy x) {
    return anyOf(powerOfTwo(Interval(x.value)));
}
inline Sloppy exponential(Sloppy x) {
    return anyOf(exponential(Interval(x.value)));
}
inline Sloppy binaryLogarithm(Sloppy x) {
    return anyOf(binaryLogarithm(Interval(x.value)));
}
inline Sloppy naturalLogarithm(Sloppy x) {
    return anyOf(naturalLogarithm(Interval(x.value)));
}
inline Sloppy sine(Sloppy x) {
    return anyOf(sine(Interval(x.value)));
}
inline Sloppy cosine(Sloppy x) {
    return anyOf(cosine(Interval(x.value)));
}
inline Sloppy least(Sloppy a, Sloppy b) {
    return std::min(a.value, b.value);
}
inline Sloppy most(Sloppy a, Sloppy b) {
    return std::max(a.value, b.value);
}
inline Sloppy size(Sloppy a) {
    return std::abs(a.value);
}
inline Sloppy floorOf(Sloppy a) {
    return std::floor(a.value);
}
inline bool isLess(Sloppy a, Sloppy b) {
    return a.value < b.value;
}
inline Sloppy chosen(bool truth, Sloppy a, Sloppy b) {
    return truth ? a : b;
}
inline Sloppy approximating(Sloppy x, double relative, double absolute = 0) {
    return anyOf(approximating(Interval(x.value), relative, absolute));
}
template <class Of>
Sloppy monotoneOf(Sloppy x, Of of, double relative, double absolute = 0) {
    return anyOf(monotoneOf(Interval(x.value), of, relative, absolute));
}

}  // namespace diptych::probe
