// SPDX-License-Identifier: MIT
// One logical device with one queue. Does not depend on scenes or windows.
#pragma once

#include "shared/vulkan/device/draw_division.h"
#include "shared/vulkan/device/memory.h"
#include "shared/vulkan/instance/device_info.h"
#include "shared/vulkan/instance/device_profile.h"
#include "shared/vulkan/instance/device_support.h"
#include "shared/vulkan/instance/owned.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace diptych {

class PipelineCompiler;

struct DeviceOptions {
    std::string choice;     // "": first a real GPU; an index of listDevices(); part of a name
    bool validate = false;  // Khronos validation, including synchronization validation
    ProfileChoices choices = ProfileChoices::of_device;
    // Receives all pipelines, which are chosen as for its device; must outlive the device. nullptr: none.
    PipelineCompiler* compiler = nullptr;
};

// Measured rounding of floats when a fragment shader writes a render target: the largest error in steps of
// the format (0.5: to nearest, 1: truncation).
struct TargetRounding {
    std::string format;
    double steps = 0;
    std::string kind;  // "to nearest", "towards zero", ...; empty: not supported as a colour attachment
};

// Ticks between two time stamps. Only the lowest `validBits` are defined, and the counter wraps around.
std::uint64_t elapsedTicks(std::uint64_t from, std::uint64_t to, std::uint32_t validBits);

// All devices in the loader's order. Throws std::runtime_error if Vulkan is not available.
std::vector<DeviceInfo> listDevices();

class Device {
public:
    // Throws std::runtime_error naming --device if the choice matches no device, or naming a missing
    // feature.
    explicit Device(const DeviceOptions& options);
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    const DeviceInfo& info() const;
    // Queried once.
    const DeviceSupport& support() const;
    const VkPhysicalDeviceLimits& limits() const { return support().limits(); }
    VkDevice handle() const;
    Memory& memory();
    VkPipelineCache pipelineCache() const;  // for all pipeline creation, from any thread
    // Largest number of indirect draws per command; 1 without multi-draw indirect.
    std::uint32_t indirectDraws() const;
    const DeviceProfile& profile() const;
    PipelineCompiler* compiler() const;
    std::uint64_t ticksBetween(std::uint64_t from, std::uint64_t to) const;

    VkQueue queue() const;
    std::uint32_t queueFamily() const;

    // Records a complete command buffer for submission to queue().
    void record(VkCommandBuffer commands, const std::function<void(VkCommandBuffer)>& record);
    // Draws report their triangles to it.
    DrawDivision& drawDivision();

    // Records, submits and waits. Returns the CPU time from submit to fence, ms. Throws std::runtime_error
    // naming `what` if the device is lost.
    double submit(const std::function<void(VkCommandBuffer)>& record, const std::string& what = {});

    // Debug label around the following commands; does nothing without --validate.
    void beginLabel(VkCommandBuffer commands, const std::string& name);
    void endLabel(VkCommandBuffer commands);
    void setName(VkObjectType type, std::uint64_t handle, const std::string& name);

    // Number of validation messages so far (0 without --validate), and the first message.
    std::uint64_t validationMessages() const;
    std::string firstValidationMessage() const;

    // Largest number of loop iterations that one shader invocation completes, up to 100,000.
    std::uint32_t probeLoopLimit();

    // Draws known values to several render target formats and reads them back.
    std::vector<TargetRounding> probeRounding();

    // Results of both probes, as text for people.
    std::vector<DeviceProperty> probe();

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace diptych
