// SPDX-License-Identifier: MIT
#include "compare/files/output_folder.h"

#include "compare/files/file_moves.h"
#include "compare/files/folder_lock.h"
#include "compare/files/open_folder.h"
#include "compare/files/our_files.h"

#include "shared/image/atomic_file.h"
#include "shared/text/input_file.h"
#include "shared/text/named.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <sys/xattr.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <set>
#include <span>
#include <stdexcept>
#include <string_view>

namespace diptych {

namespace fs = std::filesystem;

namespace {

// Absolute name: "out/" and "out/." become "out", a symbolic link its target.
fs::path nameOf(const fs::path& folder) {
    fs::path path = fs::absolute(folder).lexically_normal();
    if (!path.has_filename()) path = path.parent_path();
    return fs::is_symlink(fs::symlink_status(path)) ? fs::weakly_canonical(path) : path;
}

void copy(InputFile& from, const fs::path& to) {
    const int file = ::open(to.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file < 0) throw std::runtime_error(writingFailed(finalName(to), errno));
    std::uint64_t left = from.size();
    // Shares blocks if the file system supports it.
    for (ssize_t copied = 0; left > 0; left -= static_cast<std::uint64_t>(copied))
        if (copied = ::copy_file_range(from.descriptor(), nullptr, file, nullptr, left, 0); copied <= 0)
            break;
    std::vector<std::byte> piece(std::min<std::uint64_t>(left, std::uint64_t(1) << 20));
    int error = 0;
    while (left > 0 && error == 0) {
        const std::span<std::byte> bytes(piece.data(), std::min<std::uint64_t>(left, piece.size()));
        try {
            from.read(bytes);
        } catch (...) {  // the file became shorter
            ::close(file);
            throw;
        }
        left -= bytes.size();
        for (std::size_t at = 0; at < bytes.size() && error == 0;) {
            const ssize_t put = ::write(file, bytes.data() + at, bytes.size() - at);
            if (put > 0) at += static_cast<std::size_t>(put);
            if (put < 0 && errno != EINTR) error = errno;
        }
    }
    if (::close(file) != 0 && error == 0) error = errno;
    if (error != 0) throw std::runtime_error(writingFailed(finalName(to), error));
}

// Whether the folder contains only the regular files `ours`, their folders, and `aside`.
bool holdsOnly(const fs::path& folder, const std::vector<std::string>& ours, const fs::path& aside) {
    const std::set<std::string> names(ours.begin(), ours.end());
    std::set<std::string> folders;
    for (const std::string& name : ours)
        for (const fs::path& inner : foldersOf(name)) folders.insert(inner.string());
    std::error_code error;
    fs::recursive_directory_iterator entry(folder, error);
    for (const fs::recursive_directory_iterator end; !error && entry != end; entry.increment(error)) {
        const fs::file_status status = entry->symlink_status(error);
        if (entry->path() == aside) {
            entry.disable_recursion_pending();
            continue;
        }
        const std::string name = entry->path().lexically_relative(folder).string();
        if (!(fs::is_directory(status)      ? folders
              : fs::is_regular_file(status) ? names
                                            : std::set<std::string>())
                 .contains(name))
            return false;
    }
    return !error;
}

// Whether the folder has extended attributes, such as access lists, that a new folder would lack. Ignores
// those that SELinux sets on every folder.
bool hasAttributes(const fs::path& folder) {
    char names[4096];
    const ssize_t size = ::llistxattr(folder.c_str(), names, sizeof names);
    if (size < 0) return errno != ENOTSUP;
    for (std::string_view rest(names, static_cast<std::size_t>(size)); !rest.empty();) {
        const std::string_view name = rest.substr(0, rest.find('\0'));
        if (!name.starts_with("security.")) return true;
        rest.remove_prefix(name.size() + 1);
    }
    return false;
}

// Gives the new folder the mode of the old one. False if owner or group differ, or if the old one is a
// link or our working directory.
bool likeNew(const fs::path& folder, const fs::path& fresh) {
    struct stat old {
    }, made{};
    std::error_code error;
    if (::lstat(folder.c_str(), &old) != 0 || ::lstat(fresh.c_str(), &made) != 0) return false;
    return S_ISDIR(old.st_mode) && old.st_uid == made.st_uid && old.st_gid == made.st_gid &&
           !hasAttributes(folder) && !fs::equivalent(folder, fs::current_path(error), error) && !error &&
           ::chmod(fresh.c_str(), old.st_mode & 07777) == 0;
}

bool isReadOnly(const fs::path& folder) {
    return ::faccessat(AT_FDCWD, folder.c_str(), W_OK, AT_EACCESS) != 0;
}

// Moves files that other programs created in the old folder during the exchange.
void rescue(const OpenFolder& from, const OpenFolder& to, const std::vector<std::string>& ours) {
    for (const std::string& name : ours) from.removeFile(name);
    for (const std::string& name : ours)
        for (const fs::path& inner : foldersOf(name)) from.removeFolder(inner);
    for (const std::string& name : from.names()) from.move(name, to, name, RENAME_NOREPLACE);
}

}  // namespace

OutputFolder::OutputFolder(const fs::path& folder) : folder_(nameOf(folder)) {
    std::error_code error;
    fs::create_directories(folder_.parent_path(), error);
    if (error) throw std::runtime_error(writingFailed(folder, error.value()));
    const FolderLock lock(folder_);
    // Each Temporary removes leftovers of killed programs: first beside the folder, then inside it.
    temporary_ = std::make_unique<Temporary>(folder_.parent_path(), folder_);
    if (fs::exists(folder_)) temporary_ = std::make_unique<Temporary>(folder_, folder_);
    if (!temporary_->createFolder()) throw std::runtime_error(writingFailed(folder, errno));
}

// Blocks interruptions, which would remove the temporary folder meanwhile.
void OutputFolder::makeFolders(const std::vector<std::string>& files) const {
    const auto held = holdTemporaries();
    for (const std::string& name : files) {
        const fs::path inner = path() / fs::path(name).parent_path();
        std::error_code error;
        fs::create_directories(inner, error);
        if (error) throw std::runtime_error(writingFailed(finalName(inner), error.value()));
    }
}

// Replaces the folder in one step. Changes nothing and returns false if that is impossible.
bool OutputFolder::exchange(const std::vector<std::string>& earlier) {
    if (isReadOnly(folder_) || !holdsOnly(folder_, earlier, temporary_->path()) ||
        !likeNew(folder_, temporary_->path()))
        return false;
    const fs::path home = temporary_->path().parent_path(), beside = folder_.parent_path();
    if (home != beside && !temporary_->moveTo(beside)) return false;
    if (::renameat2(AT_FDCWD, temporary_->path().c_str(), AT_FDCWD, folder_.c_str(), RENAME_EXCHANGE) == 0) {
        rescue(OpenFolder(temporary_->path()), OpenFolder(folder_), earlier);
        return true;
    }
    return false;
}

void OutputFolder::put(const std::vector<std::string>& files,
                       const std::function<std::vector<std::string>()>& earlier) {
    const FolderLock lock(folder_);
    const auto held = holdTemporaries();
    finishMoves(folder_);
    const std::vector<std::string> old = earlier();
    if (!fs::exists(fs::symlink_status(folder_))) {
        if (!temporary_->become(folder_)) throw std::runtime_error(writingFailed(folder_, errno));
        return;
    }
    if (exchange(old)) return;
    if (temporary_->path().parent_path() != folder_ && !temporary_->moveTo(folder_))
        throw std::runtime_error(writingFailed(folder_, errno));
    moveFiles(folder_, *temporary_, {files, old});
}

void linkOrCopy(const fs::path& root, const std::string& name, const fs::path& to) {
    named((root / name).string(), [&] {
        const auto held = holdTemporaries();  // an interruption must not remove the folder meanwhile
        InputFile from(root, name);
        // By file descriptor: the file cannot be swapped meanwhile.
        const std::string opened = fmt::format("/proc/self/fd/{}", from.descriptor());
        if (::linkat(AT_FDCWD, opened.c_str(), AT_FDCWD, to.c_str(), AT_SYMLINK_FOLLOW) != 0) copy(from, to);
    });
}

void copyBelow(const fs::path& root, const std::string& name, const fs::path& to) {
    named((root / name).string(), [&] {
        const auto held = holdTemporaries();
        InputFile from(root, name);
        copy(from, to);
    });
}

void finishOutput(const fs::path& folder) {
    const fs::path path = nameOf(folder);
    if (!isMoveBegun(path)) return;
    const FolderLock lock(path);
    const auto held = holdTemporaries();
    finishMoves(path);
}

}  // namespace diptych
