// SPDX-License-Identifier: MIT
#include "compare/run/color.h"

#include <gtest/gtest.h>

#include <fcntl.h>
#include <unistd.h>

#include <cstdlib>

namespace diptych {
namespace {

TEST(Color, MarksVerdictsWhereTheyBeginOrEndALine) {
    EXPECT_EQ(colored("  lit  relative  0.1  FAIL\n"), "  lit  relative  0.1  \033[1;31mFAIL\033[0m\n");
    EXPECT_EQ(colored("pass: all\nERROR x"), "\033[32mpass\033[0m: all\n\033[1;31mERROR\033[0m x");
    EXPECT_EQ(colored("  warning lit: a pass of light"), "  \033[33mwarning\033[0m lit: a pass of light");
    EXPECT_EQ(colored("pass\nFAIL: not a pass"), "\033[32mpass\033[0m\n\033[1;31mFAIL\033[0m: not a pass");
    EXPECT_EQ(colored("a warn\n warn"), "a \033[33mwarn\033[0m\n \033[33mwarn\033[0m");
    for (const char* text : {"", "\n", "passes", "the pass failed", "bypass", "no verdict\n\n",
                             "pass_2 and 2pass", "pass2", "_pass", "  "})
        EXPECT_EQ(colored(text), text);
}

TEST(Color, IsForTerminalsUnlessAskedFor) {
    std::FILE* const file = std::tmpfile();
    EXPECT_FALSE(hasColor(ColorChoice::automatic, file)) << "no terminal";
    EXPECT_TRUE(hasColor(ColorChoice::on, file));
    EXPECT_FALSE(hasColor(ColorChoice::off, file));
    std::fclose(file);
}

// On a terminal of its own, NO_COLOR and TERM=dumb disable colours.
TEST(Color, NoColorIsHeeded) {
    const int terminal = posix_openpt(O_RDWR | O_NOCTTY);
    if (terminal < 0) GTEST_SKIP() << "no pseudo terminal here";
    grantpt(terminal);
    unlockpt(terminal);
    std::FILE* const stream = std::fopen(ptsname(terminal), "w");
    ASSERT_NE(stream, nullptr);
    setenv("TERM", "xterm", 1);
    unsetenv("NO_COLOR");
    EXPECT_TRUE(hasColor(ColorChoice::automatic, stream));
    setenv("NO_COLOR", "1", 1);
    EXPECT_FALSE(hasColor(ColorChoice::automatic, stream));
    EXPECT_TRUE(hasColor(ColorChoice::on, stream)) << "--color on says otherwise";
    setenv("NO_COLOR", "", 1);
    EXPECT_TRUE(hasColor(ColorChoice::automatic, stream)) << "set to nothing is not set (no-color.org)";
    for (const char* term : {"dumb", ""}) {
        setenv("TERM", term, 1);
        EXPECT_FALSE(hasColor(ColorChoice::automatic, stream)) << term;
    }
    std::fclose(stream);
    close(terminal);
}

}  // namespace
}  // namespace diptych
