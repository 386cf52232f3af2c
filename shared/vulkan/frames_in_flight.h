// SPDX-License-Identifier: MIT
// Frames that the host records while the device still draws earlier ones, for a window. Where times are
// taken, Device::submit() waits for each.
#pragma once

#include "shared/vulkan/device.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace diptych {

class FramesInFlight {
public:
    // At most `count` frames are under way, each in a slot of its own.
    explicit FramesInFlight(Device& device, std::uint32_t count = 2);
    ~FramesInFlight();  // waits for all
    FramesInFlight(const FramesInFlight&) = delete;
    FramesInFlight& operator=(const FramesInFlight&) = delete;

    // Waits until the device is done with the oldest frame, and returns its slot, 0 to count - 1, which the
    // next submit() takes: buffers that the host writes anew for each frame exist once a slot, and may be
    // written from now on. Throws std::runtime_error where the device is lost.
    std::uint32_t nextSlot();
    // Records and submits a frame. Frames run in the order of their submits; barriers reach from one to the
    // next.
    // `what` is named where the device is lost.
    void submit(const std::function<void(VkCommandBuffer)>& record, const std::string& what);
    void wait();  // until the device is done with all

    std::uint32_t count() const { return static_cast<std::uint32_t>(slots_.size()); }

private:
    struct Slot {
        VkCommandBuffer commands = VK_NULL_HANDLE;
        OwnedFence fence;
        bool under_way = false;
        std::string what;
    };
    void wait(Slot& slot);

    Device& device_;
    OwnedCommandPool pool_;
    std::vector<Slot> slots_;
    std::uint32_t next_ = 0;
};

}  // namespace diptych
