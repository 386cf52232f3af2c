// SPDX-License-Identifier: MIT
#include "compare/explain/frame_images.h"

#include "shared/frame/debug_modes.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <numeric>
#include <stdexcept>

namespace diptych {

namespace {

constexpr double sameFactor = 1e-3;
constexpr double darkest = 1e-3;  // fraction of the mean

}  // namespace

const Image& channelOf(const Frame& frame, Channel channel) {
    if (const Image* const image = findChannel(frame, channel)) return *image;
    throw std::runtime_error(
        fmt::format("{} has no channel {}, which an explanation needs", frame.name, debugMode(channel).name));
}

glm::dvec3 colorAt(const Image& image, std::size_t pixel) {
    const float* const p = image.pixel(pixel);
    return {p[0], p[1], p[2]};
}

int materialOf(const float* pixel, const Scene& scene) {
    const float id = *pixel;
    return id >= 0 && id < static_cast<float>(scene.materials.size()) ? static_cast<int>(id) : -1;
}

bool sameBits(const Image& a, const Image& b) {
    return a.data.size() == b.data.size() &&
           std::memcmp(a.data.data(), b.data.data(), a.data.size() * sizeof(float)) == 0;
}

Image differenceOf(const Image& a, const Image& b) {
    Image difference(b.width, b.height, 3);
    for (std::size_t i = 0; i < difference.data.size(); ++i) {
        const float left = a.data[i] - b.data[i];
        if (std::isfinite(left)) difference.data[i] = left;
    }
    return difference;
}

std::vector<double> errorsOf(const Image& a, const Image& b) {
    std::vector<double> errors(a.pixels());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, a.pixels(), 4096), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            const float *const x = a.pixel(i), *const y = b.pixel(i);
            const double sum =
                std::abs(double{x[0]} - y[0]) + std::abs(double{x[1]} - y[1]) + std::abs(double{x[2]} - y[2]);
            errors[i] = std::isfinite(sum) ? sum / 3 : 0.0;
        }
    });
    return errors;
}

double meanOf(const std::vector<double>& values) {
    return values.empty()
               ? 0.0
               : std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

std::optional<double> commonFactor(const Image& lit, const Image& expected) {
    double sum = 0;
    std::size_t finite = 0;
    for (const float value : expected.data)
        if (std::isfinite(value)) sum += std::abs(double{value}), ++finite;
    if (finite == 0 || !(sum > 0)) return {};
    const double min = darkest * sum / static_cast<double>(finite);
    std::vector<double> ratios;
    for (std::size_t i = 0; i < lit.data.size(); ++i) {
        const double a = lit.data[i], b = expected.data[i];
        if (std::isfinite(a) && std::isfinite(b) && b > min) ratios.push_back(a / b);
    }
    if (ratios.empty()) return {};
    const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
    std::ranges::nth_element(ratios, middle);
    const double factor = *middle;
    const auto alike = std::ranges::count_if(
        ratios, [factor](double ratio) { return std::abs(ratio - factor) <= sameFactor * factor; });
    if (!(factor > 0) || 2 * static_cast<std::size_t>(alike) < ratios.size()) return {};
    return factor;
}

std::optional<double> exposureBetween(std::optional<double> baseline, std::optional<double> test) {
    if (!baseline || !test) return {};
    const double factor = *test / *baseline;
    if (std::abs(factor - 1) <= 2 * sameFactor) return {};
    return factor;
}

}  // namespace diptych
