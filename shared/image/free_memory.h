// SPDX-License-Identifier: MIT
// The memory that this process may still take, and a check before it takes more.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace diptych {

struct FreeMemory {
    std::uint64_t bytes = UINT64_MAX;  // UINT64_MAX: no known limit
    std::string limit;                 // its source: "this machine", "a cgroup", "ulimit -v", "ulimit -d"
};

// The minimum of three: MemAvailable of /proc/meminfo; the limits of the process's cgroup and its
// ancestors, less their use without cached files; RLIMIT_AS and RLIMIT_DATA, less what the process has.
// Both cgroup versions are read; in version 2, memory.high is also a limit, because the process is
// throttled beyond it. Files that cannot be read set no limit; swap does not count. `root` contains proc
// and sys.
FreeMemory freeMemory(const std::filesystem::path& root = "/");

// Throws std::runtime_error if `needed` bytes exceed the free memory: "WHAT: needs about 3.1 GB, 2.0 GB
// are free here (ulimit -v); REMEDY".
void checkMemory(const std::string& what, std::uint64_t needed, const std::string& remedy,
                 const FreeMemory& free = freeMemory());

}  // namespace diptych
