// SPDX-License-Identifier: MIT
#include "compare/cli/add_option.h"
#include "compare/cli/command.h"
#include "compare/cli/command_line.h"
#include "compare/cli/option_groups.h"
#include "compare/files/scene_folders.h"
#include "compare/run/print.h"
#include "compare/shards/slurm.h"
#include "shared/text/counted.h"

#include <fmt/format.h>

#include <algorithm>

namespace diptych::cli {
namespace {

namespace fs = std::filesystem;

constexpr int maxShards = 16;  // at most, without --shards

struct SubmitLine : OutputGroup {
    std::string engine;                  // "slurm"
    std::vector<std::string> submitted;  // the command: words after --
    std::vector<std::string> options;    // --sbatch
    int shards = 0, at_once = 0;         // 0: one per scene, at most 16; 0: no limit
    bool dry_run = false;
};

void describeSubmit(CLI::App& app, SubmitLine& options) {
    addOption(app, "engine", options.engine, "slurm", "job system")->required();
    addOption(app, "--shards", options.shards, "N",
              "number of shards to split the scenes into (one per scene, at most 16)")
        ->check(CLI::Range(1, 1000000));
    addOption(app, "--at-once", options.at_once, "K", "number of shards that run at a time (no limit)")
        ->check(CLI::Range(1, 1000000));
    addEach(app, "--sbatch", options.options, "OPTION",
            "sbatch option for the shards, such as --sbatch=--partition=long; repeatable");
    app.add_flag("--dry-run", options.dry_run, "print both scripts; write and submit nothing");
    addFiles(app, options, "not accepted: give -o to the command after --");
    addOutput(app, options);
}

// Removes -o and its value.
std::vector<std::string> withoutOut(const std::vector<std::string>& words) {
    std::vector<std::string> left;
    for (std::size_t i = 0; i < words.size(); ++i) {
        const std::string& word = words[i];
        if (word == "--") {
            left.insert(left.end(), words.begin() + static_cast<std::ptrdiff_t>(i), words.end());
            break;
        }
        if (word == "-o" || word == "--out")
            ++i;
        else if (!word.starts_with("--out=") && !(word.starts_with("-o") && !word.starts_with("--")))
            left.push_back(word);
    }
    return left;
}

int runSubmit(const SubmitLine& options) {
    if (options.engine != "slurm") refuse("submit {}: is not supported; use slurm", options.engine);
    if (!options.out.empty()) refuse("-o {}: give -o to the command after --", options.out.string());
    const std::vector<std::string>& words = options.submitted;
    if (words.empty())
        refuse("submit slurm: a command is missing; for example submit slurm -- compare scenes/ -o report");
    // Reports usage errors here instead of in a job's log.
    const CommandLine parsed = parseCommandLine(words);
    const auto* command = dynamic_cast<const ShardedGroup*>(parsed.command.line.get());
    // view has the options of compare, apart from --shard.
    if (!parsed.help.empty() || command == nullptr || *command->folder == 0)
        refuse("submit slurm: {}: only compare and tradeoff can be split into shards", words.front());
    if (!command->shard.empty())
        refuse("--shard {}: the jobs set it; give submit --shards N, the number of shards", command->shard);
    const auto scenes = scenesOf(command->scenes).size();
    shards::SlurmJob job;
    std::error_code error;
    job.program = fs::read_symlink("/proc/self/exe", error).string();
    job.working = fs::current_path();
    job.words = withoutOut(words);
    job.out = fs::absolute(command->out.empty() ? command->folder : command->out).lexically_normal();
    job.shards =
        options.shards > 0 ? options.shards : static_cast<int>(std::min<std::size_t>(scenes, maxShards));
    job.at_once = options.at_once;
    job.options = options.options;
    if (options.dry_run) {
        printOut("# {}\n{}\n# {}, runs after it\n{}", (shards::slurmFolder(job.out) / "array.sh").string(),
                 arrayScript(job), (shards::slurmFolder(job.out) / "merge.sh").string(), mergeScript(job));
        return 0;
    }
    const shards::Submitted jobs = submit(job);
    if (!options.quiet)
        printOut("job {}: {} of {}{}\njob {}: merges them into {}\nlogs: {}\n", jobs.array,
                 counted(static_cast<std::uint64_t>(job.shards), "shard"), counted(scenes, "scene"),
                 job.at_once > 0 ? fmt::format(", {} at a time", job.at_once) : "", jobs.merge,
                 (job.out / "index.html").string(), shards::slurmFolder(job.out).string());
    return 0;
}

}  // namespace

Command submitCommand() {
    return makeCommand<SubmitLine>(
        {"submit", "Runs a command over many scenes as a Slurm job array and merges the reports",
         "diptych submit slurm --shards 16 --at-once 4 -- compare scenes/ -o report"},
        describeSubmit, [](SubmitLine&) {}, runSubmit);
}

}  // namespace diptych::cli
