// SPDX-License-Identifier: MIT
// Shows a step that reports nothing itself, such as decoding one large image.
#pragma once

#include "compare/run/progress.h"

#include <chrono>
#include <mutex>
#include <string>
#include <thread>

namespace diptych {

// Reports the last step again each `pause` until it is destroyed.
class StillWorking {
public:
    StillWorking(const Stage& stage, std::string step,
                 std::chrono::milliseconds pause = std::chrono::seconds(1));
    void at(double fraction, const std::string& step);

private:
    void repeat(const std::stop_token& stop, std::chrono::milliseconds pause);

    Stage stage_;
    std::mutex mutex_;
    double fraction_ = 0;
    std::string step_;
    std::jthread thread_;  // last: it uses the others
};

}  // namespace diptych
