// SPDX-License-Identifier: MIT
#include "shared/vulkan/instance/instance.h"

#include "shared/vulkan/instance/check.h"
#include "shared/vulkan/instance/driver_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <string_view>

namespace diptych {

namespace {

constexpr const char* validationLayer = "VK_LAYER_KHRONOS_validation";

VKAPI_ATTR VkBool32 VKAPI_CALL onMessage(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                         VkDebugUtilsMessageTypeFlagsEXT types,
                                         const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
    // General messages are the loader's comments on layers and drivers.
    if ((types & ~VkDebugUtilsMessageTypeFlagsEXT{VK_DEBUG_UTILS_MESSAGE_TYPE_GENERAL_BIT_EXT}) == 0)
        return VK_FALSE;
    auto& log = *static_cast<ValidationLog*>(user);
    const std::scoped_lock lock(log.mutex);
    if (log.messages++ == 0) log.first = data->pMessage;
    return VK_FALSE;
}

bool layerThere(const char* name) {
    std::uint32_t count = 0;
    vkEnumerateInstanceLayerProperties(&count, nullptr);
    std::vector<VkLayerProperties> layers(count);
    vkEnumerateInstanceLayerProperties(&count, layers.data());
    return std::any_of(layers.begin(), layers.end(),
                       [&](const auto& l) { return std::string_view(l.layerName) == name; });
}

VkDebugUtilsMessengerCreateInfoEXT messengerInfo(ValidationLog& log) {
    return {.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT,
            .pNext = nullptr,
            .flags = 0,
            .messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT |
                               VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT,
            .messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_GENERAL_BIT_EXT |
                           VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT |
                           VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT,
            .pfnUserCallback = onMessage,
            .pUserData = &log};
}

}  // namespace

VulkanInstance::VulkanInstance(ValidationLog* log, std::span<const char* const> extensions) {
    avoidCacheOnFullDisk();
    if (log != nullptr && !layerThere(validationLayer))
        throw std::runtime_error(
            "--validate: the Khronos validation layer is missing; install vulkan-validationlayers");
    std::vector<const char*> enabled(extensions.begin(), extensions.end());
    if (log != nullptr) enabled.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    const VkApplicationInfo application{.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
                                        .pNext = nullptr,
                                        .pApplicationName = "diptych",
                                        .applicationVersion = 1,
                                        .pEngineName = "diptych",
                                        .engineVersion = 1,
                                        .apiVersion = VK_API_VERSION_1_3};
    VkInstanceCreateInfo info{.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                              .pNext = nullptr,
                              .flags = 0,
                              .pApplicationInfo = &application,
                              .enabledLayerCount = 0,
                              .ppEnabledLayerNames = nullptr,
                              .enabledExtensionCount = static_cast<std::uint32_t>(enabled.size()),
                              .ppEnabledExtensionNames = enabled.data()};
    const VkValidationFeatureEnableEXT enable = VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
    VkValidationFeaturesEXT features{.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT,
                                     .pNext = nullptr,
                                     .enabledValidationFeatureCount = 1,
                                     .pEnabledValidationFeatures = &enable,
                                     .disabledValidationFeatureCount = 0,
                                     .pDisabledValidationFeatures = nullptr};
    VkDebugUtilsMessengerCreateInfoEXT messages{};
    if (log != nullptr) {
        messages = messengerInfo(*log);
        features.pNext = &messages;
        info.pNext = &features;
        info.enabledLayerCount = 1;
        info.ppEnabledLayerNames = &validationLayer;
    }
    const VkResult result = vkCreateInstance(&info, nullptr, &handle_);
    if (result != VK_SUCCESS)
        throw std::runtime_error(fmt::format("Vulkan: cannot create an instance: {}; {}", nameOf(result),
                                             driverFilesFault().value_or("install mesa-vulkan-drivers")));
    if (log == nullptr) return;
    const auto create = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
        vkGetInstanceProcAddr(handle_, "vkCreateDebugUtilsMessengerEXT"));
    messages.pNext = nullptr;
    checkResult(create(handle_, &messages, nullptr, &messenger_), "vkCreateDebugUtilsMessengerEXT");
}

VulkanInstance::~VulkanInstance() {
    if (messenger_ != VK_NULL_HANDLE)
        reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
            vkGetInstanceProcAddr(handle_, "vkDestroyDebugUtilsMessengerEXT"))(handle_, messenger_, nullptr);
    vkDestroyInstance(handle_, nullptr);
}

std::vector<VkPhysicalDevice> VulkanInstance::devices() const {
    std::uint32_t count = 0;
    checkResult(vkEnumeratePhysicalDevices(handle_, &count, nullptr), "vkEnumeratePhysicalDevices");
    std::vector<VkPhysicalDevice> found(count);
    checkResult(vkEnumeratePhysicalDevices(handle_, &count, found.data()), "vkEnumeratePhysicalDevices");
    return found;
}

}  // namespace diptych
