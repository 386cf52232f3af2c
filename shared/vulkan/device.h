// SPDX-License-Identifier: MIT
// One logical device with one queue. Knows no scene and no window.
#pragma once

#include "shared/vulkan/device_info.h"
#include "shared/vulkan/device_profile.h"
#include "shared/vulkan/device_support.h"
#include "shared/vulkan/draw_division.h"
#include "shared/vulkan/memory.h"
#include "shared/vulkan/owned.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace diptych {

class PipelineCompiler;

struct DeviceOptions {
    std::string choice;     // "" a real GPU first; an index of listDevices(); part of a name
    bool validate = false;  // Khronos validation with synchronization validation
    ProfileChoices choices = ProfileChoices::of_device;
    // Is told of all pipelines, which are chosen as its device draws; must outlive the device. nullptr: none.
    PipelineCompiler* compiler = nullptr;
};

// How a device rounds a float to a render target's format when a fragment shader writes it, measured by
// drawing: the largest error in units of the format's step (0.5 to nearest, 1 truncating).
struct TargetRounding {
    std::string format;
    double steps = 0;
    std::string kind;  // "to nearest", "towards zero", ...; empty: the device does not draw to it
};

// Ticks from one time stamp to a later one, of which the lowest `validBits` count: the others are undefined,
// and the counter wraps around.
std::uint64_t elapsedTicks(std::uint64_t from, std::uint64_t to, std::uint32_t validBits);

// Every device, in the loader's order. Throws std::runtime_error where there is no Vulkan at all.
std::vector<DeviceInfo> listDevices();

class Device {
public:
    // Throws std::runtime_error naming --device where the choice fits none, or the missing feature.
    explicit Device(const DeviceOptions& options);
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    const DeviceInfo& info() const;
    // Asked once.
    const DeviceSupport& support() const;
    const VkPhysicalDeviceLimits& limits() const { return support().limits(); }
    VkDevice handle() const;
    Memory& memory();
    VkPipelineCache pipelineCache() const;  // for everything that makes pipelines, from any thread
    // How many indirect draws one command may have: 1 where a device takes no more.
    std::uint32_t indirectDraws() const;
    const DeviceProfile& profile() const;
    PipelineCompiler* compiler() const;
    std::uint64_t ticksBetween(std::uint64_t from, std::uint64_t to) const;

    VkQueue queue() const;
    std::uint32_t queueFamily() const;

    // Records a command buffer from its begin to its end, ready to be submitted to queue().
    void record(VkCommandBuffer commands, const std::function<void(VkCommandBuffer)>& record);
    // What draws of many triangles tell of them.
    DrawDivision& drawDivision();

    // Records, submits, and waits until the device is done. Returns the wall clock from submit to fence, ms.
    // Throws std::runtime_error that says `what` was running where the device is lost.
    double submit(const std::function<void(VkCommandBuffer)>& record, const std::string& what = {});

    // Brackets what follows with a name for debuggers; nothing without --validate.
    void beginLabel(VkCommandBuffer commands, const std::string& name);
    void endLabel(VkCommandBuffer commands);
    void setName(VkObjectType type, std::uint64_t handle, const std::string& name);

    // Messages of the validation layers so far (always 0 without --validate), and the first one.
    std::uint64_t validationMessages() const;
    std::string firstValidationMessage() const;

    // How many iterations of its loops one shader invocation is granted, up to 100,000.
    std::uint32_t probeLoopLimit();

    // Draws known values to each render target format of interest and reads them back.
    std::vector<TargetRounding> probeRounding();

    // Both, as facts for people: what only a measurement tells.
    std::vector<DeviceFact> probe();

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace diptych
