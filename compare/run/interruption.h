// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace diptych {

// From now on SIGINT, SIGTERM, SIGHUP and SIGQUIT end the program at once, even during a long submission to
// the device; signals that are already ignored (as under nohup) stay ignored. Unfinished temporary files are
// removed, the progress line is wiped, and the program dies of the signal, as its shell expects. Call this
// before any thread is started: threads inherit the blocked signals.
void watchInterruption();

// Sets the line that an interruption prints on stderr before the program ends; empty: none. May be called
// from any thread.
void sayWhenInterrupted(const std::string& line);

// While there is one, an interruption first ends what a child of this process supervises, so that nobody
// writes into folders that are then removed. The child ends when its end of the socket `lifeline` has a byte
// or is closed.
class EndedWhenInterrupted {
public:
    EndedWhenInterrupted(int lifeline, int supervisor);
    ~EndedWhenInterrupted();  // once the supervisor has been waited for
    EndedWhenInterrupted(const EndedWhenInterrupted&) = delete;
    EndedWhenInterrupted& operator=(const EndedWhenInterrupted&) = delete;

private:
    const int supervisor_;
};
void endSupervised(int lifeline);

// The program ends as if `signal` had never been caught.
[[noreturn]] void dieOf(int signal);

}  // namespace diptych
