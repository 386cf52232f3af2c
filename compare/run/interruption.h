// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace diptych {

// From now on SIGINT, SIGTERM, SIGHUP and SIGQUIT end the program at once, even during a long submission
// to the device. Signals that are ignored already, as under nohup, stay ignored. Removes temporary files,
// wipes the progress line, and dies by the signal, as the shell expects. Call before any thread starts:
// threads inherit the signal mask.
void watchInterruption();

// Sets the line that an interruption prints on stderr; empty: none. Thread-safe.
void setInterruptionMessage(const std::string& line);

// While an object exists, an interruption first ends the processes under `supervisor`, a child of this
// process. Otherwise they could write into folders that are being removed. The supervisor ends when its
// end of the socket `lifeline` receives a byte or is closed.
class EndedWhenInterrupted {
public:
    EndedWhenInterrupted(int lifeline, int supervisor);
    ~EndedWhenInterrupted();  // after waiting for the supervisor
    EndedWhenInterrupted(const EndedWhenInterrupted&) = delete;
    EndedWhenInterrupted& operator=(const EndedWhenInterrupted&) = delete;

private:
    const int supervisor_;
};
// Ends them now. Kills the supervisor and all processes under it if it has not ended after a second.
void endSupervised(int lifeline, int supervisor);

// Ends the program by `signal` with its default action.
[[noreturn]] void dieOf(int signal);

}  // namespace diptych
