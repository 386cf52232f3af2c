// SPDX-License-Identifier: MIT
// Manifest of a shard's report, which identifies its command for merging.
#pragma once

#include "compare/shards/partition.h"
#include "compare/verdict/comparison.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace diptych::shards {

// A scene of the command.
struct Item {
    std::string scene;
    std::string folder;  // of its files, in all reports: sceneFolders()
    int shard = 1;       // shard that has it
};

// A shard's manifest, shard.json.
struct Manifest {
    std::string build;            // buildName() of the program
    std::string command;          // "compare"
    nlohmann::ordered_json plan;  // inputs of the result except the files' contents
    Shard shard;
    std::vector<Item> items;         // of the whole command
    std::vector<SceneError> errors;  // of this shard
};

// "0.1.0, commit 0123456789ab"; a hash of the program if built outside a repository.
std::string buildName();
// Differs between any two builds of the program.
std::string programStamp();

// hashOf() a plan's JSON (compare/report/folders.h).
std::string planHash(const nlohmann::ordered_json& plan);

std::string textOf(const Manifest& manifest);
// Throws std::runtime_error naming the folder if it has no valid manifest.
Manifest readManifest(const std::filesystem::path& folder, const char* file);

}  // namespace diptych::shards
