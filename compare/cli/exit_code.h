// SPDX-License-Identifier: MIT
// Exit codes of all commands, as those of diff and grep. main() ends with exit_error after an exception.
#pragma once

namespace diptych::cli {

enum ExitCode {
    exit_pass,   // parity holds, the budget is met, the output is written
    exit_fail,   // a difference beyond tolerance, a budget that is not met
    exit_error,  // not done: usage, bad input, no suitable device, disk full
};

// An error counts before the verdict.
constexpr int exitCode(bool passed, bool errors = false) {
    return errors ? exit_error : passed ? exit_pass : exit_fail;
}

}  // namespace diptych::cli
