// SPDX-License-Identifier: MIT
// The user's cache folder. It only saves time. Drivers trust its contents, so files that others could have
// written are not used.
#pragma once

#include "shared/text/open_folder.h"

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

namespace diptych {

// $XDG_CACHE_HOME/diptych, else $HOME/.cache/diptych. Empty if neither is an absolute path, or if
// cacheFault() reports a problem, which is then printed to stderr once.
std::filesystem::path userCacheFolder();

// Why a folder is not used as a cache, one line. Empty if it belongs to this user and nobody else may
// write to it, or if it does not exist.
std::string cacheFault(const std::filesystem::path& folder);

struct CacheFile {
    std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream{nullptr, std::fclose};  // null: do not use
    std::uintmax_t bytes = 0;
};
// Opens a regular file, not a link, that belongs to this user and that nobody else may write to.
CacheFile openCacheFile(const std::filesystem::path& file);

// Creates the folder for this user alone if it is missing. Not open if cacheFault() reports a problem.
OpenFolder makeCacheFolder(const std::filesystem::path& folder);
// Restricts access to this user regardless of the umask; otherwise openCacheFile() would reject the file.
void cacheForUser(std::FILE* file);

}  // namespace diptych
