// SPDX-License-Identifier: MIT
#include "shared/text/open_folder.h"

#include <dirent.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <map>
#include <mutex>
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

void removeContentsOf(int folder) {
    for (const std::string& name : namesIn(folder)) {
        if (::unlinkat(folder, name.c_str(), 0) == 0 || errno == ENOENT) continue;
        const int inner = openedIn(folder, name.c_str());
        if (inner < 0) continue;
        removeContentsOf(inner);
        ::close(inner);
        ::unlinkat(folder, name.c_str(), AT_REMOVEDIR);
    }
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

// Opens the folders of a relative path one after the other. Closes `file`.
int stepDown(int file, const fs::path& names) {
    for (const fs::path& part : names) {
        if (file < 0) break;
        if (part.empty() || part == ".") continue;
        const int inner = part == ".." ? (errno = ELOOP, -1) : openedIn(file, part.c_str()), error = errno;
        ::close(file);
        file = inner;
        errno = error;
    }
    return file;
}

// Pinned folders by their absolute paths. Never destroyed: another thread may write while the program exits.
struct PinnedFolders {
    std::mutex mutex;
    std::multimap<fs::path, int> files;
};

PinnedFolders& pinnedFolders() {
    static auto* const all = new PinnedFolders;
    return *all;
}

// Absolute, without a slash at its end.
fs::path keyOf(const fs::path& folder) {
    std::error_code none;  // the working directory may be gone
    const fs::path path = fs::absolute(folder.empty() ? "." : folder, none).lexically_normal();
    return path.has_filename() ? path : path.parent_path();
}

// The innermost pinned folder that is `path` or contains it; null if there is none. Under the mutex.
const std::pair<const fs::path, int>* pinnedAncestor(const fs::path& path) {
    const auto& files = pinnedFolders().files;
    for (fs::path outer = path; outer.has_relative_path(); outer = outer.parent_path())
        if (const auto pinned = files.find(outer); pinned != files.end()) return &*pinned;
    return nullptr;
}

void letGo(const fs::path& path, int file) {
    const std::lock_guard lock(pinnedFolders().mutex);
    auto [at, end] = pinnedFolders().files.equal_range(keyOf(path));
    at = std::find_if(at, end, [&](const auto& pinned) { return pinned.second == file; });
    if (at != end) pinnedFolders().files.erase(at);
}

}  // namespace

OpenFolder::OpenFolder(const fs::path& folder)
    : path_(folder), file_(checked(AT_FDCWD, folder.c_str(), folder)) {}

OpenFolder::~OpenFolder() {
    if (pinned_) letGo(path_, file_);
    if (file_ >= 0) ::close(file_);
}

OpenFolder& OpenFolder::operator=(OpenFolder&& other) noexcept {
    std::swap(path_, other.path_);
    std::swap(file_, other.file_);
    std::swap(pinned_, other.pinned_);
    return *this;
}

OpenFolder OpenFolder::at(const fs::path& folder) {
    const fs::path path = keyOf(folder);
    {
        const std::lock_guard lock(pinnedFolders().mutex);
        if (const auto* const pinned = pinnedAncestor(path))
            return {folder, stepDown(::fcntl(pinned->second, F_DUPFD_CLOEXEC, 0),
                                     path.lexically_relative(pinned->first))};
    }
    const char* const name = folder.empty() ? "." : folder.c_str();
    const int file = ::open(name, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    return {folder, file < 0 && errno == EACCES ? ::open(name, O_PATH | O_DIRECTORY | O_CLOEXEC) : file};
}

bool OpenFolder::isBelowPinned(const fs::path& path) {
    const std::lock_guard lock(pinnedFolders().mutex);
    return pinnedAncestor(keyOf(path).parent_path()) != nullptr;
}

OpenFolder OpenFolder::made(const fs::path& folder) {
    OpenFolder there = at(folder);
    if (there.isOpen() || errno != ENOENT || !folder.has_relative_path()) return there;
    if (!folder.has_filename()) return made(folder.parent_path());
    const OpenFolder parent = made(folder.parent_path());
    if (!parent.isOpen()) return {};
    if (const int error = parent.makeFolder(folder.filename()); error != 0 && error != EEXIST) {
        errno = error;
        return {};
    }
    return {folder, openedIn(parent.file_, folder.filename().c_str())};
}

OpenFolder OpenFolder::own(const fs::path& folder) {
    const OpenFolder parent = made(folder.parent_path());
    const int error = parent.isOpen() ? parent.makeFolder(folder.filename(), 0755) : errno;
    if (error != 0 && error != EEXIST) throw std::runtime_error(writingFailed(folder, error));
    OpenFolder there{folder, checked(parent.file_, folder.filename().c_str(), folder)};
    // A new one is ours even if the file system gives it another owner.
    const bool fresh = error == 0 && there.names().empty();
    if (const std::string fault = there.fault(); !fresh && !fault.empty())
        throw std::runtime_error(fmt::format("{}: {}", folder.string(), fault));
    return there;
}

void OpenFolder::pin() {
    const std::lock_guard lock(pinnedFolders().mutex);
    pinnedFolders().files.emplace(keyOf(path_), file_);
    pinned_ = true;
}

void OpenFolder::pinAs(fs::path path) {
    if (pinned_) letGo(path_, file_);
    path_ = std::move(path);
    pin();
}

OpenFolder OpenFolder::copy() const {
    return {path_, ::fcntl(file_, F_DUPFD_CLOEXEC, 0)};
}

std::string OpenFolder::fault(const char* remedy) const {
    struct stat there {};
    if (::fstat(file_, &there) != 0 || there.st_uid != ::geteuid())
        return fmt::format("it belongs to another user; {}", remedy);
    return (there.st_mode & (S_IWGRP | S_IWOTH)) != 0 ? "other users may write to it; run chmod go-w on it"
                                                      : "";
}

bool OpenFolder::lock() const {
    return ::flock(file_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
}

OpenFolder OpenFolder::parentOf(const fs::path& name) const {
    if (!isOpen()) {
        errno = -file_;
        return {path_, -1};
    }
    return {path_ / name.parent_path(), stepDown(::fcntl(file_, F_DUPFD_CLOEXEC, 0), name.parent_path())};
}

OpenFolder OpenFolder::find(const fs::path& name) const {
    return {path_ / name, stepDown(::fcntl(file_, F_DUPFD_CLOEXEC, 0), name)};
}

OpenFolder OpenFolder::in(const fs::path& name) const {
    const OpenFolder parent = parentOf(name);
    if (!parent.isOpen()) throw std::runtime_error(writingFailed(path_ / name, errno));
    return {path_ / name, checked(parent.file_, name.filename().c_str(), path_ / name)};
}

struct stat OpenFolder::status(const fs::path& name) const {
    struct stat there {};
    const OpenFolder parent = parentOf(name);
    if (::fstatat(parent.file_, name.filename().c_str(), &there, AT_SYMLINK_NOFOLLOW) != 0) there = {};
    return there;
}

bool OpenFolder::has(const fs::path& name) const {
    return status(name).st_mode != 0;
}

bool OpenFolder::hasFile(const fs::path& name) const {
    return S_ISREG(status(name).st_mode);
}

bool OpenFolder::has(const fs::path& name, const struct stat& seen) const {
    const struct stat there = status(name);
    return there.st_mode != 0 && there.st_dev == seen.st_dev && there.st_ino == seen.st_ino;
}

std::vector<std::string> OpenFolder::names() const {
    return namesIn(file_);
}

std::string OpenFolder::read(const fs::path& name, std::size_t max) const {
    const auto fail = [&](const std::string& why) {
        throw std::runtime_error(fmt::format("{}: {}", (path_ / name).string(), why));
    };
    const int file = open(name, O_RDONLY | O_NONBLOCK);  // does not block on a pipe
    struct stat status {};
    std::FILE* const stream = file < 0 ? nullptr : ::fdopen(file, "rb");
    if (!stream) {
        if (file >= 0) ::close(file);
        fail("cannot be read");
    }
    std::string text;
    const bool fits =
        ::fstat(file, &status) == 0 && S_ISREG(status.st_mode) && status.st_size <= static_cast<off_t>(max);
    if (fits) text.resize(static_cast<std::size_t>(status.st_size));
    const bool whole = fits && std::fread(text.data(), 1, text.size(), stream) == text.size();
    std::fclose(stream);
    if (!fits) fail(fmt::format("is not a regular file of at most {} bytes", max));
    if (!whole) fail("cannot be read completely");
    return text;
}

int OpenFolder::open(const fs::path& name, int flags, mode_t mode) const {
    const OpenFolder parent = parentOf(name);
    if (!parent.isOpen()) return -1;
    return ::openat(parent.file_, name.filename().c_str(), flags | O_NOFOLLOW | O_CLOEXEC | O_NOCTTY, mode);
}

std::FILE* OpenFolder::create(const fs::path& name) const {
    const int file = open(name, O_WRONLY | O_CREAT | O_EXCL, 0666);
    std::FILE* const stream = file < 0 ? nullptr : ::fdopen(file, "wb");
    if (file >= 0 && !stream) ::close(file);
    return stream;
}

int OpenFolder::makeFolder(const fs::path& name, mode_t mode) const {
    const OpenFolder parent = parentOf(name);
    return parent.isOpen() ? errorOf(::mkdirat(parent.file_, name.filename().c_str(), mode)) : errno;
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
    if (removeFile(name) == 0) return;
    const OpenFolder parent = parentOf(name);
    if (const OpenFolder inner{{}, openedIn(parent.file_, name.filename().c_str())}; inner.isOpen())
        inner.removeContents();
    removeFolder(name);
}

void OpenFolder::removeContents() const {
    removeContentsOf(file_);
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

std::string writingFailed(const fs::path& file, int error) {
    const char* helps = "";
    switch (error) {
        case ENOSPC:
        case EDQUOT:
            helps = "; make room, or write to another place with -o";
            break;
        case EROFS:
        case EACCES:
        case EPERM:
            helps = "; write to another place with -o";
            break;
        case EFBIG:
            helps = "; raise the limit on a file's size (ulimit -f), or write to another place with -o";
            break;
        case EMFILE:
        case ENFILE:
            helps = "; raise the limit on open files (ulimit -n)";
            break;
        case EIO:
            helps = "; check the disk, or write to another place with -o";
            break;
        default:
            helps = "; -o chooses another place";
    }
    return fmt::format("{}: {}{}", file.string(), std::strerror(error), helps);
}

}  // namespace diptych
