// SPDX-License-Identifier: MIT
// Vulkan layer that hides one capability of every device, named by DIPTYCH_HIDE (hidden.h); empty: none.
// It is below the validation layer, which then reports every use of the hidden capability.
#include "tests/tool/layer/hidden.h"

#include <vulkan/vk_layer.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <map>
#include <mutex>

namespace {

namespace format_use = diptych::format_use;

const std::string& hidden() {
    static const std::string named = [] {
        const char* const value = std::getenv("DIPTYCH_HIDE");
        return std::string(value != nullptr ? value : "");
    }();
    return named;
}

bool hides(const std::string& name) {
    return hidden() == name;
}

// The lowered limit: the given number, or `min`.
std::uint32_t lowered(const std::string& limit, std::uint32_t there, std::uint32_t min) {
    if (!hidden().starts_with(limit)) return there;
    const std::string number = hidden().substr(limit.size());
    if (number.empty()) return std::min(there, min);
    return number[0] == ' ' ? static_cast<std::uint32_t>(std::stoul(number)) : there;
}

// The hidden uses of a format, a sum of format_use.
std::uint32_t hiddenUses(VkFormat format) {
    const char* name = "";
#define NAME(row, promised, left, helps) \
    if (format == VK_FORMAT_##row) name = #row;
    DEVICE_FORMATS(NAME)
#undef NAME
    std::uint32_t uses = 0;
    const auto add = [&](const char* use, std::uint32_t bit) {
        if (hides(std::string("format ") + name + " " + use)) uses |= bit;
    };
#define USE(use, features, bit, word) add(#use, format_use::use);
    DEVICE_FORMAT_USES(USE)
#undef USE
    add("multisampled", format_use::multisampled);
    return uses;
}

// ---- the layer below ---------------------------------------------------------------------------------

#define HOOKED(X)                                \
    X(vkGetPhysicalDeviceFeatures)               \
    X(vkGetPhysicalDeviceFeatures2)              \
    X(vkGetPhysicalDeviceProperties)             \
    X(vkGetPhysicalDeviceProperties2)            \
    X(vkGetPhysicalDeviceFormatProperties)       \
    X(vkGetPhysicalDeviceFormatProperties2)      \
    X(vkGetPhysicalDeviceImageFormatProperties)  \
    X(vkGetPhysicalDeviceImageFormatProperties2) \
    X(vkEnumerateDeviceExtensionProperties)

// One table for every instance: the loader's functions.
struct Next {
    PFN_vkGetInstanceProcAddr vkGetInstanceProcAddr = nullptr;
#define POINTER(name) PFN_##name name = nullptr;
    HOOKED(POINTER)
#undef POINTER
} next;

std::mutex devicesMutex;
std::map<VkDevice, PFN_vkGetDeviceProcAddr> devices;

template <class Info>
Info* linkOf(const void* chain, VkStructureType type) {
    auto* link = static_cast<VkBaseOutStructure*>(const_cast<void*>(chain));
    while (link != nullptr &&
           (link->sType != type || reinterpret_cast<Info*>(link)->function != VK_LAYER_LINK_INFO))
        link = link->pNext;
    return reinterpret_cast<Info*>(link);
}

VKAPI_ATTR VkResult VKAPI_CALL createInstance(const VkInstanceCreateInfo* info,
                                              const VkAllocationCallbacks* allocator, VkInstance* instance) {
    auto* const link =
        linkOf<VkLayerInstanceCreateInfo>(info->pNext, VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO);
    if (link == nullptr) return VK_ERROR_INITIALIZATION_FAILED;
    next.vkGetInstanceProcAddr = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
    link->u.pLayerInfo = link->u.pLayerInfo->pNext;
    const auto create = reinterpret_cast<PFN_vkCreateInstance>(
        next.vkGetInstanceProcAddr(VK_NULL_HANDLE, "vkCreateInstance"));
    const VkResult result = create(info, allocator, instance);
    if (result != VK_SUCCESS) return result;
#define LOAD(name) next.name = reinterpret_cast<PFN_##name>(next.vkGetInstanceProcAddr(*instance, #name));
    HOOKED(LOAD)
#undef LOAD
    return VK_SUCCESS;
}

VKAPI_ATTR VkResult VKAPI_CALL createDevice(VkPhysicalDevice physical, const VkDeviceCreateInfo* info,
                                            const VkAllocationCallbacks* allocator, VkDevice* device) {
    auto* const link =
        linkOf<VkLayerDeviceCreateInfo>(info->pNext, VK_STRUCTURE_TYPE_LOADER_DEVICE_CREATE_INFO);
    if (link == nullptr) return VK_ERROR_INITIALIZATION_FAILED;
    const PFN_vkGetInstanceProcAddr instanceFunction = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
    const PFN_vkGetDeviceProcAddr deviceFunction = link->u.pLayerInfo->pfnNextGetDeviceProcAddr;
    link->u.pLayerInfo = link->u.pLayerInfo->pNext;
    const auto create =
        reinterpret_cast<PFN_vkCreateDevice>(instanceFunction(VK_NULL_HANDLE, "vkCreateDevice"));
    const VkResult result = create(physical, info, allocator, device);
    if (result != VK_SUCCESS) return result;
    const std::scoped_lock lock(devicesMutex);
    devices[*device] = deviceFunction;
    return VK_SUCCESS;
}

// ---- hiding ------------------------------------------------------------------------------------------

void hideFeatures(VkPhysicalDeviceFeatures& v10) {
    VkPhysicalDeviceVulkan12Features v12{};
    VkPhysicalDeviceVulkan13Features v13{};
#define HIDE(version, name, need, what) \
    if (hides("feature " #name)) version.name = VK_FALSE;
    DEVICE_FEATURES(HIDE)
    static_cast<void>(v12), static_cast<void>(v13);
}
void hideFeatures(VkPhysicalDeviceVulkan12Features& v12) {
    VkPhysicalDeviceFeatures v10{};
    VkPhysicalDeviceVulkan13Features v13{};
    DEVICE_FEATURES(HIDE)
    static_cast<void>(v10), static_cast<void>(v13);
}
void hideFeatures(VkPhysicalDeviceVulkan13Features& v13) {
    VkPhysicalDeviceFeatures v10{};
    VkPhysicalDeviceVulkan12Features v12{};
    DEVICE_FEATURES(HIDE)
    static_cast<void>(v10), static_cast<void>(v12);
#undef HIDE
}

VKAPI_ATTR void VKAPI_CALL getFeatures(VkPhysicalDevice device, VkPhysicalDeviceFeatures* features) {
    next.vkGetPhysicalDeviceFeatures(device, features);
    hideFeatures(*features);
}

VKAPI_ATTR void VKAPI_CALL getFeatures2(VkPhysicalDevice device, VkPhysicalDeviceFeatures2* features) {
    next.vkGetPhysicalDeviceFeatures2(device, features);
    hideFeatures(features->features);
    for (auto* link = static_cast<VkBaseOutStructure*>(features->pNext); link != nullptr;
         link = link->pNext) {
        if (link->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES)
            hideFeatures(*reinterpret_cast<VkPhysicalDeviceVulkan12Features*>(link));
        if (link->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES)
            hideFeatures(*reinterpret_cast<VkPhysicalDeviceVulkan13Features*>(link));
    }
}

void lowerLimits(VkPhysicalDeviceLimits& limits) {
#define LOWER(name, min, needed, what) limits.name = lowered("limit " #name, limits.name, min);
    DEVICE_LIMITS(LOWER)
#undef LOWER
}

VKAPI_ATTR void VKAPI_CALL getProperties(VkPhysicalDevice device, VkPhysicalDeviceProperties* properties) {
    next.vkGetPhysicalDeviceProperties(device, properties);
    lowerLimits(properties->limits);
}

VKAPI_ATTR void VKAPI_CALL getProperties2(VkPhysicalDevice device, VkPhysicalDeviceProperties2* properties) {
    next.vkGetPhysicalDeviceProperties2(device, properties);
    lowerLimits(properties->properties.limits);
}

// `linear`, `optimal`, `buffer`: flags of VkFormatProperties or of VkFormatProperties3.
template <class Properties>
void hideUses(std::uint32_t uses, Properties& properties) {
    VkFormatFeatureFlags2 optimalTilingFeatures = 0, bufferFeatures = 0;
#define HIDE_USE(use, features, bit, word) \
    if ((uses & format_use::use) != 0) features |= VK_FORMAT_FEATURE_2_##bit;
    DEVICE_FORMAT_USES(HIDE_USE)
#undef HIDE_USE
    using Flags = decltype(properties.bufferFeatures);
    properties.linearTilingFeatures &= static_cast<Flags>(~optimalTilingFeatures);
    properties.optimalTilingFeatures &= static_cast<Flags>(~optimalTilingFeatures);
    properties.bufferFeatures &= static_cast<Flags>(~bufferFeatures);
}

VKAPI_ATTR void VKAPI_CALL getFormat(VkPhysicalDevice device, VkFormat format,
                                     VkFormatProperties* properties) {
    next.vkGetPhysicalDeviceFormatProperties(device, format, properties);
    hideUses(hiddenUses(format), *properties);
}

VKAPI_ATTR void VKAPI_CALL getFormat2(VkPhysicalDevice device, VkFormat format,
                                      VkFormatProperties2* properties) {
    next.vkGetPhysicalDeviceFormatProperties2(device, format, properties);
    const std::uint32_t uses = hiddenUses(format);
    hideUses(uses, properties->formatProperties);
    for (auto* link = static_cast<VkBaseOutStructure*>(properties->pNext); link != nullptr;
         link = link->pNext)
        if (link->sType == VK_STRUCTURE_TYPE_FORMAT_PROPERTIES_3)
            hideUses(uses, *reinterpret_cast<VkFormatProperties3*>(link));
}

VkResult hideImages(VkFormat format, VkImageUsageFlags usage, VkImageFormatProperties& properties) {
    const std::uint32_t uses = hiddenUses(format);
    const auto lacks = [&](VkImageUsageFlags bit, std::uint32_t use) {
        return (usage & bit) != 0 && (uses & use) != 0;
    };
    if (lacks(VK_IMAGE_USAGE_SAMPLED_BIT, format_use::sampled) ||
        lacks(VK_IMAGE_USAGE_STORAGE_BIT, format_use::stored) ||
        lacks(VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT, format_use::drawn) ||
        lacks(VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, format_use::depth)) {
        properties = {};
        return VK_ERROR_FORMAT_NOT_SUPPORTED;
    }
    if ((uses & format_use::multisampled) != 0) properties.sampleCounts &= VK_SAMPLE_COUNT_1_BIT;
    VkPhysicalDeviceLimits limits{};
    limits.maxImageDimension2D = properties.maxExtent.width;
    limits.maxImageArrayLayers = properties.maxArrayLayers;
    lowerLimits(limits);
    properties.maxExtent.width = std::min(properties.maxExtent.width, limits.maxImageDimension2D);
    properties.maxExtent.height = std::min(properties.maxExtent.height, limits.maxImageDimension2D);
    properties.maxArrayLayers = limits.maxImageArrayLayers;
    return VK_SUCCESS;
}

VKAPI_ATTR VkResult VKAPI_CALL getImages(VkPhysicalDevice device, VkFormat format, VkImageType type,
                                         VkImageTiling tiling, VkImageUsageFlags usage,
                                         VkImageCreateFlags flags, VkImageFormatProperties* properties) {
    const VkResult result =
        next.vkGetPhysicalDeviceImageFormatProperties(device, format, type, tiling, usage, flags, properties);
    return result == VK_SUCCESS ? hideImages(format, usage, *properties) : result;
}

VKAPI_ATTR VkResult VKAPI_CALL getImages2(VkPhysicalDevice device,
                                          const VkPhysicalDeviceImageFormatInfo2* info,
                                          VkImageFormatProperties2* properties) {
    const VkResult result = next.vkGetPhysicalDeviceImageFormatProperties2(device, info, properties);
    return result == VK_SUCCESS ? hideImages(info->format, info->usage, properties->imageFormatProperties)
                                : result;
}

VKAPI_ATTR VkResult VKAPI_CALL listExtensions(VkPhysicalDevice device, const char* layer,
                                              std::uint32_t* count, VkExtensionProperties* list) {
    if (layer != nullptr && std::strcmp(layer, "VK_LAYER_DIPTYCH_hide") == 0) {
        *count = 0;
        return VK_SUCCESS;
    }
    std::uint32_t there = 0;
    VkResult result = next.vkEnumerateDeviceExtensionProperties(device, layer, &there, nullptr);
    if (result != VK_SUCCESS) return result;
    std::vector<VkExtensionProperties> all(there);
    result = next.vkEnumerateDeviceExtensionProperties(device, layer, &there, all.data());
    if (result != VK_SUCCESS) return result;
    std::erase_if(all, [](const VkExtensionProperties& extension) {
        return hides(std::string("extension ") + extension.extensionName);
    });
    const auto found = static_cast<std::uint32_t>(all.size());
    if (list == nullptr) {
        *count = found;
        return VK_SUCCESS;
    }
    *count = std::min(*count, found);
    std::copy_n(all.begin(), *count, list);
    return *count < found ? VK_INCOMPLETE : VK_SUCCESS;
}

// ---- the loader's entry points -----------------------------------------------------------------------

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL deviceFunction(VkDevice device, const char* name) {
    if (std::strcmp(name, "vkGetDeviceProcAddr") == 0)
        return reinterpret_cast<PFN_vkVoidFunction>(&deviceFunction);
    const std::scoped_lock lock(devicesMutex);
    return devices.at(device)(device, name);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL instanceFunction(VkInstance instance, const char* name) {
    const std::pair<const char*, PFN_vkVoidFunction> own[] = {
        {"vkGetInstanceProcAddr", reinterpret_cast<PFN_vkVoidFunction>(&instanceFunction)},
        {"vkGetDeviceProcAddr", reinterpret_cast<PFN_vkVoidFunction>(&deviceFunction)},
        {"vkCreateInstance", reinterpret_cast<PFN_vkVoidFunction>(&createInstance)},
        {"vkCreateDevice", reinterpret_cast<PFN_vkVoidFunction>(&createDevice)},
        {"vkGetPhysicalDeviceFeatures", reinterpret_cast<PFN_vkVoidFunction>(&getFeatures)},
        {"vkGetPhysicalDeviceFeatures2", reinterpret_cast<PFN_vkVoidFunction>(&getFeatures2)},
        {"vkGetPhysicalDeviceProperties", reinterpret_cast<PFN_vkVoidFunction>(&getProperties)},
        {"vkGetPhysicalDeviceProperties2", reinterpret_cast<PFN_vkVoidFunction>(&getProperties2)},
        {"vkGetPhysicalDeviceFormatProperties", reinterpret_cast<PFN_vkVoidFunction>(&getFormat)},
        {"vkGetPhysicalDeviceFormatProperties2", reinterpret_cast<PFN_vkVoidFunction>(&getFormat2)},
        {"vkGetPhysicalDeviceImageFormatProperties", reinterpret_cast<PFN_vkVoidFunction>(&getImages)},
        {"vkGetPhysicalDeviceImageFormatProperties2", reinterpret_cast<PFN_vkVoidFunction>(&getImages2)},
        {"vkEnumerateDeviceExtensionProperties", reinterpret_cast<PFN_vkVoidFunction>(&listExtensions)}};
    for (const auto& [known, function] : own)
        if (std::strcmp(name, known) == 0) return function;
    return instance == VK_NULL_HANDLE ? nullptr : next.vkGetInstanceProcAddr(instance, name);
}

}  // namespace

extern "C" __attribute__((visibility("default"))) VKAPI_ATTR VkResult VKAPI_CALL
vkNegotiateLoaderLayerInterfaceVersion(VkNegotiateLayerInterface* version) {
    version->loaderLayerInterfaceVersion = std::min(version->loaderLayerInterfaceVersion, 2u);
    version->pfnGetInstanceProcAddr = &instanceFunction;
    version->pfnGetDeviceProcAddr = &deviceFunction;
    version->pfnGetPhysicalDeviceProcAddr = nullptr;
    return VK_SUCCESS;
}
