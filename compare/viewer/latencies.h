// SPDX-License-Identifier: MIT
// How long keys and the first pictures took to be seen, and what the interface's own frames take.
#pragma once

#include "compare/viewer/shown.h"

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace diptych::viewer {

// Whether a picture is as large as was asked for: smaller ones are drawn while something moves.
bool isWhole(const Shown& shown);

class Latencies {
public:
    using Clock = std::chrono::steady_clock;

    // `say` takes each line that tells a time; times of pictures count from `begun`.
    Latencies(std::function<void(const std::string&)> say, Clock::time_point begun);

    // A key was pressed while `order` had been asked for last; 0: none.
    void pressed(std::string_view key, std::uint64_t order);
    // What was pressed before this order shows in its picture.
    void asked(std::uint64_t order);
    // The picture is in the window; `order` was asked for last.
    void seen(const Shown& shown, std::uint64_t order);

    // The interface's own frame took so long.
    void frame(double ms);
    double percentile() const { return percentile_; }  // the 99th of its frames, ms; 0 before the first 30
    void sayFrames() const;

private:
    struct Waiting {
        std::string key;
        Clock::time_point pressed;
        std::uint64_t order = 0;   // that shows it; 0: none was asked for yet
        std::uint64_t before = 0;  // the order of that time: a key that asks for nothing is seen at once
    };
    double percentileOf(double share) const;

    std::function<void(const std::string&)> say_;
    Clock::time_point begun_;
    bool said_first_ = false, said_whole_ = false;
    std::vector<Waiting> waiting_;
    std::vector<double> frames_;  // ms
    double percentile_ = 0;
};

}  // namespace diptych::viewer
