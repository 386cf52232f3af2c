// SPDX-License-Identifier: MIT
#include "shared/environment/lat_long.h"

#include "shared/contract/constants.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace diptych {

// Columns wrap around. Beyond a pole, rows repeat in reverse, rotated by half a turn.
glm::vec3 LatLong::radiance(const glm::vec3& d) const {
    const int width = image_.width, height = image_.height;
    const float x = (std::atan2(d.x, -d.z) / (2 * gpu::PI) + 0.5f) * static_cast<float>(width) - 0.5f;
    const float y = std::atan2(std::hypot(d.x, d.z), d.y) / gpu::PI * static_cast<float>(height) - 0.5f;
    const float left = std::floor(x), top = std::floor(y), fx = x - left, fy = y - top;
    const auto row = [&](int j) {
        int column = static_cast<int>(left);
        if (j < 0 || j >= height) {
            j = std::clamp(j < 0 ? -1 - j : 2 * height - 1 - j, 0, height - 1);
            column += width / 2;
        }
        column %= width;
        if (column < 0) column += width;
        const std::size_t begin = static_cast<std::size_t>(j) * static_cast<std::size_t>(width);
        const float* a = image_.pixel(begin + static_cast<std::size_t>(column));
        const float* b = image_.pixel(begin + static_cast<std::size_t>((column + 1) % width));
        return glm::vec3(a[0] + (b[0] - a[0]) * fx, a[1] + (b[1] - a[1]) * fx, a[2] + (b[2] - a[2]) * fx);
    };
    const glm::vec3 above = row(static_cast<int>(top)), below = row(static_cast<int>(top) + 1);
    return above + (below - above) * fy;
}

glm::dvec3 LatLong::direction(double x, double y) const {
    const double azimuth = 2 * std::numbers::pi * (x + 0.5) / image_.width - std::numbers::pi,
                 polar = std::numbers::pi * (y + 0.5) / image_.height;
    return {std::sin(polar) * std::sin(azimuth), std::cos(polar), -std::sin(polar) * std::cos(azimuth)};
}

// A row's weight falls linearly between two centres; its integral times the sine has a closed form.
std::vector<double> LatLong::solidAngles() const {
    const double step = std::numbers::pi / image_.height, column = 2 * std::numbers::pi / image_.width;
    std::vector<double> weights(static_cast<std::size_t>(image_.height));
    for (std::size_t y = 0; y < weights.size(); ++y) {
        const double middle = step * (static_cast<double>(y) + 0.5);
        // Beyond the centre of a polar row, interpolation uses that row on both sides.
        const double falling = (1 - std::sin(step) / step) / step;  // integral of (1 - t) sin(t step), t =
                                                                    // 0..1
        const double level = (1 - std::cos(step)) / (step * step);  // integral of (1 - t) cos(t step)
        const auto half = [&](double sign) {
            return step * (std::sin(middle) * level + sign * std::cos(middle) * falling);
        };
        double weight = 0;
        weight += y == 0 ? 1 - std::cos(middle) : half(-1);
        weight += y + 1 == weights.size() ? 1 + std::cos(middle) : half(1);
        weights[y] = weight * column;
    }
    return weights;
}

}  // namespace diptych
