// SPDX-License-Identifier: MIT
#include "compare/explain/frame_images.h"

#include "shared/frame/debug_modes.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <cstddef>
#include <cstring>
#include <numeric>
#include <stdexcept>

namespace diptych {

const Image& channelOf(const Frame& frame, Channel mode) {
    const auto found = frame.channels.find(mode);
    if (found == frame.channels.end())
        throw std::runtime_error(fmt::format("{} has no channel {}, which an explanation needs", frame.name,
                                             debugMode(mode).name));
    return found->second;
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

}  // namespace diptych
