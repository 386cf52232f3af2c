// SPDX-License-Identifier: MIT
#include "shared/environment/bright_pixels.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <numbers>
#include <utility>

namespace diptych {

namespace {

float brightest(const float* p) {
    return std::max({p[0], p[1], p[2]});
}

// Parts along one side of a pixel's support, which is two pixels wide. Four parts span a texel.
int partsAcross(double pixel, int side) {
    const double texel = std::sqrt(4 * std::numbers::pi) / side;
    return std::clamp(static_cast<int>(std::ceil(2 * pixel / (texel / 4))), 8, 256);
}

}  // namespace

BrightPixels::BrightPixels(Environment& environment)
    : width_(environment.radiance.width),
      height_(environment.radiance.height),
      solid_(LatLong(environment).solidAngles()) {
    Image& image = environment.radiance;
    double mean = 0;
    for (int y = 0; y < height_; ++y) {
        double row = 0;
        for (int x = 0; x < width_; ++x) row += double{brightest(&image.at(x, y))};
        mean += row * solid_[static_cast<std::size_t>(y)] / (4 * std::numbers::pi);
    }
    const auto bound = static_cast<float>(8 * mean);
    for (int y = 0; y < height_; ++y)
        for (int x = 0; x < width_; ++x) {
            float* const p = &image.at(x, y);
            const float brightness = brightest(p);
            if (!(brightness > bound)) continue;
            const float kept = bound / brightness;
            pixels_.push_back({x, y, glm::vec3(p[0], p[1], p[2]) * (1 - kept)});
            for (int c = 0; c < 3; ++c) p[c] *= kept;
        }
}

template <class Visit>
void BrightPixels::eachPart(int side, const Visit& visit) const {
    const double wide = 2 * std::numbers::pi / width_, high = std::numbers::pi / height_;
    const int down = partsAcross(high, side);
    std::vector<std::pair<double, double>> rows;  // polar angle, weight
    for (const Pixel& pixel : pixels_) {
        rows.clear();
        double sum = 0;
        for (int j = 0; j < down; ++j) {
            const double off = 2 * (j + 0.5) / down - 1, polar = high * (pixel.y + 0.5 + off);
            // Beyond a pole the sine is negative and the direction is on the other side.
            const double weight = (1 - std::abs(off)) * std::abs(std::sin(polar));
            rows.emplace_back(polar, weight);
            sum += weight;
        }
        const double power = solid_[static_cast<std::size_t>(pixel.y)] / sum;
        for (const auto& [polar, weight] : rows) {
            const int across = partsAcross(wide * std::abs(std::sin(polar)), side);
            double tent = 0;  // sum of the tent weights
            for (int i = 0; i < across; ++i) tent += 1 - std::abs(2 * (i + 0.5) / across - 1);
            for (int i = 0; i < across; ++i) {
                const double off = 2 * (i + 0.5) / across - 1;
                const double azimuth = wide * (pixel.x + 0.5 + off) - std::numbers::pi;
                const glm::dvec3 d(std::sin(polar) * std::sin(azimuth), std::cos(polar),
                                   -std::sin(polar) * std::cos(azimuth));
                const glm::vec3 part =
                    pixel.radiance * static_cast<float>(power * weight * (1 - std::abs(off)) / tent);
                visit(glm::vec3(d), Texel{part.x, part.y, part.z, 0});
            }
        }
    }
}

void BrightPixels::addTo(OctahedralMap& map) const {
    eachPart(map.side, [&](const glm::vec3& direction, const Texel& power) {
        const glm::vec2 p = octahedralPosition(direction);
        const auto texel = [&](float at) {
            const float half = 0.5f * static_cast<float>(map.side);
            return std::clamp(static_cast<int>(at * half + half), 0, map.side - 1);
        };
        const int x = texel(p.x), y = texel(p.y);
        map.at(x, y) += power / static_cast<float>(map.solidAngle(x, y));
    });
    map.fillBorder();
}

// A node on an edge occurs twice, the corner node four times.
void BrightPixels::addTo(NodeMap& map) const {
    const int last = map.side - 1;
    eachPart(last, [&](const glm::vec3& direction, const Texel& power) {
        const glm::vec2 p = octahedralPosition(direction);
        const auto node = [&](float at) {
            return static_cast<int>(std::lround((at * 0.5f + 0.5f) * static_cast<float>(last)));
        };
        const int x = node(p.x), y = node(p.y);
        const glm::vec3 d = octahedralDirection(map.positionOf(x, y));
        const float l1 = std::abs(d.x) + std::abs(d.y) + std::abs(d.z), step = 2 / static_cast<float>(last);
        const Texel radiance = power / (step * step * l1 * l1 * l1);
        const bool column = x == 0 || x == last, row = y == 0 || y == last;
        map.at(x, y) += radiance;
        if (column) map.at(x, last - y) += radiance;
        if (row) map.at(last - x, y) += radiance;
        if (column && row) map.at(last - x, last - y) += radiance;
    });
}

}  // namespace diptych
