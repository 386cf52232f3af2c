// SPDX-License-Identifier: MIT
// Sources of the left panel other than the other path: the reference, rendered in the background, and a
// stored image.
#pragma once

#include "compare/viewer/drawing/mailbox.h"
#include "compare/viewer/drawing/pair_renderer.h"
#include "compare/viewer/drawing/reference_thread.h"

#include <atomic>
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

namespace diptych::viewer {

class LeftPanel {
public:
    using Clock = std::chrono::steady_clock;

    // Signals the mailbox whenever more of the reference is rendered.
    explicit LeftPanel(Mailbox& mailbox);

    // The request's reference as far as it is rendered, over `under`, and the finished fraction. Starts it
    // if it is another one than before. Throws std::runtime_error if it fails.
    std::pair<std::shared_ptr<const Frame>, double> reference(const DrawRequest& request, PairRenderer& pair,
                                                              const Stage& stage, const Frame& under);
    std::shared_ptr<const Frame> storedFrame(const std::filesystem::path& file);
    std::shared_ptr<const Frame> finishedReference() const { return reference_.frame({}, nullptr); }

    void stopReference() { reference_.stop(); }
    // Stops a reference in progress that the request does not need.
    void stopUnneeded(const DrawRequest& request);
    double referenceDone() const { return reference_.done(); }  // 0 to 1; 1: finished
    // Whether the reference has new pixels for the request; show them at `nextUpdate`.
    bool hasMore(const DrawRequest& request) const;
    Clock::time_point nextUpdate() const;
    bool isUpdateDue(const DrawRequest& request) const;

private:
    std::atomic<bool> more_{false};
    Clock::time_point reference_shown_{};
    std::shared_ptr<const Scene> reference_scene_;
    std::optional<std::pair<std::filesystem::path, std::shared_ptr<const Frame>>> stored_;
    ReferenceThread reference_;
};

}  // namespace diptych::viewer
