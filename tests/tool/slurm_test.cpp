// SPDX-License-Identifier: MIT
// submit slurm, on a Slurm of two nodes on this machine (tests/slurm/cluster.sh). Tests that need Slurm
// are skipped with a message if it is not installed.
#include "tests/tool/running.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace diptych {
namespace {

const std::string slurmCompare =
    "compare builtin:points builtin:triangle builtin:spots builtin:areas builtin:crossed --size 32x18 --runs "
    "0 "
    "--channels lit,normals";

class SlurmCluster {
public:
    explicit SlurmCluster(const Folder& folder) : folder_(folder) {
        const Ran ran = run("start");
        started = ran.code == 0;
        why = ran.err;
    }
    ~SlurmCluster() { run("stop"); }
    SlurmCluster(const SlurmCluster&) = delete;
    SlurmCluster& operator=(const SlurmCluster&) = delete;

    Ran run(const std::string& what) const {
        const std::string word = what.substr(0, what.find(' ')), rest = what.substr(word.size());
        return shell("'" DIPTYCH_SOURCE_DIR "/tests/slurm/cluster.sh' " + word + " '" +
                     (folder_ / "cluster").string() + "'" + rest);
    }
    Ran shell(const std::string& command) const {
        return runShell(folder_,
                        "export SLURM_CONF='" + (folder_ / "cluster/slurm.conf").string() + "'; " + command,
                        folder_ / "work");
    }
    Ran tool(const std::string& arguments) const { return shell("'" DIPTYCH_PROGRAM "' " + arguments); }
    // Waits until no job is left. Tasks that Slurm requeued start at once instead of after two minutes.
    bool idle() const {
        return soon([&] {
            const Ran queue = shell("squeue -h -o '%i %T %r'");
            if (queue.out.find("BeginTime") != std::string::npos)
                shell(
                    "for job in $(squeue -h -o '%i %r' | sed -n 's/ BeginTime//p'); do scontrol update "
                    "jobid=$job "
                    "starttime=now; done");
            std::this_thread::sleep_for(std::chrono::milliseconds(200));
            return queue.code == 0 && queue.out.empty();
        });
    }

    bool started = false;
    std::string why;

private:
    const Folder& folder_;
};

#define SKIP_WITHOUT_SLURM(cluster) \
    if (!(cluster).started) GTEST_SKIP() << "no Slurm here: " << (cluster).why

TEST(Slurm, ADryRunPrintsBothScripts) {
    const Folder folder;
    const Ran ran = runTool(
        folder, "submit slurm --shards 4 --at-once 2 --dry-run -- " + slurmCompare + " -o 'a report'");
    EXPECT_EQ(ran.code, 0) << ran.err;
    for (const char* text :
         {"#SBATCH --job-name=diptych-compare\n", "#SBATCH --job-name=diptych-merge\n",
          "#SBATCH --array=1-4%2\n", "#SBATCH --requeue\n", "/a report.slurm/shard-%a.log\"\n",
          " compare --shard slurm/4 -o '", "/a report.slurm/shard-'\"$SLURM_ARRAY_TASK_ID\" ", " merge '",
          "/a report.slurm/shard-4' -o '", "/a report.slurm/merge.log\"\n"})
        EXPECT_NE(ran.out.find(text), std::string::npos) << text << "\n" << ran.out;
    EXPECT_FALSE(fs::exists(folder / "a report.slurm")) << "nothing is written";
    // Five scenes: five shards by default.
    EXPECT_NE(runTool(folder, "submit slurm --dry-run -- " + slurmCompare).out.find("--array=1-5\n"),
              std::string::npos);
    EXPECT_TRUE(runTool(folder, "submit slurm").failedOver("a command is missing"));
    EXPECT_TRUE(runTool(folder, "submit slurm -o report -- compare").failedOver("to the command after --"));
    EXPECT_TRUE(runTool(folder, "submit cron -- compare").failedOver("use slurm"));
    EXPECT_TRUE(
        runTool(folder, "submit slurm -- render builtin:points").failedOver("can be split into shards"));
    EXPECT_TRUE(runTool(folder, "submit slurm -- compare --sise 3x4").failedOver("--sise"));
    EXPECT_TRUE(runTool(folder, "submit slurm -- compare --shard 1/2").failedOver("the jobs set it"));
    EXPECT_TRUE(runTool(folder, "submit slurm --dry-run -- compare 'nothing/*.glb'")
                    .failedOver("nothing/*.glb: matches no .gltf or .glb file"));
}

TEST(Slurm, AnArrayAndItsMergeMakeTheReport) {
    const Folder folder;
    fs::create_directories(folder / "work");
    const SlurmCluster cluster(folder);
    SKIP_WITHOUT_SLURM(cluster);
    const Ran ran =
        cluster.tool("submit slurm --shards 3 --at-once 2 -- " + slurmCompare + " -o 'the report'");
    ASSERT_EQ(ran.code, 0) << ran.err;
    ASSERT_TRUE(cluster.idle());
    const fs::path out = folder / "work/the report";
    ASSERT_TRUE(fs::exists(out / "index.html")) << contentsOf(folder / "work/the report.slurm/merge.log");
    const auto json = nlohmann::json::parse(contentsOf(out / "report.json"));
    EXPECT_EQ(json["comparisons"].size(), 5u);
    EXPECT_EQ(json["verdict"], "pass");
    for (const char* log : {"shard-1.log", "shard-2.log", "shard-3.log", "merge.log"})
        EXPECT_NE(contentsOf(folder / "work/the report.slurm" / log).find("report: "), std::string::npos)
            << log;
    EXPECT_TRUE(
        cluster.tool("submit slurm --sbatch=--partition=none -- " + slurmCompare).failedOver("sbatch: "));
}

TEST(Slurm, ANodeThatIsLostInTheMiddleIsMadeUpFor) {
    const Folder folder;
    fs::create_directories(folder / "work");
    const SlurmCluster cluster(folder);
    SKIP_WITHOUT_SLURM(cluster);
    // Long enough to be interrupted.
    const Ran ran =
        cluster.tool("submit slurm --shards 2 -- " + slurmCompare +
                     " builtin:gallery builtin:spheres builtin:glass builtin:many_materials -v -o r");
    ASSERT_EQ(ran.code, 0) << ran.err;
    const auto log = [&](int shard) {
        return contentsOf(folder / fmt::format("work/r.slurm/shard-{}.log", shard));
    };
    ASSERT_TRUE(soon([&] { return log(1).find("builtin:") != std::string::npos; })) << log(1);
    std::this_thread::sleep_for(std::chrono::milliseconds(700));
    const std::string node = cluster.shell("squeue -h -t R -o '%K %N' | sed -n 's/^1 .*-//p'").out;
    ASSERT_FALSE(node.empty());
    cluster.run("kill " + node.substr(0, 1));
    ASSERT_TRUE(soon([&] {  // until Slurm notices the dead node
        return cluster.shell("squeue -h -o '%T'").out.find("PENDING") != std::string::npos &&
               cluster.shell("sinfo -h -o %T").out.find("down") != std::string::npos;
    }));
    cluster.run("node " + node.substr(0, 1));
    ASSERT_TRUE(cluster.idle());
    const auto json = nlohmann::json::parse(contentsOf(folder / "work/r/report.json"));
    EXPECT_EQ(json["comparisons"].size(), 9u) << log(1);
    EXPECT_TRUE(json["errors"].empty());
}

}  // namespace
}  // namespace diptych
