// SPDX-License-Identifier: MIT
#include "compare/reference/light/environment.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace diptych::reference {
namespace {

using std::numbers::pi;

std::size_t at(int i) {
    return static_cast<std::size_t>(i);
}

// Inverts a cumulative distribution: the entry that contains u times the total, and the position within
// it, 0 to 1.
struct Found {
    std::size_t index;
    double within;
};
Found find(const double* cumulative, std::size_t count, double u) {
    const double target = u * cumulative[count - 1];
    const double* entry =
        std::min(std::upper_bound(cumulative, cumulative + count, target), cumulative + count - 1);
    const double before = entry == cumulative ? 0 : entry[-1];
    const double width = *entry - before;
    return {static_cast<std::size_t>(entry - cumulative),
            width > 0 ? std::clamp((target - before) / width, 0.0, 1.0) : 0.5};
}

// Blocks are at least about 11 degrees wide.
constexpr int maxAcross = 32, maxDown = 16;

}  // namespace

// A pixel's weight is its mean bilinearly interpolated brightness, so that it is above 0 wherever there is
// light.
EnvironmentLight::EnvironmentLight(const Environment& environment, double factor, double rotation)
    : image_(environment.radiance),
      factor_(factor),
      rotation_(rotation),
      across_(std::min(maxAcross, image_.width)),
      down_(std::min(maxDown, image_.height)) {
    const int width = image_.width, height = image_.height;
    const auto brightness = [&](int x, int y) {
        const glm::dvec3 color = texel(x, y);
        return std::max({color.r, color.g, color.b});
    };
    for (int y = 0; y < height; ++y)
        solid_.push_back(2 * pi / width * (std::cos(pi * y / height) - std::cos(pi * (y + 1) / height)));
    weight_.resize(image_.pixels());
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            constexpr std::array<double, 3> fraction{0.125, 0.75, 0.125};
            double mean = 0;
            for (int dy = -1; dy <= 1; ++dy)
                for (int dx = -1; dx <= 1; ++dx)
                    mean += fraction[at(dx + 1)] * fraction[at(dy + 1)] * brightness(x + dx, y + dy);
            weight_[at(y) * at(width) + at(x)] = mean * solid_[at(y)];
        }
    for (int j = 0; j < down_; ++j)
        for (int i = 0; i < across_; ++i) {
            const int x = i * width / across_, y = j * height / down_;
            Block block{x, y, (i + 1) * width / across_ - x, (j + 1) * height / down_ - y, {}, 0, {}, {}};
            block.middle = directionOf(x + block.width / 2.0, y + block.height / 2.0);
            for (const double across : {0.0, 0.5, 1.0})
                for (const double down : {0.0, 0.5, 1.0})
                    block.reach =
                        std::max(block.reach,
                                 glm::length(directionOf(x + across * block.width, y + down * block.height) -
                                             block.middle));
            double sum = 0;
            for (int row = 0; row < block.height; ++row) {
                double along = 0;
                for (int column = 0; column < block.width; ++column) {
                    along += weight_[at(y + row) * at(width) + at(x + column)];
                    block.columns.push_back(along);
                }
                sum += along;
                block.rows.push_back(sum);
            }
            brightness_ += sum;
            blocks_.push_back(std::move(block));
        }
}

// Columns wrap around. A row beyond a pole mirrors to the same distance before it, rotated by 180 degrees.
glm::dvec3 EnvironmentLight::texel(int x, int y) const {
    const int width = image_.width, height = image_.height;
    if (y < 0 || y >= height) {
        y = std::clamp(y < 0 ? -1 - y : 2 * height - 1 - y, 0, height - 1);
        x += width / 2;
    }
    while (x < 0) x += width;
    while (x >= width) x -= width;
    const float* p = image_.pixel(at(y) * at(width) + at(x));
    return {double{p[0]}, double{p[1]}, double{p[2]}};
}

glm::dvec3 EnvironmentLight::directionOf(double x, double y) const {
    const double azimuth = 2 * pi * x / image_.width - pi - rotation_, polar = pi * y / image_.height;
    return {std::sin(polar) * std::sin(azimuth), std::cos(polar), -std::sin(polar) * std::cos(azimuth)};
}

// Azimuth grows toward +X, clockwise seen from above; undoing a counter-clockwise rotation adds to it.
double EnvironmentLight::column(const glm::dvec3& d) const {
    const double turns = (std::atan2(d.x, -d.z) + rotation_) / (2 * pi) + 0.5;
    return (turns - std::floor(turns)) * image_.width;
}

glm::dvec3 EnvironmentLight::radiance(const glm::dvec3& d) const {
    const double x = column(d) - 0.5;
    const double y = std::acos(std::clamp(d.y, -1.0, 1.0)) / pi * image_.height - 0.5;
    const double left = std::floor(x), top = std::floor(y), fx = x - left, fy = y - top;
    const int x0 = static_cast<int>(left), y0 = static_cast<int>(top);
    return ((texel(x0, y0) * (1 - fx) + texel(x0 + 1, y0) * fx) * (1 - fy) +
            (texel(x0, y0 + 1) * (1 - fx) + texel(x0 + 1, y0 + 1) * fx) * fy) *
           factor_;
}

EnvironmentLight::Pixel EnvironmentLight::pixelOf(const glm::dvec3& d) const {
    const double x = column(d);
    const double y = std::acos(std::clamp(d.y, -1.0, 1.0)) / pi * image_.height;
    return {std::clamp(static_cast<int>(x), 0, image_.width - 1),
            std::clamp(static_cast<int>(y), 0, image_.height - 1)};
}

// The block that contains the pixel: the last that begins at or before it.
std::size_t EnvironmentLight::blockOf(Pixel pixel) const {
    const int i = ((pixel.x + 1) * across_ - 1) / image_.width,
              j = ((pixel.y + 1) * down_ - 1) / image_.height;
    return at(j) * at(across_) + at(i);
}

EnvironmentLight::Sampler::Sampler(const EnvironmentLight& light, const Weight& weight) : light_(light) {
    double sum = 0;
    for (const Block& block : light.blocks_) {
        if (block.rows.back() > 0) sum += block.rows.back() * weight(block.middle, block.reach);
        cumulative_.push_back(sum);
    }
}

glm::dvec3 EnvironmentLight::Sampler::operator()(const glm::dvec2& u) const {
    const Found chosen = find(cumulative_.data(), cumulative_.size(), u.x);
    const Block& block = light_.blocks_[chosen.index];
    const Found row = find(block.rows.data(), block.rows.size(), u.y);
    const Found column =
        find(block.columns.data() + row.index * at(block.width), at(block.width), chosen.within);
    // Uniform in solid angle within the row: linear in the cosine of the polar angle.
    const double y = block.y + static_cast<double>(row.index),
                 x = block.x + static_cast<double>(column.index) + column.within;
    const double top = std::cos(pi * y / light_.image_.height),
                 bottom = std::cos(pi * (y + 1) / light_.image_.height);
    return light_.directionOf(
        x, std::acos(std::clamp(top + (bottom - top) * row.within, -1.0, 1.0)) / pi * light_.image_.height);
}

double EnvironmentLight::Sampler::density(const glm::dvec3& direction) const {
    const Pixel pixel = light_.pixelOf(direction);
    const std::size_t index = light_.blockOf(pixel);
    const double fraction = cumulative_[index] - (index > 0 ? cumulative_[index - 1] : 0);
    const double all = light_.blocks_[index].rows.back();
    if (!(fraction > 0)) return 0;
    return fraction / cumulative_.back() *
           light_.weight_[at(pixel.y) * at(light_.image_.width) + at(pixel.x)] / all /
           light_.solid_[at(pixel.y)];
}

}  // namespace diptych::reference
