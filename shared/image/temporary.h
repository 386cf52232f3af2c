// SPDX-License-Identifier: MIT
// Temporary names for incomplete output: ".NAME.PROCESS-NUMBER.tmp". They are removed however the program
// ends: by the destructor, by abandonTemporaries() on an interruption, and by the next program's sweep if it
// was killed.
#pragma once

#include <cstdio>
#include <filesystem>
#include <mutex>
#include <string>

namespace diptych {

// A temporary name of a file or a folder. Throws only when out of memory; errno tells what went wrong.
class Temporary {
public:
    // `target` is the output that it will become, or become a part of; it is created in `folder`, after
    // leftovers of ended programs for the same target have been removed from there.
    Temporary(const std::filesystem::path& folder, std::filesystem::path target);
    ~Temporary();  // removes it with all its contents
    Temporary(const Temporary&) = delete;
    Temporary& operator=(const Temporary&) = delete;

    const std::filesystem::path& path() const { return path_; }

    std::FILE* createFile();                           // opens it for writing; nullptr on failure
    bool createFolder(bool isPrivate = false);         // private: 0700 whatever the umask
    bool moveTo(const std::filesystem::path& folder);  // keeps its name and stays temporary
    // Renames it to `file`, replacing what is there; it is no longer temporary.
    bool become(const std::filesystem::path& file);

private:
    std::filesystem::path path_, target_;
    int lock_ = -1;  // of a folder
};

// While the returned lock is held, an interruption waits: for steps that must be done together, and for what
// is made inside a temporary folder by other means than createFile(). Milliseconds at most.
std::unique_lock<std::recursive_mutex> holdTemporaries();

// Removes all temporaries, and prevents that another one is created or committed: the caller ends the
// program.
void abandonTemporaries() noexcept;

// Whether `name` is that of a Temporary of `target`, in this or another program.
bool isTemporaryOf(const std::filesystem::path& target, const std::string& name);

// The final name of `path` if it is in a temporary folder; otherwise `path`. For messages.
std::filesystem::path finalName(const std::filesystem::path& path);

}  // namespace diptych
