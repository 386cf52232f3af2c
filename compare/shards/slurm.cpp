// SPDX-License-Identifier: MIT
#include "compare/shards/slurm.h"

#include "compare/run/command_text.h"
#include "shared/image/atomic_file.h"
#include "shared/text/one_line.h"
#include "shared/text/open_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string_view>
#include <system_error>

extern char** environ;

namespace diptych::shards {
namespace {

namespace fs = std::filesystem;

// A path in an #SBATCH line: Slurm interprets quotes, and % begins a pattern.
std::string directivePath(const fs::path& path) {
    const std::string name = path.string();
    if (name.find_first_of("\"\\") != name.npos || oneLine(name, name.size()) != name)
        throw std::runtime_error(
            fmt::format("-o {}: a Slurm script cannot write a log to such a folder; use a name without "
                        "quotes, backslashes, line breaks and control characters",
                        name));
    std::string text;
    for (const char c : name) text += c == '%' ? "%%" : std::string(1, c);
    return text;
}

std::string head(const SlurmJob& job, const std::string& name, const std::string& log, const char* more) {
    return fmt::format("#!/bin/sh\n#SBATCH --job-name=diptych-{}\n#SBATCH --output=\"{}/{}\"\n{}", name,
                       directivePath(slurmFolder(job.out)), log, more);
}

std::string beginning(const SlurmJob& job) {
    return fmt::format("cd {} || exit 2\n", shellWord(job.working.string()));
}

std::string commandLine(const SlurmJob& job, const std::vector<std::string>& words) {
    std::string line = "exec ";
    line += shellWord(job.program);
    for (const std::string& word : words) line.append(" ").append(shellWord(word));
    return line;
}

struct Ran {
    int code = -1;
    std::string out;  // stdout and stderr
};

Ran run(std::vector<std::string> words) {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[1], 1);
    posix_spawn_file_actions_adddup2(&actions, ends[1], 2);
    // The child must not inherit our blocked signals.
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    sigset_t none;
    sigemptyset(&none);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK);
    pid_t process = 0;
    const int error = ::posix_spawnp(&process, argv[0], &actions, &attributes, argv.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    ::close(ends[1]);
    Ran ran;
    char piece[4096];
    for (ssize_t got = 0; error == 0 && (got = ::read(ends[0], piece, sizeof piece)) != 0;) {
        if (got < 0 && errno != EINTR) break;
        if (got > 0) ran.out.append(piece, static_cast<std::size_t>(got));
    }
    ::close(ends[0]);
    if (error != 0)
        throw std::runtime_error(fmt::format("{}: {}; it comes with Slurm (Debian: slurm-client)",
                                             words.front(), std::strerror(error)));
    int status = 0;
    while (::waitpid(process, &status, 0) < 0 && errno == EINTR) {
    }
    ran.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    while (!ran.out.empty() && ran.out.back() == '\n') ran.out.pop_back();
    return ran;
}

// "123" or "123;cluster".
std::string jobId(const std::vector<std::string>& words) {
    const Ran ran = run(words);
    // The number is the last line; sbatch may print messages before it.
    const std::size_t line = ran.out.rfind('\n');
    std::string id = line == ran.out.npos ? ran.out : ran.out.substr(line + 1);
    id = id.substr(0, id.find(';'));
    if (ran.code != 0 || id.empty() || id.find_first_not_of("0123456789") != id.npos)
        throw std::runtime_error(
            fmt::format("sbatch: {}", ran.out.empty() ? "failed without a message" : ran.out));
    return id;
}

}  // namespace

fs::path slurmFolder(const fs::path& out) {
    const fs::path path = out.has_filename() ? out : out.parent_path();
    return path.string() + ".slurm";
}

std::string arrayScript(const SlurmJob& job) {
    std::vector<std::string> words = job.words;
    words.insert(words.begin() + 1, {"--shard", fmt::format("slurm/{}", job.shards), "-o"});
    // The shard's folder name ends in the task ID, so the script's text is split after -o.
    const std::string before = commandLine(job, {words.begin(), words.begin() + 4});
    std::string after;
    for (const std::string& word : std::vector<std::string>(words.begin() + 4, words.end()))
        after.append(" ").append(shellWord(word));
    const std::string limit = job.at_once > 0 ? fmt::format("%{}", job.at_once) : "";
    return head(job, job.words.front(), "shard-%a.log",
                fmt::format("#SBATCH --array=1-{}{}\n#SBATCH --requeue\n#SBATCH --open-mode=append\n",
                            job.shards, limit)
                    .c_str()) +
           "# Exit code 1 is a difference beyond tolerance, which the merged report shows. Slurm calls such "
           "a task\n# failed, too.\n" +
           beginning(job) + before + " " + shellWord((slurmFolder(job.out) / "shard-").string()) +
           "\"$SLURM_ARRAY_TASK_ID\"" + after + "\n";
}

std::string mergeScript(const SlurmJob& job) {
    std::vector<std::string> words{"merge"};
    for (int i = 1; i <= job.shards; ++i)
        words.push_back((slurmFolder(job.out) / fmt::format("shard-{}", i)).string());
    words.insert(words.end(), {"-o", job.out.string()});
    return head(job, "merge", "merge.log", "#SBATCH --requeue\n#SBATCH --open-mode=append\n") +
           beginning(job) + commandLine(job, words) + "\n";
}

Submitted submit(const SlurmJob& job) {
    const fs::path folder = slurmFolder(job.out);
    OpenFolder own = OpenFolder::own(folder);  // nobody else may change the scripts
    own.pin();
    const fs::path array = folder / "array.sh", merge = folder / "merge.sh";
    writeFile(array, arrayScript(job));
    writeFile(merge, mergeScript(job));
    Submitted submitted;
    std::vector<std::string> words{"sbatch", "--parsable"};
    words.insert(words.end(), job.options.begin(), job.options.end());
    words.push_back(array.string());
    submitted.array = jobId(words);
    // afterany: merge even if tasks failed; the report names what is missing.
    submitted.merge =
        jobId({"sbatch", "--parsable", "--dependency=afterany:" + submitted.array, merge.string()});
    return submitted;
}

}  // namespace diptych::shards
