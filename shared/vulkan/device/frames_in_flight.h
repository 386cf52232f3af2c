// SPDX-License-Identifier: MIT
// Frames in flight for a window: the CPU records while the GPU draws earlier frames. Timed frames use
// Device::submit(), which waits.
#pragma once

#include "shared/vulkan/device/device.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace diptych {

class FramesInFlight {
public:
    // At most `count` frames are in flight, each in its own slot.
    explicit FramesInFlight(Device& device, std::uint32_t count = 2);
    ~FramesInFlight();  // waits for all
    FramesInFlight(const FramesInFlight&) = delete;
    FramesInFlight& operator=(const FramesInFlight&) = delete;

    // Waits for the oldest frame and returns its slot, 0 to count - 1, which the next submit() uses.
    // Per-slot buffers may be written from then on. Throws std::runtime_error if the device is lost.
    std::uint32_t nextSlot();
    // Records and submits a frame. Frames run in submit order, and barriers apply across them. `what`: for
    // the error message if the device is lost.
    void submit(const std::function<void(VkCommandBuffer)>& record, const std::string& what);
    void wait();  // until all frames are done

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
