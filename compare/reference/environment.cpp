// SPDX-License-Identifier: MIT
#include "compare/reference/environment.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace diptych::reference {
namespace {

constexpr double pi = std::numbers::pi;

std::size_t at(int i) {
    return static_cast<std::size_t>(i);
}

// The first entry beyond u, and how far u is on the way to it.
struct Found {
    int index;
    double within;
};
Found find(const double* cumulative, int count, double u) {
    const double* end = cumulative + count;
    const double target = u * end[-1];
    const double* entry = std::min(std::upper_bound(cumulative, end, target), end - 1);
    const double before = entry == cumulative ? 0 : entry[-1];
    const double width = *entry - before;
    return {static_cast<int>(entry - cumulative), width > 0 ? (target - before) / width : 0.5};
}

}  // namespace

// The density of a pixel follows the brightest of what bilinear interpolation shows within it, so that nowhere
// where there is light it is 0.
EnvironmentLight::EnvironmentLight(const Environment& environment, double factor)
    : image_(environment.radiance), factor_(factor) {
    const int width = image_.width, height = image_.height;
    rows_.resize(at(height));
    columns_.resize(image_.pixels());
    weight_.resize(image_.pixels());
    const auto brightness = [&](int x, int y) {
        return std::max({texel(x, y, 0), texel(x, y, 1), texel(x, y, 2)});
    };
    double sum = 0;
    for (int y = 0; y < height; ++y) {
        const double solid = std::cos(pi * y / height) - std::cos(pi * (y + 1) / height);
        double row = 0;
        for (int x = 0; x < width; ++x) {
            double largest = 0;
            for (int dy = -1; dy <= 1; ++dy)
                for (int dx = -1; dx <= 1; ++dx) largest = std::max(largest, brightness(x + dx, y + dy));
            weight_[at(y * width + x)] = largest * solid;
            row += largest * solid;
            columns_[at(y * width + x)] = row;
        }
        sum += row;
        rows_[at(y)] = sum;
    }
    if (sum > 0)
        for (double& w : weight_) w /= sum;
}

// Columns go round; rows beyond a pole are those before it, half a turn on.
double EnvironmentLight::texel(int x, int y, int c) const {
    const int width = image_.width, height = image_.height;
    if (y < 0 || y >= height) {
        y = y < 0 ? -1 - y : 2 * height - 1 - y;
        x += width / 2;
    }
    return double{image_.at((x % width + width) % width, std::clamp(y, 0, height - 1), c)};
}

glm::dvec3 EnvironmentLight::radiance(const glm::dvec3& d) const {
    const double x = (std::atan2(d.x, -d.z) / (2 * pi) + 0.5) * image_.width - 0.5;
    const double y = std::acos(std::clamp(d.y, -1.0, 1.0)) / pi * image_.height - 0.5;
    const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
    const double fx = x - x0, fy = y - y0;
    glm::dvec3 sum(0);
    for (int c = 0; c < 3; ++c)
        sum[c] = (texel(x0, y0, c) * (1 - fx) + texel(x0 + 1, y0, c) * fx) * (1 - fy) +
                 (texel(x0, y0 + 1, c) * (1 - fx) + texel(x0 + 1, y0 + 1, c) * fx) * fy;
    return sum * factor_;
}

glm::dvec3 EnvironmentLight::sample(const glm::dvec2& u) const {
    const int width = image_.width, height = image_.height;
    const Found row = find(rows_.data(), height, u.y);
    const Found column = find(columns_.data() + at(row.index) * at(width), width, u.x);
    // Within a row by solid angle, which is even in the cosine.
    const double top = std::cos(pi * row.index / height), bottom = std::cos(pi * (row.index + 1) / height);
    const double cosine = top + (bottom - top) * row.within, sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
    const double azimuth = 2 * pi * (column.index + column.within) / width - pi;
    return {sine * std::sin(azimuth), cosine, -sine * std::cos(azimuth)};
}

double EnvironmentLight::density(const glm::dvec3& d) const {
    const int width = image_.width, height = image_.height;
    const int x = static_cast<int>((std::atan2(d.x, -d.z) / (2 * pi) + 0.5) * width);
    const int y = static_cast<int>(std::acos(std::clamp(d.y, -1.0, 1.0)) / pi * height);
    const int row = std::clamp(y, 0, height - 1), column = std::clamp(x, 0, width - 1);
    const double solid = 2 * pi / width * (std::cos(pi * row / height) - std::cos(pi * (row + 1) / height));
    return weight_[at(row) * at(width) + at(column)] / solid;
}

}  // namespace diptych::reference
