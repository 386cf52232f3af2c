// SPDX-License-Identifier: MIT
// A command over many scenes as jobs of Slurm: an array of shards, and a job that joins their reports.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace diptych::shards {

struct SlurmJob {
    std::string program;             // to run, absolute
    std::filesystem::path working;   // the folder that the command was given in, absolute
    std::vector<std::string> words;  // of the command, without -o and --shard: "compare", "scenes/"
    std::filesystem::path out;       // the report; shards, scripts and logs stand in OUT.slurm
    int shards = 1;
    int at_once = 0;                   // how many of them may run at a time; 0: as many as Slurm lets
    std::vector<std::string> options;  // of sbatch, for the array: "--partition=long"
};

// The folder beside the report.
std::filesystem::path slurmFolder(const std::filesystem::path& out);

// A batch script for /bin/sh: shard N of the command, which goes on behind what it left when its node was
// lost, as Slurm puts such a task into the queue again. And the one that joins what there is once all have
// ended.
std::string arrayScript(const SlurmJob& job);
std::string mergeScript(const SlurmJob& job);

// Writes both scripts and submits them, the second behind the first. Returns the two jobs' numbers. Throws
// std::runtime_error, one line, with what sbatch says.
struct Submitted {
    std::string array, merge;
};
Submitted submit(const SlurmJob& job);

}  // namespace diptych::shards
