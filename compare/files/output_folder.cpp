// SPDX-License-Identifier: MIT
#include "compare/files/output_folder.h"

#include "compare/files/diptych_files.h"
#include "compare/files/file_moves.h"
#include "compare/files/folder_lock.h"
#include "compare/files/linked_file.h"

#include "shared/image/atomic_file.h"
#include "shared/text/input_file.h"
#include "shared/text/named.h"
#include "shared/text/open_folder.h"

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

// Absolute name: "out/" and "out/." become "out". A symbolic link that the user named becomes its target.
fs::path nameOf(const fs::path& folder) {
    fs::path path = fs::absolute(folder).lexically_normal();
    if (!path.has_filename()) path = path.parent_path();
    return OpenFolder::isBelowPinned(path) ? path : linkedFile(path);
}

void copy(InputFile& from, const OpenFolder& folder, const fs::path& to) {
    std::FILE* const file = folder.create(to.filename());
    if (!file) throw std::runtime_error(writingFailed(finalName(to), errno));
    std::uint64_t left = from.size();
    // Shares blocks if the file system supports it.
    for (ssize_t copied = 0; left > 0; left -= static_cast<std::uint64_t>(copied))
        if (copied = ::copy_file_range(from.descriptor(), nullptr, ::fileno(file), nullptr, left, 0);
            copied <= 0)
            break;
    std::vector<std::byte> piece(std::min<std::uint64_t>(left, std::uint64_t(1) << 20));
    int error = 0;
    while (left > 0 && error == 0) {
        const std::span<std::byte> bytes(piece.data(), std::min<std::uint64_t>(left, piece.size()));
        try {
            from.read(bytes);
        } catch (...) {  // the file became shorter
            std::fclose(file);
            throw;
        }
        left -= bytes.size();
        if (std::fwrite(bytes.data(), 1, bytes.size(), file) != bytes.size()) error = errno;
    }
    if (std::fclose(file) != 0 && error == 0) error = errno;
    if (error != 0) throw std::runtime_error(writingFailed(finalName(to), error));
}

OpenFolder folderOf(const fs::path& file) {
    OpenFolder folder = OpenFolder::at(file.parent_path());
    if (!folder.isOpen()) throw std::runtime_error(writingFailed(finalName(file), errno));
    return folder;
}

// Whether the folder can be listed and changed.
bool isWritable(const OpenFolder& folder) {
    return ::faccessat(folder.descriptor(), ".", R_OK | W_OK, AT_EACCESS) == 0;
}

// Whether the folder can be replaced: it contains only the regular files `written`, their folders, and
// `aside`. `below`: empty, or the names' beginning.
bool holdsOnly(const OpenFolder& folder, const std::set<std::string>& written, const std::string& below,
               const std::string& aside) {
    return isWritable(folder) && std::ranges::all_of(folder.names(), [&](const std::string& name) {
               const mode_t mode = folder.status(name).st_mode;
               if (below + name == aside || (S_ISREG(mode) && written.contains(below + name))) return true;
               const std::string inside = below + name + "/";
               const auto first = written.lower_bound(inside);
               const OpenFolder inner = folder.find(name);
               return inner.isOpen() && first != written.end() && first->starts_with(inside) &&
                      holdsOnly(inner, written, inside, aside);
           });
}

// Whether the folder has extended attributes, such as access lists, that a new folder would lack. Ignores
// those that SELinux sets on every folder.
bool hasAttributes(const OpenFolder& folder) {
    char names[4096];
    const ssize_t size = ::flistxattr(folder.descriptor(), names, sizeof names);
    if (size < 0) return errno != ENOTSUP;
    for (std::string_view rest(names, static_cast<std::size_t>(size)); !rest.empty();) {
        const std::string_view name = rest.substr(0, rest.find('\0'));
        if (!name.starts_with("security.")) return true;
        rest.remove_prefix(name.size() + 1);
    }
    return false;
}

// Whether a new folder may take the place of the old one: same owner and group, and not our working
// directory.
bool isReplaceable(const OpenFolder& folder, const OpenFolder& fresh) {
    struct stat old {
    }, made{}, working{};
    if (::fstat(folder.descriptor(), &old) != 0 || ::fstat(fresh.descriptor(), &made) != 0) return false;
    const bool here =
        ::stat(".", &working) == 0 && working.st_dev == old.st_dev && working.st_ino == old.st_ino;
    return old.st_uid == made.st_uid && old.st_gid == made.st_gid && !hasAttributes(folder) && !here;
}

// Moves files that other programs created in the old folder during the exchange.
void rescue(const OpenFolder& from, const OpenFolder& to, const std::vector<std::string>& written) {
    for (const std::string& name : written) from.removeFile(name);
    for (const std::string& name : written)
        for (const fs::path& inner : foldersOf(name)) from.removeFolder(inner);
    for (const std::string& name : from.names()) from.move(name, to, name, RENAME_NOREPLACE);
}

}  // namespace

OutputFolder::OutputFolder(const fs::path& folder)
    : folder_(nameOf(folder)), beside_(OpenFolder::made(folder_.parent_path())) {
    if (!beside_.isOpen()) throw std::runtime_error(writingFailed(folder, errno));
    const FolderLock lock(folder_);
    // Each Temporary removes leftovers of killed programs: first beside the folder, then inside it.
    temporary_ = std::make_unique<Temporary>(beside_.copy(), folder_);
    if (isThere()) temporary_ = std::make_unique<Temporary>(destination_.copy(), folder_);
    if (!temporary_->createFolder()) throw std::runtime_error(writingFailed(folder, errno));
}

// Opens the folder once it exists, and pins it.
bool OutputFolder::isThere() {
    const std::string name = folder_.filename();
    if (!destination_.isOpen() && beside_.has(name)) {
        destination_ = beside_.in(name);
        destination_.pin();
    }
    struct stat opened {};
    if (destination_.isOpen() &&
        (::fstat(destination_.descriptor(), &opened) != 0 || !beside_.has(name, opened)))
        throw std::runtime_error(writingFailed(folder_, ESTALE));  // another one has its name by now
    return destination_.isOpen();
}

// Blocks interruptions, which would remove the temporary folder meanwhile.
void OutputFolder::makeFolders(const std::vector<std::string>& files) const {
    const auto held = lockTemporaries();
    for (const std::string& name : files) {
        const fs::path inner = (path() / name).parent_path();
        if (!OpenFolder::made(inner).isOpen())
            throw std::runtime_error(writingFailed(finalName(inner), errno));
    }
}

// Replaces the folder in one step. Changes nothing and returns false if that is impossible.
bool OutputFolder::exchange(const std::vector<std::string>& earlier) {
    if (!holdsOnly(destination_, {earlier.begin(), earlier.end()}, {}, temporary_->path().filename()) ||
        !isReplaceable(destination_, temporary_->contents()))
        return false;
    const bool beside = temporary_->path().parent_path() == folder_.parent_path();
    if ((!beside && !temporary_->moveTo(beside_)) || !temporary_->exchange(destination_)) return false;
    rescue(temporary_->contents(), destination_, earlier);
    return true;
}

void OutputFolder::put(const std::vector<std::string>& files,
                       const std::function<std::vector<std::string>()>& earlier) {
    const FolderLock lock(folder_);
    const auto held = lockTemporaries();
    const bool there = isThere();
    finishMoves(folder_);
    const std::vector<std::string> old = earlier();
    if (!there) {
        if (!temporary_->become()) throw std::runtime_error(writingFailed(folder_, errno));
        return;
    }
    if (exchange(old)) return;
    if (temporary_->path().parent_path() != folder_ && !temporary_->moveTo(destination_))
        throw std::runtime_error(writingFailed(folder_, errno));
    moveFiles(folder_, *temporary_, {files, old});
}

void linkOrCopy(const fs::path& root, const std::string& name, const fs::path& to) {
    named((root / name).string(), [&] {
        const auto held = lockTemporaries();  // an interruption must not remove the folder meanwhile
        InputFile from(root, name);
        const OpenFolder folder = folderOf(to);
        // By file descriptor: the file cannot be swapped meanwhile.
        const std::string opened = fmt::format("/proc/self/fd/{}", from.descriptor());
        if (::linkat(AT_FDCWD, opened.c_str(), folder.descriptor(), to.filename().c_str(),
                     AT_SYMLINK_FOLLOW) != 0)
            copy(from, folder, to);
    });
}

void copyBelow(const fs::path& root, const std::string& name, const fs::path& to) {
    named((root / name).string(), [&] {
        const auto held = lockTemporaries();
        InputFile from(root, name);
        copy(from, folderOf(to), to);
    });
}

void finishOutput(const fs::path& folder) {
    const fs::path path = nameOf(folder);
    if (!isMoveBegun(path)) return;
    const FolderLock lock(path);
    const auto held = lockTemporaries();
    finishMoves(path);
}

}  // namespace diptych
