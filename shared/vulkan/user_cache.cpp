// SPDX-License-Identifier: MIT
#include "shared/vulkan/user_cache.h"

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
    struct stat named {
    }, there{};
    // A link must belong to this user, too: others' links may lead anywhere.
    if (::lstat(folder.c_str(), &named) != 0 || ::stat(folder.c_str(), &there) != 0) return {};
    const char* const why = named.st_uid != ::geteuid() || there.st_uid != ::geteuid()
                                ? "it belongs to another user; set XDG_CACHE_HOME to another folder"
                            : !isOnlyOurs(there) ? "other users may write to it; run chmod go-w on it"
                                                 : nullptr;
    return why ? fmt::format("{}: not used as a cache: {}", folder.string(), why) : std::string();
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

void makeCacheFolder(const fs::path& folder) {
    std::error_code failed;  // the writer will notice a failure
    fs::create_directories(folder.parent_path(), failed);
    ::mkdir(folder.c_str(), 0700);
}

void keepForUser(std::FILE* file) {
    ::fchmod(::fileno(file), 0600);
}

}  // namespace diptych
