// SPDX-License-Identifier: MIT
// Atomic replacement of output files.
#pragma once

#include "shared/image/temporary.h"

#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>

namespace diptych {

// Writes to a temporary file beside `file`, which commit() renames. Without commit(), the temporary is
// removed. There is no sync to disk: this protects against full disks and interruptions, not against power
// loss. All functions throw std::runtime_error with `file`, the system's message and a remedy.
class AtomicFile {
public:
    // Replaces links instead of following them. Rejects folders and devices.
    explicit AtomicFile(const std::filesystem::path& file);
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    std::FILE* stream() const { return stream_; }
    void commit();  // checks all writes, closes and renames

private:
    [[noreturn]] void fail(int error);

    std::filesystem::path file_;
    Temporary temporary_;
    std::FILE* stream_ = nullptr;
};

// Writes a whole file atomically.
void writeFile(const std::filesystem::path& file, std::string_view contents);

}  // namespace diptych
