// SPDX-License-Identifier: MIT
// Free memory, from made-up kernel files.
#include "shared/image/free_memory.h"
#include "tests/support/files.h"

#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>
#include <string>

namespace diptych {
namespace {

constexpr std::uint64_t kib = 1024, gib = std::uint64_t{1} << 30;

class FreeMemoryOf : public testing::Test {
protected:
    void write(const std::string& file, const std::string& text) const {
        const std::filesystem::path path = root_ / file;
        std::filesystem::create_directories(path.parent_path());
        std::ofstream(path) << text;
    }
    // 20 GiB of the machine's memory are free, and no limit is set.
    void SetUp() override {
        write("proc/meminfo",
              "MemTotal:       33554432 kB\nMemFree:  1024 kB\nMemAvailable:   20971520 kB\n");
        write("proc/self/status", "VmPeak:\t 4194304 kB\nVmSize:\t 2097152 kB\nVmData:\t 1048576 kB\n");
        write("proc/self/limits",
              "Limit                     Soft Limit           Hard Limit           Units     \n"
              "Max data size             unlimited            unlimited            bytes     \n"
              "Max address space         unlimited            unlimited            bytes     \n");
    }
    void expect(std::uint64_t bytes, const std::string& limit) const {
        const FreeMemory free = freeMemory(root_);
        EXPECT_EQ(free.bytes, bytes);
        EXPECT_EQ(free.limit, limit);
    }

    const std::filesystem::path root_ = folder();
};

TEST_F(FreeMemoryOf, AMachineWithoutLimits) {
    expect(20 * gib, "this machine");
}

TEST_F(FreeMemoryOf, NoFilesAtAllSetNoLimit) {
    const FreeMemory free = freeMemory(root_ / "nowhere");
    EXPECT_EQ(free.bytes, UINT64_MAX);
    EXPECT_NO_THROW(checkMemory("diff", UINT64_MAX, "nothing helps", free));
}

TEST_F(FreeMemoryOf, TheProcessesLimitsCountWhatItHas) {
    write("proc/self/limits",
          "Max data size             5368709120           unlimited            bytes     \n"
          "Max address space         5368709120           5368709120           bytes     \n");
    expect(3 * gib, "ulimit -v");
    write("proc/self/limits",
          "Max data size             1073742848           unlimited            bytes     \n"
          "Max address space         5368709120           5368709120           bytes     \n");
    expect(kib, "ulimit -d");
    write("proc/self/limits",
          "Max address space         1073741824           1073741824           bytes     \n");
    expect(0, "ulimit -v");
}

TEST_F(FreeMemoryOf, OfCgroupsTheTightestOnTheWayUp) {
    write("proc/self/cgroup", "0::/user.slice/job.scope\n");
    write("sys/fs/cgroup/user.slice/job.scope/memory.max", "8589934592\n");
    write("sys/fs/cgroup/user.slice/job.scope/memory.high", "max\n");
    write("sys/fs/cgroup/user.slice/job.scope/memory.current", "3221225472\n");
    expect(5 * gib, "a cgroup");
    // Cached files can be evicted; shared memory cannot.
    write("sys/fs/cgroup/user.slice/job.scope/memory.stat",
          "anon 1\nfile 9\nshmem 5\ninactive_anon 7\nactive_anon 3\ninactive_file 1073741824\n"
          "active_file 1073741824\n");
    expect(7 * gib, "a cgroup");
    write("sys/fs/cgroup/user.slice/memory.max", "max\n");
    write("sys/fs/cgroup/user.slice/memory.high", "6442450944\n");
    write("sys/fs/cgroup/user.slice/memory.current", "4294967296\n");
    expect(2 * gib, "a cgroup");
}

// In a container the path may be the host's; the container's own cgroup is at the mount point.
TEST_F(FreeMemoryOf, FirstVersionsCgroups) {
    write("proc/self/cgroup", "12:cpu,cpuacct:/docker/0123\n5:memory:/docker/0123\n0::/docker/0123\n");
    write("sys/fs/cgroup/memory/memory.limit_in_bytes", "4294967296\n");
    write("sys/fs/cgroup/memory/memory.usage_in_bytes", "3221225472\n");
    expect(gib, "a cgroup");
    write("sys/fs/cgroup/memory/memory.stat",
          "inactive_file 5\ntotal_inactive_file 1073741824\ntotal_active_file 1024\n");
    expect(2 * gib + kib, "a cgroup");
    write("sys/fs/cgroup/memory/memory.limit_in_bytes", "9223372036854771712\n");
    expect(20 * gib, "this machine");
}

TEST_F(FreeMemoryOf, ARefusalIsOneLineWithBothNumbers) {
    const FreeMemory free{2'000'000'000, "ulimit -v"};
    EXPECT_NO_THROW(checkMemory("diff", 2'000'000'000, "take less", free));
    try {
        checkMemory("diff of a.png and b.png, 16384x16384", 3'100'000'000, "compare smaller pictures", free);
        ADD_FAILURE();
    } catch (const std::runtime_error& e) {
        EXPECT_STREQ(e.what(),
                     "diff of a.png and b.png, 16384x16384: needs about 3.1 GB, but only 2.0 GB are free "
                     "(ulimit -v); compare smaller pictures");
    }
}

// This machine has some free memory, and less than 1 PiB.
TEST(FreeMemoryHere, IsSome) {
    const FreeMemory free = freeMemory();
    EXPECT_GT(free.bytes, std::uint64_t{16} << 20);
    EXPECT_LT(free.bytes, std::uint64_t{1} << 50);
}

}  // namespace
}  // namespace diptych
