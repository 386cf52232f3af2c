// SPDX-License-Identifier: MIT
// Temporary names for incomplete output: ".NAME.PROCESS-NUMBER.tmp". They are always removed: by the
// destructor, by abandonTemporaries() on interruption, or by the next program's sweep if this one was
// killed.
#pragma once

#include <cstdio>
#include <filesystem>
#include <mutex>
#include <string>

namespace diptych {

// A temporary name of a file or folder. Throws only if out of memory; otherwise errno has the error.
class Temporary {
public:
    // `target`: the output that it will become, or be part of. It is created in `folder`, after removing
    // leftovers of ended programs for the same target.
    Temporary(const std::filesystem::path& folder, std::filesystem::path target);
    ~Temporary();  // removes it recursively
    Temporary(const Temporary&) = delete;
    Temporary& operator=(const Temporary&) = delete;

    const std::filesystem::path& path() const { return path_; }

    std::FILE* createFile();                           // opens it for writing; nullptr on failure
    bool createFolder(bool isPrivate = false);         // private: mode 0700 for any umask
    bool moveTo(const std::filesystem::path& folder);  // keeps its name and stays temporary
    // Renames it to `file`, replacing an existing one; it is no longer temporary.
    bool become(const std::filesystem::path& file);

private:
    std::filesystem::path path_, target_;
    int lock_ = -1;  // for folders
};

// Interruptions wait while the returned lock is held. For steps that belong together, and for files
// created inside a temporary folder without createFile(). Hold it for milliseconds at most.
std::unique_lock<std::recursive_mutex> holdTemporaries();

// Removes all temporaries and prevents new ones and commits. The caller must end the program.
void abandonTemporaries() noexcept;

// Whether `name` is a Temporary of `target`, of this or another program.
bool isTemporaryOf(const std::filesystem::path& target, const std::string& name);

// The final name of `path` if it is in a temporary folder, else `path`. For messages.
std::filesystem::path finalName(const std::filesystem::path& path);

}  // namespace diptych
