// SPDX-License-Identifier: MIT
// The launcher with fake dpkg, apt and CMake: the calls it makes and the messages it prints.
#include "tests/tool/run.h"
#include "tests/tool/running.h"

#include <fcntl.h>
#include <sys/file.h>

#include <chrono>
#include <set>
#include <sstream>
#include <thread>

namespace diptych {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

// A checkout with the launcher, and a folder of fake programs in front of PATH.
class Launcher : public testing::Test {
protected:
    void SetUp() override {
        fs::create_directories(home_.path() / "repository");
        fs::copy(fs::path(DIPTYCH_SOURCE_DIR) / "diptych", home_ / "repository/diptych");
        fs::create_directories(home_ / "repository/tests");
        fs::copy(fs::path(DIPTYCH_SOURCE_DIR) / "tests/run.py", home_ / "repository/tests/run.py");
        home_.write("repository/packages.txt",
                    "# build\nalpha\n\nbeta-dev\n\n# to test: gamma, too\ngamma\n");
        installed("alpha beta-dev gamma");
        home_.write("bin/id", "#!/bin/sh\necho 0\n", true);
        home_.write("bin/apt-get", "#!/bin/sh\necho \"$@\" >>'" + (home_ / "apt.log").string() + "'\n", true);
        home_.write("bin/ctest", "#!/bin/sh\necho \"ctest $* $DIPTYCH_TIER $DIPTYCH_TESTS\"\nexit 8\n", true);
        // The fake CMake builds a program that prints its arguments; it fails if two run at once.
        home_.write(
            "bin/cmake",
            "#!/bin/sh\n"
            "build='" +
                build() +
                "'\n"
                "echo \"noise of the build\"\n"
                "echo \"$@\" >>'" +
                (home_ / "cmake.log").string() +
                "'\n"
                "[ ! -e '" +
                (home_ / "broken").string() +
                "' ] || { echo 'error: broken'; exit 1; }\n"
                "mkdir \"$build/running\" || exit 1\n"
                "sleep 0.1\n"
                "mkdir -p \"$build/compare\"\n"
                ": >\"$build/build.ninja\"\n"
                "echo 'CMAKE_HOME_DIRECTORY:INTERNAL=" +
                (home_ / "repository").string() +
                "' >\"$build/CMakeCache.txt\"\n"
                "printf '#!/bin/sh\\nprintf \"<%%s>\" \"$@\"\\npwd\\nexit 3\\n' >\"$build/compare/diptych\"\n"
                "chmod +x \"$build/compare/diptych\"\n"
                "rmdir \"$build/running\"\n",
            true);
    }

    void installed(const std::string& packages) {
        home_.write("bin/dpkg-query",
                    "#!/bin/sh\nfor p in " + packages + "; do echo \"installed $p\"; done\n", true);
    }
    std::string build() const { return (home_ / "repository/build").string(); }
    Ran run(const std::string& arguments, const std::string& from = "") {
        return runShell(home_,
                        "PATH='" + (home_ / "bin").string() + "':\"$PATH\" '" +
                            (home_ / "repository/diptych").string() + "' " + arguments,
                        home_.path() / from);
    }

    Folder home_;
};

TEST_F(Launcher, WhereAllIsUpToDateOnlyTheProgramSpeaks) {
    const Ran first = run("plan 'a b.glb'");
    EXPECT_EQ(first.code, 3);
    EXPECT_EQ(first.out, "<plan><a b.glb>" + home_.path().string() + "\n");
    EXPECT_NE(first.err.find("building"), std::string::npos);

    fs::create_directories(home_ / "elsewhere");
    const Ran second = run("plan 'a b.glb'", "elsewhere");
    EXPECT_EQ(second.code, 3);
    EXPECT_EQ(second.out, "<plan><a b.glb>" + (home_ / "elsewhere").string() + "\n");
    EXPECT_EQ(second.err, "");
    EXPECT_FALSE(fs::exists(home_ / "apt.log"));
}

TEST_F(Launcher, FindsItsRepositoryThroughALink) {
    fs::create_directories(home_ / "elsewhere");
    fs::create_symlink("../repository/diptych", home_ / "elsewhere/link");
    const Ran ran = runShell(home_, "PATH='" + (home_ / "bin").string() + "':\"$PATH\" ./link devices",
                             home_ / "elsewhere");
    EXPECT_EQ(ran.out, "<devices>" + (home_ / "elsewhere").string() + "\n") << ran.err;
}

TEST_F(Launcher, InstallsWhatIsMissingAndSaysSo) {
    installed("alpha");
    const Ran ran = run("devices");
    EXPECT_NE(ran.err.find("installing Debian packages: beta-dev\n"), std::string::npos) << ran.err;
    EXPECT_NE(contentsOf(home_ / "apt.log").find("install beta-dev\n"), std::string::npos);
    EXPECT_EQ(ran.out, "<devices>" + home_.path().string() + "\n");
}

TEST_F(Launcher, OfAlternativesTakesWhatTheSystemHas) {
    home_.write("repository/packages.txt", "alpha\nbeta-dev|beta8-dev|beta9-dev\n");
    home_.write("bin/apt-cache", "#!/bin/sh\n[ \"$2\" != beta-dev ]\n", true);
    installed("alpha beta9-dev");
    EXPECT_EQ(run("devices").code, 3);
    EXPECT_FALSE(fs::exists(home_ / "apt.log")) << "any of them will do";
    installed("alpha");
    EXPECT_TRUE(run("--no-install devices").failedOver("beta-dev|beta8-dev|beta9-dev"));
    EXPECT_EQ(run("devices").code, 3);
    EXPECT_NE(contentsOf(home_ / "apt.log").find("install beta8-dev\n"), std::string::npos);
    home_.write("bin/apt-cache", "#!/bin/sh\nexit 100\n", true);
    run("devices");
    EXPECT_NE(contentsOf(home_ / "apt.log").find("install beta-dev|beta8-dev|beta9-dev\n"), std::string::npos)
        << "apt-get says what it does not know";
}

TEST_F(Launcher, OnlyTestInstallsWhatOnlyTestsNeed) {
    installed("alpha beta-dev");
    EXPECT_EQ(run("devices").code, 3);
    EXPECT_FALSE(fs::exists(home_ / "apt.log"));
    fs::remove(home_ / "cmake.log");
    EXPECT_EQ(run("test").code, 8);
    EXPECT_NE(contentsOf(home_ / "apt.log").find("install gamma\n"), std::string::npos);
    EXPECT_NE(contentsOf(home_ / "cmake.log").find("-S "), std::string::npos)
        << "CMake is asked again for what it did not find";
}

TEST_F(Launcher, NoInstallOnlyNamesWhatIsMissing) {
    installed("beta-dev gamma");
    EXPECT_TRUE(run("--no-install compare").failedOver("alpha"));
    EXPECT_FALSE(fs::exists(home_ / "apt.log"));
    EXPECT_FALSE(fs::exists(home_ / "cmake.log"));
    installed("alpha beta-dev");
    EXPECT_EQ(run("--no-install compare").out, "<compare>" + home_.path().string() + "\n");
}

TEST_F(Launcher, AFailedBuildIsShownAndIsExitTwo) {
    home_.write("broken", "");
    const Ran ran = run("compare");
    EXPECT_EQ(ran.code, 2);
    EXPECT_EQ(ran.out, "");
    EXPECT_NE(ran.err.find("error: broken"), std::string::npos) << ran.err;
    fs::remove(home_ / "broken");
    EXPECT_EQ(run("compare").code, 3);
}

TEST_F(Launcher, TestBuildsEverythingAndHandsOnToCtest) {
    const auto says = [&](const std::string& arguments, const std::string& told) {
        const Ran ran = run(arguments);
        EXPECT_EQ(ran.code, 8);
        EXPECT_EQ(ran.out.find("ctest --test-dir " + build()), 0u) << ran.out;
        EXPECT_TRUE(ran.out.ends_with(told)) << ran.out;
    };
    says("test -L unit", " -LE ^longer$ -L unit default \n");
    says("test all -L unit", " -L unit all \n");
    says("test Msaa.Edges -j 3", " -R Msaa\\.Edges -j 3 all Msaa.Edges\n");
    EXPECT_NE(contentsOf(home_ / "cmake.log").find("--target all"), std::string::npos);
}

TEST_F(Launcher, ATestRunEndsWithALineAKindAndCtestsOwn) {
    home_.write(
        "bin/ctest",
        "#!/bin/sh\n"
        "echo '1/2 Test #1: image.1 ..........   Passed    3.50 sec'\n"
        "echo '2/2 Test #2: fuzz.png .........   Passed    5.00 sec'\n"
        "mkdir -p '" +
            build() + "/tests/results'\ncat >'" + build() +
            "/tests/results/image.1.xml' <<END\n"
            "<testsuites><testsuite><testcase name='A' time='1.6'/><testcase name='B' time='1'>"
            "<skipped message='a.cpp:3&#x0A;no Chromium here'/></testcase></testsuite></testsuites>\n"
            "END\n"
            "echo '100% tests passed, 0 tests failed out of 2'\necho 'Total Test time (real) = 4 sec'\n",
        true);
    const Ran ran = run("test");
    EXPECT_EQ(ran.code, 0);
    EXPECT_TRUE(
        ran.out.ends_with("fuzz         1 tests      5 s\n"
                          "image        2 tests      3 s\n"
                          "    1 skipped: no Chromium here\n\n"
                          "100% tests passed, 0 tests failed out of 2\nTotal Test time (real) = 4 sec\n"))
        << ran.out;
}

TEST_F(Launcher, AMovedRepositoryIsConfiguredAnew) {
    run("compare");
    home_.write("repository/build/CMakeCache.txt", "CMAKE_HOME_DIRECTORY:INTERNAL=/elsewhere\n");
    fs::remove(home_ / "cmake.log");
    EXPECT_EQ(run("compare").code, 3);
    EXPECT_NE(contentsOf(home_ / "cmake.log").find("--fresh"), std::string::npos);
}

TEST_F(Launcher, TwoAtOnceBuildOneAfterTheOther) {
    const std::string one = "PATH='" + (home_ / "bin").string() + "':\"$PATH\" '" +
                            (home_ / "repository/diptych").string() +
                            "' devices >/dev/null 2>&1; [ $? = 3 ] && echo good";
    const Ran ran =
        runShell(home_, "( " + one + " ) & ( " + one + " ) & ( " + one + " ) & wait", home_.path());
    EXPECT_EQ(ran.out, "good\ngood\ngood\n");
}

// Acquires the lock as another launcher would, until released.
class HeldLock {
public:
    explicit HeldLock(const fs::path& file) {
        fs::create_directories(file.parent_path());
        file_ = ::open(file.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
        EXPECT_EQ(::flock(file_, LOCK_EX | LOCK_NB), 0);
    }
    ~HeldLock() { release(); }
    void release() {
        if (file_ >= 0) ::close(file_);
        file_ = -1;
    }

private:
    int file_;
};

TEST_F(Launcher, WhoWaitsForAnotherOneSaysSoAfterASecond) {
    ASSERT_EQ(run("devices").code, 3);  // builds
    fs::remove(home_ / ".stderr");
    HeldLock other(build() + "/launcher.lock");
    Ran ran;
    std::thread waiting([&] { ran = run("devices"); });
    const auto start = Clock::now();
    EXPECT_TRUE(soon([&] { return !contentsOf(home_ / ".stderr").empty(); }));
    EXPECT_GE(Clock::now() - start, 900ms) << "not at once";
    const auto freed = Clock::now();
    other.release();
    waiting.join();
    EXPECT_LT(Clock::now() - freed, 30s);
    EXPECT_EQ(ran.err, "diptych: waiting: another launcher is building in " + build() + "\n");
    EXPECT_EQ(ran.out, "<devices>" + home_.path().string() + "\n");
    EXPECT_EQ(ran.code, 3);
}

TEST_F(Launcher, WhoWaitsForLessThanASecondIsSilent) {
    ASSERT_EQ(run("devices").code, 3);
    for (int attempt = 0; attempt < 5; ++attempt) {
        const auto start = Clock::now();
        Ran ran;
        {
            HeldLock other(build() + "/launcher.lock");
            std::thread waiting([&] { ran = run("devices"); });
            std::this_thread::sleep_for(200ms);
            other.release();
            waiting.join();
        }
        EXPECT_EQ(ran.code, 3);
        if (Clock::now() - start > 900ms) continue;  // on a busy machine it may indeed have waited longer
        EXPECT_EQ(ran.err, "");
        return;
    }
    GTEST_SKIP() << "this machine is too busy to wait for less than a second";
}

TEST_F(Launcher, ALockThatCannotBeHadIsNamed) {
    home_.write("bin/flock", "#!/bin/sh\necho 'flock: 9: No locks available' >&2\nexit 71\n", true);
    const Ran ran = run("devices");
    EXPECT_EQ(ran.code, 2);
    EXPECT_NE(ran.err.find("diptych: " + build() + "/launcher.lock: cannot be locked\n"), std::string::npos)
        << ran.err;
    EXPECT_EQ(ran.err.find("another launcher"), std::string::npos) << ran.err;
}

// The real list: every entry is the name of a Debian package, listed once, sorted within its section.
TEST(Packages, AreNamedOnce) {
    std::istringstream lines(contentsOf(fs::path(DIPTYCH_SOURCE_DIR) / "packages.txt"));
    std::set<std::string> names;
    for (std::string line; std::getline(lines, line);) {
        line = line.substr(0, line.find('#'));
        if (line.empty()) continue;
        EXPECT_EQ(line.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789+-.|"), std::string::npos)
            << line;
        std::istringstream alternatives(line);
        for (std::string name; std::getline(alternatives, name, '|');)
            EXPECT_TRUE(names.insert(name).second) << line;
    }
    EXPECT_TRUE(names.contains("g++") && names.contains("mesa-vulkan-drivers") && names.contains("clang"));
}

}  // namespace
}  // namespace diptych
