// SPDX-License-Identifier: MIT
// Saves finished parts of a long rendering to a file, so that an interrupted program can resume.
#pragma once

#include "shared/image/temporary.h"

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <mutex>
#include <span>
#include <vector>

namespace diptych::reference {

// Records of floats, each with an index and a checksum. Complete records stay usable however the program
// ends. Thread-safe.
class Checkpoint {
public:
    struct Record {
        std::uint64_t index;
        std::vector<float> values;
    };

    // The file's name is STEM-HASH; HASH is the first half of `key` in hexadecimal digits, so each image
    // has its own file. The file is locked while the Checkpoint lives. If another program holds the lock,
    // others may write the file, or it belongs to another image, it is left unchanged and the name becomes
    // STEM-HASH-2, then -3. Records in other files of the same image are used too. Files whose programs have
    // ended are merged into this one and removed. `floats`: number of floats in a record. Throws
    // std::runtime_error naming the file if it cannot be written. On a file system without locks, two
    // programs may share a file.
    Checkpoint(const std::filesystem::path& stem, std::uint64_t key, std::size_t floats);
    ~Checkpoint();  // the file remains
    Checkpoint(const Checkpoint&) = delete;
    Checkpoint& operator=(const Checkpoint&) = delete;

    const std::filesystem::path& file() const { return file_; }

    // The records found at the start, each index once.
    std::vector<Record> takeEarlier() { return std::move(earlier_); }

    void keep(std::uint64_t index,
              std::span<const float> values);  // a record shorter than `floats` is padded with 0

    // Removes the file and stops saving records: the image has been written elsewhere.
    void remove();

private:
    struct Head;
    bool open(const Head& head);
    void merge(const std::filesystem::path& stem, const Head& head);

    OpenFolder folder_;
    std::filesystem::path file_;  // in it
    std::size_t floats_;
    std::FILE* stream_ = nullptr;
    std::mutex mutex_;
    std::vector<Record> earlier_;
};

// Checkpoint files of this stem, for any image, that no program is writing: left by interrupted commands.
// Sorted by name.
std::vector<std::filesystem::path> abandonedCheckpoints(const std::filesystem::path& stem);

}  // namespace diptych::reference
