// SPDX-License-Identifier: MIT
// Runs a command over many scenes as Slurm jobs: an array of shards, and a merge job.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace diptych::shards {

struct SlurmJob {
    std::string program;             // absolute path
    std::filesystem::path working;   // folder where the command was given, absolute
    std::vector<std::string> words;  // without -o and --shard: "compare", "scenes/"
    std::filesystem::path out;       // the report; shards, scripts and logs are in OUT.slurm
    int shards = 1;
    int at_once = 0;                   // tasks at a time; 0: Slurm's limit
    std::vector<std::string> options;  // of sbatch, for the array: "--partition=long"
};

// OUT.slurm beside the report.
std::filesystem::path slurmFolder(const std::filesystem::path& out);

// Batch scripts for /bin/sh. arrayScript() runs shard N; a requeued task resumes after its lost node.
// mergeScript() merges what exists once all tasks have ended.
std::string arrayScript(const SlurmJob& job);
std::string mergeScript(const SlurmJob& job);

// Writes and submits both scripts; the merge waits for the array. Returns both job numbers. Throws
// std::runtime_error, one line with sbatch's message.
struct Submitted {
    std::string array, merge;
};
Submitted submit(const SlurmJob& job);

}  // namespace diptych::shards
