// SPDX-License-Identifier: MIT
#include "shared/environment/map_cache.h"

#include "shared/image/atomic_file.h"
#include "shared/text/input_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <cstring>
#include <exception>
#include <span>
#include <stdexcept>
#include <system_error>
#include <vector>

namespace diptych {

namespace {

namespace fs = std::filesystem;

// Increased whenever maps are made otherwise.
constexpr std::uint64_t mapVersion = 5;

// A word at a time through SplitMix64's finaliser (Steele, Lea and Flood 2014).
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

// How a file begins; floats follow: the harmonics, then each map, its side first.
struct MapFileHead {
    std::array<char, 8> magic{'d', 'i', 'p', 't', 'e', 'n', 'v', '1'};
    std::uint64_t key = 0, maps = 0, floats = 0, hash = 0;
};
static_assert(std::has_unique_object_representations_v<MapFileHead>);

std::vector<float> flattened(const EnvironmentMaps& maps) {
    std::vector<float> floats;
    for (const glm::dvec3& c : maps.harmonics)
        for (int i = 0; i < 3; ++i) {
            // A double is two floats of its bits.
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

// Nothing where the floats are not those of so many maps.
std::optional<EnvironmentMaps> unflattened(std::span<const float> floats, std::uint64_t count) {
    constexpr std::size_t harmonics = 9 * 3 * 2;
    if (floats.size() < harmonics || count < 1) return {};
    EnvironmentMaps maps;
    for (std::size_t i = 0; i < harmonics; i += 2)
        maps.harmonics[i / 6][static_cast<int>(i / 2 % 3)] =
            std::bit_cast<double>(std::array<float, 2>{floats[i], floats[i + 1]});
    floats = floats.subspan(harmonics);
    for (std::uint64_t number = 0; number < count; ++number) {
        constexpr float most = 16384;
        if (floats.empty() || !(floats[0] >= 1 && floats[0] <= most)) return {};
        NodeMap map(static_cast<int>(floats[0]));
        const std::size_t values = std::size_t{3} * static_cast<std::size_t>(map.side * map.side);
        if (floats.size() < 1 + values) return {};
        const float* next = floats.data() + 1;
        for (int y = 0; y < map.side; ++y)
            for (int x = 0; x < map.side; ++x, next += 3) map.at(x, y) = Texel{next[0], next[1], next[2], 0};
        floats = floats.subspan(1 + values);
        if (number == 0)
            maps.diffuse = std::move(map);
        else
            maps.levels.push_back(std::move(map));
    }
    if (!floats.empty()) return {};
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

std::optional<EnvironmentMaps> readMaps(const fs::path& file, std::uint64_t key) {
    MapFileHead head;
    std::vector<float> floats;
    try {
        InputFile cache(file);
        cache.read(std::as_writable_bytes(std::span(&head, 1)));
        const std::uint64_t size = cache.size();
        if (head.magic != MapFileHead{}.magic || head.key != key || head.floats > size / sizeof(float) ||
            size != sizeof head + head.floats * sizeof(float))
            return {};
        floats.resize(head.floats);
        cache.read(std::as_writable_bytes(std::span(floats)));
    } catch (const std::runtime_error&) {  // none, or none of ours: the maps are made
        return {};
    }
    std::error_code failed;
    MapHash hash;
    hash.add(head.maps);
    hash.add(floats);
    if (hash.value() != head.hash) return {};
    // What is read is needed: it goes last.
    fs::last_write_time(file, fs::file_time_type::clock::now(), failed);
    return unflattened(floats, head.maps);
}

bool writeMaps(const fs::path& file, std::uint64_t key, const EnvironmentMaps& maps) {
    try {
        fs::create_directories(file.parent_path());
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
        std::fwrite(&head, sizeof head, 1, out.stream());
        std::fwrite(floats.data(), sizeof(float), floats.size(), out.stream());
        out.commit();
        return true;
    } catch (const std::exception&) {  // a full disk, a folder that cannot be written: made again next time
        return false;
    }
}

void limitMapCache(const fs::path& folder, std::uintmax_t most) {
    struct Kept {
        fs::path file;
        fs::file_time_type time;
        std::uintmax_t bytes;
    };
    std::vector<Kept> files;
    std::error_code failed;
    std::uintmax_t sum = 0;
    for (fs::directory_iterator at(folder, failed), end; !failed && at != end; at.increment(failed)) {
        // A writer that was killed leaves its temporary file, whose name begins with a dot.
        const std::string name = at->path().filename().string();
        const bool temporary = name.starts_with(".environment-");
        if (!temporary && !name.starts_with("environment-")) continue;
        std::error_code gone;  // another program may limit the same folder
        const fs::file_time_type time = fs::last_write_time(at->path(), gone);
        if (temporary && !gone && fs::file_time_type::clock::now() - time > std::chrono::hours(1)) {
            fs::remove(at->path(), gone);
            continue;
        }
        const std::uintmax_t bytes = gone ? 0 : fs::file_size(at->path(), gone);
        if (gone) continue;
        files.push_back({at->path(), time, bytes});
        sum += bytes;
    }
    std::ranges::sort(files, {}, &Kept::time);
    for (const Kept& kept : files) {
        if (sum <= most) return;
        if (fs::remove(kept.file, failed)) sum -= kept.bytes;
    }
}

EnvironmentMaps environmentMaps(const Environment& environment, const EnvironmentRequest& request,
                                const fs::path& folder, bool* wasKept) {
    if (wasKept) *wasKept = false;
    if (folder.empty()) return makeEnvironmentMaps(environment, request);
    const std::uint64_t key = mapKey(environment, request);
    const fs::path file = mapCacheFile(folder, key);
    if (std::optional<EnvironmentMaps> maps = readMaps(file, key)) {
        if (wasKept) *wasKept = true;
        return std::move(*maps);
    }
    EnvironmentMaps maps = makeEnvironmentMaps(environment, request);
    if (writeMaps(file, key, maps)) limitMapCache(folder);
    return maps;
}

}  // namespace diptych
