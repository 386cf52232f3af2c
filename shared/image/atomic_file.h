// SPDX-License-Identifier: MIT
// Output files that appear under their name complete or not at all.
#pragma once

#include "shared/image/temporary.h"

#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>

namespace diptych {

// A file written under a temporary name beside `file` and renamed by commit(); without a commit the
// temporary is removed. It is not synced to the disk: this protects against a full disk and an interrupted
// program, not against a power cut. All functions throw std::runtime_error naming `file`, the system's
// message and a remedy.
class AtomicFile {
public:
    // A link is replaced, never followed; a folder or a device is refused.
    explicit AtomicFile(const std::filesystem::path& file);
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    std::FILE* stream() const { return stream_; }
    void commit();  // checks all writes so far, closes and renames

private:
    [[noreturn]] void fail(int error);

    std::filesystem::path file_;
    Temporary temporary_;
    std::FILE* stream_ = nullptr;
};

// Writes a whole file at once.
void writeFile(const std::filesystem::path& file, std::string_view contents);

// "FILE: the system's message; a remedy", for an errno of a failed write.
std::string writingFailed(const std::filesystem::path& file, int error);

}  // namespace diptych
