// SPDX-License-Identifier: MIT
#include "shared/vulkan/instance/physical_device.h"

#include "shared/contract/bindings.h"
#include "shared/contract/features.h"
#include "shared/contract/gbuffer.h"
#include "shared/contract/light_list.h"
#include "shared/contract/material.h"
#include "shared/vulkan/instance/check.h"
#include "shared/vulkan/instance/driver_files.h"
#include "shared/vulkan/spirv/binding_table.h"

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

std::string mebibytes(std::uint64_t bytes) {
    return fmt::format("{} MiB", bytes >> 20);
}

// Largest number of descriptors of these types that one shader stage sees. Set layouts expose every
// binding to every stage. A pipeline uses the sets of draws, or those of light list building.
constexpr std::uint32_t descriptors(std::initializer_list<VkDescriptorType> kinds) {
    constexpr auto frame = bindingTypes({FRAME_BINDINGS(DIPTYCH_BINDING_ROW)});
    constexpr auto sums = bindingTypes({PARTIAL_SUM_BINDINGS(DIPTYCH_BINDING_ROW)});
    constexpr auto gbuffer = bindingTypes({GBUFFER_SET_BINDINGS(DIPTYCH_BINDING_ROW)});
    constexpr auto lists = bindingTypes({LIST_BINDINGS(DIPTYCH_BINDING_ROW)});
    const auto count = [&](std::span<const VkDescriptorType> types) {
        std::uint32_t found = 0;
        for (const VkDescriptorType type : types) found += std::ranges::find(kinds, type) != kinds.end();
        return found;
    };
    // A material's textures are in no table.
    const bool images = std::ranges::find(kinds, binding_kind::image) != kinds.end();
    const std::uint32_t drawing =
        count(frame) + count(gbuffer) + count(sums) + (images ? gpu::SLOT_COUNT : 0);
    return std::max(drawing, count(frame) + count(lists));
}

// In SET_FRAME alone.
constexpr std::uint32_t frameDescriptors(VkDescriptorType kind) {
    constexpr auto frame = bindingTypes({FRAME_BINDINGS(DIPTYCH_BINDING_ROW)});
    return static_cast<std::uint32_t>(std::ranges::count(frame, kind));
}

// Formats that only some Settings need.
void noteFormats(std::vector<DeviceProperty>& list, const DeviceSupport& device) {
    const auto note = [&](const char* what, VkFormat format, std::uint32_t uses) {
        list.push_back({what, device.can(format, uses), false, nameOf(format)});
    };
    note("blending of 32-bit floats", VK_FORMAT_R32G32B32A32_SFLOAT, format_use::blended);
    note("filtering of 32-bit floats", VK_FORMAT_R32G32B32A32_SFLOAT, format_use::filtered);
    note("filtering of 16-bit textures", VK_FORMAT_R16G16B16A16_UNORM, format_use::filtered);
    note("24-bit depth", VK_FORMAT_X8_D24_UNORM_PACK32, format_use::depth | format_use::sampled);
    note("packed-float colour attachments", VK_FORMAT_B10G11R11_UFLOAT_PACK32, format_use::drawn);
    note("4 samples per pixel, also in a G-buffer", VK_FORMAT_R32G32_UINT, format_use::multisampled);
}

std::vector<DeviceProperty> propertiesOf(const DeviceSupport& device) {
    const VkPhysicalDeviceProperties& properties = device.properties();
    const VkPhysicalDeviceLimits& l = device.limits();
    const bool cpu = properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU;
    const auto range = [](std::uint32_t bytes) { return bytes == ~0u ? "4 GiB" : mebibytes(bytes); };
    std::vector<DeviceProperty> list;
    const auto need = [&](const char* what, bool there, std::string note = "") {
        list.push_back({what, there, true, std::move(note)});
    };
    const auto note = [&](const char* what, bool there, std::string text = "") {
        list.push_back({what, there, false, std::move(text)});
    };

    need("queue with graphics and compute", device.graphicsFamily().has_value());
    need(memoryProperty, device.memory().memoryTypeCount > 0);
    enum Need { required, optional };
    const auto feature = [&](DeviceFeature name, Need how, const char* what) {
        list.push_back({what, device.has(name), how == required, ""});
    };
    const auto limit = [&](std::uint32_t there, std::uint32_t min, std::uint32_t needed, const char* what) {
        if (needed > min) need(what, there >= needed, fmt::format("{}, {} needed", there, needed));
    };
    using namespace binding_kind;
#define DIPTYCH_FEATURE_PROPERTY(version, name, how, what) feature(DeviceFeature::name, how, what);
    DEVICE_FEATURES(DIPTYCH_FEATURE_PROPERTY)
#undef DIPTYCH_FEATURE_PROPERTY
#define DIPTYCH_LIMIT_PROPERTY(name, min, needed, what) limit(l.name, min, needed, what);
    DEVICE_LIMITS(DIPTYCH_LIMIT_PROPERTY)
#undef DIPTYCH_LIMIT_PROPERTY
    need("subgroup arithmetic in compute shaders",
         device.hasSubgroups(VK_SHADER_STAGE_COMPUTE_BIT, VK_SUBGROUP_FEATURE_ARITHMETIC_BIT));
    need("32-bit depth", device.can(VK_FORMAT_D32_SFLOAT, format_use::depth | format_use::sampled));
    noteFormats(list, device);
    note("image size", true, fmt::format("up to {} x {}", device.maxPixels(), device.maxPixels()));
    note("storage buffers", true, "up to " + range(l.maxStorageBufferRange));
    note("uniform buffers", true, fmt::format("up to {} KiB", l.maxUniformBufferRange >> 10));
    note("texel buffers", true, fmt::format("up to {} texels", l.maxTexelBufferElements));
#define DIPTYCH_EXTENSION_PROPERTY(name, what) note(what, device.hasExtension(#name));
    DEVICE_EXTENSIONS(DIPTYCH_EXTENSION_PROPERTY)
#undef DIPTYCH_EXTENSION_PROPERTY
    note("descriptor indexing", device.hasDescriptorIndexing(),
         "not used: every material has its own descriptor set");
    note("multiview", !cpu && device.hasMultiview(),
         cpu && device.hasMultiview()
             ? "reported, but lavapipe puts triangles that cross the edge into layer 0"
             : "");
    note("timestamps per pass", !cpu && l.timestampComputeAndGraphics == VK_TRUE,
         cpu ? "execution is deferred: passes are timed by submit, fence and CPU clock" : "");
    note("branches save work", !cpu,
         cpu ? "both sides execute: shader variants are specialised instead" : "");
    note("anisotropic filtering", device.hasAnisotropy(),
         "not used, so that filtering is the same on every device");
    return list;
}

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

void requireUsable(const DeviceInfo& info) {
    for (const DeviceProperty& property : info.properties)
        if (property.required && !property.there)
            throw std::runtime_error(fmt::format("device {} ({}) lacks {}{}; choose another with --device",
                                                 info.index, info.name, property.what,
                                                 property.note.empty() ? "" : " (" + property.note + ")"));
}

}  // namespace

bool DeviceInfo::usable() const {
    return std::all_of(properties.begin(), properties.end(),
                       [](const DeviceProperty& f) { return f.there || !f.required; });
}

DeviceInfo describe(const DeviceSupport& device, int index) {
    const VkPhysicalDeviceProperties& p = device.properties();
    DeviceInfo info;
    info.index = index;
    info.name = p.deviceName;
    info.driver = device.driver();
    info.type = typeName(p.deviceType);
    info.api_version = fmt::format("{}.{}.{}", VK_API_VERSION_MAJOR(p.apiVersion),
                                   VK_API_VERSION_MINOR(p.apiVersion), VK_API_VERSION_PATCH(p.apiVersion));
    info.properties = propertiesOf(device);
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
            fmt::format("no Vulkan device found; {}",
                        driverFilesFault().value_or(
                            "install mesa-vulkan-drivers, which contains the software device lavapipe")));
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

VkDevice createDevice(const DeviceSupport& device, bool statistics) {
    FeatureChain wanted;
#define DIPTYCH_WANT_FEATURE(version, name, need, what) \
    wanted.version.name = device.has(DeviceFeature::name) ? VK_TRUE : VK_FALSE;
    DEVICE_FEATURES(DIPTYCH_WANT_FEATURE)
#undef DIPTYCH_WANT_FEATURE
    std::vector<const char*> extensions;
#define DIPTYCH_WANT_EXTENSION(name, what) \
    if (device.hasExtension(#name)) extensions.push_back(#name);
    DEVICE_EXTENSIONS(DIPTYCH_WANT_EXTENSION)
#undef DIPTYCH_WANT_EXTENSION
    VkPhysicalDevicePipelineExecutablePropertiesFeaturesKHR compiled{};
    compiled.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PIPELINE_EXECUTABLE_PROPERTIES_FEATURES_KHR;
    compiled.pipelineExecutableInfo = VK_TRUE;
    if (statistics) {
        extensions.push_back(VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME);
        wanted.v13.pNext = &compiled;
    }
    const float priority = 1.0f;
    const VkDeviceQueueCreateInfo queue{.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                        .pNext = nullptr,
                                        .flags = 0,
                                        .queueFamilyIndex = device.graphicsFamily().value(),
                                        .queueCount = 1,
                                        .pQueuePriorities = &priority};
    const VkDeviceCreateInfo info{.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                  .pNext = &wanted.all,
                                  .flags = 0,
                                  .queueCreateInfoCount = 1,
                                  .pQueueCreateInfos = &queue,
                                  .enabledLayerCount = 0,
                                  .ppEnabledLayerNames = nullptr,
                                  .enabledExtensionCount = static_cast<std::uint32_t>(extensions.size()),
                                  .ppEnabledExtensionNames = extensions.data(),
                                  .pEnabledFeatures = nullptr};
    VkDevice made = VK_NULL_HANDLE;
    checkResult(vkCreateDevice(device.handle(), &info, nullptr, &made), "vkCreateDevice");
    return made;
}

}  // namespace diptych
