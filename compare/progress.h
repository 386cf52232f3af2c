// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <mutex>
#include <string>

namespace diptych {

// One line on a terminal that says how far something long has come: it appears after a second, so that short
// work stays silent, and is wiped at the end. Nothing where standard error is no terminal.
class ProgressBar {
public:
    // `what` it is about, e.g. "Sponza.gltf". `on` false: never anything.
    ProgressBar(std::string what, bool on);
    ~ProgressBar();
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    // From any thread. `fraction` from 0 to 1; `step` in a word or two.
    void at(double fraction, const char* step);

private:
    using Clock = std::chrono::steady_clock;
    std::string what_;
    bool on_;
    bool shown_ = false;
    std::mutex mutex_;
    Clock::time_point next_;  // not drawn before
};

// "Sponza.gltf [=======>      ] 52 % images and meshes", as wide as `columns` at most.
std::string progressLine(const std::string& what, double fraction, const std::string& step,
                         std::size_t columns);

}  // namespace diptych
