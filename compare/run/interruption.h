// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace diptych {

// From now on SIGINT, SIGTERM and SIGHUP (but for those that are ignored, as under nohup) end the program at
// once, within a long submit too: what is not whole is removed, the line of progress is wiped, and the
// program dies of the signal, as its shell expects. To be called before any thread is started: all inherit
// the blocked signals.
void watchInterruption();

// What an interruption says on stderr before the program ends; empty: nothing. From any thread.
void sayWhenInterrupted(const std::string& line);

// The program ends as if `signal` had never been caught.
[[noreturn]] void dieOf(int signal);

}  // namespace diptych
