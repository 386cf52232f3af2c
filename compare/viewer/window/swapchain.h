// SPDX-License-Identifier: MIT
// The images of the window. Follows its size.
#pragma once

#include "compare/viewer/window/window_device.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace diptych::viewer {

struct WindowImage {
    VkImage image = VK_NULL_HANDLE;
    OwnedImageView view;
    Owned<VkFramebuffer, vkDestroyFramebuffer> framebuffer;
    OwnedSemaphore drawn;
};

class Swapchain {
public:
    // `render_pass`: of the images' framebuffers. Both must outlive this.
    Swapchain(const WindowDevice& device, VkRenderPass render_pass)
        : device_(device), render_pass_(render_pass) {}

    // The next image to draw; signals `acquired` once it is free. nullptr: none, because the window has no
    // area or changes its size.
    const WindowImage* acquire(VkSemaphore acquired);
    // Shows that image, once it is drawn.
    void present();
    VkExtent2D extent() const { return extent_; }

private:
    bool make();
    VkPresentModeKHR presentMode() const;
    VkExtent2D sizeOf(const VkSurfaceCapabilitiesKHR& can) const;
    WindowImage windowImage(VkImage handle) const;

    const WindowDevice& device_;
    VkRenderPass render_pass_;
    Owned<VkSwapchainKHR, vkDestroySwapchainKHR> swapchain_;
    VkExtent2D extent_{};
    std::vector<WindowImage> images_;
    std::uint32_t acquired_ = 0;  // index into images_
    bool stale_ = true;           // it no longer fits the window
};

}  // namespace diptych::viewer
