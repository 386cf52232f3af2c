// SPDX-License-Identifier: MIT
// Another program that is run to its end, within a time.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace diptych::external {

// How a program ended, and what it said.
struct Ended {
    int code = -1;           // its exit code; -1: a signal ended it
    int signal = 0;          // that signal; 0: none
    bool timed_out = false;  // it took longer than it may, and was killed
    // The end of what it wrote to stdout and stderr, at most most_said bytes, as it wrote them; and how many
    // bytes came before that.
    std::string said;
    std::size_t unsaid = 0;
    std::string warned;  // the end of what of it was written to stderr
    double ms = 0;

    bool well() const { return code == 0 && !timed_out; }
};
inline constexpr std::size_t most_said = 16 * 1024;

// Runs arguments[0], which is looked for in PATH where it has no slash, with `arguments` as they are: no
// shell reads them. Its working directory is `folder`, its stdin is empty, and all that it started, in
// whatever group or session, is killed when the program ends, when `seconds` are over, and when this process
// ends, however it does. Throws std::runtime_error, one line naming the program, where it cannot be started.
Ended runProgram(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
                 double seconds);

// "was killed after 60 s", "exited with 3", "was ended by signal 11 (Segmentation fault)"; empty where all is
// well.
std::string howItEnded(const Ended& ended, double seconds);

}  // namespace diptych::external
