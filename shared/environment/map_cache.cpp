// SPDX-License-Identifier: MIT
#include "shared/environment/map_cache.h"

#include "shared/image/atomic_file.h"
#include "shared/vulkan/instance/user_cache.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <ctime>
#include <exception>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace diptych {

namespace {

namespace fs = std::filesystem;

// Increase it whenever the computation of maps changes.
constexpr std::uint64_t mapVersion = 5;

// Hashes one word at a time by SplitMix64's finalizer (Steele, Lea and Flood 2014).
class MapHash {
public:
    void add(std::uint64_t word) {
        std::uint64_t z = (value_ ^ word) + 0x9e3779b97f4a7c15u;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        value_ = z ^ (z >> 31);
    }
    void add(std::span<const float> floats) {
        add(floats.size());
        std::size_t i = 0;
        for (; i + 2 <= floats.size(); i += 2) {
            std::uint64_t word = 0;
            std::memcpy(&word, floats.data() + i, sizeof word);
            add(word);
        }
        if (i < floats.size()) add(std::bit_cast<std::uint32_t>(floats[i]));
    }
    std::uint64_t value() const { return value_; }

private:
    std::uint64_t value_ = 0;
};

// File header. Floats follow: the harmonics, then each map after its side.
struct MapFileHead {
    std::array<char, 8> magic{'d', 'i', 'p', 't', 'e', 'n', 'v', '1'};
    std::uint64_t key = 0, maps = 0, floats = 0, hash = 0;
};
static_assert(std::has_unique_object_representations_v<MapFileHead>);

std::vector<float> flattened(const EnvironmentMaps& maps) {
    std::vector<float> floats;
    for (const glm::dvec3& c : maps.harmonics)
        for (int i = 0; i < 3; ++i) {
            // A double is stored as the bits of two floats.
            const auto halves = std::bit_cast<std::array<float, 2>>(c[i]);
            floats.insert(floats.end(), halves.begin(), halves.end());
        }
    const auto add = [&](const NodeMap& map) {
        floats.push_back(static_cast<float>(map.side));
        for (int y = 0; y < map.side; ++y)
            for (int x = 0; x < map.side; ++x) {
                const Texel& t = map.at(x, y);
                floats.insert(floats.end(), {t[0], t[1], t[2]});
            }
    };
    add(maps.diffuse);
    for (const NodeMap& level : maps.levels) add(level);
    return floats;
}

constexpr std::size_t harmonicFloats = 9 * 3 * 2;

std::uint64_t floatsOf(const MapSides& sides) {
    const auto of = [](int side) {
        return 1 + 3 * static_cast<std::uint64_t>(side) * static_cast<std::uint64_t>(side);
    };
    std::uint64_t floats = harmonicFloats + of(sides.diffuse);
    for (const int side : sides.levels) floats += of(side);
    return floats;
}

// Empty if the maps have other sides. `floats` has floatsOf(sides) elements.
std::optional<EnvironmentMaps> unflattened(std::span<const float> floats, const MapSides& sides) {
    EnvironmentMaps maps;
    for (std::size_t i = 0; i < harmonicFloats; i += 2)
        maps.harmonics[i / 6][static_cast<int>(i / 2 % 3)] =
            std::bit_cast<double>(std::array<float, 2>{floats[i], floats[i + 1]});
    const float* next = floats.data() + harmonicFloats;
    const auto take = [&](NodeMap& map, int side) {
        if (*next++ != static_cast<float>(side)) return false;
        map = NodeMap(side);
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x, next += 3) map.at(x, y) = Texel{next[0], next[1], next[2], 0};
        return true;
    };
    if (!take(maps.diffuse, sides.diffuse)) return {};
    for (const int side : sides.levels)
        if (!take(maps.levels.emplace_back(), side)) return {};
    return maps;
}

}  // namespace

std::uint64_t mapKey(const Environment& environment, const EnvironmentRequest& request) {
    MapHash hash;
    hash.add(mapVersion);
    hash.add(static_cast<std::uint64_t>(environment.radiance.width));
    hash.add(static_cast<std::uint64_t>(environment.radiance.height));
    hash.add(std::span<const float>(environment.radiance.data.data(), environment.radiance.data.size()));
    hash.add(static_cast<std::uint64_t>(request.quality.samples));
    hash.add(std::bit_cast<std::uint32_t>(request.quality.bias));
    hash.add(static_cast<std::uint64_t>(request.prefilter));
    return hash.value();
}

fs::path mapCacheFile(const fs::path& folder, std::uint64_t key) {
    return folder / fmt::format("environment-{:016x}", key);
}

std::optional<EnvironmentMaps> readMaps(const fs::path& file, std::uint64_t key, const MapSides& sides) {
    const CacheFile opened = openCacheFile(file);
    std::FILE* const stream = opened.stream.get();
    MapFileHead head;
    if (!stream || std::fread(&head, sizeof head, 1, stream) != 1) return {};
    // Checks sizes before allocating.
    if (head.magic != MapFileHead{}.magic || head.key != key || head.maps != 1 + sides.levels.size() ||
        head.floats != floatsOf(sides) || opened.bytes != sizeof head + head.floats * sizeof(float))
        return {};
    std::vector<float> floats(head.floats);
    if (std::fread(floats.data(), sizeof(float), floats.size(), stream) != floats.size()) return {};
    MapHash hash;
    hash.add(head.maps);
    hash.add(floats);
    if (hash.value() != head.hash) return {};
    // Updates the file time: recently read files are removed last.
    ::futimens(::fileno(stream), nullptr);
    return unflattened(floats, sides);
}

bool writeMaps(const fs::path& file, std::uint64_t key, const EnvironmentMaps& maps) {
    try {
        OpenFolder folder = makeCacheFolder(file.parent_path());
        if (!folder.isOpen()) return false;
        folder.pin();
        const std::vector<float> floats = flattened(maps);
        MapFileHead head;
        head.key = key;
        head.maps = 1 + maps.levels.size();
        head.floats = floats.size();
        MapHash hash;
        hash.add(head.maps);
        hash.add(floats);
        head.hash = hash.value();
        AtomicFile out(file);
        cacheForUser(out.stream());
        std::fwrite(&head, sizeof head, 1, out.stream());
        std::fwrite(floats.data(), sizeof(float), floats.size(), out.stream());
        out.commit();
        return true;
    } catch (const std::exception&) {  // a full disk or a read-only folder: computed again next time
        return false;
    }
}

void limitMapCache(const fs::path& path, std::uintmax_t max) {
    const OpenFolder folder = makeCacheFolder(path);
    std::vector<std::pair<std::string, struct stat>> files;
    std::uintmax_t sum = 0;
    for (const std::string& name : folder.names()) {
        // A killed writer leaves a temporary file, whose name begins with a dot.
        const bool temporary = name.starts_with(".environment-");
        if (!temporary && !name.starts_with("environment-")) continue;
        const struct stat there = folder.status(name);  // another process may clean the same folder
        if (!S_ISREG(there.st_mode)) continue;
        if (temporary && ::time(nullptr) - there.st_mtime > 3600) {
            folder.removeFile(name);
            continue;
        }
        files.emplace_back(name, there);
        sum += static_cast<std::uintmax_t>(there.st_size);
    }
    std::ranges::sort(files, {}, [](const auto& file) {
        return std::pair(file.second.st_mtim.tv_sec, file.second.st_mtim.tv_nsec);
    });
    for (const auto& [name, there] : files) {
        if (sum <= max) return;
        if (folder.removeFile(name) == 0) sum -= static_cast<std::uintmax_t>(there.st_size);
    }
}

EnvironmentMaps environmentMaps(const Environment& environment, const EnvironmentRequest& request,
                                const fs::path& folder, bool* wasCached) {
    if (wasCached) *wasCached = false;
    if (folder.empty()) return makeEnvironmentMaps(environment, request);
    const std::uint64_t key = mapKey(environment, request);
    const fs::path file = mapCacheFile(folder, key);
    const MapSides sides =
        mapSides(environment.radiance.width, environment.radiance.height, request.prefilter);
    if (std::optional<EnvironmentMaps> maps = readMaps(file, key, sides)) {
        if (wasCached) *wasCached = true;
        return std::move(*maps);
    }
    EnvironmentMaps maps = makeEnvironmentMaps(environment, request);
    if (writeMaps(file, key, maps)) limitMapCache(folder);
    return maps;
}

}  // namespace diptych
