// SPDX-License-Identifier: MIT
#include "compare/files/open_folder.h"

#include "shared/image/atomic_file.h"

#include <dirent.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <stdexcept>

namespace diptych {

namespace fs = std::filesystem;

namespace {

// Falls back to O_PATH for folders without read permission, which then cannot be listed or locked.
int openedIn(int folder, const char* name) {
    constexpr int how = O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC;
    const int file = ::openat(folder, name, O_RDONLY | how);
    return file < 0 && errno == EACCES ? ::openat(folder, name, O_PATH | how) : file;
}

int checked(int folder, const char* name, const fs::path& path) {
    const int file = openedIn(folder, name);
    if (file >= 0) return file;
    const int error = errno;
    struct stat status {};
    if (::fstatat(folder, name, &status, AT_SYMLINK_NOFOLLOW) == 0 && S_ISLNK(status.st_mode))
        throw std::runtime_error(
            fmt::format("{}: is a symbolic link, which diptych does not follow here; move it away, or choose "
                        "another folder",
                        path.string()));
    throw std::runtime_error(writingFailed(path, error));
}

int errorOf(int result) {
    return result == 0 ? 0 : errno;
}

std::vector<std::string> namesIn(int folder) {
    std::vector<std::string> names;
    const int file = ::openat(folder, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    DIR* const entries = file < 0 ? nullptr : ::fdopendir(file);
    if (!entries) {
        if (file >= 0) ::close(file);
        return names;
    }
    while (const dirent* entry = ::readdir(entries))
        if (const std::string name = entry->d_name; name != "." && name != "..") names.push_back(name);
    ::closedir(entries);
    return names;
}

void removeAllIn(int folder, const char* name) {
    if (::unlinkat(folder, name, 0) == 0 || errno == ENOENT) return;
    const int inner = openedIn(folder, name);
    if (inner < 0) return;
    for (const std::string& each : namesIn(inner)) removeAllIn(inner, each.c_str());
    ::close(inner);
    ::unlinkat(folder, name, AT_REMOVEDIR);
}

void removeLinksIn(int folder) {
    for (const std::string& name : namesIn(folder)) {
        struct stat status {};
        if (::fstatat(folder, name.c_str(), &status, AT_SYMLINK_NOFOLLOW) != 0 || S_ISREG(status.st_mode))
            continue;
        if (!S_ISDIR(status.st_mode)) {
            ::unlinkat(folder, name.c_str(), 0);
        } else if (const int inner = openedIn(folder, name.c_str()); inner >= 0) {
            removeLinksIn(inner);
            ::close(inner);
        }
    }
}

}  // namespace

OpenFolder::OpenFolder(const fs::path& folder)
    : path_(folder), file_(checked(AT_FDCWD, folder.c_str(), folder)) {}

OpenFolder::~OpenFolder() {
    if (file_ >= 0) ::close(file_);
}

bool OpenFolder::lock() const {
    return ::flock(file_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
}

OpenFolder OpenFolder::parentOf(const fs::path& name) const {
    int file = ::fcntl(file_, F_DUPFD_CLOEXEC, 0);
    for (const fs::path& part : name.parent_path()) {
        if (file < 0) break;
        const int inner = openedIn(file, part.c_str()), error = errno;
        ::close(file);
        file = inner;
        errno = error;
    }
    return {path_ / name.parent_path(), file};
}

OpenFolder OpenFolder::in(const fs::path& name) const {
    const OpenFolder parent = parentOf(name);
    if (parent.file_ < 0) throw std::runtime_error(writingFailed(path_ / name, errno));
    return {path_ / name, checked(parent.file_, name.filename().c_str(), path_ / name)};
}

bool OpenFolder::has(const fs::path& name) const {
    struct stat status {};
    const OpenFolder parent = parentOf(name);
    return ::fstatat(parent.file_, name.filename().c_str(), &status, AT_SYMLINK_NOFOLLOW) == 0;
}

bool OpenFolder::hasFile(const fs::path& name) const {
    struct stat status {};
    const OpenFolder parent = parentOf(name);
    return ::fstatat(parent.file_, name.filename().c_str(), &status, AT_SYMLINK_NOFOLLOW) == 0 &&
           S_ISREG(status.st_mode);
}

std::vector<std::string> OpenFolder::names() const {
    return namesIn(file_);
}

std::string OpenFolder::read(const fs::path& name, std::size_t most) const {
    const auto fail = [&](const std::string& why) {
        throw std::runtime_error(fmt::format("{}: {}", (path_ / name).string(), why));
    };
    const OpenFolder parent = parentOf(name);
    // O_NONBLOCK: do not block on a pipe.
    const int file =
        ::openat(parent.file_, name.filename().c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    struct stat status {};
    std::FILE* const stream = file < 0 ? nullptr : ::fdopen(file, "rb");
    if (!stream) {
        if (file >= 0) ::close(file);
        fail("cannot be read");
    }
    std::string text;
    const bool fits =
        ::fstat(file, &status) == 0 && S_ISREG(status.st_mode) && status.st_size <= static_cast<off_t>(most);
    if (fits) text.resize(static_cast<std::size_t>(status.st_size));
    const bool whole = fits && std::fread(text.data(), 1, text.size(), stream) == text.size();
    std::fclose(stream);
    if (!fits) fail(fmt::format("is not a regular file of at most {} bytes", most));
    if (!whole) fail("cannot be read completely");
    return text;
}

int OpenFolder::makeFolder(const fs::path& name) const {
    const OpenFolder parent = parentOf(name);
    return parent.file_ < 0 ? errno : errorOf(::mkdirat(parent.file_, name.filename().c_str(), 0777));
}

int OpenFolder::removeFile(const fs::path& name) const {
    const OpenFolder parent = parentOf(name);
    return parent.file_ < 0 ? errno : errorOf(::unlinkat(parent.file_, name.filename().c_str(), 0));
}

int OpenFolder::removeFolder(const fs::path& name) const {
    const OpenFolder parent = parentOf(name);
    return parent.file_ < 0 ? errno
                            : errorOf(::unlinkat(parent.file_, name.filename().c_str(), AT_REMOVEDIR));
}

void OpenFolder::removeAll(const fs::path& name) const {
    if (const OpenFolder parent = parentOf(name); parent.file_ >= 0)
        removeAllIn(parent.file_, name.filename().c_str());
}

void OpenFolder::removeLinks() const {
    removeLinksIn(file_);
}

int OpenFolder::move(const fs::path& name, const OpenFolder& to, const fs::path& as, unsigned flags) const {
    const OpenFolder here = parentOf(name);
    if (here.file_ < 0) return errno;
    const OpenFolder there = to.parentOf(as);
    if (there.file_ < 0) return errno;
    return errorOf(
        ::renameat2(here.file_, name.filename().c_str(), there.file_, as.filename().c_str(), flags));
}

int OpenFolder::link(const fs::path& name, const OpenFolder& to, const fs::path& as) const {
    const OpenFolder here = parentOf(name);
    if (here.file_ < 0) return errno;
    const OpenFolder there = to.parentOf(as);
    if (there.file_ < 0) return errno;
    return errorOf(::linkat(here.file_, name.filename().c_str(), there.file_, as.filename().c_str(), 0));
}

}  // namespace diptych
