// SPDX-License-Identifier: MIT
// Seeds of the fuzzers. Every function writes files below OUT/TARGET.
#pragma once

#include <filesystem>
#include <string_view>

namespace diptych::fuzz {

// Larger seeds mutate too slowly to be worth their coverage.
inline constexpr std::size_t largest_seed = std::size_t{64} << 10;

void writeSeed(const std::filesystem::path& out, const char* target, std::string_view name,
               std::string_view bytes);

void writeImageSeeds(const std::filesystem::path& out);  // hdr, pfm, png, texture, tiff
void writeExrSeeds(const std::filesystem::path& out);
void writeGltfSeeds(const std::filesystem::path& out);
void writeTextSeeds(const std::filesystem::path& out);  // lights, settings
// Copies small assets; .gltf files get their buffers and images as data URIs. Returns the number of files.
int copySeeds(const std::filesystem::path& assets, const std::filesystem::path& out);

}  // namespace diptych::fuzz
