// SPDX-License-Identifier: MIT
#include "compare/external/child_process.h"

#include "compare/run/interruption.h"
#include "shared/text/one_line.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <system_error>

extern char** environ;

namespace diptych::external {
namespace {

using Clock = std::chrono::steady_clock;

// A file descriptor of this process, closed at its end.
class Descriptor {
public:
    explicit Descriptor(int number = -1) : number_(number) {}
    ~Descriptor() {
        if (number_ >= 0) ::close(number_);
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    int number() const { return number_; }

private:
    const int number_;
};

void check(int error, const char* what) {
    if (error != 0) throw std::system_error(error, std::generic_category(), what);
}

// What is told to posix_spawn: where the program runs, what it reads and writes, and a group of its own.
class SpawnPlan {
public:
    SpawnPlan(const std::filesystem::path& folder, int output, int error) {
        check(posix_spawn_file_actions_init(&actions_), "posix_spawn");
        check(posix_spawnattr_init(&attributes_), "posix_spawn");
        check(posix_spawn_file_actions_addchdir_np(&actions_, folder.c_str()), "posix_spawn");
        check(posix_spawn_file_actions_addopen(&actions_, 0, "/dev/null", O_RDONLY, 0), "posix_spawn");
        check(posix_spawn_file_actions_adddup2(&actions_, output, 1), "posix_spawn");
        check(posix_spawn_file_actions_adddup2(&actions_, error, 2), "posix_spawn");
        // The signals that this program waits for are blocked in it, and the program's own are not.
        sigset_t none, all;
        sigemptyset(&none);
        sigfillset(&all);
        check(posix_spawnattr_setsigmask(&attributes_, &none), "posix_spawn");
        check(posix_spawnattr_setsigdefault(&attributes_, &all), "posix_spawn");
        check(posix_spawnattr_setpgroup(&attributes_, 0), "posix_spawn");
        check(posix_spawnattr_setflags(
                  &attributes_, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF),
              "posix_spawn");
    }
    ~SpawnPlan() {
        posix_spawn_file_actions_destroy(&actions_);
        posix_spawnattr_destroy(&attributes_);
    }
    SpawnPlan(const SpawnPlan&) = delete;
    SpawnPlan& operator=(const SpawnPlan&) = delete;

    // 0, or why the program did not start. `folder`: that it runs in, which programs also look up in PWD.
    int start(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
              pid_t& process) const {
        std::string pwd = "PWD=" + folder.string();
        std::vector<char*> variables{pwd.data()};
        for (char** variable = environ; *variable; ++variable)
            if (!std::string_view(*variable).starts_with("PWD=")) variables.push_back(*variable);
        variables.push_back(nullptr);
        std::vector<char*> words;
        for (const std::string& word : arguments) words.push_back(const_cast<char*>(word.c_str()));
        words.push_back(nullptr);
        return posix_spawnp(&process, words.front(), &actions_, &attributes_, words.data(), variables.data());
    }

private:
    posix_spawn_file_actions_t actions_{};
    posix_spawnattr_t attributes_{};
};

// A pipe from a program; the end that it writes to is closed here once it has begun.
struct Pipe {
    Pipe() {
        int ends[2];
        check(::pipe2(ends, O_CLOEXEC) == 0 ? 0 : errno, "pipe");
        output.emplace(ends[0]);
        input.emplace(ends[1]);
        check(::fcntl(ends[0], F_SETFL, O_NONBLOCK) == 0 ? 0 : errno, "fcntl");
    }
    std::optional<Descriptor> output, input;
};

// Returns how many bytes it has cut off.
std::size_t addToEnd(std::string& text, std::string_view more) {
    text.append(more);
    const std::size_t over = text.size() - std::min(text.size(), most_said);
    text.erase(0, over);
    return over;
}

// Adds what there is to read; false at the end of it.
bool readInto(Ended& ended, const Pipe& pipe, bool error) {
    char bytes[4096];
    for (;;) {
        const ssize_t count = ::read(pipe.output->number(), bytes, sizeof bytes);
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) return errno == EAGAIN;
        if (count == 0) return false;
        const std::string_view more(bytes, static_cast<std::size_t>(count));
        ended.unsaid += addToEnd(ended.said, more);
        if (error) addToEnd(ended.warned, more);
    }
}

// Until the process has ended or the time is over, reads what it says. Its end is what counts and not that of
// its output, which whoever it started may hold open.
bool waitFor(int process, const Pipe& output, const Pipe& error, double seconds, Ended& ended) {
    const auto last = Clock::now() + std::chrono::duration<double>(seconds);
    pollfd watched[3] = {
        {process, POLLIN, 0}, {output.output->number(), POLLIN, 0}, {error.output->number(), POLLIN, 0}};
    for (;;) {
        const double left = std::chrono::duration<double, std::milli>(last - Clock::now()).count();
        if (left <= 0) return false;
        const int ready = ::poll(watched, 3, static_cast<int>(std::min(left, 1000.0)) + 1);
        if (ready < 0 && errno != EINTR) check(errno, "poll");
        if (ready <= 0) continue;
        if (watched[1].revents != 0 && !readInto(ended, output, false)) watched[1].fd = -1;
        if (watched[2].revents != 0 && !readInto(ended, error, true)) watched[2].fd = -1;
        if (watched[0].revents != 0) return true;
    }
}

}  // namespace

Ended runProgram(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
                 double seconds) {
    Pipe output, error;
    const auto start = Clock::now();
    Ended ended;
    pid_t process = 0;
    if (const int failed = SpawnPlan(folder, output.input->number(), error.input->number())
                               .start(arguments, folder, process);
        failed != 0)
        throw std::runtime_error(fmt::format("{}: cannot be started in {}: {}", oneLine(arguments.front()),
                                             oneLine(folder.string()), std::strerror(failed)));
    output.input.reset();
    error.input.reset();
    const KilledWhenInterrupted watched(process);
    // By its number: glibc 2.36 declares pidfd_open() without C linkage.
    const Descriptor handle(static_cast<int>(::syscall(SYS_pidfd_open, process, 0)));
    check(handle.number() >= 0 ? 0 : errno, "pidfd_open");
    ended.timed_out = !waitFor(handle.number(), output, error, seconds, ended);
    // Before the process is waited for: until then nobody else can have its group's number.
    ::kill(-process, SIGKILL);
    int status = 0;
    while (::waitpid(process, &status, 0) < 0 && errno == EINTR) {
    }
    readInto(ended, output, false);
    readInto(ended, error, true);
    if (WIFEXITED(status)) ended.code = WEXITSTATUS(status);
    if (WIFSIGNALED(status)) ended.signal = WTERMSIG(status);
    ended.ms = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
    return ended;
}

std::string howItEnded(const Ended& ended, double seconds) {
    if (ended.timed_out) return fmt::format("was killed after {:g} s, which is its timeout", seconds);
    if (ended.signal != 0)
        return fmt::format("was ended by signal {} ({})", ended.signal, ::strsignal(ended.signal));
    return ended.code == 0 ? std::string() : fmt::format("exited with {}", ended.code);
}

}  // namespace diptych::external
