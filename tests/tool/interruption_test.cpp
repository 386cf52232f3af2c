// SPDX-License-Identifier: MIT
// Signals, concurrent programs, and disks that are really full or read-only.
#include "tests/support/campaign.h"
#include "tests/tool/faults.h"
#include "tests/tool/running.h"

#include <fcntl.h>
#include <sys/file.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <csignal>
#include <memory>
#include <random>
#include <set>
#include <thread>
#include <vector>

namespace diptych {
namespace {

using namespace std::chrono_literals;

const std::vector<std::string> longWork{"render",    "builtin:spheres", "-v",   "--assign", "every", "--size",
                                        "1920x1080", "--runs",          "5000", "-o",       "r"};

TEST(Interruption, ALongSubmitEndsAtOnceByTheSignal) {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) {
        const Folder folder;
        Running tool(folder, longWork);
        ASSERT_TRUE(soon([&] { return tool.err().find(": time") != std::string::npos; })) << tool.err();
        std::this_thread::sleep_for(100ms);  // during a frame, or at any other time
        ::kill(tool.process(), signal);
        ASSERT_TRUE(soon([&] { return tool.ended(); })) << signal;
        EXPECT_TRUE(WIFSIGNALED(tool.wait()) && WTERMSIG(tool.wait()) == signal) << tool.wait();
        EXPECT_EQ(contentsBelow(folder.path()).size(), 1u) << "its stderr alone";
    }
}

// Whether the report's folder, or the temporary one that will replace it, exists.
bool isWriting(const Folder& folder) {
    for (const auto& entry : fs::directory_iterator(folder.path()))
        if (entry.path().filename() == "r" || isLeftover(entry.path().filename().string())) return true;
    return false;
}

// A signal at any time during writing.
TEST(Interruption, WritingLeavesAllOrNothing) {
    const Folder folder;
    int cut = 0;
    for (int attempt = 0; cut < 3; ++attempt) {  // a busy machine may let some end first
        ASSERT_LT(attempt, 40);
        fs::remove_all(folder / "r");
        Running tool(folder,
                     {"compare", "-q", "builtin:points", "--size", "96x54", "--runs", "0", "-o", "r"});
        ASSERT_TRUE(soon([&] { return tool.ended() || isWriting(folder); }));
        std::this_thread::sleep_for(std::chrono::milliseconds(9 * (attempt % 6)));
        constexpr int signals[] = {SIGINT, SIGQUIT, SIGTERM, SIGHUP};
        if (!tool.ended()) ::kill(tool.process(), signals[attempt % 4]);
        ASSERT_TRUE(soon([&] { return tool.ended(); }));
        const bool died = WIFSIGNALED(tool.wait());
        cut += died;
        ASSERT_EQ(leftoversIn(folder.path()), std::vector<std::string>()) << attempt;
        if (!died) {
            EXPECT_EQ(WEXITSTATUS(tool.wait()), 0) << tool.err();
        }
        EXPECT_TRUE(fs::exists(folder / "r/report.json") || !fs::exists(folder / "r")) << attempt;
    }
}

TEST(Interruption, AnIgnoredSignalStaysIgnored) {
    const Folder folder;
    const Ran ran = runShell(folder,
                             "trap '' HUP INT; '" DIPTYCH_PROGRAM
                             "' render -v builtin:triangle --size 640x360 --runs 200 -o r 2>log & "
                             "while kill -0 $! && ! grep -q ': time' log; do sleep 0.01; done; "
                             "kill -HUP $!; kill -INT $!; wait $!",
                             folder.path());
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_TRUE(fs::exists(folder / "r/frame.json"));
}

// A pipe that its reader closes early is no failure, and nothing is left behind.
TEST(Interruption, AClosedPipeEndsAfterTheReportIsWhole) {
    const Folder folder;
    const Ran ran = runShell(
        folder, "'" DIPTYCH_PROGRAM "' render -v builtin:triangle --size 16x9 --runs 0 -o r 2>&1 | true",
        folder.path());
    EXPECT_EQ(ran.err, "");
    ASSERT_TRUE(soon([&] { return fs::exists(folder / "r/frame.json"); }));
    EXPECT_TRUE(leftoversIn(folder.path()).empty());
}

TEST(Interruption, OneThatIsKilledIsSweptByTheNext) {
    const Folder folder;
    folder.write(".r.99999999-0.tmp/half.png", "of a process that is no more: numbers end at 4194304");
    folder.write(".r.1-0.tmp/half.png", "of one that lives");
    folder.write(".r.99999999.tmp/half.png", "not as ours are called");
    folder.write(".other.99999999-0.tmp", "of another report");
    const std::string small = "render -q builtin:triangle --size 16x9 --runs 0 -o r";
    ASSERT_EQ(runTool(folder, small).code, 0);
    EXPECT_FALSE(fs::exists(folder / ".r.99999999-0.tmp"));
    for (const char* kept : {".r.1-0.tmp", ".r.99999999.tmp", ".other.99999999-0.tmp"})
        EXPECT_TRUE(fs::exists(folder / kept)) << kept;

    folder.write(".r.99999999-1.tmp", "of a process in another container, which holds its lock");
    const int locked = ::open((folder / ".r.99999999-1.tmp").c_str(), O_RDONLY | O_CLOEXEC);
    ASSERT_EQ(::flock(locked, LOCK_EX | LOCK_NB), 0);
    ASSERT_EQ(runTool(folder, small).code, 0);
    EXPECT_TRUE(fs::exists(folder / ".r.99999999-1.tmp"));
    ::close(locked);
    ASSERT_EQ(runTool(folder, small).code, 0);
    EXPECT_FALSE(fs::exists(folder / ".r.99999999-1.tmp"));
}

// The one of two reports that a folder contains; all its files must agree.
std::string channelsIn(const fs::path& report) {
    std::string found;
    for (const auto& entry : fs::directory_iterator(report)) {
        const std::string name = entry.path().filename().string();
        for (const std::string channel : {"albedo", "normals"})
            if (name.starts_with(channel) && found.find(channel) == found.npos) found += channel;
    }
    return found;
}

TEST(Interruption, TwoProgramsLeaveOneWholeReport) {
    const Folder folder;
    const auto words = [](const std::string& channel) {
        return std::vector<std::string>{"compare", "-q", "builtin:triangle", "--size", "16x9",
                                        "--runs",  "0",  "--channels",       channel,  "-o",
                                        "r"};
    };
    for (int attempt = 0; attempt < 5; ++attempt) {
        if (attempt % 3 == 0) fs::remove_all(folder / "r");
        if (attempt == 1) folder.write("r/mine.txt", "keep");
        Running one(folder, words("albedo")), other(folder, words("normals"));
        EXPECT_EQ(one.wait(), 0) << one.err();
        EXPECT_EQ(other.wait(), 0) << other.err();
        const std::string channels = channelsIn(folder / "r");
        EXPECT_TRUE(channels == "albedo" || channels == "normals") << attempt << channels;
        EXPECT_TRUE(fs::exists(folder / "r/report.json"));
        EXPECT_TRUE(leftoversIn(folder.path()).empty());
        if (attempt == 1) {
            EXPECT_EQ(contentsOf(folder / "r/mine.txt"), "keep");
        }
    }
}

// The files of an output, and those that its manifest lists.
std::pair<std::set<std::string>, std::set<std::string>> filesAndListed(const fs::path& output) {
    const char* manifest = fs::exists(output / "report.json") ? "report.json" : "frame.json";
    std::set<std::string> there, listed{manifest};
    for (const auto& [path, text] : contentsBelow(output))
        if (text != "(folder)") there.insert(path);
    const auto json = nlohmann::json::parse(contentsOf(output / manifest), nullptr, false);
    if (json.is_object() && json.contains("files"))
        for (const std::string name : json["files"]) listed.insert(name);
    return {there, listed};
}

// Two programs write to one folder, each killed at any time: outputs are complete or absent, and the next
// run removes leftovers. A full run kills 200 times by each signal.
TEST(Kills, LeaveNothingThatTheNextRunDoesNotRemove) {
    const Folder folder;
    fs::create_directories(folder / "tmp");
    const char* const earlier = std::getenv("TMPDIR");
    const std::string own_folder = earlier ? earlier : "";
    ::setenv("TMPDIR", (folder / "tmp").c_str(), 1);
    std::vector<std::vector<std::string>> commands{
        {"compare", "builtin:triangle", "--channels", "lit"},
        {"compare", "builtin:triangle", "builtin:points", "--channels", "lit"},
        {"render", "builtin:triangle", "--path", "reference", "--reference-mode", "scene", "--spp", "64"}};
    const std::set<std::string> allowed{"tmp", "out-0", "out-1", "out-2", ".stdout", ".stderr", ".other"};
    std::vector<double> whole_ms;
    for (std::size_t i = 0; i < commands.size(); ++i) {
        const std::string out = "out-" + std::to_string(i);
        for (const char* word : {"-q", "--size", "32x18", "--runs", "0", "-o", out.c_str()})
            commands[i].emplace_back(word);
        const auto start = std::chrono::steady_clock::now();
        Running whole(folder, commands[i]);
        ASSERT_EQ(whole.wait(), 0) << whole.err();
        whole_ms.push_back(
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
    }
    std::mt19937 random(campaignSeed());
    int killed = 0, left = 0, runs = 0;
    const int rounds = isCampaign() ? 500 : 3;  // of two programs, five signals in turn
    for (int round = 0; round < rounds || killed == 0; ++round) {
        ASSERT_LT(round, 600);
        constexpr int signals[] = {SIGKILL, SIGINT, SIGTERM, SIGHUP, SIGQUIT};
        const int signal = signals[round % 5];
        const auto kind = static_cast<std::size_t>(round / 5 + round) % commands.size();
        const fs::path output = folder / ("out-" + std::to_string(kind));
        if (random() % 3 == 0) fs::remove_all(output);
        const auto sleep = [&] {
            std::uniform_real_distribution<double> ms(0, 0.6 * whole_ms[kind]);
            std::this_thread::sleep_for(std::chrono::duration<double, std::milli>(ms(random)));
        };
        const auto first = std::make_unique<Running>(folder, commands[kind]),
                   second = std::make_unique<Running>(folder, commands[kind], folder / ".other");
        for (const auto* program : {&first, &second}) {
            sleep();
            if (!(*program)->ended()) ::kill((*program)->process(), signal);
        }
        for (const auto* program : {&first, &second}) {
            ASSERT_TRUE(soon([&] { return (*program)->ended(); })) << "round " << round;
            const int status = (*program)->wait();
            ++runs;
            if (WIFSIGNALED(status)) {
                ++killed;
                EXPECT_EQ(WTERMSIG(status), signal) << "round " << round;
            } else if (WEXITSTATUS(status) != 0) {
                EXPECT_NE((*program)->err().find("another diptych writes to the same -o"), std::string::npos)
                    << "round " << round << ": " << (*program)->err();
            }
        }
        const std::vector<std::string> rubbish = leftoversIn(folder.path());
        left += !rubbish.empty();
        if (signal != SIGKILL) {
            EXPECT_EQ(rubbish, std::vector<std::string>()) << "round " << round << " by " << signal;
        }
        if (fs::exists(output) && leftoversIn(output).empty()) {
            const auto [there, listed] = filesAndListed(output);
            EXPECT_EQ(there, listed) << "round " << round << " by " << signal;
        }
        Running next(folder, commands[kind]);
        EXPECT_EQ(next.wait(), 0) << "round " << round << " by " << signal << ": " << next.err();
        const auto [there, listed] = filesAndListed(output);
        EXPECT_EQ(there, listed) << "round " << round << " by " << signal;
        for (const auto& entry : fs::directory_iterator(folder.path()))
            EXPECT_TRUE(allowed.contains(entry.path().filename().string()))
                << "round " << round << " by " << signal << " left " << entry.path();
        EXPECT_TRUE(fs::is_empty(folder / "tmp")) << "round " << round << " by " << signal;
    }
    if (own_folder.empty())
        ::unsetenv("TMPDIR");
    else
        ::setenv("TMPDIR", own_folder.c_str(), 1);
    RecordProperty("programs", runs);
    RecordProperty("killed", killed);
    RecordProperty("rounds_with_leftovers", left);
    if (isCampaign())
        std::printf("%d programs, %d of them killed; %d of %d rounds left something\n", runs, killed, left,
                    rounds);
}

// A program waits until the other has moved its files.
TEST(Interruption, AFolderThatIsBeingWrittenIsWaitedFor) {
    const Folder folder;
    const int held = ::open(folder.path().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    ASSERT_EQ(::flock(held, LOCK_EX), 0);
    Running tool(folder, {"render", "-q", "builtin:triangle", "--size", "16x9", "--runs", "0", "-o", "r"});
    std::this_thread::sleep_for(1s);
    EXPECT_FALSE(fs::exists(folder / "r"));
    EXPECT_FALSE(tool.ended());
    ::close(held);
    EXPECT_EQ(tool.wait(), 0) << tool.err();
    EXPECT_TRUE(fs::exists(folder / "r/frame.json"));
}

// Runs `script` in a mount namespace of its own; skipped if that is not permitted.
Ran mounted(const Folder& folder, const std::string& script) {
    folder.write("script", "set -e\n" + script);
    return runShell(folder, "unshare -rm sh script", folder.path());
}
bool canMount(const Folder& folder) {
    return mounted(folder, "mkdir -p m; mount -t tmpfs -o size=64k none m").code == 0;
}

const std::string render = "'" DIPTYCH_PROGRAM "' render -q builtin:triangle --size 64x36 --runs 0 -o ";
const std::string sums = "(cd m/r && find . -type f | sort | xargs sha256sum)";

TEST(FullDisk, OfAnySizeLeavesTheEarlierReport) {
    const Folder folder;
    if (!canMount(folder)) GTEST_SKIP() << "no name space to mount a small disk in";
    int failed = 0;
    for (int blocks = 6; blocks < 400; blocks += 3) {
        // The earlier report is small, with one channel; the next one has all.
        const Ran ran =
            mounted(folder, "mkdir -p m; mount -t tmpfs -o size=" + std::to_string(4 * blocks) +
                                "k none m\n" + render + "m/r --channels albedo || exit 9\n" + sums +
                                " > before\nif " + render + "m/r; then exit 0; fi\n" + sums +
                                " > after; cmp before after; ls -A m | grep -qx r; "
                                "[ $(ls -A m | wc -l) = 1 ]; exit 2");
        if (ran.code == 0) break;
        if (ran.code == 9) continue;  // not even the earlier one fits on the disk
        ++failed;
        EXPECT_TRUE(ran.failedOver("No space left on device; make room, or write to another place with -o"))
            << blocks;
    }
    EXPECT_GE(failed, 2);
}

// Otherwise a full disk under Mesa's shader cache would end the process by SIGBUS.
TEST(FullDisk, OfTheDriversCacheIsDoneWithout) {
    const Folder folder;
    if (!canMount(folder)) GTEST_SKIP() << "no name space to mount a small disk in";
    const Ran ran = mounted(folder,
                            "mkdir -p m; mount -t tmpfs -o size=20k none m\n"
                            "dd if=/dev/zero of=m/full 2>/dev/null || true\n"
                            "export XDG_CACHE_HOME=$PWD/m; unset MESA_SHADER_CACHE_DIR\n" +
                                render + "r");
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_EQ(ran.err, "");
}

TEST(FullDisk, OneThatIsReadOnlyIsNamedAndKept) {
    const Folder folder;
    if (!canMount(folder)) GTEST_SKIP() << "no name space to mount a read-only disk in";
    const std::string mount = "mkdir -p m; mount -t tmpfs none m\n" + render + "m/r\n" + sums +
                              " > before\nmount -o remount,ro m\n";
    for (const std::string out : {"m/r", "m/new", "m/a.exr", "m/a.png"}) {
        const Ran ran =
            mounted(folder, mount + "code=0; " + render + out + " || code=$?\n" + sums +
                                " > after; cmp before after; [ $(ls -A m | wc -l) = 1 ]; exit $code");
        EXPECT_TRUE(ran.failedOver("Read-only file system; write to another place with -o")) << out;
    }
}

TEST(FullDisk, ALimitOnFileSizeIsAnErrorAsAnyOther) {
    const Folder folder;
    const Ran ran = runShell(folder, "ulimit -f 1; " + render + "r", folder.path());
    EXPECT_TRUE(ran.failedOver("raise the limit on a file's size (ulimit -f)"));
    EXPECT_FALSE(fs::exists(folder / "r"));
    EXPECT_TRUE(leftoversIn(folder.path()).empty());
}

}  // namespace
}  // namespace diptych
