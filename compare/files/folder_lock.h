// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

namespace diptych {

// Excludes other diptych programs from moving files into the folder or beside it. Locks the parent folder,
// which leaves no file behind and ends with the process. Programs wait for each other; moving takes
// milliseconds.
class FolderLock {
public:
    // Throws std::runtime_error naming the folder if another program holds the lock for 30 s. Has no
    // effect on a file system without locks.
    explicit FolderLock(const std::filesystem::path& folder);
    ~FolderLock();
    FolderLock(const FolderLock&) = delete;
    FolderLock& operator=(const FolderLock&) = delete;

private:
    int file_ = -1;
};

}  // namespace diptych
