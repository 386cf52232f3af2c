// SPDX-License-Identifier: MIT
#include "shared/image/free_memory.h"

#include <fmt/format.h>

#include <charconv>
#include <fstream>
#include <initializer_list>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace diptych {
namespace {

namespace fs = std::filesystem;

std::optional<std::uint64_t> numberIn(std::string_view word) {
    std::uint64_t value = 0;
    const auto [rest, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || rest != word.data() + word.size()) return {};
    return value;
}

std::vector<std::string> linesOf(const fs::path& file) {
    std::vector<std::string> lines;
    std::ifstream stream(file);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

// The first number after `label` at the beginning of a line; none if it is a word ("unlimited").
std::optional<std::uint64_t> labelled(const fs::path& file, std::string_view label) {
    for (const std::string& line : linesOf(file))
        if (line.starts_with(label)) {
            std::istringstream words(line.substr(label.size()));
            std::string word;
            words >> word;
            return numberIn(word);
        }
    return {};
}

// The number in a file; none if it has a word ("max").
std::optional<std::uint64_t> numberOf(const fs::path& file) {
    const std::vector<std::string> lines = linesOf(file);
    return lines.empty() ? std::nullopt : numberIn(lines.front());
}

class Least {
public:
    // Lowers the minimum to `limit` - `used`, if there is a limit.
    void take(std::optional<std::uint64_t> limit, std::uint64_t used, const char* name) {
        if (!limit) return;
        const std::uint64_t left = *limit > used ? *limit - used : 0;
        if (left < free.bytes) free = {left, name};
    }
    FreeMemory free;
};

constexpr std::uint64_t kilobyte = 1024;  // the unit "kB" in /proc

void takeMachine(const fs::path& root, Least& min) {
    if (const auto available = labelled(root / "proc/meminfo", "MemAvailable:"))
        min.take(*available * kilobyte, 0, "this machine");
}

// File names of one cgroup version.
struct CgroupFiles {
    std::initializer_list<const char*> limits;
    const char* used;
    std::initializer_list<const char*> cached;  // in memory.stat: file pages, which the kernel can drop
};

// Visits a cgroup and its ancestors up to the mount point. In a container, the path may be the host's, and
// only its end is mounted, so missing folders are skipped.
void takeCgroups(const fs::path& mount, const std::string& path, const CgroupFiles& files, Least& min) {
    for (fs::path folder = fs::path(path).relative_path();; folder = folder.parent_path()) {
        const fs::path at = mount / folder;
        if (const auto used = numberOf(at / files.used)) {
            std::uint64_t cached = 0;
            for (const char* name : files.cached)
                cached += labelled(at / "memory.stat", std::string(name) + " ").value_or(0);
            for (const char* limit : files.limits)
                min.take(numberOf(at / limit), *used > cached ? *used - cached : 0, "a cgroup");
        }
        if (folder.empty()) return;
    }
}

// Lines of /proc/self/cgroup: "0::/path" in version 2, "5:memory:/path" in version 1.
void takeCgroups(const fs::path& root, Least& min) {
    const fs::path mount = root / "sys/fs/cgroup";
    for (const std::string& line : linesOf(root / "proc/self/cgroup")) {
        const std::size_t first = line.find(':'), second = line.find(':', first + 1);
        if (first == line.npos || second == line.npos) continue;
        const std::string controllers = fmt::format(",{},", line.substr(first + 1, second - first - 1));
        const std::string path = line.substr(second + 1);
        if (controllers == ",,") {
            const CgroupFiles files{
                {"memory.max", "memory.high"}, "memory.current", {"inactive_file", "active_file"}};
            takeCgroups(mount, path, files, min);
        } else if (controllers.find(",memory,") != controllers.npos) {
            takeCgroups(mount / "memory", path,
                        {{"memory.limit_in_bytes"},
                         "memory.usage_in_bytes",
                         {"total_inactive_file", "total_active_file"}},
                        min);
        }
    }
}

void takeLimits(const fs::path& root, Least& min) {
    struct Row {
        const char *limit, *used, *name;
    };
    for (const Row& row :
         {Row{"Max address space", "VmSize:", "ulimit -v"}, Row{"Max data size", "VmData:", "ulimit -d"}})
        if (const auto limit = labelled(root / "proc/self/limits", row.limit))
            min.take(limit, labelled(root / "proc/self/status", row.used).value_or(0) * kilobyte, row.name);
}

std::string gigabytes(std::uint64_t bytes) {
    return fmt::format("{:.1f} GB", static_cast<double>(bytes) / 1e9);
}

}  // namespace

FreeMemory freeMemory(const fs::path& root) {
    Least min;
    takeMachine(root, min);
    takeCgroups(root, min);
    takeLimits(root, min);
    return min.free;
}

void checkMemory(const std::string& what, std::uint64_t needed, const std::string& remedy,
                 const FreeMemory& free) {
    if (needed > free.bytes)
        throw std::runtime_error(fmt::format("{}: needs about {}, but only {} are free ({}); {}", what,
                                             gigabytes(needed), gigabytes(free.bytes), free.limit, remedy));
}

}  // namespace diptych
