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
