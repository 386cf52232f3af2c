// SPDX-License-Identifier: MIT
#include "compare/cli/command_line.h"
#include "compare/cli/commands.h"
#include "compare/files/scene_folders.h"
#include "compare/run/print.h"
#include "compare/shards/slurm.h"
#include "shared/text/counted.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>

namespace diptych::cli {
namespace {

namespace fs = std::filesystem;

constexpr int mostShards = 16;  // at most, without --shards

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

}  // namespace

int runSubmit(const Options& options) {
    if (options.submit.engine != "slurm")
        throw std::runtime_error(
            fmt::format("submit {}: is not supported; use slurm", options.submit.engine));
    const std::vector<std::string>& words = options.submit.words;
    if (words.empty())
        throw std::runtime_error(
            "submit slurm: a command is missing; for example submit slurm -- compare scenes/ -o report");
    const Options command = parseCommandLine(words);  // reports usage errors here instead of in a job's
                                                      // log
    if (!command.help.empty() || (command.command != "compare" && command.command != "tradeoff"))
        throw std::runtime_error(fmt::format(
            "submit slurm: {}: only compare and tradeoff can be split into shards", words.front()));
    if (!command.shard.empty())
        throw std::runtime_error(fmt::format(
            "--shard {}: the jobs set it; give submit --shards N, the number of shards", command.shard));
    const auto scenes = scenesOf(command.scenes).size();
    shards::SlurmJob job;
    std::error_code error;
    job.program = fs::read_symlink("/proc/self/exe", error).string();
    job.working = fs::current_path();
    job.words = withoutOut(words);
    job.out = fs::absolute(!command.out.empty()           ? command.out.string()
                           : command.command == "compare" ? "diptych-report"
                                                          : "diptych-tradeoff")
                  .lexically_normal();
    job.shards = options.submit.shards > 0 ? options.submit.shards
                                           : static_cast<int>(std::min<std::size_t>(scenes, mostShards));
    job.at_once = options.submit.at_once;
    job.options = options.submit.options;
    if (options.submit.dry_run) {
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

}  // namespace diptych::cli
