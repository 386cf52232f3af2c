// SPDX-License-Identifier: MIT
#include "compare/commands.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <new>
#include <stdexcept>
#include <string>

namespace {

// Everything that goes wrong ends here: one line on stderr, exit code 2.
int fail(std::string what) {
    std::ranges::replace(what, '\n', ' ');
    std::fprintf(stderr, "diptych: %s\n", what.c_str());
    return 2;
}

int run(const diptych::Options& options) {
    if (options.help.empty()) return diptych::runCommand(options);
    fmt::print("{}", options.help);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        const int code = run(diptych::parseCommandLine({argv + std::min(argc, 1), argv + argc}));
        if (std::fflush(stdout) != 0 || std::ferror(stdout)) return fail("stdout: cannot be written");
        return code;
    } catch (const std::bad_alloc&) {
        return fail("out of memory");
    } catch (const std::exception& error) {
        return fail(error.what());
    }
}
