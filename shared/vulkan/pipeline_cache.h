// SPDX-License-Identifier: MIT
// What a driver has compiled, kept in the user's cache folder from one run of the program to the next. It
// only saves time: without a folder, or with a file that cannot be used or written, everything is compiled
// again.
#pragma once

#include <vulkan/vulkan.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace diptych {

// Whose a file is: a driver can use its own alone, and no other program's pipelines are asked for.
struct PipelineCacheKey {
    std::array<std::uint8_t, VK_UUID_SIZE> driver{};  // pipelineCacheUUID
    std::uint64_t program = 0;                        // a hash of all embedded modules
    std::uint32_t vendor = 0, device = 0, driver_version = 0, api_version = 0;
    bool operator==(const PipelineCacheKey&) const = default;
};

// One file for each device and driver: that of another build of the program is written over.
std::filesystem::path pipelineCacheFile(const std::filesystem::path& folder, const PipelineCacheKey& key);

// The data as they were kept under this key; empty where the file is not there, is another key's or another
// user's (openCacheFile()), or is damaged.
std::vector<std::byte> readPipelineCache(const std::filesystem::path& file, const PipelineCacheKey& key);

// Makes the folder, writes a file beside and renames it, so that the file is whole or the old one. Returns
// whether it could.
bool writePipelineCache(const std::filesystem::path& file, const PipelineCacheKey& key,
                        std::span<const std::byte> data);

// A device's cache, begun with what is kept in `folder` and kept there when it dies. Empty folder: not kept.
class PipelineCache {
public:
    PipelineCache(const VkPhysicalDeviceProperties& properties, VkDevice device,
                  const std::filesystem::path& folder);
    ~PipelineCache();
    PipelineCache(const PipelineCache&) = delete;
    PipelineCache& operator=(const PipelineCache&) = delete;

    VkPipelineCache handle() const { return cache_; }  // none where the driver makes none

private:
    void keep() const;

    VkDevice device_;
    std::filesystem::path file_;
    PipelineCacheKey key_;
    std::vector<std::byte> begun_with_;
    VkPipelineCache cache_ = VK_NULL_HANDLE;
};

}  // namespace diptych
