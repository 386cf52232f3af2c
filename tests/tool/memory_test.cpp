// SPDX-License-Identifier: MIT
// How much memory a command takes for each pixel more: what grows with the picture is held a few images at a
// time, however many there are.
#include "tests/tool/run.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstddef>

namespace diptych {
namespace {

// The largest resident set of the tool with these arguments, bytes.
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

// Both Frames are of 98 components a pixel, 392 bytes as float32: less than that is only possible where they
// are not all in memory. Holding them, and the capture's images beside them, took 1,000.
TEST(Memory, ComparingHoldsFewImagesAtATime) {
#if defined(__SANITIZE_ADDRESS__)
    GTEST_SKIP() << "the sanitizer keeps what was freed";
#endif
    constexpr double mostBytesPerPixel = 392;
    const Folder scratch;
    const auto compare = [&](int width, int height) {
        return largestMemory(scratch, {"compare", "builtin:points", "--runs", "1", "--size",
                                       fmt::format("{}x{}", width, height), "-o", "report", "--force", "-q"});
    };
    const double small = compare(smallWidth, smallHeight), large = compare(largeWidth, largeHeight);
    const double pixels = double{largeWidth} * largeHeight - double{smallWidth} * smallHeight;
    EXPECT_LT((large - small) / pixels, mostBytesPerPixel) << small << " bytes, then " << large;
    RecordProperty("bytes_per_pixel", static_cast<int>((large - small) / pixels));
}

}  // namespace diptych
