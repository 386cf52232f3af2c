// SPDX-License-Identifier: MIT
#pragma once

#include <sys/stat.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace diptych {

// An open folder: operations stay in it even if it is renamed or its name is given to another. Names
// ("lit.png", "1/lit.png") are resolved one folder at a time without following links, neither at the folder
// itself nor below it.
class OpenFolder {
public:
    OpenFolder() = default;  // none: all operations fail
    // Throws std::runtime_error naming the folder, also if it is a link.
    explicit OpenFolder(const std::filesystem::path& folder);
    ~OpenFolder();
    OpenFolder(OpenFolder&& other) noexcept { *this = std::move(other); }
    OpenFolder& operator=(OpenFolder&& other) noexcept;

    // A folder by any path; empty: the working directory. Follows links like the system, because users may
    // name folders by them, but none below a folder that is pinned. Not open, with errno set, on failure.
    static OpenFolder at(const std::filesystem::path& folder);
    // The same; creates missing folders.
    static OpenFolder made(const std::filesystem::path& folder);
    // A folder that only this user may change, created if it is missing. Throws std::runtime_error naming
    // it, and changes nothing, if it existed before and fault() is not empty.
    static OpenFolder own(const std::filesystem::path& folder);

    // While it is open, all paths below this folder are resolved from here: by at(), and so by
    // AtomicFile, Temporary and InputFile.
    void pin();
    // The same by its new name, after a move.
    void pinAs(std::filesystem::path path);

    static bool isBelowPinned(const std::filesystem::path& path);

    bool isOpen() const { return file_ >= 0; }
    int descriptor() const { return file_; }
    const std::filesystem::path& path() const { return path_; }  // for messages
    OpenFolder copy() const;                                     // not pinned
    bool lock() const;  // false if another program has the lock; true without lock support
    // Why the folder is not ours alone: "it belongs to another user; REMEDY". Else empty.
    std::string fault(const char* remedy = "move it away") const;

    OpenFolder in(const std::filesystem::path& name) const;       // throws like the constructor
    OpenFolder find(const std::filesystem::path& name) const;     // not open, with errno set, on failure
    struct stat status(const std::filesystem::path& name) const;  // of a link itself; all 0 if absent
    bool has(const std::filesystem::path& name) const;            // of any type
    bool hasFile(const std::filesystem::path& name) const;        // regular files only
    // Whether the name still refers to the file or folder that was seen.
    bool has(const std::filesystem::path& name, const struct stat& seen) const;
    std::vector<std::string> names() const;
    // Reads a regular file. Throws std::runtime_error if it is unreadable or larger than `max` bytes.
    std::string read(const std::filesystem::path& name, std::size_t max) const;
    // Opens a file; a link fails. Returns a descriptor; -1 with errno set on failure.
    int open(const std::filesystem::path& name, int flags, mode_t mode = 0) const;
    // Creates a file for writing; nullptr, with errno set, also if the name exists.
    std::FILE* create(const std::filesystem::path& name) const;

    // These return 0 or an errno.
    int makeFolder(const std::filesystem::path& name, mode_t mode = 0777) const;  // the parent must exist
    int removeFile(const std::filesystem::path& name) const;
    int removeFolder(const std::filesystem::path& name) const;  // must be empty
    void removeAll(const std::filesystem::path& name) const;    // as far as possible
    void removeContents() const;                                // as far as possible
    // Removes everything below the folder except folders and regular files.
    void removeLinks() const;
    int move(const std::filesystem::path& name, const OpenFolder& to, const std::filesystem::path& as,
             unsigned flags = 0) const;  // renameat2()
    int link(const std::filesystem::path& name, const OpenFolder& to, const std::filesystem::path& as) const;

private:
    // `file`: -1 with errno set if opening failed.
    OpenFolder(std::filesystem::path path, int file)
        : path_(std::move(path)), file_(file < 0 ? -errno : file) {}
    OpenFolder parentOf(const std::filesystem::path& name) const;  // not open, with errno set, if absent

    std::filesystem::path path_;
    int file_ = -EBADF;  // or minus the errno of a failed opening
    bool pinned_ = false;
};

// "FILE: the system's message; a remedy", for the errno of a failed write.
std::string writingFailed(const std::filesystem::path& file, int error);

}  // namespace diptych
