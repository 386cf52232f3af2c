// SPDX-License-Identifier: MIT
// gpu-first-run.sh: with the real programs in its quick mode, and with fake programs that fail as a new
// device may.
#include "tests/tool/run.h"

#include <set>
#include <vector>

namespace diptych {
namespace {

// Fake programs. BROKEN lists what fails, between commas: render, bench, differs, message, test, killed ...
constexpr const char* fakeTool = R"(#!/bin/sh
folder() {
    while [ "$1" != -o ]; do shift; done
    made=$2
    mkdir -p "$made"
}
case "$BROKEN $*" in
    *,render,*\ render*) echo "diptych: no Vulkan device" >&2; exit 2 ;;
    *list-scenes*) printf '      "name": "builtin:triangle",\n      "name": "builtin:spheres?lights=N",\n' ;;
    *render*)
        printf '{\n  "device": {\n    "name": "Fake GPU 1",\n    "driver": "fake 2",\n'
        printf '    "type": "discrete"\n  }\n}\n' ;;
    *devices\ --json) echo '{}' ;;
    *,inexact,*--probe) echo '     FAIL: 1 of 75 probes: a / b'; exit 1 ;;
    *--probe) echo '     pass: 75 of 75 probes' ;;
    *devices) printf '0  Fake GPU 1 (discrete)\n     yes  one thing\n     no   another thing\n' ;;
    *,related,*\ audit*) echo 'FAIL: 25 of 26 relations hold, 1 broken, 0 not applicable'; exit 1 ;;
    *audit*) echo 'pass: 26 of 26 relations hold, 0 broken, 0 not applicable' ;;
    *,bench,*\ bench*) echo "diptych: the device was lost" >&2; exit 2 ;;
    *,message,*\ compare*) echo "diptych: --validate: 3 messages, the first: a | b" >&2; exit 2 ;;
    *,differs,*\ compare*)
        folder "$@"
        printf '"verdict": "fail",\n"name": "deferred",\n"number": 0,\n"name": "lit",\n"verdict": "fail"\n' \
            >"$made/report.json"
        exit 1 ;;
    *compare*|*bench*) folder "$@"; printf '"name": "depth",\n"max": 1e-07,\n' >"$made/report.json" ;;
    *--version) echo "diptych 9" ;;
esac
)";
constexpr const char* fakeTests = R"(#!/bin/sh
case "$BROKEN $*" in
    *list_tests*NoContraction*) ;;
    *list_tests*) printf 'Suite.\n  Name\n' ;;
    *,killed,*Lights*) echo '[ RUN      ] Lights.Last'; kill -9 $$ ;;
    *,test,*Parity*)
        printf '[ RUN      ] Parity.Name\na.cpp:3: Failure\nExpected 0\n  Actual: 7 pixels\n'
        printf '[  FAILED  ] Parity.Name (2 ms)\n[  FAILED  ] Parity.Name\n'
        exit 1 ;;
    *) printf '[ RUN      ] Suite.Name\nmeasured: 12 pixels\n[       OK ] Suite.Name (1 ms)\n' ;;
esac
)";

constexpr const char* fakeKernels = R"(#!/bin/sh
[ "$1" -ge 15 ] && printf 'kernel  ns\ntexel buffer, as read  2.2\nstorage buffer, too  3.2\n'
)";

class GpuFirstRun : public testing::Test {
protected:
    void SetUp() override {
        home_.write("build/compare/diptych", fakeTool, true);
        for (const char* name : {"image_tests", "probe_tests"})
            home_.write(std::string("build/tests/") + name, fakeTests, true);
        home_.write("build/tests/bench_kernels", fakeKernels, true);
    }
    Ran run(const std::string& arguments, const std::string& broken, std::string build = "") {
        if (build.empty()) build = (home_ / "build").string();
        return runShell(home_,
                        "DIPTYCH_BUILD='" + build + "' BROKEN=," + broken +
                            ", '" DIPTYCH_SOURCE_DIR "/tests/gpu-first-run.sh' " + arguments,
                        home_.path());
    }
    std::string summary() const { return contentsOf(home_ / "out/README.md"); }
    // The table row of a step.
    std::string row(const std::string& step) const {
        const std::string text = summary(), start = "\n| " + step + " | ";
        const std::size_t at = text.find(start);
        return at == text.npos ? ""
                               : text.substr(at + start.size(), text.find('\n', at + 1) - at - start.size());
    }

    Folder home_;
};

TEST_F(GpuFirstRun, QuicklyWithTheRealPrograms) {
    const fs::path build = fs::path(DIPTYCH_PROGRAM).parent_path().parent_path();
    for (const char* name : {"image_tests", "probe_tests"})
        if (!fs::exists(build / "tests" / name)) GTEST_SKIP() << name << " is not built";
    const Ran ran = run("--quick out", "nothing", build.string());
    EXPECT_EQ(ran.code, 0) << ran.out << ran.err << summary();
    for (const char* step :
         {"devices", "arithmetic", "relations", "validation", "parity", "probes", "bench-spheres"})
        EXPECT_TRUE(row(step).starts_with("passed | ")) << step << "\n" << summary();
    for (const char* file : {"devices.json", "devices.txt", "validation/triangle.json", "validation.md",
                             "parity.xml", "probes.xml", "bench-spheres/bench.json", "bench-spheres.log"})
        EXPECT_GT(fs::file_size(home_ / "out" / file), 0u) << file;
    EXPECT_NE(row("parity").find("1 TESTs, 0 failed"), std::string::npos) << summary();
    EXPECT_NE(summary().find("| verdict | all right |"), std::string::npos) << summary();
}

TEST_F(GpuFirstRun, LeavesAFolderOfTheDevicesName) {
    const Ran ran = run("", "nothing");
    EXPECT_EQ(ran.code, 0) << ran.out << ran.err;
    std::string name;
    for (const auto& entry : fs::directory_iterator(home_.path()))
        if (entry.path().filename().string().starts_with("gpu-first-run-20")) name = entry.path().filename();
    ASSERT_TRUE(name.ends_with("-Fake-GPU-1")) << name << ran.out;
    fs::rename(home_ / name, home_ / "out");
    EXPECT_NE(summary().find("| device | Fake GPU 1 (discrete) |\n| driver | fake 2 |\n"), std::string::npos);
    EXPECT_TRUE(row("light-matrix").starts_with("passed")) << "a GPU is asked everything\n" << summary();
    EXPECT_TRUE(row("kernels").starts_with("passed | ")) << summary();
    EXPECT_NE(row("kernels").find(" | 2 kernels | "), std::string::npos) << summary();
    EXPECT_NE(summary().find("\n    texel buffer, as read  2.2\n"), std::string::npos) << summary();
    EXPECT_TRUE(row("no-contraction").starts_with("not run | ")) << summary();
    EXPECT_NE(row("no-contraction").find("not in this build"), std::string::npos);
    EXPECT_NE(row("validation").find("2 scenes, 0 differ, 0 with messages or errors, 2 with other depths"),
              std::string::npos)
        << summary();
    EXPECT_NE(summary().find("\n    measured: 12 pixels\n"), std::string::npos) << "of a probe\n"
                                                                                << summary();
    EXPECT_NE(summary().find("\n         no   another thing\n"), std::string::npos) << summary();
}

TEST_F(GpuFirstRun, AStepThatFailsIsNamedAndStopsNoOther) {
    struct Control {
        const char *broken, *step, *says;
    };
    // Those of one run are of different steps.
    const std::vector<std::vector<Control>> runs{
        {{"inexact", "arithmetic", "FAIL: 1 of 75 probes: a / b"},
         {"related", "relations", "FAIL: 25 of 26 relations hold, 1 broken"},
         {"bench", "bench-spheres", "the device was lost"},
         {"differs", "validation", "`builtin:points`: exit code 1: differs: lit\n"},
         {"test", "parity", "`Parity.Name`: Expected 0 Actual: 7 pixels\n"},
         {"killed", "probes", "`Lights.Last`: it ended in this one\n"}},
        {{"message", "validation", "`builtin:triangle`: exit code 2: diptych: --validate: 3 messages"}}};
    for (const std::vector<Control>& controls : runs) {
        std::string broken;
        std::set<std::string> failed;
        for (const Control& control : controls) {
            broken += std::string(broken.empty() ? "" : ",") + control.broken;
            failed.insert(control.step);
        }
        fs::remove_all(home_ / "out");
        const Ran ran = run("--quick out", broken);
        EXPECT_EQ(ran.code, 1) << broken << ran.err;
        const std::string text = summary();
        for (const auto& [name, step, says] : controls) {
            EXPECT_TRUE(row(step).starts_with("**failed** | ")) << name << "\n" << text;
            EXPECT_NE(text.find(std::string("\n- **") + step + "**"), std::string::npos);
            EXPECT_NE(text.find(says), std::string::npos) << name << "\n" << text;
        }
        EXPECT_NE(text.find("| verdict | steps that failed: " + std::to_string(failed.size()) + " |"),
                  std::string::npos)
            << text;
        for (const char* step :
             {"devices", "arithmetic", "relations", "validation", "parity", "probes", "bench-spheres"})
            EXPECT_EQ(row(step).starts_with("passed | "), !failed.contains(step)) << step << "\n" << text;
    }
}

TEST_F(GpuFirstRun, WhatItCannotDoIsOneLine) {
    const auto says = [&](const Ran& ran, const std::string& what) {
        return ran.code == 2 && ran.out.empty() && std::ranges::count(ran.err, '\n') == 1 &&
               ran.err.starts_with("gpu-first-run.sh: ") && ran.err.find(what) != std::string::npos;
    };
    EXPECT_TRUE(says(run("out", "render"), "no device draws a triangle: diptych: no Vulkan device"));
    EXPECT_FALSE(fs::exists(home_ / "out"));
    EXPECT_TRUE(says(run("--fast", "nothing"), "--fast"));
    EXPECT_TRUE(says(run("", "nothing", "nowhere"), "nowhere/compare/diptych"));
    home_.write("out/mine.txt", "mine");
    EXPECT_TRUE(says(run("--quick out", "nothing"), "out: is not empty"));
}

}  // namespace
}  // namespace diptych
