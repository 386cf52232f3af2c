// SPDX-License-Identifier: MIT
#include "shared/vulkan/device/device.h"

#include "shared/vulkan/device/commands.h"
#include "shared/vulkan/device/pipeline_cache.h"
#include "shared/vulkan/device/pipeline_compiler.h"
#include "shared/vulkan/instance/check.h"
#include "shared/vulkan/instance/instance.h"
#include "shared/vulkan/instance/physical_device.h"
#include "shared/vulkan/instance/user_cache.h"

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
        infos.push_back(describe(DeviceSupport(device), static_cast<int>(infos.size())));
    return infos;
}

std::uint64_t elapsedTicks(std::uint64_t from, std::uint64_t to, std::uint32_t validBits) {
    const std::uint64_t mask = validBits >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << validBits) - 1;
    return ((to & mask) - (from & mask)) & mask;
}

struct Device::State {
    ValidationLog log;
    std::optional<VulkanInstance> instance;
    DeviceSupport support;
    DeviceInfo info;
    DeviceProfile profile;
    PipelineCompiler* compiler = nullptr;
    std::unique_ptr<VkDevice, DeviceDeleter> device;
    std::unique_ptr<Memory> memory;
    std::optional<DrawDivision> draw_division;
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
    std::vector<DeviceSupport> devices;
    std::vector<DeviceInfo> infos;
    for (const VkPhysicalDevice device : s.instance->devices()) {
        devices.emplace_back(device);
        infos.push_back(describe(devices.back(), static_cast<int>(infos.size())));
    }
    const std::size_t chosen = chooseDevice(infos, options.choice);
    s.support = devices[chosen];
    s.info = infos[chosen];
    s.compiler = options.compiler;
    if (s.compiler != nullptr) s.support.limitTo(s.compiler->limits());
    const bool likeGpu = s.compiler != nullptr && !profileOf(s.compiler->info(), 0).software;
    const std::uint32_t family = s.support.graphicsFamily().value();  // chooseDevice requires one
    s.profile = profileOf(s.info, s.support.timestampBits(), likeGpu ? ProfileChoices::gpu : options.choices);
    if (!s.support.has(DeviceFeature::drawIndirectFirstInstance)) s.profile.culls_by_compute = false;
    s.device.reset(createDevice(s.support));
    s.draw_division.emplace(s.device.get(), s.profile.bins_at_once);
    s.memory = std::make_unique<Memory>(s.support, s.device.get());
    s.pipeline_cache.emplace(s.support.properties(), s.device.get(), userCacheFolder());
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
std::uint32_t Device::indirectDraws() const {
    return support().has(DeviceFeature::multiDrawIndirect) ? limits().maxDrawIndirectCount : 1;
}
PipelineCompiler* Device::compiler() const {
    return state_->compiler;
}
const DeviceProfile& Device::profile() const {
    return state_->profile;
}
std::uint64_t Device::ticksBetween(std::uint64_t from, std::uint64_t to) const {
    return elapsedTicks(from, to, support().timestampBits());
}
const DeviceSupport& Device::support() const {
    return state_->support;
}
VkDevice Device::handle() const {
    return state_->device.get();
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
    return *support().graphicsFamily();
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
        // The exception destroys resources that work in flight may still use.
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
