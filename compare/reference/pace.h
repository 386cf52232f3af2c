// SPDX-License-Identifier: MIT
// How long a picture will take, known before any part of it is done.
#pragma once

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <optional>

namespace diptych::reference {

// Draws pixels spread evenly over a picture of width x height, coarse first (the R2 sequence: M. Roberts
// 2018, "The Unreasonable Effectiveness of Quasirandom Sequences"), on all cores, and throws them away: for
// at most `most`, and no more than a hundredth of the picture. From that the seconds that all pixels will
// take; empty where that hundredth was done in less than 20 ms, and so the picture needs no estimate.
// `render(x, y)` draws one, from any thread.
template <class Render>
std::optional<double> expectedSeconds(int width, int height, const Render& render,
                                      std::chrono::duration<double> most = std::chrono::milliseconds(1200)) {
    using Clock = std::chrono::steady_clock;
    const double pixels = static_cast<double>(width) * height;
    const auto enough = static_cast<std::uint64_t>(std::ceil(pixels / 100));
    const auto start = Clock::now();
    std::atomic<std::uint64_t> drawn{0};
    tbb::parallel_for(std::uint64_t{0}, enough, [&](std::uint64_t i) {
        if (Clock::now() - start > most) return;
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
