// SPDX-License-Identifier: MIT
// Measures the time from key press to visible image, to the first images, and of the interface's own
// frames.
#pragma once

#include "compare/viewer/drawing/result.h"

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace diptych::viewer {

// Whether an image has the requested size; images are smaller while something moves.
bool isWhole(const DrawnView& shown);

class Latencies {
public:
    using Clock = std::chrono::steady_clock;

    // `report` receives each timing as a line; times of the first images count from `begun`.
    Latencies(std::function<void(const std::string&)> report, Clock::time_point begun);

    // A key was pressed; `request` is the latest request, 0: none.
    void pressed(std::string_view key, std::uint64_t request);
    // Earlier key presses become visible with this request's image.
    void asked(std::uint64_t request);
    // The image is in the window; `request` is the latest request.
    void seen(const DrawnView& shown, std::uint64_t request);

    // Duration of one frame of the interface.
    void frame(double ms);
    // 99th percentile of its frames, ms; 0 before the first 30.
    double percentile() const { return percentile_; }
    void reportFrames() const;

private:
    struct Waiting {
        std::string key;
        Clock::time_point pressed;
        std::uint64_t request = 0;  // request that shows it; 0: none yet
        // Latest request at the press; a key without a request is visible at once.
        std::uint64_t before = 0;
    };
    double percentileOf(double fraction) const;

    std::function<void(const std::string&)> report_;
    Clock::time_point begun_;
    bool reported_first_ = false, reported_whole_ = false;
    std::vector<Waiting> waiting_;
    std::vector<double> frames_;  // ms
    double percentile_ = 0;
};

}  // namespace diptych::viewer
