// SPDX-License-Identifier: MIT
#include "compare/viewer/window/presenter.h"

#include "compare/viewer/window/swapchain.h"
#include "compare/viewer/window/window_device.h"
#include "shared/vulkan/instance/owned.h"

#include <vulkan/vulkan.h>

#include <backends/imgui_impl_vulkan.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <stdexcept>

namespace diptych::viewer {
namespace {

// Two frames in flight: one is recorded while the GPU renders the other.
constexpr std::size_t frames_in_flight = 2;

void checkImGui(VkResult result) {
    if (result < 0) checkWindow(result, "Dear ImGui");
}

using OwnedRenderPass = Owned<VkRenderPass, vkDestroyRenderPass>;

// A host-visible buffer that is copied to an image of the window.
struct Staging {
    OwnedMemory memory;
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

}  // namespace

struct Presenter::State {
    State(GLFWwindow* window, ValidationLog* log)
        : device(window, log), render_pass(makeRenderPass()), swapchain(device, render_pass) {
        makeFrames();
        makeImGui();
    }
    ~State() {
        vkDeviceWaitIdle(device);
        ImGui_ImplVulkan_Shutdown();
    }

    WindowDevice device;
    OwnedRenderPass render_pass;
    OwnedDescriptorPool descriptors;
    std::array<FrameInFlight, frames_in_flight> frames;
    std::size_t frame = 0;
    Swapchain swapchain;

    // ---- initialization -------------------------------------------------------------------------------

    OwnedRenderPass makeRenderPass() {
        const VkAttachmentDescription attachment{.flags = 0,
                                                 .format = device.format().format,
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
        checkWindow(vkCreateRenderPass(device, &info, nullptr, &made), "vkCreateRenderPass");
        return {device, made};
    }

    void makeFrames() {
        for (FrameInFlight& each : frames) {
            const VkCommandPoolCreateInfo poolInfo{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO, nullptr, 0,
                                                   device.family()};
            VkCommandPool pool = VK_NULL_HANDLE;
            checkWindow(vkCreateCommandPool(device, &poolInfo, nullptr, &pool), "vkCreateCommandPool");
            each.pool = {device, pool};
            const VkCommandBufferAllocateInfo commandInfo{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                                          nullptr, pool, VK_COMMAND_BUFFER_LEVEL_PRIMARY, 1};
            checkWindow(vkAllocateCommandBuffers(device, &commandInfo, &each.commands),
                        "vkAllocateCommandBuffers");
            const VkFenceCreateInfo fenceInfo{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO, nullptr,
                                              VK_FENCE_CREATE_SIGNALED_BIT};
            VkFence fence = VK_NULL_HANDLE;
            checkWindow(vkCreateFence(device, &fenceInfo, nullptr, &fence), "vkCreateFence");
            each.done = {device, fence};
            each.acquired = makeSemaphore(device);
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
        checkWindow(vkCreateDescriptorPool(device, &info, nullptr, &pool), "vkCreateDescriptorPool");
        descriptors = {device, pool};
        ImGui_ImplVulkan_InitInfo init{};
        init.Instance = device.instance();
        init.PhysicalDevice = device.physical();
        init.Device = device;
        init.QueueFamily = device.family();
        init.Queue = device.queue();
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
        checkWindow(vkDeviceWaitIdle(device), "vkDeviceWaitIdle");
        checkWindow(vkResetCommandPool(device, first.pool, 0), "vkResetCommandPool");
        const VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO, nullptr,
                                             VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT, nullptr};
        checkWindow(vkBeginCommandBuffer(first.commands, &begin), "vkBeginCommandBuffer");
        ImGui_ImplVulkan_CreateFontsTexture(first.commands);
        checkWindow(vkEndCommandBuffer(first.commands), "vkEndCommandBuffer");
        VkSubmitInfo submit{};
        submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
        submit.commandBufferCount = 1;
        submit.pCommandBuffers = &first.commands;
        checkWindow(vkQueueSubmit(device.queue(), 1, &submit, VK_NULL_HANDLE), "vkQueueSubmit");
        checkWindow(vkDeviceWaitIdle(device), "vkDeviceWaitIdle");
        ImGui_ImplVulkan_DestroyFontUploadObjects();
#endif
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
        checkWindow(vkCreateBuffer(device, &info, nullptr, &buffer), "vkCreateBuffer");
        staging.buffer = {device, buffer};
        VkMemoryRequirements needs{};
        vkGetBufferMemoryRequirements(device, buffer, &needs);
        const VkPhysicalDeviceMemoryProperties& memory = device.support().memory();
        constexpr VkMemoryPropertyFlags wanted =
            VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
        std::uint32_t type = 0;  // Vulkan guarantees one
        while ((needs.memoryTypeBits >> type & 1) == 0 ||
               (memory.memoryTypes[type].propertyFlags & wanted) != wanted)
            ++type;
        const VkMemoryAllocateInfo allocate{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, nullptr, needs.size,
                                            type};
        VkDeviceMemory made = VK_NULL_HANDLE;
        checkWindow(vkAllocateMemory(device, &allocate, nullptr, &made), "vkAllocateMemory");
        staging.memory = {device, made};
        checkWindow(vkBindBufferMemory(device, buffer, made, 0), "vkBindBufferMemory");
        checkWindow(vkMapMemory(device, made, 0, VK_WHOLE_SIZE, 0, &staging.mapped), "vkMapMemory");
        staging.bytes = bytes;
    }

    // A layout of an image, and what uses it there.
    struct ImageUse {
        VkImageLayout layout;
        VkPipelineStageFlags stages;
        VkAccessFlags access;
    };

    static void barrier(VkCommandBuffer commands, VkImage image, const ImageUse& before,
                        const ImageUse& after) {
        const VkImageMemoryBarrier info{.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER,
                                        .pNext = nullptr,
                                        .srcAccessMask = before.access,
                                        .dstAccessMask = after.access,
                                        .oldLayout = before.layout,
                                        .newLayout = after.layout,
                                        .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                        .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                        .image = image,
                                        .subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1}};
        vkCmdPipelineBarrier(commands, before.stages, after.stages, 0, 0, nullptr, 0, nullptr, 1, &info);
    }

    // Copies the pixels that lie in the window, which may have become smaller meanwhile.
    void copyPixels(VkCommandBuffer commands, FrameInFlight& now, const WindowPixels& pixels, VkImage image) {
        const auto windowWidth = static_cast<int>(swapchain.extent().width),
                   windowHeight = static_cast<int>(swapchain.extent().height);
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
        checkWindow(vkResetCommandPool(device, now.pool, 0), "vkResetCommandPool");
        const VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO, nullptr,
                                             VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT, nullptr};
        checkWindow(vkBeginCommandBuffer(now.commands, &begin), "vkBeginCommandBuffer");
        // The copy waits for the acquired image's semaphore.
        constexpr ImageUse acquired{VK_IMAGE_LAYOUT_UNDEFINED, VK_PIPELINE_STAGE_TRANSFER_BIT, 0},
            written{VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_PIPELINE_STAGE_TRANSFER_BIT,
                    VK_ACCESS_TRANSFER_WRITE_BIT},
            drawn{VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT,
                  VK_ACCESS_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT};
        barrier(now.commands, image.image, acquired, written);
        const VkClearColorValue background{.float32 = {0.09f, 0.09f, 0.1f, 1}};
        const VkImageSubresourceRange all{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
        vkCmdClearColorImage(now.commands, image.image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &background, 1,
                             &all);
        if (!pixels.data.empty()) {
            barrier(now.commands, image.image, written, written);
            copyPixels(now.commands, now, pixels, image.image);
        }
        barrier(now.commands, image.image, written, drawn);
        const VkRenderPassBeginInfo pass{.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO,
                                         .pNext = nullptr,
                                         .renderPass = render_pass,
                                         .framebuffer = image.framebuffer,
                                         .renderArea = {{0, 0}, swapchain.extent()},
                                         .clearValueCount = 0,
                                         .pClearValues = nullptr};
        vkCmdBeginRenderPass(now.commands, &pass, VK_SUBPASS_CONTENTS_INLINE);
        ImGui_ImplVulkan_RenderDrawData(drawing, now.commands);
        vkCmdEndRenderPass(now.commands);
        checkWindow(vkEndCommandBuffer(now.commands), "vkEndCommandBuffer");
    }

    void show(const WindowPixels& pixels, ImDrawData* drawing) {
        FrameInFlight& now = frames.at(frame);
        const VkFence fence = now.done;
        checkWindow(vkWaitForFences(device, 1, &fence, VK_TRUE, UINT64_MAX), "vkWaitForFences");
        const WindowImage* image = swapchain.acquire(now.acquired);
        if (!image) return;
        checkWindow(vkResetFences(device, 1, &fence), "vkResetFences");
        record(now, *image, pixels, drawing);
        const VkPipelineStageFlags stage = VK_PIPELINE_STAGE_TRANSFER_BIT;
        const VkSemaphore wait = now.acquired, signal = image->drawn;
        const VkSubmitInfo submit{.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO,
                                  .pNext = nullptr,
                                  .waitSemaphoreCount = 1,
                                  .pWaitSemaphores = &wait,
                                  .pWaitDstStageMask = &stage,
                                  .commandBufferCount = 1,
                                  .pCommandBuffers = &now.commands,
                                  .signalSemaphoreCount = 1,
                                  .pSignalSemaphores = &signal};
        checkWindow(vkQueueSubmit(device.queue(), 1, &submit, fence), "vkQueueSubmit");
        swapchain.present();
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
    return state_->device.format().format == VK_FORMAT_B8G8R8A8_UNORM;
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
    return state_->device.support().properties().deviceName;
}

}  // namespace diptych::viewer
