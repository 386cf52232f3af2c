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
    struct Record {
        std::uint64_t number;
        std::vector<float> values;
    };

    // The file is called STEM-HASH, where HASH is the first half of `key` in hexadecimal digits: another
    // picture has another file. It is locked as long as the Checkpoint lives. Where another program holds the
    // lock, or where the file is of another picture all the same, it is left alone, and the file is
    // STEM-HASH-2, then -3. What other files of the same picture hold counts as well, whoever writes them;
    // those whose programs have ended are merged into this one and removed. `floats`: of a record. Throws
    // std::runtime_error naming the file where it cannot be written. A file system without locks has none:
    // two programs then share a file.
    Checkpoint(const std::filesystem::path& stem, std::uint64_t key, std::size_t floats);
    ~Checkpoint();  // the file stays
    Checkpoint(const Checkpoint&) = delete;
    Checkpoint& operator=(const Checkpoint&) = delete;

    const std::filesystem::path& file() const { return file_; }

    // Records that were kept before, each number once.
    std::vector<Record> takeEarlier() { return std::move(earlier_); }

    void keep(std::uint64_t number,
              std::span<const float> values);  // fewer than `floats` are filled up with 0

    // The picture is whole elsewhere: the file is removed, and nothing is kept any more.
    void remove();

private:
    struct Head;
    bool open(const Head& head);
    void merge(const std::filesystem::path& stem, const Head& head);

    std::filesystem::path file_;
    std::size_t floats_;
    std::FILE* stream_ = nullptr;
    std::mutex mutex_;
    std::vector<Record> earlier_;
};

// Files that are called as those of Checkpoints of this stem, whatever their picture, and that no program
// writes to now: what commands left that did not end. In the order of their names.
std::vector<std::filesystem::path> abandonedCheckpoints(const std::filesystem::path& stem);

}  // namespace diptych::reference
