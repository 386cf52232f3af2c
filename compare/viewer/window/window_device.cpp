// SPDX-License-Identifier: MIT
#include "compare/viewer/window/window_device.h"

#include "shared/vulkan/instance/check.h"

#include <GLFW/glfw3.h>

#include <array>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

namespace diptych::viewer {
namespace {

std::span<const char* const> windowExtensions() {
    std::uint32_t count = 0;
    const char** const names = glfwGetRequiredInstanceExtensions(&count);
    if (names == nullptr)
        throw std::runtime_error(
            "view: this display does not support Vulkan surfaces; use diptych render, which needs no window");
    return {names, count};
}

}  // namespace

void checkWindow(VkResult result, const char* what) {
    if (result == VK_ERROR_DEVICE_LOST) throw Lost();
    checkResult(result, what);
}

OwnedSemaphore makeSemaphore(VkDevice device) {
    const VkSemaphoreCreateInfo info{VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO, nullptr, 0};
    VkSemaphore made = VK_NULL_HANDLE;
    checkWindow(vkCreateSemaphore(device, &info, nullptr, &made), "vkCreateSemaphore");
    return {device, made};
}

WindowDevice::Surface::Surface(VkInstance of, GLFWwindow* window) : instance(of) {
    checkWindow(glfwCreateWindowSurface(of, window, nullptr, &handle), "glfwCreateWindowSurface");
}

WindowDevice::WindowDevice(GLFWwindow* window, ValidationLog* log)
    : window_(window), instance_(log, windowExtensions()), surface_(instance_, window) {
    choosePhysical();
    makeDevice();
    chooseFormat();
}

// The first device with a queue for graphics and presentation.
void WindowDevice::choosePhysical() {
    for (const VkPhysicalDevice candidate : instance_.devices()) {
        DeviceSupport asked(candidate);
        const std::optional<std::uint32_t> graphics = asked.graphicsFamily();
        VkBool32 shows = VK_FALSE;
        if (!graphics ||
            vkGetPhysicalDeviceSurfaceSupportKHR(candidate, *graphics, surface_.handle, &shows) < 0 ||
            shows == VK_FALSE)
            continue;
        physical_ = candidate;
        family_ = *graphics;
        support_ = std::move(asked);
        return;
    }
    throw std::runtime_error(
        "view: no Vulkan device can present to this window; use diptych render, which needs no window");
}

void WindowDevice::makeDevice() {
    const float priority = 1;
    const VkDeviceQueueCreateInfo queues{.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                         .pNext = nullptr,
                                         .flags = 0,
                                         .queueFamilyIndex = family_,
                                         .queueCount = 1,
                                         .pQueuePriorities = &priority};
    const char* const extension = VK_KHR_SWAPCHAIN_EXTENSION_NAME;
    const VkDeviceCreateInfo info{.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                  .pNext = nullptr,
                                  .flags = 0,
                                  .queueCreateInfoCount = 1,
                                  .pQueueCreateInfos = &queues,
                                  .enabledLayerCount = 0,
                                  .ppEnabledLayerNames = nullptr,
                                  .enabledExtensionCount = 1,
                                  .ppEnabledExtensionNames = &extension,
                                  .pEnabledFeatures = nullptr};
    checkWindow(vkCreateDevice(physical_, &info, nullptr, &device_.handle), "vkCreateDevice");
    vkGetDeviceQueue(device_.handle, family_, 0, &queue_);
}

// 8 bits without encoding: the pixels are display values.
void WindowDevice::chooseFormat() {
    constexpr std::array wanted{VK_FORMAT_B8G8R8A8_UNORM, VK_FORMAT_R8G8B8A8_UNORM};
    std::uint32_t count = 0;
    checkWindow(vkGetPhysicalDeviceSurfaceFormatsKHR(physical_, surface_.handle, &count, nullptr),
                "surface formats");
    std::vector<VkSurfaceFormatKHR> formats(count);
    checkWindow(vkGetPhysicalDeviceSurfaceFormatsKHR(physical_, surface_.handle, &count, formats.data()),
                "surface formats");
    for (const VkFormat choice : wanted)
        for (const VkSurfaceFormatKHR& candidate : formats)
            if (candidate.format == choice && candidate.colorSpace == VK_COLOR_SPACE_SRGB_NONLINEAR_KHR) {
                format_ = candidate;
                return;
            }
    throw std::runtime_error("view: the window offers no 8-bit colour format (B8G8R8A8 or R8G8B8A8)");
}

}  // namespace diptych::viewer
