// SPDX-License-Identifier: MIT
// What is done of a long picture, kept in a file as it is done.
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <mutex>
#include <span>
#include <vector>

namespace diptych::reference {

// Records of floats, numbered, each with a checksum: however the program ends, what is whole in the file
// counts. From any thread.
class Checkpoint {
public:
    // Nothing is kept where `file` is empty. What it holds of another key or size is overwritten. Throws
    // std::runtime_error naming the file where it cannot be written.
    Checkpoint(std::filesystem::path file, std::uint64_t key, std::size_t floats);
    ~Checkpoint();
    Checkpoint(const Checkpoint&) = delete;
    Checkpoint& operator=(const Checkpoint&) = delete;

    struct Record {
        std::uint64_t number;
        std::vector<float> values;
    };
    std::vector<Record> takeEarlier() { return std::move(earlier_); }

    void keep(std::uint64_t number,
              std::span<const float> values);  // fewer than `floats` are filled up with 0

private:
    std::filesystem::path file_;
    std::size_t floats_;
    std::FILE* stream_ = nullptr;
    std::mutex mutex_;
    std::vector<Record> earlier_;
};

}  // namespace diptych::reference
