// SPDX-License-Identifier: MIT
// Runs another program with a time limit.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace diptych::external {

// Exit status and output of a program.
struct Ended {
    int code = -1;           // exit code; -1: ended by a signal
    int signal = 0;          // that signal; 0: none
    bool timed_out = false;  // exceeded its time and was killed
    // The last bytes of stdout and stderr, at most largest_output, unmodified; and the number of bytes before
    // them.
    std::string output;
    std::size_t omitted = 0;
    std::string warned;  // the last bytes of stderr
    double ms = 0;

    bool well() const { return code == 0 && !timed_out; }
};
inline constexpr std::size_t largest_output = 16 * 1024;

// Runs arguments[0], found in PATH if it has no slash, with `arguments`; no shell is involved. The working
// directory is `folder`, stdin is empty. Kills everything that the program started, in any group or
// session, when it ends, after `seconds`, or when this process dies. Throws std::runtime_error, one line
// naming the program, if it cannot start.
Ended runProgram(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
                 double seconds);

// "was killed after its timeout of 60 s", "exited with 3", "was ended by signal 11 (Segmentation fault)".
// Empty on success.
std::string howItEnded(const Ended& ended, double seconds);

}  // namespace diptych::external
