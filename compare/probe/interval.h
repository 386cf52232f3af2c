// SPDX-License-Identifier: MIT
// Interval arithmetic over all float32 results that Vulkan 1.3 allows ("Precision and Operation of SPIR-V
// Instructions", table 94 and around it). Every operation has its widest allowed result, as in Vulkan's
// conformance tests.
//
//   + - *            the exact result, rounded up or down unless it is a float
//   a / b            2.5 ULP for |b| in [2^-126, 2^126], no guarantee beyond
//   inversesqrt      2 ULP; sqrt is 1 / inversesqrt
//   exp, exp2        3 + 2 |x| ULP
//   log, log2        3 ULP; an absolute error of 2^-21 for x in [0.5, 2]
//   sin, cos         an absolute error of 2^-11 for x in [-pi, pi], no guarantee beyond
//   denormals        may be 0, as operands and as results
//
// Bounds are doubles: their own rounding is 2^-29 of a ULP.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

namespace diptych::probe {

inline constexpr double endless = std::numeric_limits<double>::infinity();
inline constexpr double min_normal = 0x1p-126;

// The spacing of floats at x; 2^-149, that of denormals, below 2^-126.
inline double ulpOf(double x) {
    const auto exponent = static_cast<std::int64_t>((std::bit_cast<std::uint64_t>(x) >> 52) & 0x7ff) - 1023;
    return std::bit_cast<double>(
        static_cast<std::uint64_t>(std::max<std::int64_t>(exponent, -126) - 23 + 1023) << 52);
}

// The largest float at most x, and the smallest at least x.
inline double floatBelow(double x) {
    const float f = static_cast<float>(x);
    return f > x ? double{std::nextafter(f, -std::numeric_limits<float>::infinity())} : double{f};
}
inline double floatAbove(double x) {
    const float f = static_cast<float>(x);
    return f < x ? double{std::nextafter(f, std::numeric_limits<float>::infinity())} : double{f};
}

struct Interval {
    double lo = 0, hi = 0;

    Interval() = default;
    Interval(float x) : Interval(double{x}, double{x}) {}
    // Denormals may be treated as 0.
    Interval(double from, double to) : lo(from), hi(to) {
        if (lo > 0 && lo < min_normal) lo = 0;
        if (hi < 0 && hi > -min_normal) hi = 0;
    }
    double width() const { return hi - lo; }
};

inline Interval anything() {
    return {-endless, endless};
}

// Rounded outward to floats; anything() for NaN.
inline Interval rounded(double lo, double hi) {
    if (!(lo <= hi)) return anything();
    return {floatBelow(lo), floatAbove(hi)};
}
// The smallest x - `ulps` ULP(x) over x in [lo, hi]; the ULP doubles at each power of two.
inline double lowerBound(double lo, double hi, double ulps) {
    double bound = lo - ulps * ulpOf(lo);
    const double next = lo > 0 ? std::exp2(std::floor(std::log2(lo)) + 1) : hi;
    if (lo > 0 && next <= hi) bound = std::min(bound, next - ulps * ulpOf(next));
    return bound;
}
inline Interval within(double lo, double hi, double ulps) {
    return rounded(lowerBound(lo, hi, ulps), -lowerBound(-hi, -lo, ulps));
}
inline Interval hull(Interval a, Interval b) {
    return {std::min(a.lo, b.lo), std::max(a.hi, b.hi)};
}

inline Interval operator+(Interval a, Interval b) {
    return rounded(a.lo + b.lo, a.hi + b.hi);
}
inline Interval operator-(Interval a) {
    return {-a.hi, -a.lo};
}
inline Interval operator-(Interval a, Interval b) {
    return rounded(a.lo - b.hi, a.hi - b.lo);
}

// The range of `of` at the four combinations of ends.
template <class Of>
Interval ofEnds(Interval a, Interval b, Of of) {
    const double w = of(a.lo, b.lo), x = of(a.lo, b.hi), y = of(a.hi, b.lo), z = of(a.hi, b.hi);
    if (std::isnan(w) || std::isnan(x) || std::isnan(y) || std::isnan(z)) return anything();
    Interval ends;
    ends.lo = std::min(std::min(w, x), std::min(y, z)), ends.hi = std::max(std::max(w, x), std::max(y, z));
    return ends;
}

inline Interval operator*(Interval a, Interval b) {
    const Interval ends = ofEnds(a, b, [](double x, double y) { return x * y; });
    return rounded(ends.lo, ends.hi);
}
inline Interval operator/(Interval a, Interval b) {
    const double near = b.lo > 0 ? b.lo : -b.hi, far = b.lo > 0 ? b.hi : -b.lo;
    if (!(near >= min_normal) || far > 0x1p126) return anything();
    const Interval ends = ofEnds(a, b, [](double x, double y) { return x / y; });
    return within(ends.lo, ends.hi, 2.5);
}

// The sum in any order: the exact one, widened by two roundings of the sum of magnitudes.
inline Interval sumOf(Interval a, Interval b, Interval c) {
    const auto size = [](Interval x) { return std::max(std::abs(x.lo), std::abs(x.hi)); };
    const double max = size(a) + size(b) + size(c), more = max > 0 ? ulpOf(max) : 0;
    const Interval exact = rounded(a.lo + b.lo + c.lo, a.hi + b.hi + c.hi);
    return rounded(exact.lo - more, exact.hi + more);
}

inline Interval inverseRoot(Interval x) {
    if (x.hi <= 0) return anything();
    return within(1 / std::sqrt(x.hi), x.lo > 0 ? 1 / std::sqrt(x.lo) : endless, 2);
}
inline Interval root(Interval x) {
    if (x.hi < 0) return anything();
    // 2 ULP of inversesqrt and 2.5 of the division; a ULP is 2^-24 to 2^-23 of a number.
    const double lo = std::sqrt(std::max(x.lo, 0.0)), hi = std::sqrt(x.hi), fraction = 4.5 * 0x1p-23;
    const Interval r = rounded(lo - lo * fraction, hi + hi * fraction);
    return x.lo < 0 ? hull(r, Interval(0.0f)) : r;
}
inline Interval powerOfTwo(Interval x) {
    const double ulps = 3 + 2 * std::max(std::abs(x.lo), std::abs(x.hi));
    return within(std::exp2(x.lo), std::exp2(x.hi), ulps);
}
inline Interval exponential(Interval x) {
    const double ulps = 3 + 2 * std::max(std::abs(x.lo), std::abs(x.hi));
    return within(std::exp(x.lo), std::exp(x.hi), ulps);
}
template <class Of>
Interval logarithm(Interval x, Of of) {
    if (x.lo <= 0) return anything();
    const double lo = of(x.lo), hi = of(x.hi), off = 0x1p-21;
    const bool near = x.hi >= 0.5 && x.lo <= 2;
    return rounded(std::min(lowerBound(lo, hi, 3), near ? lo - off : lo),
                   std::max(-lowerBound(-hi, -lo, 3), near ? hi + off : hi));
}
inline Interval binaryLogarithm(Interval x) {
    return logarithm(x, [](double v) { return std::log2(v); });
}
inline Interval naturalLogarithm(Interval x) {
    return logarithm(x, [](double v) { return std::log(v); });
}
// For a narrow interval: sine and cosine change by at most its width.
template <class Of>
Interval waveOf(Interval x, Of of) {
    if (x.lo < -std::numbers::pi * (1 + 0x1p-23) || x.hi > std::numbers::pi * (1 + 0x1p-23))
        return anything();
    const double middle = of(0.5 * (x.lo + x.hi)), off = 0x1p-11 + 0.5 * x.width();
    return rounded(middle - off, middle + off);
}
inline Interval sine(Interval x) {
    return waveOf(x, [](double v) { return std::sin(v); });
}
inline Interval cosine(Interval x) {
    return waveOf(x, [](double v) { return std::cos(v); });
}

inline Interval min(Interval a, Interval b) {
    return {std::min(a.lo, b.lo), std::min(a.hi, b.hi)};
}
inline Interval max(Interval a, Interval b) {
    return {std::max(a.lo, b.lo), std::max(a.hi, b.hi)};
}
inline Interval size(Interval a) {
    if (a.lo >= 0) return a;
    return a.hi <= 0 ? -a : Interval{0, std::max(-a.lo, a.hi)};
}
inline Interval floorOf(Interval a) {
    return {std::floor(a.lo), std::floor(a.hi)};
}

// The result of a comparison, which may depend on rounding.
struct Tribool {
    bool may_hold, may_fail;
};
inline Tribool isLess(Interval a, Interval b) {
    return {a.lo < b.hi, a.hi >= b.lo};
}
inline Interval select(Tribool condition, Interval a, Interval b) {
    return condition.may_hold ? condition.may_fail ? hull(a, b) : a : b;
}

// Widens an interval by an approximation's error.
inline Interval approximating(Interval x, double relative, double absolute = 0) {
    const auto off = [&](double v) { return std::abs(v) * relative + absolute; };
    return {x.lo - off(x.lo), x.hi + off(x.hi)};
}

// A monotone function of an interval, with the approximation's error.
template <class Of>
Interval monotoneOf(Interval x, Of of, double relative, double absolute = 0) {
    const double a = of(x.lo), b = of(x.hi);
    return approximating({std::min(a, b), std::max(a, b)}, relative, absolute);
}

}  // namespace diptych::probe
