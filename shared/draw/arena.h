// SPDX-License-Identifier: MIT
// Arrays of any types in one buffer that shaders read by address.
#pragma once

#include "shared/vulkan/device/resources.h"

#include <cstddef>
#include <cstring>
#include <span>
#include <string>
#include <vector>

namespace diptych {

class Arena {
public:
    // Returns the offset of the array in bytes.
    template <class T>
    std::size_t add(std::span<const T> values) {
        const std::size_t at = (bytes_.size() + alignment - 1) / alignment * alignment;
        bytes_.resize(at + values.size_bytes());
        if (!values.empty()) std::memcpy(bytes_.data() + at, values.data(), values.size_bytes());
        return at;
    }
    template <class T>
    std::size_t add(const std::vector<T>& values) {
        return add(std::span<const T>(values));
    }
    std::size_t size() const { return bytes_.size(); }
    // Overwrites the bytes at `at`.
    template <class T>
    void put(std::size_t at, const T& value) {
        std::memcpy(bytes_.data() + at, &value, sizeof value);
    }
    void upload(Uploader& uploader, const GpuBuffer& buffer) const {
        if (!bytes_.empty()) uploader.buffer(buffer, bytes_);
    }
    // Buffer of the size of all added arrays, for upload().
    GpuBuffer makeBuffer(Device& device, const std::string& name) const {
        return {device, name, bytes_.size(),
                VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT};
    }

private:
    static constexpr std::size_t alignment = 16;
    std::vector<std::byte> bytes_;
};

}  // namespace diptych
