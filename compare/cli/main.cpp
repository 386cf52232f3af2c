// SPDX-License-Identifier: MIT
#include "compare/cli/command_line.h"
#include "compare/cli/exit_code.h"
#include "compare/run/interruption.h"
#include "compare/run/print.h"
#include "shared/text/json_text.h"
#include "shared/text/one_line.h"

#include <fcntl.h>
#include <malloc.h>
#include <unistd.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <csignal>
#include <exception>
#include <limits>
#include <new>
#include <string>
#include <string_view>
#include <system_error>

namespace {

// Handles every error: one line on stderr, exit code 2, and an object on stdout with --json.
int fail(const std::string& what, bool json) {
    diptych::printMessage(what);
    if (json) {
        const nlohmann::ordered_json object{{"schema", 1}, {"error", diptych::messageLine(what)}};
        diptych::printOut("{}\n", diptych::jsonText(object));
        diptych::flushText();
    }
    return diptych::cli::exit_error;
}

// The reader of stdout closed the pipe. Ends the program by SIGPIPE, which was ignored until now so that
// no partial file remains.
[[noreturn]] void endOfPipe() {
    diptych::dieOf(SIGPIPE);
}

// Opens descriptors 0, 1 and 2 if the parent closed them. Otherwise the next opened file would receive the
// messages. The access mode is reversed, so that reads and writes fail as on a closed descriptor.
void holdStandardDescriptors() {
    for (const int descriptor : {0, 1, 2})
        if (::fcntl(descriptor, F_GETFD) == -1 &&
            ::open("/dev/null", descriptor == 0 ? O_WRONLY : O_RDONLY) != descriptor)
            ::_exit(diptych::cli::exit_error);
}

// Keeps freed memory for the next pipeline: a driver that compiles on the CPU takes and frees tens of
// megabytes for each, in small pieces. Images and blocks of device memory go back to the system: kept, they
// leave holes of all sizes (compare/render/MEASURED.md).
void keepFreedMemory() {
    mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
    mallopt(M_MMAP_THRESHOLD, 4 << 20);
    mallopt(M_TOP_PAD, 64 << 20);
}

int run(const diptych::cli::CommandLine& line) {
    if (line.help.empty()) return line.command.run();
    diptych::printText(line.help);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    holdStandardDescriptors();
    keepFreedMemory();
    const bool json = std::any_of(argv, argv + argc, [](std::string_view word) { return word == "--json"; });
    try {
        std::signal(SIGPIPE, SIG_IGN);
        std::signal(SIGXFSZ, SIG_IGN);  // a file over the size limit (ulimit -f) becomes a write error
        diptych::watchInterruption();
        const int code = run(diptych::cli::parseCommandLine({argv + std::min(argc, 1), argv + argc}));
        if (const int error = diptych::flushText(); error != 0)
            throw std::system_error(error, std::generic_category(), "stdout: cannot write");
        return code;
    } catch (const std::system_error& error) {
        if (error.code() == std::errc::broken_pipe) endOfPipe();
        return fail(error.what(), json);
    } catch (const std::bad_alloc&) {
        return fail("out of memory; try a smaller --size, fewer --channels, or one scene at a time", json);
    } catch (const std::exception& error) {
        return fail(error.what(), json);
    }
}
