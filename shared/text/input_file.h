// SPDX-License-Identifier: MIT
// The one way to open a file for reading. A folder, a FIFO, a socket or a device in its place is an error at
// once: opening never waits, and nothing is read before kind and size are known.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace diptych {

// An open regular file. Everything throws std::runtime_error without the file's name: "no such file", "is a
// folder", "is not a regular file", "is 5000000000 bytes: at most 4294967296 are read".
class InputFile {
public:
    // Follows links, as a user may name a file by one.
    explicit InputFile(const std::filesystem::path& file, std::uint64_t most_bytes = ~std::uint64_t{0});
    // A name out of one of our own files, "Box/lit.png", below a folder that the user named: neither it nor
    // a folder on the way may be a link or "..".
    InputFile(const std::filesystem::path& root, const std::string& name,
              std::uint64_t most_bytes = ~std::uint64_t{0});
    ~InputFile();
    InputFile(const InputFile&) = delete;
    InputFile& operator=(const InputFile&) = delete;

    std::uint64_t size() const { return size_; }  // bytes, when it was opened
    // The next bytes, all of `bytes`; throws where the file ends before.
    void read(std::span<std::byte> bytes);
    int descriptor() const { return descriptor_; }

private:
    void check(std::uint64_t most_bytes);

    int descriptor_ = -1;
    std::uint64_t size_ = 0;
};

// The whole of it. Errors as of InputFile.
std::string textIn(const std::filesystem::path& file, std::uint64_t most_bytes);
std::string textBelow(const std::filesystem::path& root, const std::string& name, std::uint64_t most_bytes);

}  // namespace diptych
