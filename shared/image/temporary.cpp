// SPDX-License-Identifier: MIT
#include "shared/image/temporary.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <exception>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

namespace diptych {
namespace {

namespace fs = std::filesystem;

// Never destroyed, because a signal may interrupt the program while it exits.
struct Registry {
    std::recursive_mutex mutex;
    std::map<fs::path, Temporary*> all;  // by temporary name
};

Registry& registry() {
    static auto* const all = new Registry;
    return *all;
}

// The sticky bit has no effect here: it marks the temporary folder of an output.
constexpr mode_t temporary_mode = S_IRWXU | S_ISVTX;

// At most 200 bytes of the target's name (file names have up to 255), so that process and number fit.
std::string prefixOf(const fs::path& target) {
    return fmt::format(".{}.", target.filename().string().substr(0, 200));
}

// PROCESS of "PROCESS-NUMBER.tmp"; 0 if the name has another form.
pid_t processOf(std::string_view rest) {
    if (!rest.ends_with(".tmp")) return 0;
    pid_t process = 0;
    unsigned number = 0;
    const char* const end = rest.data() + rest.size() - 4;
    const auto first = std::from_chars(rest.data(), end, process);
    if (first.ec != std::errc{} || first.ptr == end || *first.ptr != '-' || process < 1) return 0;
    const auto second = std::from_chars(first.ptr + 1, end, number);
    return second.ec == std::errc{} && second.ptr == end ? process : 0;
}

// Whether only this user and root can rename things in the folder.
bool isSafe(const OpenFolder& folder) {
    struct stat there {};
    return ::fstat(folder.descriptor(), &there) == 0 && (there.st_uid == ::geteuid() || there.st_uid == 0) &&
           ((there.st_mode & (S_IWGRP | S_IWOTH)) == 0 || (there.st_mode & S_ISVTX) != 0);
}

// Whether nobody holds the lock. Processes in other containers, which are not visible, hold it.
bool isUnlocked(const OpenFolder& folder, const std::string& file) {
    const int opened = folder.open(file, O_RDONLY | O_NONBLOCK);
    const bool free = opened >= 0 && ::flock(opened, LOCK_EX | LOCK_NB) == 0;
    if (opened >= 0) ::close(opened);
    return free;
}

// Removes what this user made if no such process is visible and nobody holds the lock. Where others can
// rename things, they may give this user's folders such a name: only the mode shows a temporary one.
void sweep(const OpenFolder& folder, const fs::path& target) {
    for (const std::string& name : folder.names()) {
        if (!isTemporaryOf(target, name)) continue;
        const pid_t process = processOf(std::string_view(name).substr(prefixOf(target).size()));
        if (::kill(process, 0) == 0 || errno != ESRCH) continue;
        const OpenFolder inner = folder.find(name);
        struct stat there = folder.status(name);
        if (inner.isOpen() && ::fstat(inner.descriptor(), &there) != 0) continue;
        if (there.st_uid != ::geteuid()) continue;
        if (!inner.isOpen()) {
            if (isUnlocked(folder, name)) folder.removeFile(name);
        } else if ((isSafe(folder) || (there.st_mode & S_ISVTX) != 0) && inner.lock()) {
            inner.removeContents();
            folder.removeFolder(name);
        }
    }
}

// An errno as a result.
bool succeeded(int error) {
    if (error != 0) errno = error;
    return error == 0;
}

bool isTemporary(const fs::path& folder) {
    const std::lock_guard lock(registry().mutex);
    return registry().all.contains(folder);
}

}  // namespace

Temporary::Temporary(OpenFolder folder, fs::path target)
    : folder_(std::move(folder)), target_(std::move(target)) {
    static std::atomic<unsigned> serial{0};
    path_ = folder_.path() / fmt::format("{}{}-{}.tmp", prefixOf(target_), ::getpid(), serial.fetch_add(1));
    if (!isTemporary(folder_.path())) sweep(folder_, target_);
}

Temporary::~Temporary() {
    const std::lock_guard lock(registry().mutex);
    if (registry().all.erase(path_) > 0) remove();
}

// Empties a folder by its descriptor: its name may have been given to another, which is not empty and stays.
void Temporary::remove() {
    if (!contents_.isOpen()) {
        folder_.removeFile(name());
    } else {
        contents_.removeContents();
        folder_.removeFolder(name());
    }
}

bool Temporary::isThere() const {
    return succeeded(folder_.has(name(), seen_) ? 0 : ESTALE);
}

std::FILE* Temporary::createFile() {
    const std::lock_guard lock(registry().mutex);
    registry().all.emplace(path_, this);
    std::FILE* const file = folder_.create(name());
    if (!file) {
        const int error = errno;
        registry().all.erase(path_);
        errno = error;
        return nullptr;
    }
    ::fstat(::fileno(file), &seen_);
    // If locks are not supported, only the process id decides.
    ::flock(::fileno(file), LOCK_EX | LOCK_NB);
    return file;
}

bool Temporary::createFolder(bool isPrivate) {
    const std::lock_guard lock(registry().mutex);
    if (!succeeded(folder_.makeFolder(name()))) return false;
    contents_ = folder_.find(name());
    // Another program may have given the name to a folder of its own.
    if (!contents_.isOpen() || !contents_.names().empty()) return succeeded(EEXIST);
    registry().all.emplace(path_, this);
    contents_.pin();
    ::fstat(contents_.descriptor(), &seen_);
    ::fchmod(contents_.descriptor(), isPrivate ? S_IRWXU : temporary_mode | (seen_.st_mode & S_ISGID));
    contents_.lock();
    return true;
}

bool Temporary::moveTo(const OpenFolder& folder) {
    const std::lock_guard lock(registry().mutex);
    if (!isThere() || !succeeded(folder_.move(name(), folder, name()))) return false;
    registry().all.erase(path_);
    folder_ = folder.copy();
    path_ = folder_.path() / name();
    registry().all.emplace(path_, this);
    contents_.pinAs(path_);
    return true;
}

bool Temporary::rename(const std::string& name) {
    const std::lock_guard lock(registry().mutex);
    if (!isThere() || !succeeded(folder_.move(this->name(), folder_, name))) return false;
    registry().all.erase(path_);
    return true;
}

bool Temporary::become() {
    if (contents_.isOpen()) ::fchmod(contents_.descriptor(), seen_.st_mode & 07777);
    return rename(target_.filename());
}

bool Temporary::exchange(OpenFolder& old) {
    const auto swapped = [&] {
        return folder_.move(name(), folder_, target_.filename(), RENAME_EXCHANGE) == 0;
    };
    const std::lock_guard lock(registry().mutex);
    struct stat theirs {};
    if (::fstat(old.descriptor(), &theirs) != 0 || !isThere()) return false;
    ::fchmod(contents_.descriptor(), theirs.st_mode & 07777);
    if (const bool done = swapped();
        !done || !folder_.has(name(), theirs) || !folder_.has(target_.filename(), seen_)) {
        if (done) swapped();
        ::fchmod(contents_.descriptor(), temporary_mode | (seen_.st_mode & S_ISGID));
        return false;
    }
    std::swap(contents_, old);
    contents_.pinAs(path_);
    old.pinAs(target_);
    seen_ = theirs;
    return true;
}

std::unique_lock<std::recursive_mutex> lockTemporaries() {
    return std::unique_lock(registry().mutex);
}

void abandonTemporaries() noexcept {
    registry().mutex.lock();  // never released
    for (const auto& [path, temporary] : registry().all) try {
            temporary->remove();
        } catch (const std::exception&) {  // out of memory: the next program's sweep removes it
        }
}

bool isTemporaryOf(const fs::path& target, const std::string& name) {
    const std::string prefix = prefixOf(target);
    return name.starts_with(prefix) && processOf(std::string_view(name).substr(prefix.size())) != 0;
}

fs::path finalName(const fs::path& path) {
    const std::lock_guard lock(registry().mutex);
    for (fs::path folder = path.parent_path(); folder.has_filename(); folder = folder.parent_path())
        if (const auto entry = registry().all.find(folder); entry != registry().all.end())
            return entry->second->target() / path.lexically_relative(folder);
    return path;
}

}  // namespace diptych
