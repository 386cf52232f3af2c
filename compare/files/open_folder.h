// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace diptych {

// An open folder: operations stay in it even if it is renamed. Names ("lit.png", "1/lit.png") are resolved
// one folder at a time without following links, neither at the folder itself nor below it.
class OpenFolder {
public:
    // Throws std::runtime_error naming the folder, also if it is a link.
    explicit OpenFolder(const std::filesystem::path& folder);
    ~OpenFolder();
    OpenFolder(OpenFolder&& other) noexcept
        : path_(std::move(other.path_)), file_(std::exchange(other.file_, -1)) {}
    OpenFolder(const OpenFolder&) = delete;
    OpenFolder& operator=(const OpenFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }  // for messages
    bool lock() const;  // false if another program has the lock; true without lock support

    OpenFolder in(const std::filesystem::path& name) const;  // throws like the constructor
    bool has(const std::filesystem::path& name) const;       // of any type
    bool hasFile(const std::filesystem::path& name) const;   // regular files only
    std::vector<std::string> names() const;
    // Reads a regular file. Throws std::runtime_error if it is unreadable or larger than `most` bytes.
    std::string read(const std::filesystem::path& name, std::size_t most) const;

    // These return 0 or an errno.
    int makeFolder(const std::filesystem::path& name) const;  // the parent must exist
    int removeFile(const std::filesystem::path& name) const;
    int removeFolder(const std::filesystem::path& name) const;  // must be empty
    void removeAll(const std::filesystem::path& name) const;    // as far as possible
    // Removes everything below the folder except folders and regular files.
    void removeLinks() const;
    int move(const std::filesystem::path& name, const OpenFolder& to, const std::filesystem::path& as,
             unsigned flags = 0) const;  // renameat2()
    int link(const std::filesystem::path& name, const OpenFolder& to, const std::filesystem::path& as) const;

private:
    OpenFolder(std::filesystem::path path, int file) : path_(std::move(path)), file_(file) {}
    OpenFolder parentOf(const std::filesystem::path& name) const;  // invalid, with errno set, if absent

    std::filesystem::path path_;
    int file_ = -1;
};

}  // namespace diptych
