// SPDX-License-Identifier: MIT
// Temporary names for incomplete output: ".NAME.PROCESS-NUMBER.tmp". They are always removed: by the
// destructor, by abandonTemporaries() on interruption, or by the next program's sweep if this one was
// killed.
#pragma once

#include "shared/text/open_folder.h"

#include <sys/stat.h>

#include <cstdio>
#include <filesystem>
#include <mutex>
#include <string>
#include <utility>

namespace diptych {

// A temporary name of a file or folder. It stays in its folder, and is written, renamed and removed only
// there, whatever another program gives the folder's name to. Throws only if out of memory; otherwise errno
// has the error.
class Temporary {
public:
    // `target`: the output that it will become, or be part of. It is created in `folder`, after removing
    // leftovers of ended programs for the same target.
    Temporary(const std::filesystem::path& folder, std::filesystem::path target)
        : Temporary(OpenFolder::at(folder), std::move(target)) {}
    Temporary(OpenFolder folder, std::filesystem::path target);
    ~Temporary();  // removes it recursively
    Temporary(const Temporary&) = delete;
    Temporary& operator=(const Temporary&) = delete;

    const std::filesystem::path& path() const { return path_; }
    const std::filesystem::path& target() const { return target_; }
    const OpenFolder& folder() const { return folder_; }      // where it is
    const OpenFolder& contents() const { return contents_; }  // of a folder

    std::FILE* createFile();  // opens it for writing; nullptr on failure
    // For this user alone until it becomes the output; private: it never does.
    bool createFolder(bool isPrivate = false);
    bool moveTo(const OpenFolder& folder);  // keeps its name and stays temporary
    // Renames it, in its folder, to the target's name, replacing an existing file; it is no longer temporary.
    bool become();
    bool rename(const std::string& name);  // in its folder; it is no longer temporary
    // Exchanges a folder with `old`, which has the target's name in the same folder, and gives it that one's
    // mode. The old one is temporary then, and `old` the new one.
    bool exchange(OpenFolder& old);

private:
    friend void abandonTemporaries() noexcept;

    std::string name() const { return path_.filename(); }
    bool isThere() const;  // its name still refers to it
    void remove();

    OpenFolder folder_;
    OpenFolder contents_;  // of a folder; held, locked
    struct stat seen_ {};  // when created
    std::filesystem::path path_, target_;
};

// Interruptions wait while the returned lock is held. For steps that belong together, and for files
// created inside a temporary folder without createFile(). Hold it for milliseconds at most.
std::unique_lock<std::recursive_mutex> lockTemporaries();

// Removes all temporaries and prevents new ones and commits. The caller must end the program.
void abandonTemporaries() noexcept;

// Whether `name` is a Temporary of `target`, of this or another program.
bool isTemporaryOf(const std::filesystem::path& target, const std::string& name);

// The final name of `path` if it is in a temporary folder, else `path`. For messages.
std::filesystem::path finalName(const std::filesystem::path& path);

}  // namespace diptych
