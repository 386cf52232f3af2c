// SPDX-License-Identifier: MIT
// How far a command has come. On a terminal a line with a bar and the time left, which appears after a second
// and is wiped at the end; elsewhere, for a log, a plain line every ten seconds.
#pragma once

#include <chrono>
#include <functional>
#include <mutex>
#include <optional>
#include <string>

namespace diptych {

// Where progress is written, and the clock that it is timed by. Tests replace both.
struct ProgressOutput {
    using Time = std::chrono::steady_clock::time_point;
    bool terminal = false;
    std::function<std::size_t()> columns;  // of the terminal
    std::function<void(const std::string&)> write;
    std::function<Time()> now;

    static ProgressOutput standardError();
};

class Progress {
public:
    // Without an output nothing is ever written.
    explicit Progress(std::optional<ProgressOutput> output);
    // Tells `listener` every step, from the thread that takes it, and writes nothing. It may throw, which
    // ends work that reports from one thread; not in a parallel loop in which others are nested, which would
    // be left half done.
    using Listener = std::function<void(const std::string& what, double fraction, const std::string& step)>;
    explicit Progress(Listener listener);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    // May be called from any thread. `what`: the subject, e.g. "Sponza.gltf". `fraction`: of the whole
    // command, 0 to 1; it never goes back, a smaller value counts as the largest one so far. `step`: what is
    // being done, in a word or two.
    void at(const std::string& what, double fraction, const std::string& step);
    void wipe();  // removes the line from the terminal; the next at() draws it again

private:
    std::optional<ProgressOutput> output_;
    Listener listener_;
    std::timed_mutex mutex_;
    ProgressOutput::Time start_{}, next_{};  // not drawn before `next_`
    double furthest_ = 0;
    bool shown_ = false;
};

// A range of a command's progress that one piece of work covers; part() divides it further.
class Stage {
public:
    Stage() = default;  // reports to nobody
    Stage(Progress& progress, std::string what);

    void at(double fraction, const std::string& step) const;  // of this stage, from 0 to 1
    Stage part(double from, double to) const;
    Stage about(std::string what) const;  // the same under another name

private:
    Progress* progress_ = nullptr;
    std::string what_;
    double from_ = 0, to_ = 1;
};

// Removes the progress line from standard error, whichever Progress drew it. Call this before another line is
// written there or the program dies.
void wipeProgress();

// "Sponza.gltf [=======>      ] 52 % images and meshes, 0:12 left", as wide as `columns` at most.
std::string progressLine(const std::string& what, double fraction, const std::string& step,
                         std::size_t columns);

// "3:20" or "1:02:05", rounded up to seconds.
std::string clockText(double seconds);

// The remaining time at the pace so far, "0:07 left" or "1:02:05 left". Empty during the first two seconds
// and the first two percent, from which no estimate is possible.
std::string timeLeft(std::chrono::duration<double> elapsed, double fraction);

}  // namespace diptych
