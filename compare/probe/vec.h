// SPDX-License-Identifier: MIT
// Vectors of the number types of probes: Interval and Inexact for a device's arithmetic, double for exact
// results.
#pragma once

#include "compare/probe/inexact.h"

#include <cmath>

namespace diptych::probe {

template <class N>
struct Vec {
    N x{}, y{}, z{};
};

template <class N>
Vec<N> vecAt(const N* in) {
    return {in[0], in[1], in[2]};
}
inline Vec<double> exactVec(const float* in) {
    return {double{in[0]}, double{in[1]}, double{in[2]}};
}

template <class N>
Vec<N> operator+(Vec<N> a, Vec<N> b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class N>
Vec<N> operator-(Vec<N> a, Vec<N> b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class N>
Vec<N> operator*(Vec<N> a, N f) {
    return {a.x * f, a.y * f, a.z * f};
}
template <class N>
Vec<N> operator/(Vec<N> a, N f) {
    return {a.x / f, a.y / f, a.z / f};
}
inline double sumOf(double a, double b, double c) {
    return a + b + c;
}
template <class N>
N dot(Vec<N> a, Vec<N> b) {
    return sumOf(a.x * b.x, a.y * b.y, a.z * b.z);
}
template <class N>
Vec<N> cross(Vec<N> a, Vec<N> b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(Vec<double> a) {
    return std::sqrt(dot(a, a));
}
inline Vec<double> unit(Vec<double> a) {
    return a / length(a);
}

// A float vector has only nearly unit length. A formula for unit vectors may use it as it is or
// normalised; the interval covers both.
inline Vec<Interval> nearlyUnit(Vec<Interval> v) {
    const double l = length({v.x.lo, v.y.lo, v.z.lo});
    const auto both = [&](Interval c) {
        return hull(c, {std::min(c.lo / l, c.hi / l), std::max(c.lo / l, c.hi / l)});
    };
    return {both(v.x), both(v.y), both(v.z)};
}
inline Vec<Inexact> nearlyUnit(Vec<Inexact> v) {
    return v;
}

// Uniform over the sphere.
inline Vec<double> randomDirection(Random& random) {
    const double z = random.uniform(-1, 1), s = std::sqrt(1 - z * z),
                 t = random.uniform(0, 2 * std::numbers::pi);
    return {s * std::cos(t), s * std::sin(t), z};
}
// At `angle` to the z axis, rad; random azimuth.
inline Vec<double> atAngle(Random& random, double angle) {
    const double t = random.uniform(0, 2 * std::numbers::pi);
    return {std::sin(angle) * std::cos(t), std::sin(angle) * std::sin(t), std::cos(angle)};
}
inline void put(Vec<double> v, float* to) {
    to[0] = static_cast<float>(v.x), to[1] = static_cast<float>(v.y), to[2] = static_cast<float>(v.z);
}
// Rotates the vector so that the z axis becomes `n`, unit.
inline Vec<double> rotatedTo(Vec<double> n, Vec<double> v) {
    const Vec<double> other = std::abs(n.x) < 0.5 ? Vec<double>{1, 0, 0} : Vec<double>{0, 1, 0};
    const Vec<double> x = unit(cross(other, n)), y = cross(n, x);
    return x * v.x + y * v.y + n * v.z;
}

}  // namespace diptych::probe
