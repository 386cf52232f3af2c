// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

namespace diptych {

// While it lives no other program of ours moves files into the folder or beside it: a lock on the folder that
// holds it, which leaves no file behind and ends with the program, however that ends. Programs wait for each
// other; moving takes milliseconds.
class FolderLock {
public:
    // Throws std::runtime_error naming the folder where another has it for half a minute. Where the file
    // system knows no locks there is none.
    explicit FolderLock(const std::filesystem::path& folder);
    ~FolderLock();
    FolderLock(const FolderLock&) = delete;
    FolderLock& operator=(const FolderLock&) = delete;

private:
    int file_ = -1;
};

}  // namespace diptych
