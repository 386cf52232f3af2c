// SPDX-License-Identifier: MIT
#include "compare/viewer/presenter.h"

#include "shared/vulkan/check.h"
#include "shared/vulkan/device_support.h"
#include "shared/vulkan/owned.h"

#include <vulkan/vulkan.h>

#include <GLFW/glfw3.h>
#include <backends/imgui_impl_vulkan.h>
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <stdexcept>

namespace diptych::viewer {
namespace {

// Two frames in flight: one is recorded while the GPU renders the other.
constexpr std::size_t frames_in_flight = 2;

// Thrown if the device is lost, to leave the frame.
struct Lost {};

void check(VkResult result, const char* what) {
    if (result == VK_ERROR_DEVICE_LOST) throw Lost();
    checkResult(result, what);
}

void checkImGui(VkResult result) {
    if (result < 0) check(result, "Dear ImGui");
}

using OwnedSemaphore = Owned<VkSemaphore, vkDestroySemaphore>;
using OwnedRenderPass = Owned<VkRenderPass, vkDestroyRenderPass>;
using OwnedFramebuffer = Owned<VkFramebuffer, vkDestroyFramebuffer>;
using OwnedView = Owned<VkImageView, vkDestroyImageView>;
using OwnedSwapchain = Owned<VkSwapchainKHR, vkDestroySwapchainKHR>;
using OwnedDeviceMemory = Owned<VkDeviceMemory, vkFreeMemory>;

struct Surface {
    Surface(VkInstance instance, GLFWwindow* window) : instance_(instance) {
        check(glfwCreateWindowSurface(instance, window, nullptr, &handle), "glfwCreateWindowSurface");
    }
    ~Surface() { vkDestroySurfaceKHR(instance_, handle, nullptr); }
    Surface(const Surface&) = delete;
    Surface& operator=(const Surface&) = delete;
    VkSurfaceKHR handle = VK_NULL_HANDLE;

private:
    VkInstance instance_;
};

struct LogicalDevice {
    ~LogicalDevice() {
        if (handle != VK_NULL_HANDLE) vkDestroyDevice(handle, nullptr);
    }
    VkDevice handle = VK_NULL_HANDLE;
};

std::span<const char* const> windowExtensions() {
    std::uint32_t count = 0;
    const char** const names = glfwGetRequiredInstanceExtensions(&count);
    if (names == nullptr)
        throw std::runtime_error(
            "view: this display does not support Vulkan surfaces; use diptych render, which needs no window");
    return {names, count};
}

// A host-visible buffer that is copied to an image of the window.
struct Staging {
    OwnedDeviceMemory memory;
    OwnedBuffer buffer;
    void* mapped = nullptr;
    VkDeviceSize bytes = 0;
    std::uint64_t version = 0;  // of its pixels
};

struct FrameInFlight {
    OwnedCommandPool pool;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    OwnedFence done;
    OwnedSemaphore acquired;
    Staging staging;
};

struct WindowImage {
    VkImage image = VK_NULL_HANDLE;
    OwnedView view;
    OwnedFramebuffer framebuffer;
    OwnedSemaphore drawn;
};

}  // namespace

struct Presenter::State {
    State(GLFWwindow* w, ValidationLog* log)
        : window(w), instance(log, windowExtensions()), surface(instance, w) {
        choosePhysical();
        makeDevice();
        chooseFormat();
        makeRenderPass();
        makeFrames();
        makeImGui();
    }
    ~State() {
        vkDeviceWaitIdle(device.handle);
        ImGui_ImplVulkan_Shutdown();
    }

    GLFWwindow* window;
    VulkanInstance instance;
    Surface surface;
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    DeviceSupport support;
    std::string name;
    std::uint32_t family = 0;
    LogicalDevice device;
    VkQueue queue = VK_NULL_HANDLE;
    VkSurfaceFormatKHR format{};
    OwnedRenderPass render_pass;
    OwnedDescriptorPool descriptors;
    std::array<FrameInFlight, frames_in_flight> frames;
    std::size_t frame = 0;
    OwnedSwapchain swapchain;
    VkExtent2D extent{};
    std::vector<WindowImage> images;
    bool stale = true;  // the swapchain no longer fits the window

    // ---- initialization -------------------------------------------------------------------------------

    // The first device with a queue for graphics and presentation.
    void choosePhysical() {
        for (const VkPhysicalDevice candidate : instance.devices()) {
            DeviceSupport asked(candidate);
            const std::optional<std::uint32_t> graphics = asked.graphicsFamily();
            VkBool32 shows = VK_FALSE;
            if (!graphics ||
                vkGetPhysicalDeviceSurfaceSupportKHR(candidate, *graphics, surface.handle, &shows) < 0 ||
                shows == VK_FALSE)
                continue;
            physical = candidate;
            family = *graphics;
            support = std::move(asked);
            name = support.properties().deviceName;
            return;
        }
        throw std::runtime_error(
            "view: no Vulkan device can present to this window; use diptych render, which needs no window");
    }

    void makeDevice() {
        const float priority = 1;
        const VkDeviceQueueCreateInfo queues{.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                             .pNext = nullptr,
                                             .flags = 0,
                                             .queueFamilyIndex = family,
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
        check(vkCreateDevice(physical, &info, nullptr, &device.handle), "vkCreateDevice");
        vkGetDeviceQueue(device.handle, family, 0, &queue);
    }

    // 8 bits without encoding: the pixels are display values.
    void chooseFormat() {
        constexpr std::array wanted{VK_FORMAT_B8G8R8A8_UNORM, VK_FORMAT_R8G8B8A8_UNORM};
        std::uint32_t count = 0;
        check(vkGetPhysicalDeviceSurfaceFormatsKHR(physical, surface.handle, &count, nullptr),
              "surface formats");
        std::vector<VkSurfaceFormatKHR> formats(count);
        check(vkGetPhysicalDeviceSurfaceFormatsKHR(physical, surface.handle, &count, formats.data()),
              "surface formats");
        for (const VkFormat choice : wanted)
            for (const VkSurfaceFormatKHR& candidate : formats)
                if (candidate.format == choice && candidate.colorSpace == VK_COLOR_SPACE_SRGB_NONLINEAR_KHR) {
                    format = candidate;
                    return;
                }
        throw std::runtime_error("view: the window offers no 8-bit colour format (B8G8R8A8 or R8G8B8A8)");
    }

    void makeRenderPass() {
        const VkAttachmentDescription attachment{.flags = 0,
                                                 .format = format.format,
                                                 .samples = VK_SAMPLE_COUNT_1_BIT,
                                                 .loadOp = VK_ATTACHMENT_LOAD_OP_LOAD,
                                                 .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
                                                 .stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE,
                                                 .stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE,
                                                 .initialLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                                                 .finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR};
        const VkAttachmentReference reference{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
        const VkSubpassDescription subpass{.flags = 0,
                                           .pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS,
                                           .inputAttachmentCount = 0,
                                           .pInputAttachments = nullptr,
                                           .colorAttachmentCount = 1,
                                           .pColorAttachments = &reference,
                                           .pResolveAttachments = nullptr,
                                           .pDepthStencilAttachment = nullptr,
                                           .preserveAttachmentCount = 0,
                                           .pPreserveAttachments = nullptr};
        const VkSubpassDependency end{.srcSubpass = 0,
                                      .dstSubpass = VK_SUBPASS_EXTERNAL,
                                      .srcStageMask = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT,
                                      .dstStageMask = VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT,
                                      .srcAccessMask = VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT,
                                      .dstAccessMask = 0,
                                      .dependencyFlags = 0};
        const VkRenderPassCreateInfo info{.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO,
                                          .pNext = nullptr,
                                          .flags = 0,
                                          .attachmentCount = 1,
                                          .pAttachments = &attachment,
                                          .subpassCount = 1,
                                          .pSubpasses = &subpass,
                                          .dependencyCount = 1,
                                          .pDependencies = &end};
        VkRenderPass made = VK_NULL_HANDLE;
        check(vkCreateRenderPass(device.handle, &info, nullptr, &made), "vkCreateRenderPass");
        render_pass = {device.handle, made};
    }

    OwnedSemaphore makeSemaphore() {
        const VkSemaphoreCreateInfo info{VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO, nullptr, 0};
        VkSemaphore made = VK_NULL_HANDLE;
        check(vkCreateSemaphore(device.handle, &info, nullptr, &made), "vkCreateSemaphore");
        return {device.handle, made};
    }

    void makeFrames() {
        for (FrameInFlight& each : frames) {
            const VkCommandPoolCreateInfo poolInfo{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO, nullptr, 0,
                                                   family};
            VkCommandPool pool = VK_NULL_HANDLE;
            check(vkCreateCommandPool(device.handle, &poolInfo, nullptr, &pool), "vkCreateCommandPool");
            each.pool = {device.handle, pool};
            const VkCommandBufferAllocateInfo commandInfo{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                                          nullptr, pool, VK_COMMAND_BUFFER_LEVEL_PRIMARY, 1};
            check(vkAllocateCommandBuffers(device.handle, &commandInfo, &each.commands),
                  "vkAllocateCommandBuffers");
            const VkFenceCreateInfo fenceInfo{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO, nullptr,
                                              VK_FENCE_CREATE_SIGNALED_BIT};
            VkFence fence = VK_NULL_HANDLE;
            check(vkCreateFence(device.handle, &fenceInfo, nullptr, &fence), "vkCreateFence");
            each.done = {device.handle, fence};
            each.acquired = makeSemaphore();
        }
    }

    void makeImGui() {
        const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 8};
        const VkDescriptorPoolCreateInfo info{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                              .pNext = nullptr,
                                              .flags = VK_DESCRIPTOR_POOL_CREATE_FREE_DESCRIPTOR_SET_BIT,
                                              .maxSets = 8,
                                              .poolSizeCount = 1,
                                              .pPoolSizes = &size};
        VkDescriptorPool pool = VK_NULL_HANDLE;
        check(vkCreateDescriptorPool(device.handle, &info, nullptr, &pool), "vkCreateDescriptorPool");
        descriptors = {device.handle, pool};
        ImGui_ImplVulkan_InitInfo init{};
        init.Instance = instance;
        init.PhysicalDevice = physical;
        init.Device = device.handle;
        init.QueueFamily = family;
        init.Queue = queue;
        init.DescriptorPool = pool;
        init.MinImageCount = frames_in_flight;
        init.ImageCount = frames_in_flight;
        init.MSAASamples = VK_SAMPLE_COUNT_1_BIT;
        init.CheckVkResultFn = checkImGui;
        ImGui_ImplVulkan_Init(&init, render_pass);
        makeFontTexture();
    }

    void makeFontTexture() {
#if IMGUI_VERSION_NUM >= 19000
        ImGui_ImplVulkan_CreateFontsTexture();  // submits and waits
#else
        FrameInFlight& first = frames.front();
        check(vkDeviceWaitIdle(device.handle), "vkDeviceWaitIdle");
        check(vkResetCommandPool(device.handle, first.pool, 0), "vkResetCommandPool");
        const VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO, nullptr,
                                             VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT, nullptr};
        check(vkBeginCommandBuffer(first.commands, &begin), "vkBeginCommandBuffer");
        ImGui_ImplVulkan_CreateFontsTexture(first.commands);
        check(vkEndCommandBuffer(first.commands), "vkEndCommandBuffer");
        VkSubmitInfo submit{};
        submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
        submit.commandBufferCount = 1;
        submit.pCommandBuffers = &first.commands;
        check(vkQueueSubmit(queue, 1, &submit, VK_NULL_HANDLE), "vkQueueSubmit");
        check(vkDeviceWaitIdle(device.handle), "vkDeviceWaitIdle");
        ImGui_ImplVulkan_DestroyFontUploadObjects();
#endif
    }

    // ---- as the window changes ------------------------------------------------------------------------

    VkPresentModeKHR presentMode() const {
        std::uint32_t count = 0;
        check(vkGetPhysicalDeviceSurfacePresentModesKHR(physical, surface.handle, &count, nullptr),
              "present modes");
        std::vector<VkPresentModeKHR> modes(count);
        check(vkGetPhysicalDeviceSurfacePresentModesKHR(physical, surface.handle, &count, modes.data()),
              "present modes");
        return std::ranges::find(modes, VK_PRESENT_MODE_MAILBOX_KHR) != modes.end()
                   ? VK_PRESENT_MODE_MAILBOX_KHR
                   : VK_PRESENT_MODE_FIFO_KHR;
    }

    // False if the window has no area.
    bool makeSwapchain() {
        VkSurfaceCapabilitiesKHR can{};
        check(vkGetPhysicalDeviceSurfaceCapabilitiesKHR(physical, surface.handle, &can),
              "surface capabilities");
        VkExtent2D size = can.currentExtent;
        if (size.width == std::numeric_limits<std::uint32_t>::max()) {
            int width = 0, height = 0;
            glfwGetFramebufferSize(window, &width, &height);
            size = {std::clamp(static_cast<std::uint32_t>(width), can.minImageExtent.width,
                               can.maxImageExtent.width),
                    std::clamp(static_cast<std::uint32_t>(height), can.minImageExtent.height,
                               can.maxImageExtent.height)};
        }
        if (size.width == 0 || size.height == 0) return false;
        check(vkDeviceWaitIdle(device.handle), "vkDeviceWaitIdle");
        images.clear();
        const std::uint32_t most =
            can.maxImageCount > 0 ? can.maxImageCount : std::numeric_limits<std::uint32_t>::max();
        const VkSwapchainCreateInfoKHR info{
            .sType = VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR,
            .pNext = nullptr,
            .flags = 0,
            .surface = surface.handle,
            .minImageCount = std::min(std::max(can.minImageCount + 1, 3u), most),
            .imageFormat = format.format,
            .imageColorSpace = format.colorSpace,
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
            .oldSwapchain = swapchain};
        VkSwapchainKHR made = VK_NULL_HANDLE;
        check(vkCreateSwapchainKHR(device.handle, &info, nullptr, &made), "vkCreateSwapchainKHR");
        swapchain = OwnedSwapchain(device.handle, made);
        extent = size;
        std::uint32_t count = 0;
        check(vkGetSwapchainImagesKHR(device.handle, made, &count, nullptr), "vkGetSwapchainImagesKHR");
        std::vector<VkImage> handles(count);
        check(vkGetSwapchainImagesKHR(device.handle, made, &count, handles.data()),
              "vkGetSwapchainImagesKHR");
        for (const VkImage handle : handles) images.push_back(windowImage(handle));
        stale = false;
        return true;
    }

    WindowImage windowImage(VkImage handle) {
        WindowImage image;
        image.image = handle;
        const VkImageViewCreateInfo viewInfo{.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
                                             .pNext = nullptr,
                                             .flags = 0,
                                             .image = handle,
                                             .viewType = VK_IMAGE_VIEW_TYPE_2D,
                                             .format = format.format,
                                             .components = {},
                                             .subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1}};
        VkImageView view = VK_NULL_HANDLE;
        check(vkCreateImageView(device.handle, &viewInfo, nullptr, &view), "vkCreateImageView");
        image.view = {device.handle, view};
        const VkFramebufferCreateInfo info{.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO,
                                           .pNext = nullptr,
                                           .flags = 0,
                                           .renderPass = render_pass,
                                           .attachmentCount = 1,
                                           .pAttachments = &view,
                                           .width = extent.width,
                                           .height = extent.height,
                                           .layers = 1};
        VkFramebuffer framebuffer = VK_NULL_HANDLE;
        check(vkCreateFramebuffer(device.handle, &info, nullptr, &framebuffer), "vkCreateFramebuffer");
        image.framebuffer = {device.handle, framebuffer};
        image.drawn = makeSemaphore();
        return image;
    }

    // ---- each frame -----------------------------------------------------------------------------------

    void grow(Staging& staging, VkDeviceSize bytes) {
        if (staging.bytes >= bytes) return;
        staging = Staging();
        const VkBufferCreateInfo info{.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
                                      .pNext = nullptr,
                                      .flags = 0,
                                      .size = bytes,
                                      .usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                                      .sharingMode = VK_SHARING_MODE_EXCLUSIVE,
                                      .queueFamilyIndexCount = 0,
                                      .pQueueFamilyIndices = nullptr};
        VkBuffer buffer = VK_NULL_HANDLE;
        check(vkCreateBuffer(device.handle, &info, nullptr, &buffer), "vkCreateBuffer");
        staging.buffer = {device.handle, buffer};
        VkMemoryRequirements needs{};
        vkGetBufferMemoryRequirements(device.handle, buffer, &needs);
        const VkPhysicalDeviceMemoryProperties& memory = support.memory();
        constexpr VkMemoryPropertyFlags wanted =
            VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
        std::uint32_t type = 0;  // Vulkan guarantees one
        while ((needs.memoryTypeBits >> type & 1) == 0 ||
               (memory.memoryTypes[type].propertyFlags & wanted) != wanted)
            ++type;
        const VkMemoryAllocateInfo allocate{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, nullptr, needs.size,
                                            type};
        VkDeviceMemory made = VK_NULL_HANDLE;
        check(vkAllocateMemory(device.handle, &allocate, nullptr, &made), "vkAllocateMemory");
        staging.memory = {device.handle, made};
        check(vkBindBufferMemory(device.handle, buffer, made, 0), "vkBindBufferMemory");
        check(vkMapMemory(device.handle, made, 0, VK_WHOLE_SIZE, 0, &staging.mapped), "vkMapMemory");
        staging.bytes = bytes;
    }

    static void barrier(VkCommandBuffer commands, VkImage image, VkImageLayout from, VkImageLayout to,
                        VkPipelineStageFlags before, VkAccessFlags wrote, VkPipelineStageFlags after,
                        VkAccessFlags reads) {
        const VkImageMemoryBarrier info{.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER,
                                        .pNext = nullptr,
                                        .srcAccessMask = wrote,
                                        .dstAccessMask = reads,
                                        .oldLayout = from,
                                        .newLayout = to,
                                        .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                        .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                        .image = image,
                                        .subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1}};
        vkCmdPipelineBarrier(commands, before, after, 0, 0, nullptr, 0, nullptr, 1, &info);
    }

    // Copies the pixels that lie in the window, which may have become smaller meanwhile.
    void copyPixels(VkCommandBuffer commands, FrameInFlight& now, const WindowPixels& pixels, VkImage image) {
        const auto windowWidth = static_cast<int>(extent.width),
                   windowHeight = static_cast<int>(extent.height);
        const int width = std::min(pixels.width, windowWidth - pixels.x);
        const int height = std::min(pixels.height, windowHeight - pixels.y);
        if (width <= 0 || height <= 0 || pixels.x < 0 || pixels.y < 0) return;
        if (now.staging.version != pixels.version || now.staging.bytes < pixels.data.size()) {
            grow(now.staging, pixels.data.size());
            std::memcpy(now.staging.mapped, pixels.data.data(), pixels.data.size());
            now.staging.version = pixels.version;
        }
        const VkBufferImageCopy region{
            .bufferOffset = 0,
            .bufferRowLength = static_cast<std::uint32_t>(pixels.width),
            .bufferImageHeight = static_cast<std::uint32_t>(pixels.height),
            .imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
            .imageOffset = {pixels.x, pixels.y, 0},
            .imageExtent = {static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), 1}};
        vkCmdCopyBufferToImage(commands, now.staging.buffer, image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1,
                               &region);
    }

    void record(FrameInFlight& now, const WindowImage& image, const WindowPixels& pixels,
                ImDrawData* drawing) {
        check(vkResetCommandPool(device.handle, now.pool, 0), "vkResetCommandPool");
        const VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO, nullptr,
                                             VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT, nullptr};
        check(vkBeginCommandBuffer(now.commands, &begin), "vkBeginCommandBuffer");
        // The copy waits for the acquired image's semaphore.
        barrier(now.commands, image.image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                VK_PIPELINE_STAGE_TRANSFER_BIT, 0, VK_PIPELINE_STAGE_TRANSFER_BIT,
                VK_ACCESS_TRANSFER_WRITE_BIT);
        const VkClearColorValue background{.float32 = {0.09f, 0.09f, 0.1f, 1}};
        const VkImageSubresourceRange all{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
        vkCmdClearColorImage(now.commands, image.image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &background, 1,
                             &all);
        if (!pixels.data.empty()) {
            barrier(now.commands, image.image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                    VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_PIPELINE_STAGE_TRANSFER_BIT,
                    VK_ACCESS_TRANSFER_WRITE_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT,
                    VK_ACCESS_TRANSFER_WRITE_BIT);
            copyPixels(now.commands, now, pixels, image.image);
        }
        barrier(now.commands, image.image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, VK_PIPELINE_STAGE_TRANSFER_BIT,
                VK_ACCESS_TRANSFER_WRITE_BIT, VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT,
                VK_ACCESS_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT);
        const VkRenderPassBeginInfo pass{.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO,
                                         .pNext = nullptr,
                                         .renderPass = render_pass,
                                         .framebuffer = image.framebuffer,
                                         .renderArea = {{0, 0}, extent},
                                         .clearValueCount = 0,
                                         .pClearValues = nullptr};
        vkCmdBeginRenderPass(now.commands, &pass, VK_SUBPASS_CONTENTS_INLINE);
        ImGui_ImplVulkan_RenderDrawData(drawing, now.commands);
        vkCmdEndRenderPass(now.commands);
        check(vkEndCommandBuffer(now.commands), "vkEndCommandBuffer");
    }

    void show(const WindowPixels& pixels, ImDrawData* drawing) {
        if (stale && !makeSwapchain()) return;
        FrameInFlight& now = frames.at(frame);
        const VkFence fence = now.done;
        check(vkWaitForFences(device.handle, 1, &fence, VK_TRUE, UINT64_MAX), "vkWaitForFences");
        std::uint32_t index = 0;
        VkResult acquired =
            vkAcquireNextImageKHR(device.handle, swapchain, UINT64_MAX, now.acquired, VK_NULL_HANDLE, &index);
        if (acquired == VK_ERROR_OUT_OF_DATE_KHR) {
            stale = true;
            if (!makeSwapchain()) return;
            acquired = vkAcquireNextImageKHR(device.handle, swapchain, UINT64_MAX, now.acquired,
                                             VK_NULL_HANDLE, &index);
            if (acquired == VK_ERROR_OUT_OF_DATE_KHR) {  // it changed again: try the next frame
                stale = true;
                return;
            }
        }
        if (acquired == VK_SUBOPTIMAL_KHR)
            stale = true;
        else
            check(acquired, "vkAcquireNextImageKHR");
        check(vkResetFences(device.handle, 1, &fence), "vkResetFences");
        const WindowImage& image = images.at(index);
        record(now, image, pixels, drawing);
        const VkPipelineStageFlags stage = VK_PIPELINE_STAGE_TRANSFER_BIT;
        const VkSemaphore wait = now.acquired, signal = image.drawn;
        const VkSubmitInfo submit{.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO,
                                  .pNext = nullptr,
                                  .waitSemaphoreCount = 1,
                                  .pWaitSemaphores = &wait,
                                  .pWaitDstStageMask = &stage,
                                  .commandBufferCount = 1,
                                  .pCommandBuffers = &now.commands,
                                  .signalSemaphoreCount = 1,
                                  .pSignalSemaphores = &signal};
        check(vkQueueSubmit(queue, 1, &submit, fence), "vkQueueSubmit");
        const VkSwapchainKHR chain = swapchain;
        const VkPresentInfoKHR present{.sType = VK_STRUCTURE_TYPE_PRESENT_INFO_KHR,
                                       .pNext = nullptr,
                                       .waitSemaphoreCount = 1,
                                       .pWaitSemaphores = &signal,
                                       .swapchainCount = 1,
                                       .pSwapchains = &chain,
                                       .pImageIndices = &index,
                                       .pResults = nullptr};
        const VkResult presented = vkQueuePresentKHR(queue, &present);
        if (presented == VK_ERROR_OUT_OF_DATE_KHR || presented == VK_SUBOPTIMAL_KHR)
            stale = true;
        else
            check(presented, "vkQueuePresentKHR");
        frame = (frame + 1) % frames.size();
    }
};

Presenter::Presenter(GLFWwindow* window, ValidationLog* log) {
    try {
        state_ = std::make_unique<State>(window, log);
    } catch (const Lost&) {
        throw std::runtime_error(
            "view: the device that shows the window was lost as it was started; try again, or use diptych "
            "render, which needs no window");
    }
}
Presenter::~Presenter() = default;

bool Presenter::isBgr() const {
    return state_->format.format == VK_FORMAT_B8G8R8A8_UNORM;
}

void Presenter::beginFrame() {
    ImGui_ImplVulkan_NewFrame();
}

bool Presenter::show(const WindowPixels& pixels, ImDrawData* drawing) {
    try {
        state_->show(pixels, drawing);
        return true;
    } catch (const Lost&) {
        return false;
    }
}

std::string Presenter::device() const {
    return state_->name;
}

}  // namespace diptych::viewer
