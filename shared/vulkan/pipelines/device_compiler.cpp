// SPDX-License-Identifier: MIT
#include "shared/vulkan/pipelines/device_compiler.h"

#include "shared/vulkan/instance/check.h"
#include "shared/vulkan/instance/driver_probe.h"
#include "shared/vulkan/instance/instance.h"
#include "shared/vulkan/instance/physical_device.h"
#include "shared/vulkan/pipelines/descriptors.h"
#include "shared/vulkan/spirv/shared_memory.h"
#include "shared/vulkan/spirv/specialize.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <stdexcept>
#include <utility>

namespace diptych {

namespace {

struct CompilerDeviceDeleter {
    using pointer = VkDevice;
    void operator()(VkDevice device) const { vkDestroyDevice(device, nullptr); }
};

double numberOf(const VkPipelineExecutableStatisticKHR& statistic) {
    switch (statistic.format) {
        case VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_BOOL32_KHR:
            return statistic.value.b32 == VK_TRUE ? 1 : 0;
        case VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_INT64_KHR:
            return static_cast<double>(statistic.value.i64);
        case VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_UINT64_KHR:
            return static_cast<double>(statistic.value.u64);
        case VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_FLOAT64_KHR:
            return statistic.value.f64;
        default:
            return 0;
    }
}

// RADV's device name with RADV_FORCE_FAMILY.
constexpr std::string_view nullHardware = "Null hardware";
// Known to every RADV that compiles without hardware.
constexpr const char* oldestFamily = "vega10";

}  // namespace

std::string PipelineRequest::name() const {
    const Shader shader = key.fragment != Shader::none ? key.fragment : key.vertex;
    return std::string((kernel != nullptr ? *kernel : shaderModule(shader)).name);
}

struct DeviceCompiler::State {
    std::optional<VulkanInstance> instance;
    std::vector<DeviceSupport> devices;
    DeviceSupport support;
    DeviceInfo info;
    std::unique_ptr<VkDevice, CompilerDeviceDeleter> device;
    PFN_vkGetPipelineExecutablePropertiesKHR properties = nullptr;
    PFN_vkGetPipelineExecutableStatisticsKHR statistics = nullptr;
    // Keyed by handles of the drawing device, which may be reused for other layouts.
    std::map<VkDescriptorSetLayout, OwnedDescriptorSetLayout> sets;
    std::map<VkPipelineLayout, OwnedPipelineLayout> layouts;
    std::string pass;
    std::vector<PipelineRequest> requests;

    std::vector<DeviceInfo> list() {
        instance.emplace();
        devices.clear();
        std::vector<DeviceInfo> infos;
        for (const VkPhysicalDevice found : instance->devices())
            infos.push_back(describe(devices.emplace_back(found), static_cast<int>(infos.size())));
        return infos;
    }
    CreationContext context(VkPipelineLayout layout) const {
        return {.device = device.get(),
                .support = support,
                .info = info,
                .layout = layout,
                .flags = VK_PIPELINE_CREATE_CAPTURE_STATISTICS_BIT_KHR};
    }
    void open(const DeviceInfo& chosen, const std::string& choice);
    void tryPipelines() const;  // a draw and a dispatch without descriptors
    std::vector<CompiledShader> shadersOf(VkPipeline pipeline,
                                          std::span<const ShaderModule* const> modules) const;
    CompiledPipeline compile(const PipelineRequest& request) const;
    std::string lackedFormats(const PipelineKey& key) const;
};

void DeviceCompiler::State::open(const DeviceInfo& chosen, const std::string& choice) {
    info = chosen;
    support = devices.at(static_cast<std::size_t>(chosen.index));
    for (const DeviceProperty& property : info.properties)
        if (property.required && !property.there && property.what != memoryProperty)
            throw std::runtime_error(
                fmt::format("--compile-on {}: {} lacks {}", choice, info.name, property.what));
    if (!support.hasExtension(VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME))
        throw std::runtime_error(fmt::format(
            "--compile-on {}: {} does not report compiler statistics (VK_KHR_pipeline_executable_properties)",
            choice, info.name));
    device.reset(createDevice(support, true));
    const auto load = [&](const char* name) { return vkGetDeviceProcAddr(device.get(), name); };
    properties = reinterpret_cast<PFN_vkGetPipelineExecutablePropertiesKHR>(
        load("vkGetPipelineExecutablePropertiesKHR"));
    statistics = reinterpret_cast<PFN_vkGetPipelineExecutableStatisticsKHR>(
        load("vkGetPipelineExecutableStatisticsKHR"));
}

void DeviceCompiler::State::tryPipelines() const {
    const OwnedPipelineLayout layout =
        makePipelineLayout(device.get(), {}, VkPushConstantRange{VK_SHADER_STAGE_ALL, 0, 128});
    const CreationContext context = this->context(layout);
    const PipelineKey draw{.vertex = Shader::full_screen_vert,
                           .fragment = Shader::probe_rounding_frag,
                           .colors = {VK_FORMAT_R32G32B32A32_SFLOAT}};
    makePipeline(context, draw, plainParts(draw));
    makePipeline(context, shaderModule(Shader::cull_meshlets_comp), valueOf({}));
}

DeviceCompiler::DeviceCompiler(const std::string& choice) : state_(std::make_unique<State>()) {
    State& s = *state_;
    const std::vector<DeviceInfo> infos = s.list();
    if (const auto found = findDevice(infos, choice)) {
        s.open(infos.at(*found), choice);
        return;
    }
    const std::vector<std::string> files = radvFiles();
    if (files.empty())
        throw std::runtime_error(
            fmt::format("--compile-on {}: no such device; there are {}. RADV can compile for AMD GPUs that "
                        "are not present: install mesa-vulkan-drivers (Debian 13: Mesa 25)",
                        choice, listOf(infos)));
    std::string family = choice;  // RADV uses lower-case names
    for (char& c : family) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    const auto inFamily = [&](const char* name) {
        return EnvironmentVariables(
            {{"RADV_FORCE_FAMILY", name}, {"VK_DRIVER_FILES", fmt::format("{}", fmt::join(files, ":"))}});
    };
    const auto openFamily = [&] {
        for (const DeviceInfo& info : s.list())
            if (info.name.starts_with(nullHardware)) return s.open(info, choice);
        throw std::runtime_error(fmt::format("--compile-on {}: RADV ({}) does not list such a GPU", choice,
                                             fmt::join(files, ", ")));
    };
    // RADV ends the process for an unknown family.
    const DriverProbe probe_result = probeInChild([&] {
        const EnvironmentVariables forced = inFamily(family.c_str());
        openFamily();
        s.tryPipelines();
        return std::string();
    });
    if (probe_result.crashed) {
        const DriverProbe known = probeInChild([&] {
            const EnvironmentVariables forced = inFamily(oldestFamily);
            openFamily();
            return s.info.driver;
        });
        throw std::runtime_error(
            fmt::format("--compile-on {}: no such device (there are {}), and {} crashes when it compiles for "
                        "this name; Mesa 25 (mesa-vulkan-drivers of Debian 13) compiles for vega10, navi21, "
                        "navi31, gfx1201 and others",
                        choice, listOf(infos), known.crashed ? "RADV" : known.output));
    }
    const QuietStandardError quiet;  // RADV prints that hardware is missing
    const EnvironmentVariables forced = inFamily(family.c_str());
    openFamily();
}

DeviceCompiler::~DeviceCompiler() = default;

const DeviceInfo& DeviceCompiler::info() const {
    return state_->info;
}
const VkPhysicalDeviceLimits& DeviceCompiler::limits() const {
    return state_->support.limits();
}

void DeviceCompiler::addLayout(VkDescriptorSetLayout of, std::span<const VkDescriptorType> types) {
    state_->sets.insert_or_assign(of, makeSetLayout(state_->device.get(), types));
}

void DeviceCompiler::addLayout(VkPipelineLayout of, std::span<const VkDescriptorSetLayout> sets,
                               const std::optional<VkPushConstantRange>& constants) {
    std::vector<VkDescriptorSetLayout> own;
    for (const VkDescriptorSetLayout set : sets) own.push_back(state_->sets.at(set));
    state_->layouts.insert_or_assign(of, makePipelineLayout(state_->device.get(), own, constants));
}

void DeviceCompiler::beginPass(const std::string& name) {
    state_->pass = name;
}

void DeviceCompiler::ask(VkPipelineLayout layout, const PipelineKey& key, const ChooseParts& choose) {
    add({.layout = layout, .key = key, .choose = choose});
}
void DeviceCompiler::ask(VkPipelineLayout layout, const ShaderModule& kernel, const Variant& variant) {
    add({.layout = layout, .kernel = &kernel, .kernel_variant = variant});
}

void DeviceCompiler::add(PipelineRequest request) {
    request.pass = state_->pass;
    if (std::ranges::find(state_->requests, request) == state_->requests.end())
        state_->requests.push_back(std::move(request));
}

std::vector<PipelineRequest> DeviceCompiler::takeRequests() {
    state_->pass.clear();
    return std::exchange(state_->requests, {});
}

std::vector<CompiledPipeline> DeviceCompiler::compile(std::span<const PipelineRequest> requests) const {
    std::vector<CompiledPipeline> compiled(requests.size());
    tbb::parallel_for(std::size_t{0}, requests.size(),
                      [&](std::size_t i) { compiled[i] = state_->compile(requests[i]); });
    return compiled;
}

// Error text of the first unsupported attachment; empty if all are supported.
std::string DeviceCompiler::State::lackedFormats(const PipelineKey& key) const {
    const auto draws = [&](VkFormat format, VkImageUsageFlags usage) {
        return (support.sampleCounts(format, usage) & key.samples) != 0;
    };
    const auto words = [&](VkFormat format) {
        return fmt::format("does not support {} with {} samples", nameOf(format),
                           static_cast<int>(key.samples));
    };
    for (const VkFormat format : key.colors)
        if (!draws(format, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT)) return words(format);
    if (key.depth != VK_FORMAT_UNDEFINED && !draws(key.depth, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT))
        return words(key.depth);
    return {};
}

std::vector<CompiledShader> DeviceCompiler::State::shadersOf(
    VkPipeline pipeline, std::span<const ShaderModule* const> modules) const {
    const VkPipelineInfoKHR of{VK_STRUCTURE_TYPE_PIPELINE_INFO_KHR, nullptr, pipeline};
    std::uint32_t count = 0;
    checkResult(properties(device.get(), &of, &count, nullptr), "vkGetPipelineExecutablePropertiesKHR");
    VkPipelineExecutablePropertiesKHR one{};
    one.sType = VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_PROPERTIES_KHR;
    std::vector<VkPipelineExecutablePropertiesKHR> executables(count, one);
    checkResult(properties(device.get(), &of, &count, executables.data()),
                "vkGetPipelineExecutablePropertiesKHR");
    std::vector<CompiledShader> shaders;
    for (std::uint32_t i = 0; i < count; ++i) {
        CompiledShader shader;
        // The fragment shader is the last module of a draw; other executables belong to the first.
        const bool last = (executables[i].stages & VK_SHADER_STAGE_FRAGMENT_BIT) != 0;
        shader.name = (last ? modules.back() : modules.front())->name;
        shader.subgroup_size = executables[i].subgroupSize;
        const VkPipelineExecutableInfoKHR which{VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_INFO_KHR, nullptr,
                                                pipeline, i};
        std::uint32_t said = 0;
        checkResult(statistics(device.get(), &which, &said, nullptr), "vkGetPipelineExecutableStatisticsKHR");
        VkPipelineExecutableStatisticKHR empty{};
        empty.sType = VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_STATISTIC_KHR;
        std::vector<VkPipelineExecutableStatisticKHR> all(said, empty);
        checkResult(statistics(device.get(), &which, &said, all.data()),
                    "vkGetPipelineExecutableStatisticsKHR");
        for (const VkPipelineExecutableStatisticKHR& statistic : all)
            shader.statistics.push_back({statistic.name, numberOf(statistic)});
        shader.cost = costOf(shader.statistics);
        shaders.push_back(std::move(shader));
    }
    return shaders;
}

CompiledPipeline DeviceCompiler::State::compile(const PipelineRequest& request) const {
    CompiledPipeline compiled;
    const CreationContext context = this->context(layouts.at(request.layout));
    try {
        if (request.kernel != nullptr) {
            // RADV divides by zero if not even one workgroup fits.
            const SpecializationValue value = valueOf(request.kernel_variant);
            const std::uint64_t shared = sharedBytes(specialized(request.kernel->words, value));
            if (shared > support.limits().maxComputeSharedMemorySize) {
                compiled.error = fmt::format("needs {} bytes of shared memory; the device has {}", shared,
                                             support.limits().maxComputeSharedMemorySize);
                return compiled;
            }
            compiled.shaders =
                shadersOf(makePipeline(context, *request.kernel, value), std::array{request.kernel});
        } else {
            if (compiled.error = lackedFormats(request.key); !compiled.error.empty()) return compiled;
            const PipelineParts parts = request.choose(request.key);
            std::vector<const ShaderModule*> modules{parts.vertex};
            if (parts.fragment != nullptr) modules.push_back(parts.fragment);
            compiled.shaders = shadersOf(makePipeline(context, request.key, parts), modules);
        }
    } catch (const std::runtime_error& failed) {
        compiled.error = fmt::format("does not compile: {}", failed.what());
    }
    return compiled;
}

}  // namespace diptych
