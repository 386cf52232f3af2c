// SPDX-License-Identifier: MIT
// The only way to open a file for reading. Folders, FIFOs, sockets and devices are errors: opening never
// blocks, and nothing is read before type and size are checked.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace diptych {

// An open regular file. All functions throw std::runtime_error without the file's name: "no such file",
// "is a folder", "is not a regular file", "is 5000000000 bytes: at most 4294967296 are read". A Git LFS
// pointer is an error, too.
class InputFile {
public:
    // Follows links, because users may name a file by one.
    explicit InputFile(const std::filesystem::path& file, std::uint64_t max_bytes = ~std::uint64_t{0});
    // A name from one of our own files, such as "Box/lit.png", below a folder that the user named. No part
    // of it may be a link or "..".
    InputFile(const std::filesystem::path& root, const std::string& name,
              std::uint64_t max_bytes = ~std::uint64_t{0});
    ~InputFile();
    InputFile(const InputFile&) = delete;
    InputFile& operator=(const InputFile&) = delete;

    std::uint64_t size() const { return size_; }  // bytes, at opening
    // Fills `bytes` with the next bytes; throws if the file ends before.
    void read(std::span<std::byte> bytes);
    int descriptor() const { return descriptor_; }

private:
    void check(std::uint64_t max_bytes);

    int descriptor_ = -1;
    std::uint64_t size_ = 0;
};

// The whole file. Errors as for InputFile.
std::string textIn(const std::filesystem::path& file, std::uint64_t max_bytes);
std::string textBelow(const std::filesystem::path& root, const std::string& name, std::uint64_t max_bytes);

}  // namespace diptych
