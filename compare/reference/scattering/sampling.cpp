// SPDX-License-Identifier: MIT
#include "compare/reference/scattering/sampling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace diptych::reference {

namespace {

std::uint64_t mixed(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

}  // namespace

double Random::operator()() {
    state_ += 0x9e3779b97f4a7c15u;
    return static_cast<double>(mixed(state_) >> 11) * 0x1p-53;
}

// Neither factor is SplitMix64's increment; otherwise neighbouring streams would be the same sequence, one
// step apart.
std::uint64_t streamOf(std::uint64_t seed, std::uint64_t index) {
    return mixed(mixed(seed + 0xd1342543de82ef95u) + index * 0xaf251af3b0f025b5u);
}

glm::dvec2 evenly(std::uint64_t index, const glm::dvec2& shift) {
    constexpr double g = 1.32471795724474602596;  // g^3 = g + 1
    const auto n = static_cast<double>(index);
    const double x = shift.x + n / g, y = shift.y + n / (g * g);
    return {x - std::floor(x), y - std::floor(y)};
}

void Rounds::add(const Reflected& estimate) {
    ++count_;
    const Reflected deviation = estimate - mean_;
    mean_ += deviation * (1.0 / count_);
    const Reflected after = estimate - mean_;
    squares_ += deviation.sum() * after.sum();
}

double Rounds::halfWidth() const {
    if (count_ < 2) return std::numeric_limits<double>::infinity();
    // Student's t, two-sided 95 %, for 1 to 15 degrees of freedom; above, 1.96 + 2.8 / n is an upper
    // bound.
    constexpr std::array<double, 15> student{12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306,
                                             2.262,  2.228, 2.201, 2.179, 2.160, 2.145, 2.131};
    const std::uint32_t freedom = count_ - 1;
    const double t = freedom <= student.size() ? student[freedom - 1] : 1.96 + 2.8 / freedom;
    const double largest = std::max({squares_.x, squares_.y, squares_.z});
    return t * std::sqrt(largest / freedom / count_);
}

}  // namespace diptych::reference
