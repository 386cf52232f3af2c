// SPDX-License-Identifier: MIT
// What the fuzzers start from. Every function writes files below OUT/TARGET.
#pragma once

#include <filesystem>
#include <string_view>

namespace diptych::fuzz {

// A larger seed is mutated too slowly to be worth its coverage.
inline constexpr std::size_t largest_seed = std::size_t{64} << 10;

void writeSeed(const std::filesystem::path& out, const char* target, std::string_view name,
               std::string_view bytes);

void writeImageSeeds(const std::filesystem::path& out);  // hdr, pfm, png, texture, tiff
void writeExrSeeds(const std::filesystem::path& out);
void writeGltfSeeds(const std::filesystem::path& out);
void writeTextSeeds(const std::filesystem::path& out);  // lights, settings
// What is small among the assets, .gltf files with their buffers and images as data URIs. Returns how many.
int copySeeds(const std::filesystem::path& assets, const std::filesystem::path& out);

}  // namespace diptych::fuzz
