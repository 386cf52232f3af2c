// SPDX-License-Identifier: MIT
// The Vulkan device that presents to the window, and the window's surface.
#pragma once

#include "shared/vulkan/instance/device_support.h"
#include "shared/vulkan/instance/instance.h"
#include "shared/vulkan/instance/owned.h"

#include <vulkan/vulkan.h>

#include <cstdint>

struct GLFWwindow;

namespace diptych::viewer {

// Thrown if the device is lost, to leave the frame.
struct Lost {};

// Throws Lost, or std::runtime_error for another error.
void checkWindow(VkResult result, const char* what);

using OwnedSemaphore = Owned<VkSemaphore, vkDestroySemaphore>;
OwnedSemaphore makeSemaphore(VkDevice device);

class WindowDevice {
public:
    // Throws std::runtime_error, one line, if no device can present to the window.
    WindowDevice(GLFWwindow* window, ValidationLog* log);

    VkInstance instance() const { return instance_; }
    GLFWwindow* window() const { return window_; }
    VkSurfaceKHR surface() const { return surface_.handle; }
    VkPhysicalDevice physical() const { return physical_; }
    const DeviceSupport& support() const { return support_; }
    std::uint32_t family() const { return family_; }  // of the queue, for graphics and presentation
    VkQueue queue() const { return queue_; }
    const VkSurfaceFormatKHR& format() const { return format_; }
    operator VkDevice() const { return device_.handle; }

private:
    struct Surface {
        Surface(VkInstance of, GLFWwindow* window);
        ~Surface() { vkDestroySurfaceKHR(instance, handle, nullptr); }
        Surface(const Surface&) = delete;
        Surface& operator=(const Surface&) = delete;
        VkInstance instance;
        VkSurfaceKHR handle = VK_NULL_HANDLE;
    };

    struct LogicalDevice {
        ~LogicalDevice() {
            if (handle != VK_NULL_HANDLE) vkDestroyDevice(handle, nullptr);
        }
        VkDevice handle = VK_NULL_HANDLE;
    };

    void choosePhysical();
    void makeDevice();
    void chooseFormat();

    GLFWwindow* window_;
    VulkanInstance instance_;
    Surface surface_;
    VkPhysicalDevice physical_ = VK_NULL_HANDLE;
    DeviceSupport support_;
    std::uint32_t family_ = 0;
    LogicalDevice device_;
    VkQueue queue_ = VK_NULL_HANDLE;
    VkSurfaceFormatKHR format_{};
};

}  // namespace diptych::viewer
