// SPDX-License-Identifier: MIT
// Draws the reference in the background, and hands out what is done of it.
#pragma once

#include "shared/frame/frame.h"
#include "shared/scene/model/scene.h"

#include <atomic>
#include <functional>
#include <initializer_list>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace diptych::viewer {

class ReferenceThread {
public:
    // `wake` is called from another thread whenever more is done.
    explicit ReferenceThread(std::function<void()> wake) : wake_(std::move(wake)) {}
    ~ReferenceThread() { stop(); }
    ReferenceThread(const ReferenceThread&) = delete;
    ReferenceThread& operator=(const ReferenceThread&) = delete;

    // Begins a picture, in the place of any that is being drawn. `surfaces`: as drawReferenceFrame() has it,
    // nothing in mode scene.
    void begin(std::shared_ptr<const Scene> scene, const Settings& settings, std::optional<Frame> surfaces);
    void stop();  // returns once the thread has ended: within the time of a few tiles

    // The Settings of the picture that is drawn, or was last.
    const std::optional<Settings>& settings() const { return settings_; }
    double done() const { return done_; }  // 0 to 1; 1: finished
    // lit as far as it is drawn, elsewhere that of `under`, W x H x 3, and of the channels of the surfaces
    // these; all channels once it is finished.
    std::shared_ptr<const Frame> frame(std::initializer_list<int> modes, const Image* under) const;
    std::string error() const;  // why it ended without a picture; empty: it did not

private:
    void run(const std::shared_ptr<const Scene>& scene, const Settings& settings,
             const std::optional<Frame>& surfaces);

    const std::function<void()> wake_;
    std::optional<Settings> settings_;
    std::thread thread_;
    std::atomic<bool> stop_{false};
    std::atomic<double> done_{0};
    mutable std::mutex mutex_;
    Frame partial_;
    std::vector<bool> drawn_;  // by pixel of lit
    std::shared_ptr<const Frame> finished_;
    std::string error_;
};

// From now on what this thread does, and the threads that it starts, yields to the interface.
void yieldToInterface();

}  // namespace diptych::viewer
