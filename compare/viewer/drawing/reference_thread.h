// SPDX-License-Identifier: MIT
// Renders the reference in the background and returns partial results.
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

    // Starts an image and stops any current one. `surfaces`: as for drawReferenceFrame(); empty in mode
    // scene.
    void begin(std::shared_ptr<const Scene> scene, const Settings& settings, std::optional<Frame> surfaces);
    void stop();  // returns once the thread has ended, within the time of a few tiles

    // The Settings of the current or last image.
    const std::optional<Settings>& settings() const { return settings_; }
    double done() const { return done_; }  // 0 to 1; 1: finished
    // lit as far as it is rendered, `under` (W x H x 3) elsewhere, and the surface channels `modes`; all
    // channels once finished.
    std::shared_ptr<const Frame> frame(std::initializer_list<Channel> modes, const Image* under) const;
    std::string error() const;  // why it ended without an image; empty: no error

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
    std::vector<bool> drawn_;  // per pixel of lit
    std::shared_ptr<const Frame> finished_;
    std::string error_;
};

// Lowers the priority of this thread, and of threads that it starts, below the interface.
void yieldToInterface();

}  // namespace diptych::viewer
