// SPDX-License-Identifier: MIT
#include "compare/external/child_process.h"

#include "compare/run/interruption.h"
#include "shared/text/one_line.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <ctime>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <system_error>

extern char** environ;

namespace diptych::external {
namespace {

using Clock = std::chrono::steady_clock;

// Owns a file descriptor.
class Descriptor {
public:
    explicit Descriptor(int fd = -1) : fd_(fd) {}
    ~Descriptor() {
        if (fd_ >= 0) ::close(fd_);
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    int fd() const { return fd_; }

private:
    const int fd_;
};

void check(int error, const char* what) {
    if (error != 0) throw std::system_error(error, std::generic_category(), what);
}

// Arguments of posix_spawn: program, folder, stdin, stdout, stderr and a new process group. Built before
// fork(), because the child must not allocate.
class SpawnPlan {
public:
    SpawnPlan(const std::vector<std::string>& arguments, const std::filesystem::path& folder, int output,
              int error)
        : pwd_("PWD=" + folder.string()), variables_{pwd_.data()} {
        for (char** variable = environ; *variable; ++variable)
            if (!std::string_view(*variable).starts_with("PWD=")) variables_.push_back(*variable);
        variables_.push_back(nullptr);
        for (const std::string& argument : arguments)
            arguments_.push_back(const_cast<char*>(argument.c_str()));
        arguments_.push_back(nullptr);
        check(posix_spawn_file_actions_init(&actions_), "posix_spawn");
        check(posix_spawnattr_init(&attributes_), "posix_spawn");
        check(posix_spawn_file_actions_addchdir_np(&actions_, folder.c_str()), "posix_spawn");
        check(posix_spawn_file_actions_addopen(&actions_, 0, "/dev/null", O_RDONLY, 0), "posix_spawn");
        check(posix_spawn_file_actions_adddup2(&actions_, output, 1), "posix_spawn");
        check(posix_spawn_file_actions_adddup2(&actions_, error, 2), "posix_spawn");
        // Resets the signal mask and handlers, which the program would inherit.
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

    // Returns 0 or an errno.
    int start(pid_t& process) const {
        return posix_spawnp(&process, arguments_.front(), &actions_, &attributes_, arguments_.data(),
                            variables_.data());
    }

private:
    std::string pwd_;  // PWD must agree with the working directory
    std::vector<char*> variables_, arguments_;
    posix_spawn_file_actions_t actions_{};
    posix_spawnattr_t attributes_{};
};

// A pipe from the program. The write end is closed here after the fork.
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

// A socket pair: one end notices if the other sends a byte or its process dies.
struct Lifeline {
    Lifeline() {
        int ends[2];
        check(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) == 0 ? 0 : errno, "socketpair");
        ours.emplace(ends[0]);
        supervisors.emplace(ends[1]);
    }
    std::optional<Descriptor> ours, supervisors;
};

// Keeps the last largest_output bytes; returns the number of dropped ones.
std::size_t addToEnd(std::string& text, std::string_view more) {
    text.append(more);
    const std::size_t over = text.size() - std::min(text.size(), largest_output);
    text.erase(0, over);
    return over;
}

// Reads all available bytes. Returns false at the end of the stream.
bool readInto(Ended& ended, const Pipe& pipe, bool error) {
    char bytes[4096];
    for (;;) {
        const ssize_t count = ::read(pipe.output->fd(), bytes, sizeof bytes);
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) return errno == EAGAIN;
        if (count == 0) return false;
        const std::string_view more(bytes, static_cast<std::size_t>(count));
        ended.omitted += addToEnd(ended.output, more);
        if (error) addToEnd(ended.warned, more);
    }
}

// The supervisor's report.
struct Outcome {
    int failed = 0;  // errno of a failed start
    int status = 0;  // of waitpid()
};

// By system call number: glibc 2.36 declares pidfd_open() without C linkage.
int handleOf(pid_t process) {
    return static_cast<int>(::syscall(SYS_pidfd_open, process, 0));
}

// Kills all children of this single-threaded process.
void killChildren() {
    const int list = ::open("/proc/thread-self/children", O_RDONLY | O_CLOEXEC);
    if (list < 0) return;
    char bytes[4096];
    pid_t process = 0;
    for (ssize_t count = 0; (count = ::read(list, bytes, sizeof bytes)) > 0;)
        for (ssize_t i = 0; i < count; ++i)
            if (bytes[i] != ' ') {
                process = 10 * process + (bytes[i] - '0');
            } else {
                ::kill(process, SIGKILL);
                process = 0;
            }
    ::close(list);
}

// Kills everything that the program started, in any group or session. Orphans become children of this
// process, the subreaper, so it kills children until there are none. A process that survives 5 s is stuck
// in the kernel or belongs to another user.
void killAllBelow() {
    constexpr timespec pause{0, 1'000'000};
    for (int i = 0; i < 5000; ++i) {
        killChildren();
        pid_t ended = 0;
        while ((ended = ::waitpid(-1, nullptr, WNOHANG)) > 0) {
        }
        if (ended < 0) return;
        ::nanosleep(&pause, nullptr);
    }
}

// Closes all inherited descriptors, such as locks and pipes, except these two.
void keepOnly(int& lifeline, int& report) {
    // Duplicates from 3 on first, so that neither overwrites the other.
    lifeline = ::dup2(::fcntl(lifeline, F_DUPFD_CLOEXEC, 3), 0);
    report = ::dup2(::fcntl(report, F_DUPFD_CLOEXEC, 3), 1);
    if (::syscall(SYS_close_range, 2u, ~0u, 0u) == 0) return;
    const auto max = static_cast<int>(std::min(::sysconf(_SC_OPEN_MAX), 65536L));  // before Linux 5.9
    for (int file = 2; file < max; ++file) ::close(file);
}

// The supervisor process. Starts the program, and kills all its processes when it ends, when the lifeline
// signals, or when our process dies in any way. Runs in the fork of a multithreaded process: system calls
// only.
[[noreturn]] void supervise(const SpawnPlan& plan, int lifeline, int report) {
    ::setpgid(0, 0);  // own group: the terminal sends it no signals
    sigset_t all;
    sigfillset(&all);
    ::sigprocmask(SIG_BLOCK, &all, nullptr);
    ::signal(SIGCHLD, SIG_DFL);
    ::prctl(PR_SET_NAME, "diptych-run");
    ::prctl(PR_SET_CHILD_SUBREAPER, 1);
    Outcome outcome;
    pid_t process = 0;
    outcome.failed = plan.start(process);
    keepOnly(lifeline, report);
    if (outcome.failed == 0) {
        pollfd watched[2] = {{handleOf(process), POLLIN, 0}, {lifeline, POLLIN, 0}};
        if (watched[0].fd < 0) outcome.failed = errno;
        while (outcome.failed == 0 && ::poll(watched, 2, -1) < 0 && errno == EINTR) {
        }
        // Before waitpid(): until then the group's number cannot be reused.
        ::kill(-process, SIGKILL);
        ::waitpid(process, &outcome.status, 0);
        killAllBelow();
    }
    const ssize_t written = ::write(report, &outcome, sizeof outcome);
    ::_exit(written == sizeof outcome ? 0 : 1);
}

// Reads output until the supervisor ends or the time is over. The end of the output is no criterion: a
// grandchild may keep it open.
bool waitFor(int supervisor, const Pipe& output, const Pipe& error, double seconds, Ended& ended) {
    const auto last = Clock::now() + std::chrono::duration<double>(seconds);
    pollfd watched[3] = {
        {supervisor, POLLIN, 0}, {output.output->fd(), POLLIN, 0}, {error.output->fd(), POLLIN, 0}};
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
    Pipe output, error, report;
    Lifeline lifeline;
    const SpawnPlan plan(arguments, folder, output.input->fd(), error.input->fd());
    const auto start = Clock::now();
    Ended ended;
    const pid_t supervisor = ::fork();
    check(supervisor >= 0 ? 0 : errno, "fork");
    if (supervisor == 0) {
        lifeline.ours.reset();  // this copy would keep the lifeline open
        supervise(plan, lifeline.supervisors->fd(), report.input->fd());
    }
    for (Pipe* written : {&output, &error, &report}) written->input.reset();
    lifeline.supervisors.reset();
    {
        const EndedWhenInterrupted watched(lifeline.ours->fd(), supervisor);
        const Descriptor handle(handleOf(supervisor));
        const int failed = handle.fd() >= 0 ? 0 : errno;
        ended.timed_out = failed == 0 && !waitFor(handle.fd(), output, error, seconds, ended);
        if (ended.timed_out || failed != 0) endSupervised(lifeline.ours->fd(), supervisor);
        while (::waitpid(supervisor, nullptr, 0) < 0 && errno == EINTR) {
        }
        check(failed, "pidfd_open");
    }
    Outcome outcome{0, SIGKILL};  // if the supervisor was killed
    const ssize_t count = ::read(report.output->fd(), &outcome, sizeof outcome);
    if (count == sizeof outcome && outcome.failed != 0)
        throw std::runtime_error(fmt::format("{}: cannot be started in {}: {}", oneLine(arguments.front()),
                                             oneLine(folder.string()), std::strerror(outcome.failed)));
    readInto(ended, output, false);
    readInto(ended, error, true);
    if (WIFEXITED(outcome.status)) ended.code = WEXITSTATUS(outcome.status);
    if (WIFSIGNALED(outcome.status)) ended.signal = WTERMSIG(outcome.status);
    ended.ms = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
    return ended;
}

std::string howItEnded(const Ended& ended, double seconds) {
    if (ended.timed_out) return fmt::format("was killed after its timeout of {:g} s", seconds);
    if (ended.signal != 0)
        return fmt::format("was ended by signal {} ({})", ended.signal, ::strsignal(ended.signal));
    return ended.code == 0 ? std::string() : fmt::format("exited with {}", ended.code);
}

}  // namespace diptych::external
