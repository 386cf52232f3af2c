// SPDX-License-Identifier: MIT
// Which scenes of many one of several programs takes. It depends on nothing but what the command is given:
// every program works it out for itself, and all come to the same.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace diptych::shards {

// The index-th of count, from 1.
struct Shard {
    int index = 1, count = 1;
    bool operator==(const Shard&) const = default;
};

// Each has an entry where shares are counted and a line where it is missing. Slurm's arrays have 1,001 tasks
// unless a cluster is set up for more.
inline constexpr int most_shards = 1 << 16;

// An environment variable, where it is set.
using Variables = std::function<std::optional<std::string>(const char*)>;

// What --shard says.
//   "2/16"       itself
//   "slurm"      of a regular Slurm array: SLURM_ARRAY_TASK_ID of _MIN, _STEP and _MAX
//   "slurm/16"   SLURM_ARRAY_TASK_ID, 1 to 16, of any array
// Throws std::runtime_error, one line, where it says no shard, or the array is none, or irregular: Slurm does
// not tell its tasks which others such an array has.
Shard shardOf(const std::string& word, const Variables& environment);

// The scene's file and those that its JSON names: buffers and pictures. Empty of a built-in scene, and of
// what is no glTF file.
std::vector<std::filesystem::path> filesOf(const std::string& scene);

// The bytes of filesOf(); files that are not there have none.
std::uint64_t bytesOf(const std::string& scene);

// What each scene took, ms, in an earlier report: of a report.json or the folder that it is in. Throws
// std::runtime_error naming the file where it is none.
std::map<std::string, double> timingsOf(const std::filesystem::path& report);

// What each scene will take, as a share of anything: the time that it took, or else its bytes. Beside its
// bytes a scene takes what drawing takes, so that small ones are not for nothing. With timings, a scene
// without one takes what those with one take for its bytes.
std::vector<double> weightsOf(const std::vector<std::string>& scenes,
                              const std::map<std::string, double>& timings);

// The shard, 1 to count, of each scene: longest first, each to the shard that has least to do so far (Graham
// 1969, "Bounds on Multiprocessing Timing Anomalies": no shard takes longer than 4/3 of the best partition).
// Of equal weights the earlier scene comes first, of equal shards that with fewer scenes, then the earlier.
std::vector<int> partition(const std::vector<double>& weights, int count);

}  // namespace diptych::shards
