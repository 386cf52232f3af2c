// SPDX-License-Identifier: MIT
// Partitions scenes among programs. The result depends only on the command's inputs, so each program
// computes it independently.
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

// The index-th of count shards, counted from 1.
struct Shard {
    int index = 1, count = 1;
    bool operator==(const Shard&) const = default;
};

// Limits the size of shard lists. Slurm's default limit is 1,001 tasks per array.
inline constexpr int max_shards = 1 << 16;

// Value of an environment variable; empty if not set.
using Variables = std::function<std::optional<std::string>(const char*)>;

// Parses --shard.
//   "2/16"       itself
//   "slurm"      of a regular Slurm array: SLURM_ARRAY_TASK_ID of _MIN, _STEP and _MAX
//   "slurm/16"   SLURM_ARRAY_TASK_ID, 1 to 16, of any array
// Throws std::runtime_error, one line, if there is no such shard, no array, or an irregular one. Slurm
// does not tell tasks the others of an irregular array.
Shard shardOf(const std::string& word, const Variables& environment);

// The scene's file, and buffers and images named in its JSON. Empty for built-in scenes; only the file
// itself if it is not glTF.
std::vector<std::filesystem::path> filesOf(const std::string& scene);

// Total size of filesOf(); missing files count 0.
std::uint64_t bytesOf(const std::string& scene);

// Time of each scene, ms, in an earlier report.json or its folder. Throws std::runtime_error naming the
// file if it is not a report.
std::map<std::string, double> timingsOf(const std::filesystem::path& report);

// Relative cost of each scene: its time, or else its bytes plus those of rendering, so that small scenes
// have a cost too. With some timings, bytes are scaled to time by the scenes that have both.
std::vector<double> weightsOf(const std::vector<std::string>& scenes,
                              const std::map<std::string, double>& timings);

// Shard of each scene, 1 to count. Assigns the longest scene first, each to the least loaded shard: at
// most 4/3 of the optimum (Graham 1969, "Bounds on Multiprocessing Timing Anomalies"). Ties: the earlier
// scene first; the shard with fewer scenes, then the earlier one.
std::vector<int> partition(const std::vector<double>& weights, int count);

}  // namespace diptych::shards
