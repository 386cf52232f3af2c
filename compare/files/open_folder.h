// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace diptych {

// A folder that is held open, so that all of this happens in one folder, whoever renames it meanwhile. A name
// ("lit.png", "1/lit.png") is reached folder by folder, and no link is followed: neither at the folder itself
// nor below it.
class OpenFolder {
public:
    // Throws std::runtime_error naming the folder, where it is a link as well.
    explicit OpenFolder(const std::filesystem::path& folder);
    ~OpenFolder();
    OpenFolder(OpenFolder&& other) noexcept
        : path_(std::move(other.path_)), file_(std::exchange(other.file_, -1)) {}
    OpenFolder(const OpenFolder&) = delete;
    OpenFolder& operator=(const OpenFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }  // for messages
    bool lock() const;  // false where another program holds the lock; without locks nothing is locked

    OpenFolder in(const std::filesystem::path& name) const;  // throws as the constructor does
    bool has(const std::filesystem::path& name) const;       // whatever it is
    bool hasFile(const std::filesystem::path& name) const;   // a regular file
    std::vector<std::string> names() const;
    // A regular file; throws std::runtime_error where it cannot be read or is larger than `most` bytes.
    std::string read(const std::filesystem::path& name, std::size_t most) const;

    // These return 0 or an errno.
    int makeFolder(const std::filesystem::path& name) const;  // in a folder that is there
    int removeFile(const std::filesystem::path& name) const;
    int removeFolder(const std::filesystem::path& name) const;  // an empty one
    void removeAll(const std::filesystem::path& name) const;    // as much as is possible
    // Whatever below it is neither a folder nor a regular file.
    void removeLinks() const;
    int move(const std::filesystem::path& name, const OpenFolder& to, const std::filesystem::path& as,
             unsigned flags = 0) const;  // renameat2()
    int link(const std::filesystem::path& name, const OpenFolder& to, const std::filesystem::path& as) const;

private:
    OpenFolder(std::filesystem::path path, int file) : path_(std::move(path)), file_(file) {}
    OpenFolder parentOf(const std::filesystem::path& name) const;  // closed, with errno, where there is none

    std::filesystem::path path_;
    int file_ = -1;
};

}  // namespace diptych
