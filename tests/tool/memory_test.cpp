// SPDX-License-Identifier: MIT
// Memory per additional pixel and frame of a command: only a few full-size images are in memory at a time.
#include "shared/image/png.h"
#include "tests/tool/run.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstddef>
#include <cstdlib>

namespace diptych {
namespace {

// The largest resident set of the tool with these arguments, bytes. Without the variables of suites.cmake,
// by which glibc keeps freed memory.
double largestMemory(const Folder& scratch, const std::vector<std::string>& arguments) {
    std::vector<std::string> words{DIPTYCH_PROGRAM};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    const pid_t child = ::fork();
    if (child == 0) {
        const int nowhere = ::open("/dev/null", O_WRONLY);
        ::dup2(nowhere, STDOUT_FILENO);
        for (const char* name :
             {"MALLOC_TRIM_THRESHOLD_", "MALLOC_MMAP_MAX_", "MALLOC_TOP_PAD_", "GLIBC_TUNABLES"})
            ::unsetenv(name);
        if (::chdir(scratch.path().c_str()) == 0) ::execv(argv[0], argv.data());
        ::_exit(127);
    }
    int status = 0;
    rusage used{};
    if (::wait4(child, &status, 0, &used) != child || !WIFEXITED(status) || WEXITSTATUS(status) > 1) {
        ADD_FAILURE() << "status " << status;
        return 0;
    }
    return static_cast<double>(used.ru_maxrss) * 1024;
}

constexpr int smallWidth = 64, smallHeight = 36, largeWidth = 960, largeHeight = 540;

}  // namespace

// Both Frames have 98 components a pixel, 392 bytes as float32. Keeping all, plus the capture's images, took
// 1,000 bytes a pixel; it takes 230.
TEST(Memory, ComparingHoldsFewImagesAtATime) {
#if defined(__SANITIZE_ADDRESS__)
    GTEST_SKIP() << "the sanitizer keeps what was freed";
#endif
    constexpr double maxBytesPerPixel = 300;
    const Folder scratch;
    const auto compare = [&](int width, int height) {
        return largestMemory(scratch, {"compare", "builtin:points", "--runs", "1", "--size",
                                       fmt::format("{}x{}", width, height), "-o", "report", "--force", "-q"});
    };
    const double small = compare(smallWidth, smallHeight), large = compare(largeWidth, largeHeight);
    const double pixels = double{largeWidth} * largeHeight - double{smallWidth} * smallHeight;
    EXPECT_LT((large - small) / pixels, maxBytesPerPixel) << small << " bytes, then " << large;
    RecordProperty("bytes_per_pixel", static_cast<int>((large - small) / pixels));
}

// A frame compiles no pipeline again: lavapipe would, for each draw with a branch on uniforms alone, and keep
// each. Transmission once took 108 MB a frame, by its branches on a material's thickness.
TEST(Memory, FramesTakeNoMore) {
#if defined(__SANITIZE_ADDRESS__)
    GTEST_SKIP() << "the sanitizer keeps what was freed";
#endif
    constexpr double max = 64e6;  // of ten frames; single commands differ by some 5 MB
    const Folder scratch;
    for (const char* const scene : {"builtin:transmission", "builtin:layers"}) {
        const auto render = [&](const char* frames) {
            return largestMemory(
                scratch, {"render", scene, "--path", "forward_plus", "--channels", "lit", "--runs", frames,
                          "--size", "64x64", "-o", "lit.exr", "--force", "-q"});
        };
        const double few = render("2"), many = render("12");
        EXPECT_LT(many - few, max) << scene << ": " << few << " bytes, then " << many;
    }
}

// Planning uploads and compiles nothing, and blocks of device memory grow with what is in them. It took
// 352 MiB when they did not, and 157 since; the program and its libraries are 100 of them.
TEST(Memory, PlanningTakesLittle) {
#if defined(__SANITIZE_ADDRESS__)
    GTEST_SKIP() << "the sanitizer keeps what was freed";
#endif
    EXPECT_LT(largestMemory(Folder(), {"plan", "builtin:gallery", "-q"}), 220.0 * 1048576);
}

// 8-bit images stay in 8 bits, and metrics are measured a few rows at a time. Besides both images there
// are the mask of counted pixels and FLIP's errors, 1 and 4 bytes. Both sizes have the same width, so the
// threads' row buffers cancel. With float images and per-metric errors it took 44.
TEST(Memory, DiffHoldsImagesAsTheyAreStored) {
#if defined(__SANITIZE_ADDRESS__)
    GTEST_SKIP() << "the sanitizer keeps what was freed";
#endif
    constexpr double bytesPerPixel = 3 + 3 + 1 + 4;
    constexpr int width = 2048, low = 512, high = 2560;
    const Folder scratch;
    const auto diff = [&](int height) {
        Image8 image{width, height, 3, std::vector<std::uint8_t>(std::size_t{3} * width * height)};
        for (std::size_t i = 0; i < image.data.size(); ++i)
            image.data[i] = static_cast<std::uint8_t>(i / 3 * 7919 >> 6);
        writePng(scratch / "a.png", image);
        for (std::size_t i = 0; i < image.data.size(); i += 5) image.data[i] ^= 9;
        writePng(scratch / "b.png", image);
        return largestMemory(scratch, {"diff", "a.png", "b.png", "--json"});
    };
    const double small = diff(low), large = diff(high);
    const double measured = (large - small) / (double{width} * (high - low));
    EXPECT_LT(measured, bytesPerPixel + 2) << small << " bytes, then " << large;
    RecordProperty("bytes_per_pixel", static_cast<int>(measured));
}

// 67 million pixels of 11 bytes exceed the process limit of 700 MB: one line says so before anything is
// decoded.
TEST(Memory, DiffRefusesWhatDoesNotFit) {
#if defined(__SANITIZE_ADDRESS__)
    GTEST_SKIP() << "the sanitizer reserves terabytes, which ulimit -v forbids";
#endif
    const Folder scratch;
    for (const int side : {64, 8192})
        writePng(scratch / fmt::format("{}.png", side),
                 {side, side, 3, std::vector<std::uint8_t>(std::size_t{3} * side * side)});
    const auto diff = [&](int side) {
        return runShell(
            scratch, fmt::format("ulimit -v 700000; '{}' diff {}.png {}.png -q", DIPTYCH_PROGRAM, side, side),
            scratch.path());
    };
    EXPECT_EQ(diff(64).code, 0);
    const Ran refused = diff(8192);
    EXPECT_TRUE(refused.failedOver("diff of 8192.png and 8192.png, 8192x8192: needs about 0."));
    EXPECT_TRUE(refused.failedOver(" GB are free (")) << refused.err;
    EXPECT_TRUE(refused.failedOver("compare smaller images"));
}

// The memory for 256 million pixels is checked before the device allocates the first image.
TEST(Memory, DrawingRefusesWhatDoesNotFit) {
#if defined(__SANITIZE_ADDRESS__)
    GTEST_SKIP() << "the sanitizer reserves terabytes, which ulimit -v forbids";
#endif
    const Folder scratch;
    const auto run = [&](const std::string& words) {
        return runShell(scratch, fmt::format("ulimit -v 4000000; '{}' {} -q -o out", DIPTYCH_PROGRAM, words),
                        scratch.path());
    };
    EXPECT_EQ(run("render builtin:triangle --size 16x9 --runs 0 --channels lit").code, 0);
    for (const char* command :
         {"render builtin:triangle --msaa 4 --channels lit", "compare builtin:triangle",
          "audit builtin:triangle", "render builtin:triangle --path reference --reference-mode scene"}) {
        const Ran refused = run(std::string(command) + " --size 16000x16000 --force");
        EXPECT_TRUE(refused.failedOver("builtin:triangle at 16000x16000: needs about ")) << refused.err;
        EXPECT_TRUE(refused.failedOver(" GB are free (ulimit -v); a smaller --size")) << refused.err;
        EXPECT_EQ(refused.err.find("--msaa 1") != std::string::npos,
                  std::string(command).find("--msaa 4") != std::string::npos);
    }
}

}  // namespace diptych
