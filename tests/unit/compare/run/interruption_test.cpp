// SPDX-License-Identifier: MIT
#include "compare/run/interruption.h"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <ctime>

namespace diptych {
namespace {

// A supervisor that needs a moment to end its processes is not killed.
TEST(EndSupervised, WaitsForASupervisorThatEnds) {
    int ends[2];
    ASSERT_EQ(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends), 0);
    const pid_t supervisor = ::fork();
    ASSERT_GE(supervisor, 0);
    if (supervisor == 0) {  // system calls only
        char byte = 0;
        const bool told = ::read(ends[1], &byte, 1) == 1;
        constexpr timespec moment{0, 50'000'000};
        ::nanosleep(&moment, nullptr);
        ::_exit(told ? 7 : 1);
    }
    endSupervised(ends[0], supervisor);
    int status = 0;
    ASSERT_EQ(::waitpid(supervisor, &status, WNOHANG), supervisor) << "it has ended";
    EXPECT_TRUE(WIFEXITED(status)) << "signal " << WTERMSIG(status);
    EXPECT_EQ(WEXITSTATUS(status), 7);
    for (const int end : ends) ::close(end);
}

}  // namespace
}  // namespace diptych
