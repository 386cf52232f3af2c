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
    std::map<fs::path, fs::path> targets;  // by temporary name
};

Registry& registry() {
    static auto* const all = new Registry;
    return *all;
}

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

// Whether no such process is visible and nobody holds the lock. The lock is needed for processes in other
// containers, which are not visible.
bool isAbandoned(const fs::path& path, pid_t process) {
    if (::kill(process, 0) == 0 || errno != ESRCH) return false;
    const int file = ::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK);
    if (file < 0) return false;
    const bool free = ::flock(file, LOCK_EX | LOCK_NB) == 0;
    ::close(file);
    return free;
}

void sweep(const fs::path& folder, const fs::path& target) {
    const std::string prefix = prefixOf(target);
    std::vector<fs::path> left;
    std::error_code ignored;
    for (fs::directory_iterator entry(folder, ignored), end; !ignored && entry != end;
         entry.increment(ignored)) {
        const std::string name = entry->path().filename().string();
        if (!isTemporaryOf(target, name)) continue;
        const pid_t process = processOf(std::string_view(name).substr(prefix.size()));
        if (isAbandoned(entry->path(), process)) left.push_back(entry->path());
    }
    for (const fs::path& path : left) fs::remove_all(path, ignored);
}

bool isTemporary(const fs::path& folder) {
    const std::lock_guard lock(registry().mutex);
    return registry().targets.contains(folder);
}

}  // namespace

Temporary::Temporary(const fs::path& folder, fs::path target) : target_(std::move(target)) {
    static std::atomic<unsigned> serial{0};
    path_ = folder / fmt::format("{}{}-{}.tmp", prefixOf(target_), ::getpid(), serial.fetch_add(1));
    if (!isTemporary(folder)) sweep(folder.empty() ? "." : folder, target_);
}

Temporary::~Temporary() {
    const std::lock_guard lock(registry().mutex);
    std::error_code ignored;
    if (const auto entry = registry().targets.find(path_); entry != registry().targets.end()) {
        fs::remove_all(path_, ignored);
        registry().targets.erase(entry);
    }
    if (lock_ >= 0) ::close(lock_);
}

std::FILE* Temporary::createFile() {
    const std::lock_guard lock(registry().mutex);
    const auto entry = registry().targets.emplace(path_, target_).first;
    std::FILE* const file = std::fopen(path_.c_str(), "wbxe");
    if (!file) {
        const int error = errno;
        registry().targets.erase(entry);
        errno = error;
        return nullptr;
    }
    // If locks are not supported, only the process id decides.
    ::flock(::fileno(file), LOCK_EX | LOCK_NB);
    return file;
}

bool Temporary::createFolder(bool isPrivate) {
    const std::lock_guard lock(registry().mutex);
    const auto entry = registry().targets.emplace(path_, target_).first;
    constexpr mode_t ours = 0700;
    if (::mkdir(path_.c_str(), isPrivate ? ours : 0777) != 0) {
        const int error = errno;
        registry().targets.erase(entry);
        errno = error;
        return false;
    }
    if (isPrivate) ::chmod(path_.c_str(), ours);
    lock_ = ::open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    if (lock_ >= 0) ::flock(lock_, LOCK_EX | LOCK_NB);
    return true;
}

bool Temporary::moveTo(const fs::path& folder) {
    const std::lock_guard lock(registry().mutex);
    fs::path path = folder / path_.filename();
    registry().targets.emplace(path, target_);
    if (std::rename(path_.c_str(), path.c_str()) != 0) {
        const int error = errno;
        registry().targets.erase(path);
        errno = error;
        return false;
    }
    registry().targets.erase(path_);
    path_ = std::move(path);
    return true;
}

bool Temporary::become(const fs::path& file) {
    const std::lock_guard lock(registry().mutex);
    if (std::rename(path_.c_str(), file.c_str()) != 0) return false;
    registry().targets.erase(path_);
    return true;
}

std::unique_lock<std::recursive_mutex> holdTemporaries() {
    return std::unique_lock(registry().mutex);
}

void abandonTemporaries() noexcept {
    registry().mutex.lock();  // never released
    std::error_code ignored;
    for (const auto& [path, target] : registry().targets) try {
            fs::remove_all(path, ignored);
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
        if (const auto entry = registry().targets.find(folder); entry != registry().targets.end())
            return entry->second / path.lexically_relative(folder);
    return path;
}

}  // namespace diptych
