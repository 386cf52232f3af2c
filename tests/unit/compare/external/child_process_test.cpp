// SPDX-License-Identifier: MIT
#include "compare/external/child_process.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>

namespace diptych::external {
namespace {

// The program sends a signal while this process waits for its output.
TEST(ChildProcess, SignalsChangeNeitherOutputNorExitCode) {
    static int signals;
    signals = 0;
    struct sigaction before {};
    struct sigaction counting {};
    counting.sa_handler = [](int) { ++signals; };
    ASSERT_EQ(::sigaction(SIGUSR1, &counting, &before), 0);
    const Ended ended = runProgram(
        {"sh", "-c",
         fmt::format("printf 1; sleep 0.05; kill -USR1 {}; sleep 0.02; printf 2 >&2; exit 3", ::getpid())},
        "/", 10);
    ::sigaction(SIGUSR1, &before, nullptr);
    EXPECT_EQ(signals, 1);
    EXPECT_EQ(ended.code, 3);
    EXPECT_EQ(ended.signal, 0);
    EXPECT_FALSE(ended.timed_out);
    EXPECT_EQ(ended.output, "12");
    EXPECT_EQ(ended.warned, "2");
    EXPECT_EQ(howItEnded(ended, 10), "exited with 3");
}

}  // namespace
}  // namespace diptych::external
