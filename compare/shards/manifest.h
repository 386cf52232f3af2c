// SPDX-License-Identifier: MIT
// What a shard's report says of itself, so that it can be joined with the others of its command and with no
// other.
#pragma once

#include "compare/shards/partition.h"
#include "compare/verdict/comparison.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace diptych::shards {

// A scene of the whole command.
struct Item {
    std::string scene;
    std::string folder;  // of its files, in every report: sceneFolders()
    int shard = 1;       // which has it
};

// A shard's manifest, shard.json.
struct Manifest {
    std::string build;            // buildName() of the program
    std::string command;          // "compare"
    nlohmann::ordered_json plan;  // everything that the result depends on, but the files' contents
    Shard shard;
    std::vector<Item> items;         // all of the command
    std::vector<SceneError> errors;  // of the shard's own
};

// "0.1.0, commit 0123456789ab"; where the program was built outside a repository, a hash of the program.
std::string buildName();
// Differs between any two programs that were built one after the other.
std::string programStamp();

// 16 hexadecimal digits of the text (FNV-1a); of a plan's JSON.
std::string hashOf(const std::string& text);
std::string planHash(const nlohmann::ordered_json& plan);

std::string textOf(const Manifest& manifest);
// Throws std::runtime_error naming the folder where it holds none.
Manifest readManifest(const std::filesystem::path& folder, const char* file);

}  // namespace diptych::shards
