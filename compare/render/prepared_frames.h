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

// Frames of one scene that can be drawn repeatedly and in any order. Switching between them uploads nothing
// and makes no pipeline; only what each frame makes itself (light lists) is made again. What it is made of
// must outlive it.
class PreparedFrames {
public:
    // Throws std::runtime_error, one line, where a picture is too large or memory ends.
    PreparedFrames(Device& device, SharedResources& shared, SceneViews& views,
                   std::span<const Settings> settings);
    PreparedFrames(PreparedFrames&&) noexcept;
    ~PreparedFrames();

    std::size_t size() const;
    // One whole frame, ms, as FrameTime has it. The first one of each may take longer: drivers compile then.
    double draw(std::size_t i);
    // How long the host recorded the commands of the frame drawn last, and chose the lights of its objects,
    // ms.
    double recordMs(std::size_t i) const;
    double objectListsMs(std::size_t i) const;
    // Draws frames `which` in turn until the device has worked as long as it must before times mean something
    // (DeviceProfile::warm_up_ms).
    void warmUp(std::span<const std::size_t> which);
    // Each pass timed by itself, over another frame.
    std::vector<PassTime> profile(std::size_t i);
    // lit of the frame drawn last, W x H x 3.
    Image lit(std::size_t i);
    // The number of light lists of that frame that overflowed.
    void readCounters(std::size_t i, FrameCounters& counters) const;
    // The Frame as far as it is known without drawing: Settings, camera, lights, bytes, notes.
    const Frame& described(std::size_t i) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace diptych
