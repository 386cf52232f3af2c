// SPDX-License-Identifier: MIT
// Filtered environments that are kept on disk.
#include "shared/environment/map_cache.h"
#include "tests/unit/files.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <fstream>
#include <functional>
#include <thread>
#include <vector>

namespace diptych {
namespace {

namespace fs = std::filesystem;

Environment smallSky() {
    Environment sky{"sky", Image(8, 4, 3)};
    for (std::size_t i = 0; i < sky.radiance.data.size(); ++i)
        sky.radiance.data[i] = static_cast<float>(i % 7) / 3;
    return sky;
}

constexpr EnvironmentRequest coarseMaps{{8, 1}, true};

bool equal(const NodeMap& a, const NodeMap& b) {
    if (a.side != b.side) return false;
    for (int y = 0; y < a.side; ++y)
        for (int x = 0; x < a.side; ++x)
            for (int c = 0; c < 4; ++c)
                if (a.at(x, y)[c] != b.at(x, y)[c]) return false;
    return true;
}
bool equal(const EnvironmentMaps& a, const EnvironmentMaps& b) {
    if (a.harmonics != b.harmonics || !equal(a.diffuse, b.diffuse) || a.levels.size() != b.levels.size())
        return false;
    for (std::size_t i = 0; i < a.levels.size(); ++i)
        if (!equal(a.levels[i], b.levels[i])) return false;
    return true;
}

TEST(MapCache, WhatIsKeptIsWhatWasMade) {
    const fs::path in = folder();
    const Environment sky = smallSky();
    bool kept = true;
    const EnvironmentMaps made = environmentMaps(sky, coarseMaps, in / "below", &kept);
    EXPECT_FALSE(kept);
    const EnvironmentMaps read = environmentMaps(sky, coarseMaps, in / "below", &kept);
    EXPECT_TRUE(kept);
    EXPECT_TRUE(equal(made, read));
    EXPECT_TRUE(equal(made, makeEnvironmentMaps(sky, coarseMaps)));
    environmentMaps(sky, coarseMaps, {}, &kept);
    EXPECT_FALSE(kept) << "without a folder";
}

TEST(MapCache, TheKeyIsOfAllThatDecides) {
    const std::uint64_t key = mapKey(smallSky(), coarseMaps);
    EXPECT_EQ(mapKey(smallSky(), coarseMaps), key);
    Environment other = smallSky();
    other.radiance.data.back() = 9;
    EXPECT_NE(mapKey(other, coarseMaps), key);
    other = smallSky();
    std::swap(other.radiance.width, other.radiance.height);
    EXPECT_NE(mapKey(other, coarseMaps), key);
    for (const EnvironmentRequest& request :
         {EnvironmentRequest{{9, 1}, true}, {{8, 2}, true}, {{8, 1}, false}})
        EXPECT_NE(mapKey(smallSky(), request), key);
    other = smallSky();
    other.name = "elsewhere";
    EXPECT_EQ(mapKey(other, coarseMaps), key) << "the same pixels of another file";
}

TEST(MapCache, WhatAKilledWriterLeftIsRemoved) {
    const fs::path in = folder();
    const fs::path old = in / ".environment-0123456789abcdef.99-0.tmp",
                   recent = in / ".environment-0123456789abcdef.98-0.tmp", other = in / ".other.tmp";
    for (const fs::path& file : {old, recent, other}) std::ofstream(file) << "part";
    for (const fs::path& file : {old, other})
        fs::last_write_time(file, fs::file_time_type::clock::now() - std::chrono::hours(2));
    limitMapCache(in);
    EXPECT_FALSE(fs::exists(old));
    EXPECT_TRUE(fs::exists(recent)) << "another program may be writing it";
    EXPECT_TRUE(fs::exists(other));
}

TEST(MapCache, WhatIsDamagedIsMadeAnew) {
    const fs::path in = folder();
    const Environment sky = smallSky();
    const std::uint64_t key = mapKey(sky, coarseMaps);
    const fs::path file = mapCacheFile(in, key);
    const EnvironmentMaps made = environmentMaps(sky, coarseMaps, in);
    const auto size = fs::file_size(file);
    const auto flip = [&](std::uintmax_t at) {
        std::fstream stream(file, std::ios::binary | std::ios::in | std::ios::out);
        stream.seekg(static_cast<std::streamoff>(at));
        const int byte = stream.get();
        stream.seekp(static_cast<std::streamoff>(at));
        stream.put(static_cast<char>(byte ^ 0x10));
    };
    const std::function<void()> damages[] = {[&] { flip(0); },
                                             [&] { flip(9); },
                                             [&] { flip(17); },
                                             [&] { flip(size / 2); },
                                             [&] { flip(size - 1); },
                                             [&] { fs::resize_file(file, size - 4); },
                                             [&] { fs::resize_file(file, size + 4); },
                                             [&] { fs::resize_file(file, 20); },
                                             [&] { fs::resize_file(file, 0); }};
    for (const auto& damage : damages) {
        damage();
        EXPECT_FALSE(readMaps(file, key));
        bool kept = true;
        EXPECT_TRUE(equal(environmentMaps(sky, coarseMaps, in, &kept), made));
        EXPECT_FALSE(kept);
        EXPECT_TRUE(readMaps(file, key)) << "and it is whole again";
    }
    EXPECT_FALSE(readMaps(file, key + 1)) << "another's";
}

TEST(MapCache, SeveralProgramsAtOnceLeaveOneWholeFile) {
    const fs::path in = folder();
    const Environment sky = smallSky();
    const std::uint64_t key = mapKey(sky, coarseMaps);
    const EnvironmentMaps maps = makeEnvironmentMaps(sky, coarseMaps);
    const fs::path file = mapCacheFile(in, key);
    ASSERT_TRUE(writeMaps(file, key, maps));
    std::vector<std::thread> writers;
    std::atomic<int> unread{0};
    for (int i = 0; i < 4; ++i)
        writers.emplace_back([&, i] {
            for (int round = 0; round < 20; ++round)
                if (i % 2 == 0)
                    writeMaps(file, key, maps);
                else
                    unread += !readMaps(file, key);
        });
    for (std::thread& writer : writers) writer.join();
    EXPECT_EQ(unread, 0) << "nothing half written was ever there";
    EXPECT_EQ(std::distance(fs::directory_iterator(in), fs::directory_iterator()), 1);
}

TEST(MapCache, TheFolderHasALimit) {
    const fs::path in = folder();
    const auto now = fs::file_time_type::clock::now();
    for (int i = 0; i < 4; ++i) {
        const fs::path file = mapCacheFile(in, static_cast<std::uint64_t>(i));
        std::ofstream(file) << std::string(100, 'x');
        fs::last_write_time(file, now - std::chrono::hours(10 - i));
    }
    std::ofstream(in / "pipelines-0") << std::string(1000, 'x');
    limitMapCache(in, 250);
    EXPECT_FALSE(fs::exists(mapCacheFile(in, 0)));
    EXPECT_FALSE(fs::exists(mapCacheFile(in, 1)));
    EXPECT_TRUE(fs::exists(mapCacheFile(in, 2)));
    EXPECT_TRUE(fs::exists(mapCacheFile(in, 3)));
    EXPECT_TRUE(fs::exists(in / "pipelines-0")) << "somebody else's";
    limitMapCache(in / "none", 1);
}

TEST(MapCache, AFolderThatCannotBeWrittenIsDoneWithout) {
    const fs::path in = folder();
    std::ofstream(in / "file") << "no folder";
    bool kept = true;
    EXPECT_TRUE(equal(environmentMaps(smallSky(), coarseMaps, in / "file", &kept),
                      makeEnvironmentMaps(smallSky(), coarseMaps)));
    EXPECT_FALSE(kept);
}

}  // namespace
}  // namespace diptych
