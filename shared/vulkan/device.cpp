// SPDX-License-Identifier: MIT
#include "shared/vulkan/device.h"

#include "shared/vulkan/check.h"
#include "shared/vulkan/commands.h"
#include "shared/vulkan/instance.h"
#include "shared/vulkan/physical_device.h"
#include "shared/vulkan/pipeline_cache.h"
#include "shared/vulkan/pipeline_compiler.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>
#include <optional>
#include <stdexcept>

namespace diptych {

namespace {

struct DeviceDeleter {
    using pointer = VkDevice;
    void operator()(VkDevice device) const { vkDestroyDevice(device, nullptr); }
};

}  // namespace

std::vector<DeviceInfo> listDevices() {
    const VulkanInstance instance;
    std::vector<DeviceInfo> infos;
    for (const VkPhysicalDevice device : instance.devices())
        infos.push_back(describe(device, static_cast<int>(infos.size())));
    return infos;
}

std::uint64_t elapsedTicks(std::uint64_t from, std::uint64_t to, std::uint32_t validBits) {
    const std::uint64_t mask = validBits >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << validBits) - 1;
    return ((to & mask) - (from & mask)) & mask;
}

struct Device::State {
    ValidationLog log;
    std::optional<VulkanInstance> instance;
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    DeviceInfo info;
    DeviceProfile profile;
    PipelineCompiler* compiler = nullptr;
    VkPhysicalDeviceLimits limits{};
    std::uint32_t indirect_draws = 1;
    std::uint32_t timestamp_bits = 0;  // of a time stamp that the queue writes; 0: it writes none
    std::unique_ptr<VkDevice, DeviceDeleter> device;
    std::unique_ptr<Memory> memory;
    std::optional<DrawDivision> draw_division;
    std::uint32_t family = 0;
    std::optional<PipelineCache> pipeline_cache;
    VkQueue queue = VK_NULL_HANDLE;
    OwnedCommandPool pool;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    OwnedFence fence;
    PFN_vkCmdBeginDebugUtilsLabelEXT begin_label = nullptr;
    PFN_vkCmdEndDebugUtilsLabelEXT end_label = nullptr;
    PFN_vkSetDebugUtilsObjectNameEXT set_name = nullptr;
};

Device::Device(const DeviceOptions& options) : state_(std::make_unique<State>()) {
    State& s = *state_;
    s.instance.emplace(options.validate ? &s.log : nullptr);
    const std::vector<VkPhysicalDevice> devices = s.instance->devices();
    std::vector<DeviceInfo> infos;
    for (const VkPhysicalDevice device : devices)
        infos.push_back(describe(device, static_cast<int>(infos.size())));
    const std::size_t chosen = chooseDevice(infos, options.choice);
    s.physical = devices[chosen];
    s.info = infos[chosen];
    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(s.physical, &properties);
    s.limits = properties.limits;
    if (options.compiler != nullptr) {
        const VkPhysicalDeviceLimits& there = options.compiler->limits();
        for (std::uint32_t VkPhysicalDeviceLimits::*most :
             {&VkPhysicalDeviceLimits::maxImageDimension2D, &VkPhysicalDeviceLimits::maxTexelBufferElements,
              &VkPhysicalDeviceLimits::maxStorageBufferRange})
            s.limits.*most = std::min(s.limits.*most, there.*most);
    }

    const std::uint32_t family = *graphicsFamily(s.physical);  // a required fact: chooseDevice saw to it
    std::uint32_t families = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(s.physical, &families, nullptr);
    std::vector<VkQueueFamilyProperties> queues(families);
    vkGetPhysicalDeviceQueueFamilyProperties(s.physical, &families, queues.data());
    s.family = family;
    s.timestamp_bits = queues.at(family).timestampValidBits;
    s.compiler = options.compiler;
    const bool likeGpu = s.compiler != nullptr && s.compiler->info().type != "cpu";
    s.profile = profileOf(s.info, s.timestamp_bits, likeGpu ? ProfileChoices::gpu : options.choices);
    if (!beginsAtAnyInstance(s.physical)) s.profile.culls_by_compute = false;
    VkPhysicalDeviceFeatures features{};
    vkGetPhysicalDeviceFeatures(s.physical, &features);
    if (features.multiDrawIndirect == VK_TRUE) s.indirect_draws = s.limits.maxDrawIndirectCount;
    s.device.reset(createDevice(s.physical, family));
    s.draw_division.emplace(s.device.get(), s.profile.bins_at_once);
    s.memory = std::make_unique<Memory>(s.physical, s.device.get(), knowsMemoryBudget(s.physical));
    s.pipeline_cache.emplace(s.physical, s.device.get(), userCacheFolder());
    vkGetDeviceQueue(s.device.get(), family, 0, &s.queue);
    s.pool = makeCommandPool(s.device.get(), family);
    s.commands = allocateCommands(s.device.get(), s.pool);
    s.fence = makeFence(s.device.get());
    if (options.validate) {
        const auto load = [&](const char* name) { return vkGetDeviceProcAddr(s.device.get(), name); };
        s.begin_label =
            reinterpret_cast<PFN_vkCmdBeginDebugUtilsLabelEXT>(load("vkCmdBeginDebugUtilsLabelEXT"));
        s.end_label = reinterpret_cast<PFN_vkCmdEndDebugUtilsLabelEXT>(load("vkCmdEndDebugUtilsLabelEXT"));
        s.set_name = reinterpret_cast<PFN_vkSetDebugUtilsObjectNameEXT>(load("vkSetDebugUtilsObjectNameEXT"));
    }
}

Device::~Device() {
    if (state_->device) vkDeviceWaitIdle(state_->device.get());
}

const DeviceInfo& Device::info() const {
    return state_->info;
}
bool Device::countsFragments() const {
    VkPhysicalDeviceFeatures features{};
    vkGetPhysicalDeviceFeatures(state_->physical, &features);
    return features.occlusionQueryPrecise == VK_TRUE;
}
bool Device::countsStages() const {
    VkPhysicalDeviceFeatures features{};
    vkGetPhysicalDeviceFeatures(state_->physical, &features);
    return features.pipelineStatisticsQuery == VK_TRUE;
}
VkSampleCountFlags Device::sampleCounts(VkFormat format, VkImageUsageFlags usage) const {
    VkImageFormatProperties properties{};
    const VkResult found = vkGetPhysicalDeviceImageFormatProperties(
        state_->physical, format, VK_IMAGE_TYPE_2D, VK_IMAGE_TILING_OPTIMAL, usage, 0, &properties);
    return found == VK_SUCCESS ? properties.sampleCounts : 0;
}

bool Device::storesSamples() const {
    return diptych::storesSamples(state_->physical);
}

bool Device::hasFloat16() const {
    return diptych::hasFloat16(state_->physical);
}
bool Device::hasInt64() const {
    return diptych::hasInt64(state_->physical);
}

bool Device::sortsFragments() const {
    return diptych::sortsFragments(state_->physical);
}
std::uint32_t Device::indirectDraws() const {
    return state_->indirect_draws;
}
PipelineCompiler* Device::compiler() const {
    return state_->compiler;
}
const DeviceProfile& Device::profile() const {
    return state_->profile;
}
std::uint64_t Device::ticksBetween(std::uint64_t from, std::uint64_t to) const {
    return elapsedTicks(from, to, state_->timestamp_bits);
}
const VkPhysicalDeviceLimits& Device::limits() const {
    return state_->limits;
}
VkDevice Device::handle() const {
    return state_->device.get();
}
VkPhysicalDevice Device::physical() const {
    return state_->physical;
}
Memory& Device::memory() {
    return *state_->memory;
}
VkPipelineCache Device::pipelineCache() const {
    return state_->pipeline_cache->handle();
}

VkQueue Device::queue() const {
    return state_->queue;
}
std::uint32_t Device::queueFamily() const {
    return state_->family;
}

void Device::record(VkCommandBuffer commands, const std::function<void(VkCommandBuffer)>& record) {
    recordCommands(commands, [&](VkCommandBuffer begun) {
        state_->draw_division->begin(begun);
        record(begun);
    });
}

DrawDivision& Device::drawDivision() {
    return *state_->draw_division;
}

double Device::submit(const std::function<void(VkCommandBuffer)>& record, const std::string& what) {
    State& s = *state_;
    this->record(s.commands, record);
    const auto start = std::chrono::steady_clock::now();
    VkResult result = submitCommands(s.queue, s.commands, s.fence);
    const VkFence fence = s.fence;
    if (result == VK_SUCCESS) {
        result = vkWaitForFences(s.device.get(), 1, &fence, VK_TRUE, UINT64_MAX);
        // What may still run must not outlive what it works on, which the exception takes down.
        if (result != VK_SUCCESS) vkDeviceWaitIdle(s.device.get());
    }
    checkResult(result, what.empty() ? "work on the device" : "running " + what);
    const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - start;
    checkResult(vkResetFences(s.device.get(), 1, &fence), "vkResetFences");
    return elapsed.count();
}

void Device::beginLabel(VkCommandBuffer commands, const std::string& name) {
    if (state_->begin_label == nullptr) return;
    const VkDebugUtilsLabelEXT label{.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT,
                                     .pNext = nullptr,
                                     .pLabelName = name.c_str(),
                                     .color = {}};
    state_->begin_label(commands, &label);
}

void Device::endLabel(VkCommandBuffer commands) {
    if (state_->end_label != nullptr) state_->end_label(commands);
}

void Device::setName(VkObjectType type, std::uint64_t handle, const std::string& name) {
    if (state_->set_name == nullptr) return;
    const VkDebugUtilsObjectNameInfoEXT info{.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT,
                                             .pNext = nullptr,
                                             .objectType = type,
                                             .objectHandle = handle,
                                             .pObjectName = name.c_str()};
    checkResult(state_->set_name(state_->device.get(), &info), "vkSetDebugUtilsObjectNameEXT");
}

std::uint64_t Device::validationMessages() const {
    return state_->log.messages;
}

std::string Device::firstValidationMessage() const {
    const std::scoped_lock lock(state_->log.mutex);
    return state_->log.first;
}

}  // namespace diptych
