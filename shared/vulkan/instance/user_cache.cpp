// SPDX-License-Identifier: MIT
#include "shared/vulkan/instance/user_cache.h"

#include "shared/text/one_line.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <mutex>
#include <system_error>
#include <utility>

namespace diptych {

namespace fs = std::filesystem;

namespace {

constexpr mode_t othersMayWrite = S_IWGRP | S_IWOTH;

bool isOnlyOurs(const struct stat& status) {
    return status.st_uid == ::geteuid() && (status.st_mode & othersMayWrite) == 0;
}

fs::path folderOfVariables() {
    // XDG base directory specification: relative paths are invalid and ignored.
    for (const auto& [variable, below] : {std::pair{"XDG_CACHE_HOME", ""}, {"HOME", ".cache"}})
        if (const char* const value = std::getenv(variable); value && fs::path(value).is_absolute())
            return fs::path(value) / below / "diptych";
    return {};
}

}  // namespace

std::string cacheFault(const fs::path& folder) {
    constexpr const char* remedy = "set XDG_CACHE_HOME to another folder";
    struct stat named {};
    const OpenFolder there = OpenFolder::at(folder);
    if (!there.isOpen() || ::lstat(folder.c_str(), &named) != 0) return {};
    // A link must belong to this user, too: others' links may lead anywhere.
    const std::string why = named.st_uid == ::geteuid()
                                ? there.fault(remedy)
                                : fmt::format("it belongs to another user; {}", remedy);
    return why.empty() ? why : fmt::format("{}: not used as a cache: {}", folder.string(), why);
}

fs::path userCacheFolder() {
    fs::path folder = folderOfVariables();
    if (folder.empty()) return {};
    const std::string fault = cacheFault(folder);
    if (fault.empty()) return folder;
    static std::once_flag once;
    std::call_once(once, [&] { std::fprintf(stderr, "diptych: note: %s\n", oneLine(fault).c_str()); });
    return {};
}

CacheFile openCacheFile(const fs::path& file) {
    CacheFile opened;
    const int descriptor = ::open(file.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (descriptor < 0) return opened;
    struct stat status {};
    const bool used = ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode) && isOnlyOurs(status);
    if (used) opened.stream.reset(::fdopen(descriptor, "rb"));
    if (opened.stream)
        opened.bytes = static_cast<std::uintmax_t>(status.st_size);
    else
        ::close(descriptor);
    return opened;
}

OpenFolder makeCacheFolder(const fs::path& folder) {
    const OpenFolder parent = OpenFolder::made(folder.parent_path());
    if (parent.isOpen()) parent.makeFolder(folder.filename(), 0700);
    OpenFolder there = OpenFolder::at(folder);
    return there.fault().empty() ? std::move(there) : OpenFolder();
}

void cacheForUser(std::FILE* file) {
    ::fchmod(::fileno(file), 0600);
}

}  // namespace diptych
