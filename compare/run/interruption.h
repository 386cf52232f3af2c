// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace diptych {

// From now on SIGINT, SIGTERM and SIGHUP end the program at once, even during a long submission to the
// device; signals that are already ignored (as under nohup) stay ignored. Unfinished temporary files are
// removed, the progress line is wiped, and the program dies of the signal, as its shell expects. Call this
// before any thread is started: threads inherit the blocked signals.
void watchInterruption();

// Sets the line that an interruption prints on stderr before the program ends; empty: none. May be called
// from any thread.
void sayWhenInterrupted(const std::string& line);

// While there is one, an interruption kills the process group too, before the program ends.
class KilledWhenInterrupted {
public:
    explicit KilledWhenInterrupted(int group);
    ~KilledWhenInterrupted();
    KilledWhenInterrupted(const KilledWhenInterrupted&) = delete;
    KilledWhenInterrupted& operator=(const KilledWhenInterrupted&) = delete;

private:
    const int group_;
};

// The program ends as if `signal` had never been caught.
[[noreturn]] void dieOf(int signal);

}  // namespace diptych
