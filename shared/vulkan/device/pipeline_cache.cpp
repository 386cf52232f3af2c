// SPDX-License-Identifier: MIT
#include "shared/vulkan/device/pipeline_cache.h"

#include "shared/text/input_file.h"
#include "shared/vulkan/instance/user_cache.h"
#include "shared/vulkan/spirv/spirv.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <cstring>
#include <exception>
#include <string>
#include <system_error>
#include <type_traits>

namespace diptych {
namespace {

namespace fs = std::filesystem;

// 64-bit FNV-1a (Fowler, Noll and Vo 1991), over bytes or words.
class CacheHash {
public:
    template <class T>
    void add(std::span<const T> values) {
        for (const T value : values) value_ = (value_ ^ static_cast<std::uint64_t>(value)) * 0x100000001b3u;
    }
    std::uint64_t value() const { return value_; }

private:
    std::uint64_t value_ = 0xcbf29ce484222325u;
};

std::uint64_t hashOf(std::span<const std::byte> data) {
    CacheHash hash;
    hash.add(data);
    return hash.value();
}

std::uint64_t hashOfProgram() {
    CacheHash hash;
    for (const ShaderModule& module : shaderModules()) hash.add(module.words);
    return hash.value();
}

// File header.
struct CacheFileHead {
    std::array<char, 8> magic{'d', 'i', 'p', 't', 'y', 'c', 'h', '1'};
    PipelineCacheKey key;
    std::uint64_t bytes = 0, hash = 0;  // of the data, which follow
};
static_assert(std::has_unique_object_representations_v<CacheFileHead>);  // no padding: every byte is
                                                                         // initialized

// Larger than any driver's cache for one device.
constexpr std::uint64_t maxCacheBytes = std::uint64_t{1} << 30;

// Size without pipelines: the header that Vulkan requires (VkPipelineCacheHeaderVersionOne).
constexpr std::size_t emptyCacheBytes = sizeof(VkPipelineCacheHeaderVersionOne);

}  // namespace

fs::path pipelineCacheFile(const fs::path& folder, const PipelineCacheKey& key) {
    CacheHash hash;
    hash.add(std::span<const std::uint8_t>(key.driver));
    hash.add(std::span<const std::uint32_t>(
        std::array{key.vendor, key.device, key.driver_version, key.api_version}));
    return folder / fmt::format("pipelines-{:016x}", hash.value());
}

std::vector<std::byte> readPipelineCache(const fs::path& file, const PipelineCacheKey& key) {
    const CacheFile opened = openCacheFile(file);
    std::FILE* const stream = opened.stream.get();
    CacheFileHead head;
    if (!stream || std::fread(&head, sizeof head, 1, stream) != 1) return {};
    if (head.magic != CacheFileHead{}.magic || head.key != key || head.bytes > maxCacheBytes ||
        opened.bytes != sizeof head + head.bytes)
        return {};
    std::vector<std::byte> data(head.bytes);
    if (std::fread(data.data(), 1, data.size(), stream) != data.size() || hashOf(data) != head.hash)
        return {};
    return data;
}

bool writePipelineCache(const fs::path& file, const PipelineCacheKey& key, std::span<const std::byte> data) {
    const OpenFolder folder = makeCacheFolder(file.parent_path());
    const std::string name = file.filename(), beside = fmt::format("{}.{}.tmp", name, ::getpid());
    CacheFileHead head;
    head.key = key;
    head.bytes = data.size();
    head.hash = hashOf(data);
    folder.removeFile(beside);  // left by a process with the same id
    std::FILE* const stream = folder.create(beside);
    if (!stream) return false;
    cacheForUser(stream);
    const bool written = std::fwrite(&head, sizeof head, 1, stream) == 1 &&
                         std::fwrite(data.data(), 1, data.size(), stream) == data.size();
    const bool closed = std::fclose(stream) == 0;
    if (written && closed && folder.move(beside, folder, name) == 0) return true;
    folder.removeFile(beside);
    return false;
}

PipelineCache::PipelineCache(const VkPhysicalDeviceProperties& properties, VkDevice device,
                             const fs::path& folder)
    : device_(device) {
    if (!folder.empty()) {
        std::memcpy(key_.driver.data(), properties.pipelineCacheUUID, VK_UUID_SIZE);
        key_.vendor = properties.vendorID;
        key_.device = properties.deviceID;
        key_.driver_version = properties.driverVersion;
        key_.api_version = properties.apiVersion;
        file_ = pipelineCacheFile(folder, key_);
        // Hashing all modules takes milliseconds, and is wasted if the driver stores nothing.
        if (std::error_code failed; fs::exists(file_, failed)) {
            key_.program = hashOfProgram();
            begun_with_ = readPipelineCache(file_, key_);
        }
    }
    const VkPipelineCacheCreateInfo info{.sType = VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO,
                                         .pNext = nullptr,
                                         .flags = 0,
                                         .initialDataSize = begun_with_.size(),
                                         .pInitialData = begun_with_.data()};
    if (vkCreatePipelineCache(device_, &info, nullptr, &cache_) != VK_SUCCESS) cache_ = VK_NULL_HANDLE;
}

PipelineCache::~PipelineCache() {
    if (cache_ == VK_NULL_HANDLE) return;
    try {
        keep();
    } catch (const std::exception&) {  // out of memory: it is compiled again
    }
    vkDestroyPipelineCache(device_, cache_, nullptr);
}

void PipelineCache::keep() const {
    if (file_.empty()) return;
    std::size_t size = 0;
    if (vkGetPipelineCacheData(device_, cache_, &size, nullptr) != VK_SUCCESS || size <= emptyCacheBytes)
        return;
    std::vector<std::byte> data(size);
    if (vkGetPipelineCacheData(device_, cache_, &size, data.data()) != VK_SUCCESS) return;
    data.resize(size);
    if (data == begun_with_) return;
    PipelineCacheKey key = key_;
    key.program = hashOfProgram();
    writePipelineCache(file_, key, data);
}

}  // namespace diptych
