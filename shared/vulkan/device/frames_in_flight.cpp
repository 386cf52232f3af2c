// SPDX-License-Identifier: MIT
#include "shared/vulkan/device/frames_in_flight.h"

#include "shared/vulkan/device/commands.h"
#include "shared/vulkan/instance/check.h"

#include <algorithm>

namespace diptych {

FramesInFlight::FramesInFlight(Device& device, std::uint32_t count)
    : device_(device), pool_(makeCommandPool(device.handle(), device.queueFamily())), slots_(count) {
    for (Slot& slot : slots_) {
        slot.commands = allocateCommands(device.handle(), pool_);
        slot.fence = makeFence(device.handle());
    }
}

FramesInFlight::~FramesInFlight() {
    if (std::ranges::any_of(slots_, &Slot::under_way)) vkDeviceWaitIdle(device_.handle());
}

void FramesInFlight::wait(Slot& slot) {
    if (!slot.under_way) return;
    const VkFence fence = slot.fence;
    checkResult(vkWaitForFences(device_.handle(), 1, &fence, VK_TRUE, UINT64_MAX), "running " + slot.what);
    checkResult(vkResetFences(device_.handle(), 1, &fence), "vkResetFences");
    slot.under_way = false;
}

std::uint32_t FramesInFlight::nextSlot() {
    wait(slots_[next_]);
    return next_;
}

void FramesInFlight::submit(const std::function<void(VkCommandBuffer)>& record, const std::string& what) {
    Slot& slot = slots_[nextSlot()];
    device_.record(slot.commands, record);
    slot.what = what;
    checkResult(submitCommands(device_.queue(), slot.commands, slot.fence), "running " + what);
    slot.under_way = true;
    next_ = (next_ + 1) % count();
}

void FramesInFlight::wait() {
    for (Slot& slot : slots_) wait(slot);
}

}  // namespace diptych
