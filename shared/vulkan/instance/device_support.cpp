// SPDX-License-Identifier: MIT
#include "shared/vulkan/instance/device_support.h"

#include "shared/vulkan/spirv/spirv_ops.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace diptych {

namespace {

struct FormatRow {
    VkFormat format;
    const char* name;
    std::uint32_t uses, left;  // uses by this program; those that Vulkan does not guarantee
    const char* helps;
};

std::span<const FormatRow> formatRows() {
    using namespace format_use;
#define DIPTYCH_FORMAT_ROW(name, promised, left, helps) \
    FormatRow{VK_FORMAT_##name, #name, (promised) | (left), left, helps},
    static constexpr std::array rows{DEVICE_FORMATS(DIPTYCH_FORMAT_ROW)};
#undef DIPTYCH_FORMAT_ROW
    return rows;
}

std::optional<std::size_t> rowOf(VkFormat format) {
    const auto rows = formatRows();
    const auto found = std::ranges::find(rows, format, &FormatRow::format);
    if (found == rows.end()) return std::nullopt;
    return static_cast<std::size_t>(found - rows.begin());
}

// Text for: a format that lacks these uses cannot be ...
std::string wordsOf(std::uint32_t uses) {
    std::string words;
    const auto add = [&](std::uint32_t use, const char* word) {
        if ((uses & use) != 0) words += fmt::format("{}{}", words.empty() ? "" : " or ", word);
    };
#define DIPTYCH_USE_WORDS(name, features, bit, word) add(format_use::name, word);
    DEVICE_FORMAT_USES(DIPTYCH_USE_WORDS)
#undef DIPTYCH_USE_WORDS
    add(format_use::multisampled, "used with 4 samples per pixel");
    return words;
}

const char* wordsOf(DeviceFeature feature) {
#define DIPTYCH_FEATURE_WORDS(version, name, need, what) what,
    static constexpr std::array words{DEVICE_FEATURES(DIPTYCH_FEATURE_WORDS)};
#undef DIPTYCH_FEATURE_WORDS
    return words[static_cast<std::size_t>(feature)];
}

}  // namespace

FeatureChain::FeatureChain() {
    v13.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES;
    v12.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
    v11.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_FEATURES;
    all.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
    v12.pNext = &v13;
    v11.pNext = &v12;
    all.pNext = &v11;
}

std::string nameOf(VkFormat format) {
    const auto row = rowOf(format);
    return row ? formatRows()[*row].name : fmt::format("format {}", static_cast<int>(format));
}

DeviceSupport::DeviceSupport(VkPhysicalDevice device) : device_(device) {
    VkPhysicalDeviceMaintenance4Properties buffers{};
    buffers.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_4_PROPERTIES;
    VkPhysicalDeviceDriverProperties driver{};
    driver.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES;
    subgroups_.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES;
    VkPhysicalDeviceProperties2 all{};
    all.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
    all.pNext = &driver;
    driver.pNext = &subgroups_;
    vkGetPhysicalDeviceProperties(device, &properties_);
    // Structs and formats of Vulkan 1.3 are unknown to older devices, which are not usable.
    const bool known = properties_.apiVersion >= VK_API_VERSION_1_3;
    if (known) subgroups_.pNext = &buffers;
    vkGetPhysicalDeviceProperties2(device, &all);
    subgroups_.pNext = nullptr;
    max_bytes_of_buffer_ = buffers.maxBufferSize;
    driver_ = fmt::format("{} {}", driver.driverName, driver.driverInfo);
    vkGetPhysicalDeviceMemoryProperties(device, &memory_);

    std::uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
    constexpr VkQueueFlags wanted = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
    for (std::uint32_t i = 0; i < count && !graphics_family_; ++i)
        if ((families[i].queueFlags & wanted) == wanted) {
            graphics_family_ = i;
            timestamp_bits_ = families[i].timestampValidBits;
        }

    vkEnumerateDeviceExtensionProperties(device, nullptr, &count, nullptr);
    std::vector<VkExtensionProperties> extensions(count);
    vkEnumerateDeviceExtensionProperties(device, nullptr, &count, extensions.data());
    for (const VkExtensionProperties& extension : extensions)
        extensions_.emplace_back(extension.extensionName);

    if (!known) return;
    askFeatures();
    askFormats();
}

void DeviceSupport::askFeatures() {
    FeatureChain there;
    vkGetPhysicalDeviceFeatures2(device_, &there.all);
#define DIPTYCH_ASK_FEATURE(version, name, need, what) \
    features_[static_cast<std::size_t>(DeviceFeature::name)] = there.version.name == VK_TRUE;
    DEVICE_FEATURES(DIPTYCH_ASK_FEATURE)
#undef DIPTYCH_ASK_FEATURE
    descriptor_indexing_ = there.v12.shaderSampledImageArrayNonUniformIndexing == VK_TRUE &&
                           there.v12.runtimeDescriptorArray == VK_TRUE;
    multiview_ = there.v11.multiview == VK_TRUE;
    anisotropy_ = there.v10.samplerAnisotropy == VK_TRUE;
}

void DeviceSupport::askFormats() {
    for (std::size_t row = 0; row < formats_.size(); ++row) {
        const FormatRow& asked = formatRows()[row];
        VkFormatProperties3 there{};
        there.sType = VK_STRUCTURE_TYPE_FORMAT_PROPERTIES_3;
        VkFormatProperties2 all{};
        all.sType = VK_STRUCTURE_TYPE_FORMAT_PROPERTIES_2;
        all.pNext = &there;
        vkGetPhysicalDeviceFormatProperties2(device_, asked.format, &all);
        std::uint32_t& uses = formats_[row];
#define DIPTYCH_ASK_USE(name, features, bit, word) \
    if ((there.features & VK_FORMAT_FEATURE_2_##bit) != 0) uses |= format_use::name;
        DEVICE_FORMAT_USES(DIPTYCH_ASK_USE)
#undef DIPTYCH_ASK_USE
        const VkImageUsageFlags usage =
            VK_IMAGE_USAGE_SAMPLED_BIT |
            ((asked.uses & format_use::depth) != 0 ? VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT
                                                   : VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT);
        if ((asked.uses & format_use::multisampled) != 0 &&
            (sampleCounts(asked.format, usage) & VK_SAMPLE_COUNT_4_BIT) != 0)
            uses |= format_use::multisampled;
    }
}

void DeviceSupport::limitTo(const VkPhysicalDeviceLimits& other) {
    for (std::uint32_t VkPhysicalDeviceLimits::*max :
         {&VkPhysicalDeviceLimits::maxImageDimension2D, &VkPhysicalDeviceLimits::maxTexelBufferElements,
          &VkPhysicalDeviceLimits::maxStorageBufferRange})
        properties_.limits.*max = std::min(properties_.limits.*max, other.*max);
}

bool DeviceSupport::hasExtension(std::string_view name) const {
    return std::ranges::find(extensions_, name) != extensions_.end();
}

bool DeviceSupport::sortsFragments() const {
    return has(DeviceFeature::fragmentStoresAndAtomics) && has(DeviceFeature::shaderInt64) &&
           has(DeviceFeature::geometryShader) && has(DeviceFeature::shaderBufferInt64Atomics);
}

bool DeviceSupport::storesSamples() const {
    return has(DeviceFeature::fragmentStoresAndAtomics) && has(DeviceFeature::shaderStorageImageMultisample);
}

bool DeviceSupport::can(VkFormat format, std::uint32_t uses) const {
    const auto row = rowOf(format);
    const std::uint32_t listed = row ? formatRows()[*row].uses : 0;
    if ((uses & ~listed) != 0)
        throw std::logic_error(fmt::format("DEVICE_FORMATS does not list this use: {} {}", nameOf(format),
                                           wordsOf(uses & ~listed)));
    return !row || (formats_[*row] & uses) == uses;
}

std::optional<std::string> DeviceSupport::lacks(VkFormat format, std::uint32_t uses) const {
    if (can(format, uses)) return std::nullopt;
    const std::size_t row = *rowOf(format);
    const FormatRow& asked = formatRows()[row];
    const std::uint32_t missing = uses & ~formats_[row];
    const std::string helps = (missing & ~asked.left) == 0 ? asked.helps : "";
    return fmt::format("{} cannot be {}; {}choose another device with --device", nameOf(format),
                       wordsOf(missing), helps.empty() ? "" : helps + ", or ");
}

VkImageFormatProperties DeviceSupport::images(VkFormat format, VkImageUsageFlags usage) const {
    VkImageFormatProperties properties{};
    const VkResult found = vkGetPhysicalDeviceImageFormatProperties(
        device_, format, VK_IMAGE_TYPE_2D, VK_IMAGE_TILING_OPTIMAL, usage, 0, &properties);
    return found == VK_SUCCESS ? properties : VkImageFormatProperties{};
}

std::uint32_t DeviceSupport::maxPixels() const {
    return std::min(
        {limits().maxImageDimension2D, limits().maxFramebufferWidth, limits().maxFramebufferHeight});
}

std::vector<VkDeviceSize> DeviceSupport::bytesLeft() const {
    std::vector<VkDeviceSize> left;
    if (!hasExtension(VK_EXT_MEMORY_BUDGET_EXTENSION_NAME)) return left;
    VkPhysicalDeviceMemoryBudgetPropertiesEXT budgets{};
    budgets.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MEMORY_BUDGET_PROPERTIES_EXT;
    VkPhysicalDeviceMemoryProperties2 all{};
    all.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MEMORY_PROPERTIES_2;
    all.pNext = &budgets;
    vkGetPhysicalDeviceMemoryProperties2(device_, &all);
    for (std::uint32_t heap = 0; heap < all.memoryProperties.memoryHeapCount; ++heap)
        left.push_back(budgets.heapBudget[heap] -
                       std::min(budgets.heapUsage[heap], budgets.heapBudget[heap]));
    return left;
}

std::optional<std::string> moduleProblem(const DeviceSupport& device, std::span<const std::uint32_t> words) {
    // SPIR-V 1.6, "Capability". Capabilities without a feature are part of Vulkan 1.3 or covered by
    // subgroup queries.
    struct Capability {
        std::uint32_t number;
        std::optional<DeviceFeature> feature;
    };
    using enum DeviceFeature;
    static constexpr std::array known{
        Capability{1, {}},  // Shader
        Capability{2, geometryShader},
        Capability{9, shaderFloat16},
        Capability{11, shaderInt64},
        Capability{12, shaderBufferInt64Atomics},
        Capability{27, shaderStorageImageMultisample},
        Capability{35, sampleRateShading},
        Capability{46, {}},                 // SampledBuffer
        Capability{50, {}},                 // ImageQuery
        Capability{51, {}},                 // DerivativeControl
        Capability{52, sampleRateShading},  // InterpolationFunction
        Capability{56, {}},  // StorageImageWriteWithoutFormat: per format, format_use::stored_unnamed
        Capability{61, {}},
        Capability{63, {}},
        Capability{64, {}},  // GroupNonUniform, -Arithmetic, -Ballot
        Capability{5347, bufferDeviceAddress},
        Capability{5379, shaderDemoteToHelperInvocation}};
    for (std::size_t at = spirv::headerWords; at < words.size(); at += 2) {
        if (spirv::opOf(words.subspan(at)) != spirv::OpCapability) break;
        const auto found = std::ranges::find(known, words[at + 1], &Capability::number);
        if (found == known.end())
            throw std::logic_error(fmt::format(
                "a module has capability {}, which DEVICE_FEATURES does not contain", words[at + 1]));
        if (found->feature && !device.has(*found->feature))
            return fmt::format("a shader needs {}", wordsOf(*found->feature));
    }
    return std::nullopt;
}

}  // namespace diptych
