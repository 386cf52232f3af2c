// SPDX-License-Identifier: MIT
// How much memory this process may still take, and an error before it takes more than that.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace diptych {

struct FreeMemory {
    std::uint64_t bytes = UINT64_MAX;  // that value: no limit is known
    std::string limit;                 // what sets it: "this machine", "a cgroup", "ulimit -v", "ulimit -d"
};

// The least of: MemAvailable of /proc/meminfo; of the process's cgroup and each cgroup around it, versions 1
// and 2, the limit (in version 2 also memory.high, beyond which it is stopped) less what is used, not
// counting cached files; RLIMIT_AS and RLIMIT_DATA less what the process has. `root`: where proc and sys are;
// a file that cannot be read sets no limit. Swap does not count.
FreeMemory freeMemory(const std::filesystem::path& root = "/");

// Throws std::runtime_error if `needed` bytes are more than are free: "WHAT: needs about 3.1 GB, 2.0 GB are
// free here (ulimit -v); REMEDY".
void checkMemory(const std::string& what, std::uint64_t needed, const std::string& remedy,
                 const FreeMemory& free = freeMemory());

}  // namespace diptych
