// SPDX-License-Identifier: MIT
#include "compare/run/interruption.h"

#include "compare/run/print.h"
#include "compare/run/progress.h"
#include "shared/image/temporary.h"

#include <fmt/format.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <map>
#include <mutex>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>
#include <vector>

namespace diptych {
namespace {

std::mutex lastMessageMutex;
std::string lastMessage;

std::mutex supervisedMutex;
std::map<int, int> lifelines;  // key: process ID of the supervisor

void endAllSupervised() {
    const std::lock_guard lock(supervisedMutex);
    for (const auto& [supervisor, lifeline] : lifelines) endSupervised(lifeline, supervisor);
}

// Whether the child has ended within `ms`. Another thread reaps it.
bool hasEnded(pid_t child, int ms) {
    for (;; --ms) {
        siginfo_t ended{};
        const int result = ::waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED | WNOWAIT | WNOHANG);
        if ((result == 0 && ended.si_pid == child) || (result != 0 && errno != EINTR)) return true;
        if (ms <= 0) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
}

// A file under /proc, which reports no size.
std::string procText(const std::string& name) {
    std::string text;
    if (std::FILE* const file = std::fopen(name.c_str(), "re")) {
        char piece[4096];
        for (std::size_t got = 0; (got = std::fread(piece, 1, sizeof piece, file)) > 0;)
            text.append(piece, got);
        std::fclose(file);
    }
    return text;
}

// The state in /proc/PID/stat, "R" to "Z", which follows the name in brackets; 'X' if there is no such
// process.
char stateOf(pid_t process) {
    const std::string text = procText(fmt::format("/proc/{}/stat", process));
    const std::size_t end = text.rfind(") ");
    return end == text.npos ? 'X' : text[end + 2];
}

// Adds all descendants. Each thread lists its own children.
void addBelow(pid_t process, std::vector<pid_t>& all) {
    std::error_code gone;
    std::filesystem::directory_iterator thread(fmt::format("/proc/{}/task", process), gone);
    for (; !gone && thread != std::filesystem::directory_iterator(); thread.increment(gone)) {
        std::istringstream children(procText(thread->path() / "children"));
        for (pid_t child = 0; children >> child;) {
            all.push_back(child);
            addBelow(child, all);
        }
    }
}

// Kills a supervisor that does not react, for example because it is stopped, and all its descendants. They
// are stopped first, since a running process may start others; the supervisor ends last, because orphans
// become its children.
void killTree(pid_t supervisor) {
    std::vector<pid_t> all;
    bool stopped = false;
    for (int i = 0; i < 1000 && !stopped; ++i) {
        ::kill(supervisor, SIGSTOP);
        all.clear();
        addBelow(supervisor, all);
        stopped = true;
        for (const pid_t process : all)
            if (std::string_view("TtZX").find(stateOf(process)) == std::string_view::npos)
                stopped = ::kill(process, SIGSTOP) != 0 && stopped;
        if (!stopped) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    for (const pid_t process : all) ::kill(process, SIGKILL);
    ::kill(supervisor, SIGKILL);
}

}  // namespace

void setInterruptionMessage(const std::string& line) {
    const std::lock_guard lock(lastMessageMutex);
    lastMessage = line;
}

void endSupervised(int lifeline, int supervisor) {
    ::send(lifeline, "", 1, MSG_NOSIGNAL);  // fails if it has ended
    if (!hasEnded(supervisor, 1000)) killTree(supervisor);
}

EndedWhenInterrupted::EndedWhenInterrupted(int lifeline, int supervisor) : supervisor_(supervisor) {
    const std::lock_guard lock(supervisedMutex);
    lifelines.emplace(supervisor, lifeline);
}

EndedWhenInterrupted::~EndedWhenInterrupted() {
    const std::lock_guard lock(supervisedMutex);
    lifelines.erase(supervisor_);
}

void dieOf(int signal) {
    std::signal(signal, SIG_DFL);
    sigset_t one;
    sigemptyset(&one);
    sigaddset(&one, signal);
    pthread_sigmask(SIG_UNBLOCK, &one, nullptr);
    ::raise(signal);
    ::_exit(128 + signal);  // exit code as a shell reports it
}

void watchInterruption() {
    sigset_t watched;
    sigemptyset(&watched);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) {
        struct sigaction now {};
        if (::sigaction(signal, nullptr, &now) == 0 && now.sa_handler != SIG_IGN) sigaddset(&watched, signal);
    }
    pthread_sigmask(SIG_BLOCK, &watched, nullptr);
    std::thread([watched] {
        int signal = 0;
        if (sigwait(&watched, &signal) != 0) return;
        endAllSupervised();
        abandonTemporaries();
        wipeProgress();
        {
            const std::lock_guard lock(lastMessageMutex);
            if (!lastMessage.empty()) printMessage(lastMessage);
        }
        dieOf(signal);
    }).detach();
}

}  // namespace diptych
