// SPDX-License-Identifier: MIT
// Disk cache of filtered environments.
#include "shared/environment/map_cache.h"
#include "tests/support/files.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <bit>
#include <chrono>
#include <cstring>
#include <fstream>
#include <functional>
#include <limits>
#include <random>
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
const MapSides coarseSides = mapSides(8, 4, true);

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
        EXPECT_FALSE(readMaps(file, key, coarseSides));
        bool kept = true;
        EXPECT_TRUE(equal(environmentMaps(sky, coarseMaps, in, &kept), made));
        EXPECT_FALSE(kept);
        EXPECT_TRUE(readMaps(file, key, coarseSides)) << "and it is whole again";
    }
    EXPECT_FALSE(readMaps(file, key + 1, coarseSides)) << "another's";
}

TEST(MapCache, SidesAreThoseOfTheMaps) {
    for (const auto& [width, height] : {std::pair{8, 4}, {70, 30}, {64, 64}})
        for (const bool prefilter : {true, false}) {
            const EnvironmentMaps maps =
                makeEnvironmentMaps({"sky", Image(width, height, 3)}, {{1, 0}, prefilter});
            std::vector<int> sides;
            for (const NodeMap& level : maps.levels) sides.push_back(level.side);
            EXPECT_EQ(mapSides(width, height, prefilter).levels, sides) << width << " " << prefilter;
            EXPECT_EQ(mapSides(width, height, prefilter).diffuse, maps.diffuse.side);
        }
    // Halved twice, to 1024 texels a side.
    EXPECT_EQ(mapSides(16384, 8192, true).levels.front(), 1025);
}

// A forged file with a correct hash.
class Forged {
public:
    explicit Forged(const fs::path& file) {
        const std::string bytes = contentsOf(file);
        std::memcpy(head.data(), bytes.data(), sizeof head);
        floats.resize((bytes.size() - sizeof head) / sizeof(float));
        std::memcpy(floats.data(), bytes.data() + sizeof head, floats.size() * sizeof(float));
    }
    void write(const fs::path& file) {
        std::uint64_t z = 0;
        const auto add = [&](std::uint64_t word) {  // SplitMix64's finaliser, as in map_cache.cpp
            z = (z ^ word) + 0x9e3779b97f4a7c15u;
            z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
            z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
            z ^= z >> 31;
        };
        add(head[2]);
        add(floats.size());
        for (std::size_t i = 0; i < floats.size(); i += 2) {
            std::uint64_t word = 0;
            std::memcpy(&word, &floats[i], std::min<std::size_t>(2, floats.size() - i) * sizeof(float));
            add(word);
        }
        head[4] = z;
        std::ofstream stream(file, std::ios::binary);
        stream.write(reinterpret_cast<const char*>(head.data()), sizeof head);
        stream.write(reinterpret_cast<const char*>(floats.data()),
                     static_cast<std::streamsize>(floats.size() * sizeof(float)));
    }
    std::array<std::uint64_t, 5> head{};  // magic, key, maps, floats, hash
    std::vector<float> floats;
};
constexpr std::size_t harmonicFloats = 54;

TEST(MapCache, ForgedShapesAreRefused) {
    const fs::path in = folder();
    const Environment sky = smallSky();
    const std::uint64_t key = mapKey(sky, coarseMaps);
    const fs::path file = mapCacheFile(in, key);
    environmentMaps(sky, coarseMaps, in);
    const Forged whole(file);
    Forged(whole).write(file);
    ASSERT_TRUE(readMaps(file, key, coarseSides)) << "the control: forged as it was";
    const std::function<void(Forged&)> forgeries[] = {
        [](Forged& f) {  // no level
            f.floats.resize(harmonicFloats + 1 + 3 * 33 * 33);
            f.head[2] = 1;
            f.head[3] = f.floats.size();
        },
        [](Forged& f) {  // no maps
            f.floats.resize(harmonicFloats);
            f.head[2] = 0;
            f.head[3] = f.floats.size();
        },
        [](Forged& f) { f.floats[harmonicFloats] = 16384; },
        [](Forged& f) { f.floats[harmonicFloats] = -1; },
        [](Forged& f) { f.floats[harmonicFloats] = std::numeric_limits<float>::quiet_NaN(); },
        [](Forged& f) { f.head[2] = ~std::uint64_t{0}; },
        [](Forged& f) { f.head[3] = std::uint64_t{1} << 62; },
        [](Forged& f) { f.head[3] += std::uint64_t{1} << 62; },  // the same number of bytes modulo 2^64
    };
    for (const auto& forge : forgeries) {
        Forged forged = whole;
        forge(forged);
        forged.write(file);
        EXPECT_FALSE(readMaps(file, key, coarseSides)) << &forge - forgeries;
    }
    // A sparse file of 4 GB with a matching header.
    Forged huge = whole;
    huge.head[3] = (std::uint64_t{1} << 32) / sizeof(float);
    huge.write(file);
    fs::resize_file(file, sizeof huge.head + (std::uint64_t{1} << 32));
    EXPECT_FALSE(readMaps(file, key, coarseSides));
}

// Any bytes: the result is nothing, or maps of the requested size.
TEST(MapCache, AnyBytesAreMapsOrNothing) {
    const fs::path in = folder();
    const Environment sky{"sky", Image(1, 1, 3)};
    const EnvironmentRequest request{{1, 0}, false};
    const MapSides sides = mapSides(1, 1, false);
    const std::uint64_t key = mapKey(sky, request);
    const fs::path file = mapCacheFile(in, key);
    environmentMaps(sky, request, in);
    const Forged whole(file);
    std::mt19937_64 random(20261127);
    const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
    int read = 0;
    for (int round = 0; round < 200; ++round) {
        Forged forged = whole;
        for (std::size_t edits = 1 + below(3); edits > 0; --edits) switch (below(6)) {
                case 0:
                    forged.head[below(4)] ^= std::uint64_t{1} << below(64);
                    break;
                case 1:
                    forged.head[2 + below(2)] = random() >> below(64);
                    break;
                case 2:
                    forged.floats.resize(below(2 * whole.floats.size()));
                    forged.head[3] = forged.floats.size();
                    break;
                case 3:
                    if (!forged.floats.empty())
                        forged.floats[below(forged.floats.size())] =
                            std::bit_cast<float>(static_cast<std::uint32_t>(random()));
                    break;
                case 4:
                    if (forged.floats.size() > harmonicFloats)
                        forged.floats[harmonicFloats] = static_cast<float>(below(20000));
                    break;
                default:
                    if (!forged.floats.empty()) forged.floats.pop_back();
                    break;
            }
        forged.write(file);
        const std::optional<EnvironmentMaps> maps = readMaps(file, key, sides);
        if (!maps) continue;
        ++read;
        ASSERT_EQ(maps->diffuse.side, sides.diffuse);
        ASSERT_EQ(maps->levels.size(), sides.levels.size());
        for (std::size_t i = 0; i < sides.levels.size(); ++i)
            ASSERT_EQ(maps->levels[i].side, sides.levels[i]);
    }
    EXPECT_GT(read, 5) << "texels may be any";
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
                    unread += !readMaps(file, key, coarseSides);
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
