// SPDX-License-Identifier: MIT
// The Vulkan instance, with validation layers on request.
#pragma once

#include <vulkan/vulkan_core.h>

#include <atomic>
#include <cstdint>
#include <mutex>
#include <span>
#include <string>
#include <vector>

namespace diptych {

// Messages of the validation layers. Their callback may come from any thread.
struct ValidationLog {
    std::atomic<std::uint64_t> messages{0};
    std::mutex mutex;
    std::string first;
};

class VulkanInstance {
public:
    // `log`: enables Khronos validation with synchronization validation, and receives its messages; must
    // outlive this. `extensions`: instance extensions. Throws std::runtime_error, one line, if Vulkan, an
    // extension or the layer is missing.
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
