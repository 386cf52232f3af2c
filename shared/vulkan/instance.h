// SPDX-License-Identifier: MIT
// The connection to the drivers, with the validation layers where they are asked for.
#pragma once

#include <vulkan/vulkan_core.h>

#include <atomic>
#include <cstdint>
#include <mutex>
#include <span>
#include <string>
#include <vector>

namespace diptych {

// What the validation layers said. Their callback may come from any thread.
struct ValidationLog {
    std::atomic<std::uint64_t> messages{0};
    std::mutex mutex;
    std::string first;
};

class VulkanInstance {
public:
    // With `log` the Khronos validation layer runs, synchronization validation too, and tells it; the log
    // must outlive this. `extensions`: names of instance extensions. Throws std::runtime_error, one line,
    // where there is no Vulkan, an extension or the layer is missing.
    explicit VulkanInstance(ValidationLog* log = nullptr, std::span<const char* const> extensions = {});
    ~VulkanInstance();
    VulkanInstance(const VulkanInstance&) = delete;
    VulkanInstance& operator=(const VulkanInstance&) = delete;

    operator VkInstance() const { return handle_; }
    std::vector<VkPhysicalDevice> devices() const;  // in the loader's order

private:
    VkInstance handle_ = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
};

}  // namespace diptych
