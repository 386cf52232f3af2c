// SPDX-License-Identifier: MIT
// Distance of two pixels. Two NaNs are equal, and so are equal infinities; other non-finite components are
// infinitely far from anything.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

namespace diptych::metrics {

constexpr double infinity = std::numeric_limits<double>::infinity();

inline std::size_t size(int n) {
    return static_cast<std::size_t>(n);
}

inline bool finite(const float* p, int components) {
    return std::all_of(p, p + components, [](float v) { return std::isfinite(v); });
}
inline bool same(float a, float b) {
    return a == b || (std::isnan(a) && std::isnan(b));
}

// |a-b| of two components; for pixels, the largest over components.
inline double distance(float a, float b) {
    if (same(a, b)) return 0;
    if (!std::isfinite(a) || !std::isfinite(b)) return infinity;
    return std::abs(double{a} - double{b});
}
inline double distance(const float* a, const float* b, int components) {
    double largest = 0;
    for (int c = 0; c < components; ++c) largest = std::max(largest, distance(a[c], b[c]));
    return largest;
}

inline double largestFinite(const float* p, int components) {
    double largest = 0;
    for (int c = 0; c < components; ++c)
        if (std::isfinite(p[c])) largest = std::max(largest, std::abs(double{p[c]}));
    return largest;
}

// Degrees between two finite 3-vectors; 0 between two zero vectors, 180 if one is zero. Computed by atan2
// in double, because acos of a dot product loses half the digits near 0 (Kahan 2006, "How Futile are
// Mindless Assessments of Roundoff", section 12).
inline double angle(const float* a, const float* b) {
    const double ax = a[0], ay = a[1], az = a[2], bx = b[0], by = b[1], bz = b[2];
    const bool aIsZero = ax == 0 && ay == 0 && az == 0, bIsZero = bx == 0 && by == 0 && bz == 0;
    if (aIsZero || bIsZero) return aIsZero == bIsZero ? 0 : 180;
    const double cross = std::hypot(ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx);
    return std::atan2(cross, ax * bx + ay * by + az * bz) * 180 / std::numbers::pi;
}

// Degrees between two lines, each along a finite 3-vector of either sign: 0 to 90; 0 between two zero
// vectors, 90 if one is zero.
inline double lineAngle(const float* a, const float* b) {
    const std::array<float, 3> reversed{-b[0], -b[1], -b[2]};
    return std::min({angle(a, b), angle(a, reversed.data()), 90.0});
}

// Difference of the lengths of two finite 3-vectors.
inline double lengthDifference(const float* a, const float* b) {
    const auto length = [](const float* v) { return std::hypot(double{v[0]}, double{v[1]}, double{v[2]}); };
    return std::abs(length(a) - length(b));
}

}  // namespace diptych::metrics
