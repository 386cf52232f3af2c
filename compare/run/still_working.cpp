// SPDX-License-Identifier: MIT
#include "compare/run/still_working.h"

#include <condition_variable>
#include <utility>

namespace diptych {

StillWorking::StillWorking(const Stage& stage, std::string step, std::chrono::milliseconds pause)
    : stage_(stage),
      step_(std::move(step)),
      thread_([this, pause](const std::stop_token& stop) { repeat(stop, pause); }) {
    stage_.at(0, step_);
}

void StillWorking::at(double fraction, const std::string& step) {
    {
        const std::lock_guard lock(mutex_);
        fraction_ = fraction;
        step_ = step;
    }
    stage_.at(fraction, step);
}

void StillWorking::repeat(const std::stop_token& stop, std::chrono::milliseconds pause) {
    std::condition_variable_any wake;
    std::unique_lock lock(mutex_);
    while (!wake.wait_for(lock, stop, pause, [&] { return stop.stop_requested(); })) try {
            stage_.at(fraction_, step_);
        } catch (...) {  // a listener cancels by throwing; the work's own reports do so, too
        }
}

}  // namespace diptych
