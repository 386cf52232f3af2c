// SPDX-License-Identifier: MIT
// Random inputs of a row, determined by its index alone: equal on every machine and in any order.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

namespace diptych::probe {

class Random {
public:
    explicit Random(std::uint64_t seed) : state_(seed * 0x9e3779b97f4a7c15u + 0x632be59bd9b4e019u) {}

    // Steele, Lea and Flood 2014, "Fast Splittable Pseudorandom Number Generators" (SplitMix64).
    std::uint64_t bits() {
        std::uint64_t z = state_ += 0x9e3779b97f4a7c15u;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }
    double unit() { return static_cast<double>(bits() >> 11) * 0x1p-53; }  // in [0, 1)
    double uniform(double from, double to) { return from + (to - from) * unit(); }
    // Log-uniform; both ends above 0.
    double logarithmic(double from, double to) { return from * std::exp2(unit() * std::log2(to / from)); }
    // In [from, to]. Half of the values are at an end or near it, down to 2^-24 of the range away.
    double ends(double from, double to) {
        const std::uint64_t kind = bits() & 7;
        if (kind < 4) return uniform(from, to);
        if (kind == 7) return bits() & 1 ? from : to;
        const double off = (to - from) * logarithmic(0x1p-24, 1);
        return kind & 1 ? from + off : to - off;
    }
    bool coin() { return bits() & 1; }

private:
    std::uint64_t state_;
};

}  // namespace diptych::probe
