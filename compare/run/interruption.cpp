// SPDX-License-Identifier: MIT
#include "compare/run/interruption.h"

#include "compare/run/print.h"
#include "compare/run/progress.h"
#include "shared/image/temporary.h"

#include <unistd.h>

#include <csignal>
#include <mutex>
#include <set>
#include <thread>

namespace diptych {
namespace {

std::mutex lastWordsMutex;
std::string lastWords;

std::mutex groupsMutex;
std::set<int> groups;  // that an interruption kills

void killGroups() {
    const std::lock_guard lock(groupsMutex);
    for (const int group : groups) ::kill(-group, SIGKILL);
}

}  // namespace

void sayWhenInterrupted(const std::string& line) {
    const std::lock_guard lock(lastWordsMutex);
    lastWords = line;
}

KilledWhenInterrupted::KilledWhenInterrupted(int group) : group_(group) {
    const std::lock_guard lock(groupsMutex);
    groups.insert(group_);
}

KilledWhenInterrupted::~KilledWhenInterrupted() {
    const std::lock_guard lock(groupsMutex);
    groups.erase(group_);
}

void dieOf(int signal) {
    std::signal(signal, SIG_DFL);
    sigset_t one;
    sigemptyset(&one);
    sigaddset(&one, signal);
    pthread_sigmask(SIG_UNBLOCK, &one, nullptr);
    ::raise(signal);
    ::_exit(128 + signal);  // as shells number it
}

void watchInterruption() {
    sigset_t watched;
    sigemptyset(&watched);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction now {};
        if (::sigaction(signal, nullptr, &now) == 0 && now.sa_handler != SIG_IGN) sigaddset(&watched, signal);
    }
    pthread_sigmask(SIG_BLOCK, &watched, nullptr);
    std::thread([watched] {
        int signal = 0;
        if (sigwait(&watched, &signal) != 0) return;
        killGroups();
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
