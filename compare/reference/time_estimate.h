// SPDX-License-Identifier: MIT
// Estimates how long an image will take before any part of it is done.
#pragma once

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <optional>

namespace diptych::reference {

// Renders pixels spread evenly over a width x height image, coarse first, on all cores, and discards them
// (R2 sequence: M. Roberts 2018, "The Unreasonable Effectiveness of Quasirandom Sequences"). It stops
// after `max` or a hundredth of the image. Returns the estimated seconds for all pixels; empty if that
// hundredth took less than 20 ms. `render(x, y)` renders one pixel, from any thread.
template <class Render>
std::optional<double> expectedSeconds(int width, int height, const Render& render,
                                      std::chrono::duration<double> max = std::chrono::milliseconds(1200)) {
    using Clock = std::chrono::steady_clock;
    const double pixels = static_cast<double>(width) * height;
    const auto enough = static_cast<std::uint64_t>(std::ceil(pixels / 100));
    const auto start = Clock::now();
    std::atomic<std::uint64_t> drawn{0};
    tbb::parallel_for(std::uint64_t{0}, enough, [&](std::uint64_t i) {
        if (Clock::now() - start > max) return;
        // The powers of 1 / 1.3247, the plastic number.
        const double u = std::fmod(0.5 + 0.7548776662466927 * static_cast<double>(i), 1.0),
                     v = std::fmod(0.5 + 0.5698402909980532 * static_cast<double>(i), 1.0);
        render(std::min(static_cast<int>(u * width), width - 1),
               std::min(static_cast<int>(v * height), height - 1));
        ++drawn;
    });
    const std::chrono::duration<double> took = Clock::now() - start;
    if (drawn == 0 || (drawn == enough && took < std::chrono::milliseconds(20))) return {};
    return took.count() * pixels / static_cast<double>(drawn);
}

}  // namespace diptych::reference
