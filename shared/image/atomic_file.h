// SPDX-License-Identifier: MIT
// A file appears under its name whole or not at all.
#pragma once

#include "shared/image/temporary.h"

#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>

namespace diptych {

// Written beside `file` under a temporary name and renamed by commit(); without a commit the temporary is
// removed. Not synced to the disk: this guards against a full disk and an interrupted program, not against
// a power cut. Everything throws std::runtime_error naming `file`, what the system says and what helps.
class AtomicFile {
public:
    // A symbolic link keeps pointing where it does; a folder or a device is refused.
    explicit AtomicFile(const std::filesystem::path& file);
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    std::FILE* stream() const { return stream_; }
    void commit();  // checks every write before, closes, renames

private:
    static std::filesystem::path resolved(const std::filesystem::path& file);
    [[noreturn]] void fail(int error);

    std::filesystem::path file_;
    Temporary temporary_;
    std::FILE* stream_ = nullptr;
};

// The whole file at once.
void writeFile(const std::filesystem::path& file, std::string_view contents);

// "FILE: what the system says; what helps", of an errno met in writing.
std::string writingFailed(const std::filesystem::path& file, int error);

}  // namespace diptych
