// SPDX-License-Identifier: MIT
// Filtered environments on disk, in the user's cache folder: a file each, named after all that decides it.
#pragma once

#include "shared/environment/environment_maps.h"

#include <cstdint>
#include <filesystem>
#include <optional>

namespace diptych {

// What the files of one folder may hold together; the ones that were not read for longest go first.
inline constexpr std::uintmax_t mapCacheBytes = std::uintmax_t{512} << 20;

// Of the pixels and of the request, and of how maps are made: it changes whenever that does.
std::uint64_t mapKey(const Environment& environment, const EnvironmentRequest& request);
std::filesystem::path mapCacheFile(const std::filesystem::path& folder, std::uint64_t key);

// Nothing where there is no such file, or it is damaged, of another key, of maps that have not `sides`
// (mapSides()), or not this user's alone (openCacheFile()).
std::optional<EnvironmentMaps> readMaps(const std::filesystem::path& file, std::uint64_t key,
                                        const MapSides& sides);
// Whether it could be written, whole: it appears under its name at once, whoever else writes it too.
bool writeMaps(const std::filesystem::path& file, std::uint64_t key, const EnvironmentMaps& maps);
// Removes what is above `most` bytes together.
void limitMapCache(const std::filesystem::path& folder, std::uintmax_t most = mapCacheBytes);

// From the folder, or made and kept there. `folder`: empty: not kept. `wasKept`, if given, says which it was.
EnvironmentMaps environmentMaps(const Environment& environment, const EnvironmentRequest& request,
                                const std::filesystem::path& folder, bool* wasKept = nullptr);

}  // namespace diptych
