// SPDX-License-Identifier: MIT
#include "compare/run/interruption.h"

#include "compare/run/print.h"
#include "compare/run/progress.h"
#include "shared/image/temporary.h"

#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <map>
#include <mutex>
#include <thread>

namespace diptych {
namespace {

std::mutex lastWordsMutex;
std::string lastWords;

std::mutex supervisedMutex;
std::map<int, int> lifelines;  // key: process ID of the supervisor

void endAllSupervised() {
    const std::lock_guard lock(supervisedMutex);
    for (const auto& [supervisor, lifeline] : lifelines) endSupervised(lifeline);
    siginfo_t ended{};  // WNOWAIT: another thread reaps it
    for (const auto& [supervisor, lifeline] : lifelines)
        ::waitid(P_PID, static_cast<id_t>(supervisor), &ended, WEXITED | WNOWAIT);
}

}  // namespace

void sayWhenInterrupted(const std::string& line) {
    const std::lock_guard lock(lastWordsMutex);
    lastWords = line;
}

void endSupervised(int lifeline) {
    ::send(lifeline, "", 1, MSG_NOSIGNAL);  // fails if it has ended
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
            const std::lock_guard lock(lastWordsMutex);
            if (!lastWords.empty()) printMessage(lastWords);
        }
        dieOf(signal);
    }).detach();
}

}  // namespace diptych
