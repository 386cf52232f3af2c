// SPDX-License-Identifier: MIT
// Names for what is not whole yet: ".NAME.PROCESS-NUMBER.tmp". However the program ends they vanish: by the
// destructor, by abandonTemporaries() where it is interrupted, by the next program's sweep where it was
// killed.
#pragma once

#include <cstdio>
#include <filesystem>
#include <mutex>
#include <string>

namespace diptych {

// One such name, a file or a folder. Nothing throws but for want of memory; errno says what went wrong.
class Temporary {
public:
    // To become `target` or a part of it; stands in `folder`, after what dead programs left there for the
    // same target was swept.
    Temporary(const std::filesystem::path& folder, std::filesystem::path target);
    ~Temporary();  // removes it, with all in it
    Temporary(const Temporary&) = delete;
    Temporary& operator=(const Temporary&) = delete;

    const std::filesystem::path& path() const { return path_; }

    std::FILE* createFile();  // to write; nullptr
    bool createFolder();
    bool moveTo(const std::filesystem::path& folder);  // keeps its name, and stays temporary
    bool become(const std::filesystem::path& file);  // takes that name, whatever has it: no longer temporary

private:
    std::filesystem::path path_, target_;
    int lock_ = -1;  // a folder's
};

// While it lives an interruption waits: for steps that must all be done or none. Milliseconds, not more.
std::unique_lock<std::recursive_mutex> holdTemporaries();

// Removes all there are and never lets another be made nor become a file: the caller ends the program.
void abandonTemporaries() noexcept;

// A name that a Temporary of `target` has, in this or another program.
bool isTemporaryOf(const std::filesystem::path& target, const std::string& name);

// What `path`, in a temporary folder, will be called in the end; otherwise `path`. For messages.
std::filesystem::path finalName(const std::filesystem::path& path);

}  // namespace diptych
