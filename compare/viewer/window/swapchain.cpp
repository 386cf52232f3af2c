// SPDX-License-Identifier: MIT
#include "compare/viewer/window/swapchain.h"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <limits>

namespace diptych::viewer {

VkPresentModeKHR Swapchain::presentMode() const {
    std::uint32_t count = 0;
    checkWindow(
        vkGetPhysicalDeviceSurfacePresentModesKHR(device_.physical(), device_.surface(), &count, nullptr),
        "present modes");
    std::vector<VkPresentModeKHR> modes(count);
    checkWindow(vkGetPhysicalDeviceSurfacePresentModesKHR(device_.physical(), device_.surface(), &count,
                                                          modes.data()),
                "present modes");
    return std::ranges::find(modes, VK_PRESENT_MODE_MAILBOX_KHR) != modes.end() ? VK_PRESENT_MODE_MAILBOX_KHR
                                                                                : VK_PRESENT_MODE_FIFO_KHR;
}

// Size of the images; 0 if the window has no area.
VkExtent2D Swapchain::sizeOf(const VkSurfaceCapabilitiesKHR& can) const {
    if (can.currentExtent.width != std::numeric_limits<std::uint32_t>::max()) return can.currentExtent;
    int width = 0, height = 0;
    glfwGetFramebufferSize(device_.window(), &width, &height);
    return {
        std::clamp(static_cast<std::uint32_t>(width), can.minImageExtent.width, can.maxImageExtent.width),
        std::clamp(static_cast<std::uint32_t>(height), can.minImageExtent.height, can.maxImageExtent.height)};
}

// False if the window has no area.
bool Swapchain::make() {
    VkSurfaceCapabilitiesKHR can{};
    checkWindow(vkGetPhysicalDeviceSurfaceCapabilitiesKHR(device_.physical(), device_.surface(), &can),
                "surface capabilities");
    const VkExtent2D size = sizeOf(can);
    if (size.width == 0 || size.height == 0) return false;
    checkWindow(vkDeviceWaitIdle(device_), "vkDeviceWaitIdle");
    images_.clear();
    const std::uint32_t max =
        can.maxImageCount > 0 ? can.maxImageCount : std::numeric_limits<std::uint32_t>::max();
    const VkSwapchainCreateInfoKHR info{
        .sType = VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR,
        .pNext = nullptr,
        .flags = 0,
        .surface = device_.surface(),
        .minImageCount = std::min(std::max(can.minImageCount + 1, 3u), max),
        .imageFormat = device_.format().format,
        .imageColorSpace = device_.format().colorSpace,
        .imageExtent = size,
        .imageArrayLayers = 1,
        .imageUsage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT,
        .imageSharingMode = VK_SHARING_MODE_EXCLUSIVE,
        .queueFamilyIndexCount = 0,
        .pQueueFamilyIndices = nullptr,
        .preTransform = can.currentTransform,
        .compositeAlpha = VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR,
        .presentMode = presentMode(),
        .clipped = VK_TRUE,
        .oldSwapchain = swapchain_};
    VkSwapchainKHR made = VK_NULL_HANDLE;
    checkWindow(vkCreateSwapchainKHR(device_, &info, nullptr, &made), "vkCreateSwapchainKHR");
    swapchain_ = {device_, made};
    extent_ = size;
    std::uint32_t count = 0;
    checkWindow(vkGetSwapchainImagesKHR(device_, made, &count, nullptr), "vkGetSwapchainImagesKHR");
    std::vector<VkImage> handles(count);
    checkWindow(vkGetSwapchainImagesKHR(device_, made, &count, handles.data()), "vkGetSwapchainImagesKHR");
    for (const VkImage handle : handles) images_.push_back(windowImage(handle));
    stale_ = false;
    return true;
}

WindowImage Swapchain::windowImage(VkImage handle) const {
    WindowImage image;
    image.image = handle;
    const VkImageViewCreateInfo viewInfo{.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
                                         .pNext = nullptr,
                                         .flags = 0,
                                         .image = handle,
                                         .viewType = VK_IMAGE_VIEW_TYPE_2D,
                                         .format = device_.format().format,
                                         .components = {},
                                         .subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1}};
    VkImageView view = VK_NULL_HANDLE;
    checkWindow(vkCreateImageView(device_, &viewInfo, nullptr, &view), "vkCreateImageView");
    image.view = {device_, view};
    const VkFramebufferCreateInfo info{.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO,
                                       .pNext = nullptr,
                                       .flags = 0,
                                       .renderPass = render_pass_,
                                       .attachmentCount = 1,
                                       .pAttachments = &view,
                                       .width = extent_.width,
                                       .height = extent_.height,
                                       .layers = 1};
    VkFramebuffer framebuffer = VK_NULL_HANDLE;
    checkWindow(vkCreateFramebuffer(device_, &info, nullptr, &framebuffer), "vkCreateFramebuffer");
    image.framebuffer = {device_, framebuffer};
    image.drawn = makeSemaphore(device_);
    return image;
}

const WindowImage* Swapchain::acquire(VkSemaphore acquired) {
    if (stale_ && !make()) return nullptr;
    const auto next = [&] {
        return vkAcquireNextImageKHR(device_, swapchain_, UINT64_MAX, acquired, VK_NULL_HANDLE, &acquired_);
    };
    VkResult result = next();
    if (result == VK_ERROR_OUT_OF_DATE_KHR) {
        stale_ = true;
        if (!make()) return nullptr;
        result = next();
    }
    if (result == VK_ERROR_OUT_OF_DATE_KHR || result == VK_SUBOPTIMAL_KHR)
        stale_ = true;
    else
        checkWindow(result, "vkAcquireNextImageKHR");
    // If it is out of date again, try the next frame.
    return result == VK_ERROR_OUT_OF_DATE_KHR ? nullptr : &images_.at(acquired_);
}

void Swapchain::present() {
    const VkSemaphore drawn = images_.at(acquired_).drawn;
    const VkSwapchainKHR chain = swapchain_;
    const VkPresentInfoKHR info{.sType = VK_STRUCTURE_TYPE_PRESENT_INFO_KHR,
                                .pNext = nullptr,
                                .waitSemaphoreCount = 1,
                                .pWaitSemaphores = &drawn,
                                .swapchainCount = 1,
                                .pSwapchains = &chain,
                                .pImageIndices = &acquired_,
                                .pResults = nullptr};
    const VkResult presented = vkQueuePresentKHR(device_.queue(), &info);
    if (presented == VK_ERROR_OUT_OF_DATE_KHR || presented == VK_SUBOPTIMAL_KHR)
        stale_ = true;
    else
        checkWindow(presented, "vkQueuePresentKHR");
}

}  // namespace diptych::viewer
