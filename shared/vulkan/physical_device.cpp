// SPDX-License-Identifier: MIT
#include "shared/vulkan/physical_device.h"

#include "shared/contract/bindings.h"
#include "shared/contract/features.h"
#include "shared/contract/gbuffer.h"
#include "shared/contract/light_list.h"
#include "shared/contract/material.h"
#include "shared/contract/samples.h"
#include "shared/contract/transparency.h"
#include "shared/vulkan/binding_table.h"
#include "shared/vulkan/check.h"
#include "shared/vulkan/driver_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <initializer_list>
#include <span>
#include <stdexcept>

namespace diptych {

namespace {

struct Features {
    VkPhysicalDeviceVulkan13Features v13{};
    VkPhysicalDeviceVulkan12Features v12{};
    VkPhysicalDeviceVulkan11Features v11{};
    VkPhysicalDeviceFeatures2 v10{};

    Features() {
        v13.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES;
        v12.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
        v11.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_FEATURES;
        v10.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
        v12.pNext = &v13;
        v11.pNext = &v12;
        v10.pNext = &v11;
    }
    Features(const Features&) = delete;
    Features& operator=(const Features&) = delete;
};

std::string typeName(VkPhysicalDeviceType type) {
    switch (type) {
        case VK_PHYSICAL_DEVICE_TYPE_CPU:
            return "cpu";
        case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
            return "discrete";
        case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
            return "integrated";
        case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
            return "virtual";
        default:
            return "other";
    }
}

bool knowsExtension(VkPhysicalDevice device, std::string_view name) {
    std::uint32_t count = 0;
    vkEnumerateDeviceExtensionProperties(device, nullptr, &count, nullptr);
    std::vector<VkExtensionProperties> extensions(count);
    vkEnumerateDeviceExtensionProperties(device, nullptr, &count, extensions.data());
    return std::ranges::any_of(
        extensions, [&](const VkExtensionProperties& extension) { return name == extension.extensionName; });
}

bool hasMemory(VkPhysicalDevice device) {
    VkPhysicalDeviceMemoryProperties memory;
    vkGetPhysicalDeviceMemoryProperties(device, &memory);
    return memory.memoryTypeCount > 0;
}

std::string mebibytes(std::uint64_t bytes) {
    return fmt::format("{} MiB", bytes >> 20);
}

// Properties with one more struct, whose sType is set.
template <class More>
VkPhysicalDeviceProperties propertiesWith(VkPhysicalDevice device, More& more) {
    VkPhysicalDeviceProperties2 all{};
    all.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
    all.pNext = &more;
    vkGetPhysicalDeviceProperties2(device, &all);
    return all.properties;
}

bool reducesSubgroups(VkPhysicalDevice device) {
    VkPhysicalDeviceSubgroupProperties subgroup{};
    subgroup.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES;
    propertiesWith(device, subgroup);
    return (subgroup.supportedStages & VK_SHADER_STAGE_COMPUTE_BIT) != 0 &&
           (subgroup.supportedOperations & VK_SUBGROUP_FEATURE_ARITHMETIC_BIT) != 0;
}

// How many descriptors of some kinds one shader stage sees: set layouts name every binding for every stage,
// and a pipeline has the sets of drawing or those of the kernels that make light lists.
constexpr std::uint32_t descriptors(std::initializer_list<VkDescriptorType> kinds) {
    constexpr auto frame = bindingTypes({FRAME_BINDINGS(DIPTYCH_BINDING_ROW)});
    constexpr auto sums = bindingTypes({PARTIAL_SUM_BINDINGS(DIPTYCH_BINDING_ROW)});
    constexpr auto gbuffer = bindingTypes(
        {GBUFFER_BINDINGS(DIPTYCH_BINDING_ROW) BindingRow{gpu::BINDING_DEPTH, "DEPTH", binding_kind::image},
         TRANSPARENCY_BINDINGS(DIPTYCH_BINDING_ROW) SAMPLE_BINDINGS(DIPTYCH_BINDING_ROW)});
    constexpr auto lists = bindingTypes({LIST_BINDINGS(DIPTYCH_BINDING_ROW)});
    const auto count = [&](std::span<const VkDescriptorType> types) {
        std::uint32_t found = 0;
        for (const VkDescriptorType type : types) found += std::ranges::find(kinds, type) != kinds.end();
        return found;
    };
    // A material's textures stand in no table.
    const bool images = std::ranges::find(kinds, binding_kind::image) != kinds.end();
    const std::uint32_t drawing =
        count(frame) + count(gbuffer) + count(sums) + (images ? gpu::SLOT_COUNT : 0);
    return std::max(drawing, count(frame) + count(lists));
}

std::vector<DeviceFact> facts(VkPhysicalDevice device, const VkPhysicalDeviceProperties& properties) {
    Features f;
    if (properties.apiVersion >= VK_API_VERSION_1_3)
        vkGetPhysicalDeviceFeatures2(device, &f.v10);  // below 1.3 the chained structs are unknown
    const VkPhysicalDeviceLimits& l = properties.limits;
    const bool cpu = properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU;
    const auto range = [](std::uint32_t bytes) { return bytes == ~0u ? "4 GiB" : mebibytes(bytes); };
    std::vector<DeviceFact> list;
    const auto need = [&](const char* what, bool there, std::string note = "") {
        list.push_back({what, there, true, std::move(note)});
    };
    const auto note = [&](const char* what, bool there, std::string text = "") {
        list.push_back({what, there, false, std::move(text)});
    };

    need("a queue that draws and computes", graphicsFamily(device).has_value());
    need(memoryFact, hasMemory(device));
    need("dynamic rendering", f.v13.dynamicRendering == VK_TRUE);
    need("synchronization2", f.v13.synchronization2 == VK_TRUE);
    need("maintenance4", f.v13.maintenance4 == VK_TRUE);
    need("demotion to helper invocations", f.v13.shaderDemoteToHelperInvocation == VK_TRUE);
    need("scalar block layout", f.v12.scalarBlockLayout == VK_TRUE);
    need("shading of samples", f.v10.features.sampleRateShading == VK_TRUE);
    need("32-bit indices", f.v10.features.fullDrawIndexUint32 == VK_TRUE);
    need("workgroups of 256 threads", l.maxComputeWorkGroupInvocations >= gpu::LIST_GROUP,
         fmt::format("{} at most", l.maxComputeWorkGroupInvocations));
    const auto needDescriptors = [&](const char* what, std::uint32_t there,
                                     std::initializer_list<VkDescriptorType> kinds) {
        const std::uint32_t needed = descriptors(kinds);
        need(what, there >= needed, fmt::format("{}, {} needed", there, needed));
    };
    using namespace binding_kind;
    needDescriptors("storage buffers a shader", l.maxPerStageDescriptorStorageBuffers, {storage_buffer});
    needDescriptors("samplers a shader", l.maxPerStageDescriptorSamplers, {image});
    // A texel buffer counts as a sampled image.
    needDescriptors("sampled images a shader", l.maxPerStageDescriptorSampledImages, {image, texel_buffer});
    need("subgroup arithmetic in compute shaders", reducesSubgroups(device));
    need("colour attachments", l.maxColorAttachments >= gpu::CAPTURE_ATTACHMENTS,
         fmt::format("{}, {} needed", l.maxColorAttachments, gpu::CAPTURE_ATTACHMENTS));
    note("picture size", true, fmt::format("up to {} x {}", l.maxImageDimension2D, l.maxImageDimension2D));
    note("storage buffers", true, "up to " + range(l.maxStorageBufferRange));
    note("uniform buffers", true, fmt::format("up to {} KiB", l.maxUniformBufferRange >> 10));
    note("memory budgets", knowsMemoryBudget(device));
    note("depth clamping", f.v10.features.depthClamp == VK_TRUE);
    note("blending by attachment", f.v10.features.independentBlend == VK_TRUE);
    note("indirect draws of later instances", f.v10.features.drawIndirectFirstInstance == VK_TRUE);
    note("several indirect draws at once", f.v10.features.multiDrawIndirect == VK_TRUE);
    note("stores in fragment shaders", f.v10.features.fragmentStoresAndAtomics == VK_TRUE);
    note("stores to samples", f.v10.features.shaderStorageImageMultisample == VK_TRUE);
    note("64-bit atomics in fragment shaders",
         properties.apiVersion >= VK_API_VERSION_1_3 && sortsFragments(device));
    note("4 samples a pixel",
         (l.framebufferColorSampleCounts & l.framebufferDepthSampleCounts & VK_SAMPLE_COUNT_4_BIT) != 0);
    note(
        "descriptor indexing",
        f.v12.shaderSampledImageArrayNonUniformIndexing == VK_TRUE && f.v12.runtimeDescriptorArray == VK_TRUE,
        "bindless textures; here every material has a descriptor set instead");
    note("multiview", !cpu && f.v11.multiview == VK_TRUE,
         cpu && f.v11.multiview == VK_TRUE
             ? "offered, but on lavapipe triangles across the edge land in layer 0"
             : "");
    note("time stamps a pass", !cpu && l.timestampComputeAndGraphics == VK_TRUE,
         cpu ? "work runs late: passes are timed by submit, fence and clock" : "");
    note("branches skip work", !cpu, cpu ? "both sides run: variants are specialised instead" : "");
    note("anisotropic filtering", f.v10.features.samplerAnisotropy == VK_TRUE,
         "not used: mip levels alone, the same on every device");
    return list;
}

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

void requireUsable(const DeviceInfo& info) {
    for (const DeviceFact& fact : info.facts)
        if (fact.required && !fact.there)
            throw std::runtime_error(fmt::format("device {} ({}) lacks {}{}; choose another with --device",
                                                 info.index, info.name, fact.what,
                                                 fact.note.empty() ? "" : " (" + fact.note + ")"));
}

}  // namespace

bool DeviceInfo::usable() const {
    return std::all_of(facts.begin(), facts.end(),
                       [](const DeviceFact& f) { return f.there || !f.required; });
}

std::optional<std::uint32_t> graphicsFamily(VkPhysicalDevice device) {
    std::uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
    constexpr VkQueueFlags wanted = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
    for (std::uint32_t i = 0; i < count; ++i)
        if ((families[i].queueFlags & wanted) == wanted) return i;
    return std::nullopt;
}

DeviceInfo describe(VkPhysicalDevice device, int index) {
    VkPhysicalDeviceDriverProperties driver{};
    driver.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES;
    const VkPhysicalDeviceProperties p = propertiesWith(device, driver);
    DeviceInfo info;
    info.index = index;
    info.name = p.deviceName;
    info.driver = fmt::format("{} {}", driver.driverName, driver.driverInfo);
    info.type = typeName(p.deviceType);
    info.api_version = fmt::format("{}.{}.{}", VK_API_VERSION_MAJOR(p.apiVersion),
                                   VK_API_VERSION_MINOR(p.apiVersion), VK_API_VERSION_PATCH(p.apiVersion));
    info.facts = facts(device, p);
    return info;
}

std::string listOf(const std::vector<DeviceInfo>& infos) {
    std::string text;
    for (const DeviceInfo& info : infos)
        text += fmt::format("{}{}: {}", text.empty() ? "" : ", ", info.index, info.name);
    return text.empty() ? "none" : text;
}

std::optional<std::size_t> findDevice(const std::vector<DeviceInfo>& infos, const std::string& choice) {
    int number = -1;
    const auto [end, error] = std::from_chars(choice.data(), choice.data() + choice.size(), number);
    const bool isNumber = error == std::errc{} && end == choice.data() + choice.size();
    for (std::size_t i = 0; i < infos.size(); ++i)
        if (isNumber ? infos[i].index == number
                     : lower(infos[i].name).find(lower(choice)) != std::string::npos)
            return i;
    return std::nullopt;
}

std::size_t chooseDevice(const std::vector<DeviceInfo>& infos, const std::string& choice) {
    if (infos.empty())
        throw std::runtime_error(
            fmt::format("no Vulkan device; {}",
                        driverFilesFault().value_or(
                            "install mesa-vulkan-drivers, which brings the software device lavapipe")));
    if (choice.empty()) {
        constexpr std::array order{"discrete", "integrated", "virtual", "cpu", "other"};
        for (const char* type : order)
            for (std::size_t i = 0; i < infos.size(); ++i)
                if (infos[i].type == type && infos[i].usable()) return i;
        requireUsable(infos.front());
    }
    if (const auto found = findDevice(infos, choice)) {
        requireUsable(infos[*found]);
        return *found;
    }
    throw std::runtime_error(fmt::format("--device {}: no such device; there are {}", choice, listOf(infos)));
}

bool knowsMemoryBudget(VkPhysicalDevice device) {
    return knowsExtension(device, VK_EXT_MEMORY_BUDGET_EXTENSION_NAME);
}
bool saysStatistics(VkPhysicalDevice device) {
    return knowsExtension(device, VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME);
}

bool sortsFragments(VkPhysicalDevice device) {
    Features f;
    vkGetPhysicalDeviceFeatures2(device, &f.v10);
    const VkPhysicalDeviceFeatures& core = f.v10.features;
    return core.fragmentStoresAndAtomics == VK_TRUE && core.shaderInt64 == VK_TRUE &&
           core.geometryShader == VK_TRUE && f.v12.shaderBufferInt64Atomics == VK_TRUE;
}

bool storesSamples(VkPhysicalDevice device) {
    VkPhysicalDeviceFeatures there{};
    vkGetPhysicalDeviceFeatures(device, &there);
    return there.fragmentStoresAndAtomics == VK_TRUE && there.shaderStorageImageMultisample == VK_TRUE;
}

bool hasInt64(VkPhysicalDevice device) {
    VkPhysicalDeviceFeatures there{};
    vkGetPhysicalDeviceFeatures(device, &there);
    return there.shaderInt64 == VK_TRUE;
}

bool hasFloat16(VkPhysicalDevice device) {
    Features f;
    vkGetPhysicalDeviceFeatures2(device, &f.v10);
    return f.v12.shaderFloat16 == VK_TRUE;
}

bool beginsAtAnyInstance(VkPhysicalDevice device) {
    VkPhysicalDeviceFeatures there{};
    vkGetPhysicalDeviceFeatures(device, &there);
    return there.drawIndirectFirstInstance == VK_TRUE;
}

VkDevice createDevice(VkPhysicalDevice physical, std::uint32_t family, bool statistics) {
    Features wanted;
    wanted.v13.dynamicRendering = VK_TRUE;
    wanted.v13.synchronization2 = VK_TRUE;
    wanted.v13.maintenance4 = VK_TRUE;                    // a workgroup's size by a constant
    wanted.v13.shaderDemoteToHelperInvocation = VK_TRUE;  // holes of alpha masks
    wanted.v12.scalarBlockLayout = VK_TRUE;
    wanted.v12.bufferDeviceAddress = VK_TRUE;  // of Vulkan 1.3: every device has it
    wanted.v10.features.fullDrawIndexUint32 = VK_TRUE;
    wanted.v10.features.sampleRateShading = VK_TRUE;  // and what is interpolated at an offset
    VkPhysicalDeviceFeatures there{};
    vkGetPhysicalDeviceFeatures(physical, &there);
    wanted.v10.features.occlusionQueryPrecise = there.occlusionQueryPrecise;
    wanted.v10.features.pipelineStatisticsQuery = there.pipelineStatisticsQuery;
    wanted.v10.features.depthClamp = there.depthClamp;
    wanted.v10.features.independentBlend = there.independentBlend;
    wanted.v10.features.drawIndirectFirstInstance = there.drawIndirectFirstInstance;
    wanted.v10.features.multiDrawIndirect = there.multiDrawIndirect;
    wanted.v10.features.fragmentStoresAndAtomics = there.fragmentStoresAndAtomics;
    wanted.v10.features.shaderStorageImageMultisample = there.shaderStorageImageMultisample;
    wanted.v10.features.shaderInt64 = there.shaderInt64;
    if (sortsFragments(physical)) {
        wanted.v10.features.geometryShader = VK_TRUE;  // gl_PrimitiveID in fragment shaders
        wanted.v12.shaderBufferInt64Atomics = VK_TRUE;
    }
    wanted.v12.shaderFloat16 = hasFloat16(physical) ? VK_TRUE : VK_FALSE;
    const float priority = 1.0f;
    const VkDeviceQueueCreateInfo queue{.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                        .pNext = nullptr,
                                        .flags = 0,
                                        .queueFamilyIndex = family,
                                        .queueCount = 1,
                                        .pQueuePriorities = &priority};
    std::vector<const char*> extensions;
    if (knowsMemoryBudget(physical)) extensions.push_back(VK_EXT_MEMORY_BUDGET_EXTENSION_NAME);
    VkPhysicalDevicePipelineExecutablePropertiesFeaturesKHR compiled{};
    compiled.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PIPELINE_EXECUTABLE_PROPERTIES_FEATURES_KHR;
    compiled.pipelineExecutableInfo = VK_TRUE;
    if (statistics) {
        extensions.push_back(VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME);
        wanted.v13.pNext = &compiled;
    }
    const VkDeviceCreateInfo info{.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                  .pNext = &wanted.v10,
                                  .flags = 0,
                                  .queueCreateInfoCount = 1,
                                  .pQueueCreateInfos = &queue,
                                  .enabledLayerCount = 0,
                                  .ppEnabledLayerNames = nullptr,
                                  .enabledExtensionCount = static_cast<std::uint32_t>(extensions.size()),
                                  .ppEnabledExtensionNames = extensions.data(),
                                  .pEnabledFeatures = nullptr};
    VkDevice device = VK_NULL_HANDLE;
    checkResult(vkCreateDevice(physical, &info, nullptr, &device), "vkCreateDevice");
    return device;
}

}  // namespace diptych
