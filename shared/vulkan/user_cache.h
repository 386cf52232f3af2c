// SPDX-License-Identifier: MIT
// The user's cache folder. It only saves time, and drivers read it without mistrust: nothing is used
// that somebody else could have written.
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

namespace diptych {

// $XDG_CACHE_HOME/diptych, else $HOME/.cache/diptych; empty where neither is an absolute path, and where
// cacheFault() has something to say, which is then said on stderr, once.
std::filesystem::path userCacheFolder();

// Why a folder is not used as a cache, one line; empty: it is this user's and nobody else may write to it, or
// there is none yet.
std::string cacheFault(const std::filesystem::path& folder);

struct CacheFile {
    std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream{nullptr, std::fclose};  // null: not used
    std::uintmax_t bytes = 0;
};
// A regular file, not a link, that is this user's and that nobody else may write to.
CacheFile openCacheFile(const std::filesystem::path& file);

// Makes the folder, for this user alone, where it is missing.
void makeCacheFolder(const std::filesystem::path& folder);
// For this user alone whatever the umask: openCacheFile() would refuse it otherwise.
void keepForUser(std::FILE* file);

}  // namespace diptych
