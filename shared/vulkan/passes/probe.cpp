// SPDX-License-Identifier: MIT
// Measurements of properties that Vulkan does not report.
#include "shared/vulkan/passes/pass_list.h"
#include "shared/vulkan/pipelines/descriptors.h"
#include "shared/vulkan/pipelines/pipelines.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <functional>

namespace diptych {

namespace {

// First 32 bits of every texel after a full-screen draw of `fragment`.
std::vector<std::uint32_t> drawProbe(Device& device, Shader fragment, VkFormat format, std::uint32_t width) {
    const OwnedPipelineLayout layout = makePipelineLayout(device, {});
    Pipelines pipelines(device, layout);
    PassList passes(device, width, 1);
    const ImageRef target = passes.image("probe", format);
    const Pipeline pipeline = pipelines.get({.vertex = Shader::full_screen_vert,
                                             .fragment = fragment,
                                             .variant = {},
                                             .input = 0,
                                             .colors = {format}});
    passes.draw("probe").color(target, Load::clear).record([&](VkCommandBuffer commands) {
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
        vkCmdSetCullMode(commands, VK_CULL_MODE_NONE);
        vkCmdSetFrontFace(commands, VK_FRONT_FACE_COUNTER_CLOCKWISE);
        vkCmdDraw(commands, 3, 1, 0, 0);
    });
    passes.run();
    const std::vector<float> texels = passes.readBack(std::array{PassList::ReadBack{target, 1}}).front();
    std::vector<std::uint32_t> bits(texels.size());
    for (std::size_t i = 0; i < bits.size(); ++i) bits[i] = std::bit_cast<std::uint32_t>(texels[i]);
    return bits;
}

struct Target {
    const char* name;
    VkFormat format;
    std::function<double(std::uint32_t)> decode;  // the red component
    std::function<double(double)> step;           // between two codes around a value
};

double floatStep(double value, int mantissa) {
    return std::ldexp(1.0, std::ilogb(value) - mantissa);
}

// PassList::readBack converts small float formats to float32.
double readFloat(std::uint32_t bits) {
    return static_cast<double>(std::bit_cast<float>(bits));
}

const std::array<Target, 5>& targets() {
    static const std::array<Target, 5> list{{
        {"R8G8B8A8_UNORM", VK_FORMAT_R8G8B8A8_UNORM, [](std::uint32_t b) { return (b & 0xff) / 255.0; },
         [](double) { return 1 / 255.0; }},
        {"A2B10G10R10_UNORM", VK_FORMAT_A2B10G10R10_UNORM_PACK32,
         [](std::uint32_t b) { return (b & 0x3ff) / 1023.0; }, [](double) { return 1 / 1023.0; }},
        {"R16G16_SNORM", VK_FORMAT_R16G16_SNORM, [](std::uint32_t b) { return (b & 0x7fff) / 32767.0; },
         [](double) { return 1 / 32767.0; }},
        {"R16G16B16A16_SFLOAT", VK_FORMAT_R16G16B16A16_SFLOAT, readFloat,
         [](double v) { return floatStep(v, 10); }},
        {"B10G11R11_UFLOAT", VK_FORMAT_B10G11R11_UFLOAT_PACK32, readFloat,
         [](double v) { return floatStep(v, 6); }},
    }};
    return list;
}

}  // namespace

std::vector<TargetRounding> Device::probeRounding() {
    constexpr std::uint32_t samples = 4096;
    const std::vector<std::uint32_t> exact =
        drawProbe(*this, Shader::probe_rounding_frag, VK_FORMAT_R32G32B32A32_SFLOAT, samples);
    std::vector<TargetRounding> result;
    for (const Target& target : targets()) {
        if (!support().can(target.format, format_use::drawn | format_use::sampled)) {
            result.push_back({target.name, 0, ""});
            continue;
        }
        const std::vector<std::uint32_t> bits =
            drawProbe(*this, Shader::probe_rounding_frag, target.format, samples);
        double largest = 0, above = 0;
        for (std::uint32_t i = 0; i < samples; ++i) {
            const auto value = static_cast<double>(std::bit_cast<float>(exact[i]));
            const double error = (target.decode(bits[i]) - value) / target.step(value);
            largest = std::max(largest, std::abs(error));
            above = std::max(above, error);
        }
        // Rounding to nearest stays within half a step, plus the float32 rounding of value x steps.
        const char* kind = largest < 0.51 ? "to nearest" : above < 0.01 ? "towards zero" : "not to nearest";
        result.push_back({target.name, largest, kind});
    }
    return result;
}

std::uint32_t Device::probeLoopLimit() {
    return static_cast<std::uint32_t>(
        std::bit_cast<float>(drawProbe(*this, Shader::probe_loop_frag, VK_FORMAT_R32_SFLOAT, 1).front()));
}

std::vector<DeviceProperty> Device::probe() {
    std::vector<DeviceProperty> properties;
    const std::uint32_t limit = probeLoopLimit();
    properties.push_back(
        {"loops of any length", limit >= 99'999, false,
         limit >= 99'999
             ? "tested to 100,000 iterations"
             : fmt::format("all loops of an invocation together end silently after {} iterations", limit)});
    for (const TargetRounding& target : probeRounding())
        properties.push_back(
            {"rounds to nearest: " + target.format, target.kind == "to nearest", false,
             target.kind.empty()
                 ? "not supported as a colour attachment; only this probe needs it"
                 : fmt::format("{}, error up to {:.2f} of a step; the G-buffer rounds in the shader",
                               target.kind, target.steps)});
    return properties;
}

}  // namespace diptych
