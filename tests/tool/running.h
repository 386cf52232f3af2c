// SPDX-License-Identifier: MIT
// The tool as a background process that tests can interrupt.
#pragma once

#include "tests/tool/run.h"

#include <fcntl.h>
#include <spawn.h>

#include <chrono>
#include <csignal>
#include <thread>
#include <vector>

extern char** environ;

namespace diptych {

// The tool as a child process, its stderr in a file, or in `error`: a terminal.
class Running {
public:
    Running(const Folder& folder, std::vector<std::string> words, const fs::path& error = {})
        : error_(error.empty() ? folder / ".stderr" : error) {
        words.insert(words.begin(), DIPTYCH_PROGRAM);
        std::vector<char*> argv;
        for (std::string& word : words) argv.push_back(word.data());
        argv.push_back(nullptr);
        posix_spawn_file_actions_t actions;
        posix_spawn_file_actions_init(&actions);
        posix_spawn_file_actions_addchdir_np(&actions, folder.path().c_str());
        posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
        posix_spawn_file_actions_addopen(&actions, 2, error_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
        // Background jobs of a shell ignore SIGINT, and child processes inherit that: reset it.
        sigset_t heard;
        sigemptyset(&heard);
        for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) sigaddset(&heard, signal);
        posix_spawnattr_t attributes;
        posix_spawnattr_init(&attributes);
        posix_spawnattr_setsigdefault(&attributes, &heard);
        posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
        EXPECT_EQ(::posix_spawn(&process_, DIPTYCH_PROGRAM, &actions, &attributes, argv.data(), environ), 0);
        posix_spawnattr_destroy(&attributes);
        posix_spawn_file_actions_destroy(&actions);
    }
    ~Running() {
        if (process_ <= 0) return;
        ::kill(process_, SIGKILL);
        wait();
    }
    Running(const Running&) = delete;
    Running& operator=(const Running&) = delete;

    pid_t process() const { return process_; }
    std::string err() const { return contentsOf(error_); }
    bool ended() {
        const pid_t ended = process_ > 0 ? ::waitpid(process_, &status_, WNOHANG) : 0;
        if (ended > 0) process_ = 0;
        return process_ == 0;
    }
    int wait() {
        if (process_ > 0) ::waitpid(process_, &status_, 0);
        process_ = 0;
        return status_;
    }

private:
    pid_t process_ = 0;
    int status_ = 0;
    fs::path error_;
};

// Waits until the condition is met; only a program that hangs reaches the time limit.
template <typename Condition>
bool soon(Condition condition) {
    using Clock = std::chrono::steady_clock;
    for (const Clock::time_point end = Clock::now() + std::chrono::minutes(1); Clock::now() < end;
         std::this_thread::sleep_for(std::chrono::milliseconds(2)))
        if (condition()) return true;
    return false;
}

}  // namespace diptych
