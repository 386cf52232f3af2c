// SPDX-License-Identifier: MIT
#include "compare/run/interruption.h"

#include "compare/run/progress.h"
#include "shared/image/temporary.h"

#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <mutex>
#include <thread>

namespace diptych {
namespace {

std::mutex lastWordsMutex;
std::string lastWords;

}  // namespace

void sayWhenInterrupted(const std::string& line) {
    const std::lock_guard lock(lastWordsMutex);
    lastWords = line;
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
        abandonTemporaries();
        wipeProgress();
        {
            const std::lock_guard lock(lastWordsMutex);
            if (!lastWords.empty()) std::fprintf(stderr, "diptych: %s\n", lastWords.c_str());
        }
        dieOf(signal);
    }).detach();
}

}  // namespace diptych
