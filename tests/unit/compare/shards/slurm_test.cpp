// SPDX-License-Identifier: MIT
// The submission of jobs, with a shell script as sbatch.
#include "compare/shards/slurm.h"

#include "tests/support/errors.h"
#include "tests/support/files.h"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>

namespace diptych::shards {
namespace {

// Puts a folder with this script as sbatch first in PATH.
class FakeSbatch {
public:
    explicit FakeSbatch(const std::string& script) : path_(std::getenv("PATH")) {
        const std::filesystem::path bin = testFolder() / "bin", file = bin / "sbatch";
        std::filesystem::create_directories(bin);
        std::ofstream(file) << "#!/bin/sh\n" << script;
        std::filesystem::permissions(file, std::filesystem::perms::owner_all);
        ::setenv("PATH", (bin.string() + ":" + path_).c_str(), 1);
    }
    ~FakeSbatch() { ::setenv("PATH", path_.c_str(), 1); }
    FakeSbatch(const FakeSbatch&) = delete;
    FakeSbatch& operator=(const FakeSbatch&) = delete;

private:
    const std::string path_;
};

SlurmJob jobBelow(const std::filesystem::path& folder) {
    return {"/bin/true", folder, {"compare", "a.glb"}, folder / "report", 2, 0, {"--partition=long"}};
}

TEST(SlurmSubmission, TheMergeWaitsForTheArray) {
    const std::filesystem::path root = folder();
    const FakeSbatch sbatch("echo \"$@\" >>'" + (root / "log").string() +
                            "'\necho a warning\ncase $2 in --dep*) echo 8;; *) echo '7;cluster';; esac\n");
    const Submitted submitted = submit(jobBelow(root));
    EXPECT_EQ(submitted.array, "7");
    EXPECT_EQ(submitted.merge, "8");
    const std::string scripts = (root / "report.slurm").string();
    EXPECT_EQ(contentsOf(root / "log"), "--parsable --partition=long " + scripts +
                                            "/array.sh\n--parsable --dependency=afterany:7 " + scripts +
                                            "/merge.sh\n");
}

// Both scripts, whole: words of /bin/sh and of #SBATCH lines are quoted by different rules.
TEST(SlurmSubmission, ScriptsAreWhole) {
    SlurmJob job{
        "/opt/my diptych", "/srv/it's", {"compare", "a b.glb", "--size", "8x8"}, "100%/report", 2, 0, {}};
    EXPECT_EQ(slurmFolder("a/report/"), "a/report.slurm");
    EXPECT_EQ(
        arrayScript(job),
        "#!/bin/sh\n"
        "#SBATCH --job-name=diptych-compare\n"
        "#SBATCH --output=\"100%%/report.slurm/shard-%a.log\"\n"
        "#SBATCH --array=1-2\n"
        "#SBATCH --requeue\n"
        "#SBATCH --open-mode=append\n"
        "# Exit code 1 is a difference beyond tolerance, which the merged report shows. Slurm calls such "
        "a task\n# failed, too.\n"
        "cd '/srv/it'\\''s' || exit 2\n"
        "exec '/opt/my diptych' compare --shard slurm/2 -o 100%/report.slurm/shard-"
        "\"$SLURM_ARRAY_TASK_ID\" 'a b.glb' --size 8x8\n");
    EXPECT_EQ(mergeScript(job),
              "#!/bin/sh\n"
              "#SBATCH --job-name=diptych-merge\n"
              "#SBATCH --output=\"100%%/report.slurm/merge.log\"\n"
              "#SBATCH --requeue\n"
              "#SBATCH --open-mode=append\n"
              "cd '/srv/it'\\''s' || exit 2\n"
              "exec '/opt/my diptych' merge 100%/report.slurm/shard-1 100%/report.slurm/shard-2 -o "
              "100%/report\n");
    job.at_once = 1;
    EXPECT_NE(arrayScript(job).find("#SBATCH --array=1-2%1\n"), std::string::npos);
    for (const std::string name : {"a\"b", "a\\b", "a\nb", "a\tb"}) {
        job.out = name;
        EXPECT_EQ(
            faultOf([&] { arrayScript(job); }),
            "-o " + name +
                ".slurm: a Slurm script cannot write a log to such a folder; use a name without quotes, "
                "backslashes, line breaks and control characters");
        EXPECT_NE(faultOf([&] { mergeScript(job); }), "");
    }
}

// The job's number is the last line; without it, what sbatch printed is the error.
TEST(SlurmSubmission, WhatSbatchPrintsIsTheError) {
    const std::filesystem::path root = folder();
    for (const auto& [script, fault] : {std::pair{"exit 1", "sbatch: failed without a message"},
                                        {"echo; exit 0", "sbatch: failed without a message"},
                                        {"echo no such partition; echo; exit 1", "sbatch: no such partition"},
                                        {"echo 7 jobs", "sbatch: 7 jobs"},
                                        {"echo 7; echo a warning", "sbatch: 7\na warning"}}) {
        const FakeSbatch sbatch(script);
        EXPECT_EQ(faultOf([&] { submit(jobBelow(root)); }), fault) << script;
    }
    const FakeSbatch sbatch("echo 7");
    ::setenv("PATH", (root / "empty").c_str(), 1);
    EXPECT_EQ(faultOf([&] { submit(jobBelow(root)); }),
              "sbatch: No such file or directory; it comes with Slurm (Debian: slurm-client)");
}

// sbatch sends a signal while its output is read, and another while its end is awaited.
TEST(SlurmSubmission, SignalsChangeNeitherOutputNorExitCode) {
    static int signals;
    signals = 0;
    struct sigaction before {};
    struct sigaction counting {};
    counting.sa_handler = [](int) { ++signals; };  // without SA_RESTART: interrupts calls
    ASSERT_EQ(::sigaction(SIGUSR1, &counting, &before), 0);
    const std::filesystem::path root = folder();
    const FakeSbatch sbatch(
        "printf 1; sleep 0.05; kill -USR1 $PPID; sleep 0.02; printf 23\n"
        "exec >&- 2>&-; sleep 0.05; kill -USR1 $PPID; sleep 0.02; exit 3\n");
    EXPECT_EQ(faultOf([&] { submit(jobBelow(root)); }), "sbatch: 123") << "a job's number, but a failure";
    ::sigaction(SIGUSR1, &before, nullptr);
    EXPECT_GE(signals, 1) << "two may arrive as one";
}

}  // namespace
}  // namespace diptych::shards
