// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace diptych::reference {

// A hash of everything that affects an image (64-bit FNV-1a; Fowler, Noll and Vo 1991). Saved parts are
// reused only if their key matches.
class Key {
public:
    void add(std::span<const std::byte> bytes) {
        for (const std::byte byte : bytes)
            value_ = (value_ ^ static_cast<std::uint64_t>(byte)) * 0x100000001b3u;
    }
    template <class T>
    void add(const T& value) {
        add(std::as_bytes(std::span(&value, 1)));
    }
    template <class T, class Allocator>
    void addAll(const std::vector<T, Allocator>& values) {
        add(values.size());
        add(std::as_bytes(std::span(values)));
    }
    std::uint64_t value() const { return value_; }

private:
    std::uint64_t value_ = 0xcbf29ce484222325u;
};

}  // namespace diptych::reference
