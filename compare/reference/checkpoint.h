// SPDX-License-Identifier: MIT
// Keeps finished parts of a long picture in a file, so that an interrupted program can go on from there.
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <mutex>
#include <span>
#include <vector>

namespace diptych::reference {

// Numbered records of floats, each with a checksum: however the program ends, the complete records in the
// file can be used. Functions may be called from any thread.
class Checkpoint {
public:
    struct Record {
        std::uint64_t number;
        std::vector<float> values;
    };

    // The file's name is STEM-HASH, where HASH is the first half of `key` in hexadecimal digits, so that
    // different pictures have different files. The file is locked as long as the Checkpoint lives. If
    // another program holds the lock, or if the file is of another picture nevertheless, it is left alone
    // and the name is STEM-HASH-2, then -3. Records in other files of the same picture are used as well,
    // whichever program writes them; files whose programs have ended are merged into this one and removed.
    // `floats`: in a record. Throws std::runtime_error naming the file if it cannot be written. On a file
    // system without locks, two programs share a file.
    Checkpoint(const std::filesystem::path& stem, std::uint64_t key, std::size_t floats);
    ~Checkpoint();  // the file stays
    Checkpoint(const Checkpoint&) = delete;
    Checkpoint& operator=(const Checkpoint&) = delete;

    const std::filesystem::path& file() const { return file_; }

    // The records that were found, each number once.
    std::vector<Record> takeEarlier() { return std::move(earlier_); }

    void keep(std::uint64_t number,
              std::span<const float> values);  // a record shorter than `floats` is filled up with 0

    // Removes the file and stops keeping records: the picture has been written elsewhere.
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

// Checkpoint files of this stem, of any picture, that no program is writing to: left by commands that were
// interrupted. Sorted by name.
std::vector<std::filesystem::path> abandonedCheckpoints(const std::filesystem::path& stem);

}  // namespace diptych::reference
