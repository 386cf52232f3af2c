// SPDX-License-Identifier: MIT
// All optional parts of Vulkan that this program uses: features, format uses, limits, extensions. Each is
// a row of a table here. DeviceSupport queries it once; no other code queries Vulkan (unit.Conventions).
// tool.HiddenSupport masks each row (tests/tool/layer).
#pragma once

#include <vulkan/vulkan_core.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace diptych {

// version  feature  need  description
//   need   required: the device is not usable without it; optional: enabled if supported
// clang-format off
#define DEVICE_FEATURES(X)                                                                      \
    X(v13, dynamicRendering,               required, "dynamic rendering")                       \
    X(v13, synchronization2,               required, "synchronization2")                        \
    X(v13, maintenance4,                   required, "maintenance4") /* a workgroup's size by a constant */ \
    X(v13, shaderDemoteToHelperInvocation, required, "demote to helper invocation") /* alpha masks */ \
    X(v12, scalarBlockLayout,              required, "scalar block layout")                     \
    X(v12, bufferDeviceAddress,            required, "buffer device addresses")                 \
    X(v10, sampleRateShading,              required, "sample shading")                          \
    X(v10, fullDrawIndexUint32,            required, "32-bit indices")                          \
    X(v10, occlusionQueryPrecise,          optional, "precise occlusion queries")               \
    X(v10, pipelineStatisticsQuery,        optional, "pipeline statistics")                     \
    X(v10, independentBlend,               optional, "independent blending")                    \
    X(v10, drawIndirectFirstInstance,      optional, "indirect draws with a first instance")    \
    X(v10, multiDrawIndirect,              optional, "multi-draw indirect")                     \
    X(v10, fragmentStoresAndAtomics,       optional, "stores and atomics in fragment shaders")  \
    X(v10, shaderStorageImageMultisample,  optional, "multisampled storage images")             \
    X(v10, shaderInt64,                    optional, "64-bit integers in shaders")              \
    X(v10, geometryShader,                 optional, "triangle indices in fragment shaders")    \
    X(v12, shaderBufferInt64Atomics,       optional, "64-bit buffer atomics")                   \
    X(v12, shaderFloat16,                  optional, "16-bit floats in shaders")

// use  of an image or a buffer  Vulkan feature bit  text: "a format without it cannot be ..."
#define DEVICE_FORMAT_USES(X)                                                                          \
    X(sampled,        optimalTilingFeatures, SAMPLED_IMAGE_BIT,               "sampled in shaders")    \
    X(filtered,       optimalTilingFeatures, SAMPLED_IMAGE_FILTER_LINEAR_BIT, "filtered linearly")     \
    X(stored,         optimalTilingFeatures, STORAGE_IMAGE_BIT,               "used as a storage image") \
    X(stored_unnamed, optimalTilingFeatures, STORAGE_WRITE_WITHOUT_FORMAT_BIT,                         \
                                                   "used as a storage image without a format in the shader") \
    X(drawn,          optimalTilingFeatures, COLOR_ATTACHMENT_BIT,            "used as a colour attachment") \
    X(blended,        optimalTilingFeatures, COLOR_ATTACHMENT_BLEND_BIT,      "blended")               \
    X(depth,          optimalTilingFeatures, DEPTH_STENCIL_ATTACHMENT_BIT,    "used as a depth attachment") \
    X(texels,         bufferFeatures,        UNIFORM_TEXEL_BUFFER_BIT,        "used as a texel buffer") \
    X(vertices,       bufferFeatures,        VERTEX_BUFFER_BIT,               "used as a vertex attribute")

// format  guaranteed uses  optional uses  advice if one is missing
//   Uses are those of this program. Guarantees: Vulkan 1.3, "Required Format Support". `multisampled`: an
//   attachment with 4 samples per pixel that shaders read; guaranteed for floats and depth.
#define DEVICE_FORMATS(X)                                                                             \
    X(R8G8B8A8_UNORM,           sampled | filtered | drawn, 0, "")                                    \
    X(R8G8B8A8_SRGB,            sampled | filtered, 0, "")                                            \
    X(A2B10G10R10_UNORM_PACK32, sampled | drawn, 0, "")                                               \
    X(B10G11R11_UFLOAT_PACK32,  sampled, drawn | blended, "use --lit-format fp32")                    \
    X(R16G16_SNORM,             0, sampled | drawn, "")                                               \
    X(R16G16_SFLOAT,            sampled | filtered | drawn, stored | stored_unnamed,                  \
                                                                   "use --evsm-precision fp32")       \
    X(R16G16B16A16_UNORM,       0, sampled | filtered | stored | stored_unnamed, "use --shadows evsm4") \
    X(R16G16B16A16_SFLOAT,      sampled | filtered | stored | drawn | blended | multisampled,         \
                                                                   stored_unnamed, "use --shadows pcf") \
    X(R32_UINT,                 sampled | stored | drawn | texels, multisampled, "use --msaa 1")      \
    X(R32_SFLOAT,               sampled | stored | drawn | multisampled, blended,                     \
                                                                   "use --transparency sorted")       \
    X(R32G32_UINT,              sampled | drawn, multisampled, "use --msaa 1")                        \
    X(R32G32_SFLOAT,            sampled | stored | drawn | multisampled, filtered | stored_unnamed,   \
                                                                   "use --shadows pcf")               \
    X(R32G32B32_SFLOAT,         vertices, 0, "")                                                      \
    X(R32G32B32A32_UINT,        sampled | drawn | texels, multisampled, "use --msaa 1")               \
    X(R32G32B32A32_SFLOAT,      sampled | stored | drawn | texels | vertices | multisampled,          \
                                filtered | stored_unnamed | blended,                                  \
                          "use --lit-format fp16 with --transparency sorted or list, and --shadows pcf") \
    X(D16_UNORM,                sampled | depth, 0, "")                                               \
    X(X8_D24_UNORM_PACK32,      0, sampled | depth, "use --depth-format d32f")                        \
    X(D32_SFLOAT,               sampled | multisampled, depth, "")

// limit  Vulkan's minimum  minimum for this program, from physical_device.cpp; 0: any  description
#define DEVICE_LIMITS(X)                                                                                \
    X(maxImageDimension2D, 4096, 0, "")                                                                 \
    X(maxImageArrayLayers, 256, 0, "")                                                                  \
    X(maxFramebufferWidth, 4096, 0, "")                                                                 \
    X(maxFramebufferHeight, 4096, 0, "")                                                                \
    X(maxTexelBufferElements, 65536, 0, "")                                                             \
    X(maxUniformBufferRange, 16384, 0, "")                                                              \
    X(maxStorageBufferRange, 1 << 27, 0, "")                                                            \
    X(maxPushConstantsSize, 128, 0, "")                                                                 \
    X(maxBoundDescriptorSets, 4, 0, "")                                                                 \
    X(maxPerStageDescriptorSamplers, 16, descriptors({image}), "samplers per shader")                   \
    X(maxPerStageDescriptorUniformBuffers, 12, descriptors({uniform_buffer}), "uniform buffers per shader") \
    X(maxPerStageDescriptorStorageBuffers, 4, descriptors({storage_buffer}), "storage buffers per shader") \
    /* a texel buffer counts as a sampled image */                                                      \
    X(maxPerStageDescriptorSampledImages, 16, descriptors({image, fetched_image, texel_buffer}),        \
                                                                        "sampled images per shader")    \
    X(maxPerStageDescriptorStorageImages, 4, descriptors({storage_image}), "storage images per shader") \
    X(maxVertexInputAttributes, 16, 0, "")                                                              \
    X(maxVertexInputBindings, 16, 0, "")                                                                \
    X(maxVertexOutputComponents, 64, 0, "")                                                             \
    X(maxFragmentInputComponents, 64, 0, "")                                                            \
    X(maxColorAttachments, 4, gpu::MAX_COLOR_ATTACHMENTS, "colour attachments")                         \
    X(maxFragmentOutputAttachments, 4, gpu::MAX_COLOR_ATTACHMENTS, "outputs of a fragment shader")      \
    X(maxFragmentCombinedOutputResources, 4, gpu::MAX_COLOR_ATTACHMENTS + frameDescriptors(storage_buffer), \
                                                    "outputs and storage resources of a fragment shader") \
    X(maxComputeSharedMemorySize, 16384, 0, "")                                                         \
    X(maxComputeWorkGroupInvocations, 128, gpu::LIST_GROUP, "invocations per workgroup")                \
    X(maxComputeWorkGroupSize[0], 128, gpu::LIST_GROUP, "invocations per workgroup along x")            \
    X(maxDrawIndirectCount, 1, 0, "")                                                                   \
    X(standardSampleLocations, 0, 0, "")

// extension  description
#define DEVICE_EXTENSIONS(X)                                                                            \
    X(VK_EXT_memory_budget, "memory budgets")
// clang-format on

// Uses of a format, a sum of DEVICE_FORMAT_USES.
namespace format_use {
enum : std::uint32_t {
#define DIPTYCH_FORMAT_USE(name, ...) name##_index,
    DEVICE_FORMAT_USES(DIPTYCH_FORMAT_USE)
#undef DIPTYCH_FORMAT_USE
        multisampled_index
};
enum : std::uint32_t {
#define DIPTYCH_FORMAT_USE(name, ...) name = 1u << name##_index,
    DEVICE_FORMAT_USES(DIPTYCH_FORMAT_USE)
#undef DIPTYCH_FORMAT_USE
        multisampled = 1u << multisampled_index
};
}  // namespace format_use

enum class DeviceFeature {
#define DIPTYCH_DEVICE_FEATURE(version, name, ...) name,
    DEVICE_FEATURES(DIPTYCH_DEVICE_FEATURE)
#undef DIPTYCH_DEVICE_FEATURE
};

// Vulkan's name without VK_FORMAT_; "format 78" for formats without a row.
std::string nameOf(VkFormat format);

class DeviceSupport {
public:
    DeviceSupport() = default;
    explicit DeviceSupport(VkPhysicalDevice device);

    VkPhysicalDevice handle() const { return device_; }
    const VkPhysicalDeviceProperties& properties() const { return properties_; }
    const VkPhysicalDeviceLimits& limits() const { return properties_.limits; }
    // Reduces the limits that choices depend on to those of another device.
    void limitTo(const VkPhysicalDeviceLimits& other);
    VkDeviceSize maxBytesOfBuffer() const { return max_bytes_of_buffer_; }
    const VkPhysicalDeviceMemoryProperties& memory() const { return memory_; }
    // Name and version of the driver.
    const std::string& driver() const { return driver_; }
    // First queue family with graphics and compute; valid bits of its time stamps, 0: no time stamps.
    std::optional<std::uint32_t> graphicsFamily() const { return graphics_family_; }
    std::uint32_t timestampBits() const { return timestamp_bits_; }

    bool has(DeviceFeature feature) const { return features_.at(static_cast<std::size_t>(feature)); }
    bool hasExtension(std::string_view name) const;
    // Whether all these stages support the subgroup operations.
    bool hasSubgroups(VkShaderStageFlags stages, VkSubgroupFeatureFlags operations) const {
        return (subgroups_.supportedStages & stages) == stages &&
               (subgroups_.supportedOperations & operations) == operations;
    }
    // Whether fragment shaders support 64-bit buffer atomics, stores, and the triangle's index.
    bool sortsFragments() const;
    // Whether fragment shaders can store to samples of an image.
    bool storesSamples() const;
    // Reported only: bindless textures, multiview, anisotropy.
    bool hasDescriptorIndexing() const { return descriptor_indexing_; }
    bool hasMultiview() const { return multiview_; }
    bool hasAnisotropy() const { return anisotropy_; }

    // Whether a format supports all of these uses, a sum of format_use. Throws std::logic_error if
    // DEVICE_FORMATS does not list one of them, because tests could not mask it.
    bool can(VkFormat format, std::uint32_t uses) const;
    // Text of the missing use and advice; nothing if all uses are supported.
    std::optional<std::string> lacks(VkFormat format, std::uint32_t uses) const;
    // Limits for images of a format and usage: extent, levels, layers, samples; all 0 if unsupported.
    VkImageFormatProperties images(VkFormat format, VkImageUsageFlags usage) const;
    // Supported sample counts for a format and usage, a sum of VkSampleCountFlagBits; 0 if unsupported.
    VkSampleCountFlags sampleCounts(VkFormat format, VkImageUsageFlags usage) const {
        return images(format, usage).sampleCounts;
    }
    // Largest side of an image that is drawn to.
    std::uint32_t maxPixels() const;

    // Free bytes of each heap; empty if the device does not report it.
    std::vector<VkDeviceSize> bytesLeft() const;

private:
    void askFeatures();
    void askFormats();

    VkPhysicalDevice device_ = VK_NULL_HANDLE;
    VkPhysicalDeviceProperties properties_{};
    VkPhysicalDeviceSubgroupProperties subgroups_{};
    VkPhysicalDeviceMemoryProperties memory_{};
    VkDeviceSize max_bytes_of_buffer_ = 0;
    std::string driver_;
    std::optional<std::uint32_t> graphics_family_;
    std::uint32_t timestamp_bits_ = 0;
#define DIPTYCH_ONE(...) +1
    std::array<bool, 0 DEVICE_FEATURES(DIPTYCH_ONE)> features_{};
    std::array<std::uint32_t, 0 DEVICE_FORMATS(DIPTYCH_ONE)> formats_{};  // supported uses, by row
#undef DIPTYCH_ONE
    std::vector<std::string> extensions_;
    bool descriptor_indexing_ = false, multiview_ = false, anisotropy_ = false;
};

// Feature structs that DEVICE_FEATURES names, chained from v10.
struct FeatureChain {
    VkPhysicalDeviceVulkan13Features v13{};
    VkPhysicalDeviceVulkan12Features v12{};
    VkPhysicalDeviceVulkan11Features v11{};
    VkPhysicalDeviceFeatures2 all{};
    VkPhysicalDeviceFeatures& v10 = all.features;

    FeatureChain();
    FeatureChain(const FeatureChain&) = delete;
    FeatureChain& operator=(const FeatureChain&) = delete;
};

// Name of the feature that a module's capabilities need and the device lacks; nothing if it supports the
// module. Throws std::logic_error for a capability without a row in DEVICE_FEATURES.
std::optional<std::string> moduleProblem(const DeviceSupport& device, std::span<const std::uint32_t> words);

}  // namespace diptych
