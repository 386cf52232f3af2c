// SPDX-License-Identifier: MIT
#pragma once

#include "shared/frame/frame.h"
#include "shared/image/image.h"
#include "shared/scene/scene_view.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace diptych {

class Device;
struct SharedResources;

// Frames of one scene that can be rendered repeatedly and in any order. Switching between them uploads
// nothing and creates no pipeline; each frame only rebuilds its own data (light lists). The constructor's
// arguments must outlive it.
class PreparedFrames {
public:
    // Throws std::runtime_error, one line, if an image is too large or memory runs out.
    PreparedFrames(Device& device, SharedResources& shared, SceneViews& views,
                   std::span<const Settings> settings);
    PreparedFrames(PreparedFrames&&) noexcept;
    ~PreparedFrames();

    std::size_t size() const;
    // Renders one frame; returns FrameTime's ms. The first call may take longer, because drivers compile
    // then.
    double draw(std::size_t i);
    // Time of the last frame's command recording, and of choosing the lights of its objects on the host,
    // ms.
    double recordMs(std::size_t i) const;
    double objectListsMs(std::size_t i) const;
    // Renders frames `which` in turn until the device has left its idle clocks
    // (DeviceProfile::warm_up_ms).
    void warmUp(std::span<const std::size_t> which);
    // Times each pass of another frame by itself.
    std::vector<PassTime> profile(std::size_t i);
    // lit of the last frame, W x H x 3.
    Image lit(std::size_t i);
    // Number of light lists of that frame that overflowed.
    void readCounters(std::size_t i, FrameCounters& counters) const;
    // The Frame with lit and the counters of the last frame; NaN and infinity in lit are replaced.
    Frame frame(std::size_t i);
    // The Frame as known without rendering: Settings, camera, lights, bytes, notes.
    const Frame& described(std::size_t i) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace diptych
