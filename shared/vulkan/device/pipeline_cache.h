// SPDX-License-Identifier: MIT
// Stores the driver's compiled pipelines in the user's cache folder between runs. It only saves time:
// without a folder, or with an unusable file, everything is compiled again.
#pragma once

#include <vulkan/vulkan.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace diptych {

// Owner of a cache file: a driver can use only its own cache, and it should contain only this program's
// pipelines.
struct PipelineCacheKey {
    std::array<std::uint8_t, VK_UUID_SIZE> driver{};  // pipelineCacheUUID
    std::uint64_t program = 0;                        // hash of all embedded modules
    std::uint32_t vendor = 0, device = 0, driver_version = 0, api_version = 0;
    bool operator==(const PipelineCacheKey&) const = default;
};

// One file per device and driver. Caches of other builds of the program are overwritten.
std::filesystem::path pipelineCacheFile(const std::filesystem::path& folder, const PipelineCacheKey& key);

// Data stored under this key; empty if the file is missing, damaged, has another key or belongs to another
// user (see openCacheFile()).
std::vector<std::byte> readPipelineCache(const std::filesystem::path& file, const PipelineCacheKey& key);

// Creates the folder, writes a temporary file and renames it, so the cache is replaced atomically. Returns
// whether it succeeded.
bool writePipelineCache(const std::filesystem::path& file, const PipelineCacheKey& key,
                        std::span<const std::byte> data);

// A device's pipeline cache: loaded from `folder`, and stored there on destruction. Empty folder: not
// stored.
class PipelineCache {
public:
    PipelineCache(const VkPhysicalDeviceProperties& properties, VkDevice device,
                  const std::filesystem::path& folder);
    ~PipelineCache();
    PipelineCache(const PipelineCache&) = delete;
    PipelineCache& operator=(const PipelineCache&) = delete;

    VkPipelineCache handle() const { return cache_; }  // null if the driver does not support one

private:
    void keep() const;

    VkDevice device_;
    std::filesystem::path file_;
    PipelineCacheKey key_;
    std::vector<std::byte> begun_with_;
    VkPipelineCache cache_ = VK_NULL_HANDLE;
};

}  // namespace diptych
