// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

namespace diptych {

// While this object lives, no other diptych program moves files into the folder or beside it. It is a lock on
// the parent folder, which leaves no file behind and is released however the program ends. Programs wait for
// each other; moving takes milliseconds.
class FolderLock {
public:
    // Throws std::runtime_error naming the folder if another program holds the lock for half a minute. On a
    // file system without locks nothing is locked.
    explicit FolderLock(const std::filesystem::path& folder);
    ~FolderLock();
    FolderLock(const FolderLock&) = delete;
    FolderLock& operator=(const FolderLock&) = delete;

private:
    int file_ = -1;
};

}  // namespace diptych
