// SPDX-License-Identifier: MIT
// The list of all commands.
#include "compare/cli/command.h"

namespace diptych::cli {

// In the order of --help. command_X.cpp defines xCommand().
#define COMMANDS(X) \
    X(compare)      \
    X(render)       \
    X(diff)         \
    X(tradeoff)     \
    X(explain)      \
    X(choose)       \
    X(audit)        \
    X(plan)         \
    X(view)         \
    X(bench)        \
    X(calibrate)    \
    X(merge)        \
    X(submit)       \
    X(accept)       \
    X(devices)

#define DECLARED(name) Command name##Command();
COMMANDS(DECLARED)

std::vector<Command> allCommands() {
#define MADE(name) name##Command(),
    return {COMMANDS(MADE)};
}

}  // namespace diptych::cli
