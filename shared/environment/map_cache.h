// SPDX-License-Identifier: MIT
// Disk cache of filtered environments in the user's cache folder: one file per environment and request,
// named by a hash.
#pragma once

#include "shared/environment/environment_maps.h"

#include <cstdint>
#include <filesystem>
#include <optional>

namespace diptych {

// Size limit of one folder. The files that were not read for the longest time are removed first.
inline constexpr std::uintmax_t mapCacheBytes = std::uintmax_t{512} << 20;

// Hash of the pixels, the request and the version of the filter.
std::uint64_t mapKey(const Environment& environment, const EnvironmentRequest& request);
std::filesystem::path mapCacheFile(const std::filesystem::path& folder, std::uint64_t key);

// Empty if the file is missing, damaged or of another key, if its maps do not have `sides` (see
// mapSides()), or if other users can access it (see openCacheFile()).
std::optional<EnvironmentMaps> readMaps(const std::filesystem::path& file, std::uint64_t key,
                                        const MapSides& sides);
// Replaces the file atomically, also with concurrent writers. Returns whether it succeeded.
bool writeMaps(const std::filesystem::path& file, std::uint64_t key, const EnvironmentMaps& maps);
// Removes the oldest files until the folder has at most `max` bytes.
void limitMapCache(const std::filesystem::path& folder, std::uintmax_t max = mapCacheBytes);

// Reads the maps from the folder, or computes and stores them. Empty `folder`: no cache. `wasCached`:
// optional, set to whether they were read.
EnvironmentMaps environmentMaps(const Environment& environment, const EnvironmentRequest& request,
                                const std::filesystem::path& folder, bool* wasCached = nullptr);

}  // namespace diptych
