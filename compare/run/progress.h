// SPDX-License-Identifier: MIT
// Progress of a command. On a terminal: a line with a bar and the time left, shown after a second and
// wiped at the end. Otherwise, for a log: a plain line every ten seconds.
#pragma once

#include <chrono>
#include <functional>
#include <mutex>
#include <optional>
#include <string>

namespace diptych {

// Time since `start`, ms.
inline double msSince(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

// Output and clock of the progress; tests replace both.
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
    // Writes nothing without an output.
    explicit Progress(std::optional<ProgressOutput> output);
    // Calls `listener` for every step, on the reporting thread, and writes nothing. It may throw to cancel
    // work that reports from one thread, but not inside nested parallel loops.
    using Listener = std::function<void(const std::string& what, double fraction, const std::string& step)>;
    explicit Progress(Listener listener);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    // Thread-safe. `what`: the subject, for example "Sponza.gltf". `fraction` of the whole command, 0 to
    // 1; smaller values than before are ignored. `step`: current activity, one or two words.
    void at(const std::string& what, double fraction, const std::string& step);
    void wipe();  // removes the line; the next at() shows it again

private:
    std::optional<ProgressOutput> output_;
    Listener listener_;
    std::timed_mutex mutex_;
    ProgressOutput::Time start_{}, next_{};  // earliest next output
    double furthest_ = 0;
    bool shown_ = false;
};

// A range of a command's progress for one piece of work; part() subdivides it.
class Stage {
public:
    Stage() = default;  // reports nothing
    Stage(Progress& progress, std::string what);

    void at(double fraction, const std::string& step) const;  // within this stage, 0 to 1
    Stage part(double from, double to) const;
    Stage about(std::string what) const;  // the same range, another subject

private:
    Progress* progress_ = nullptr;
    std::string what_;
    double from_ = 0, to_ = 1;
};

// Removes the progress line of any Progress from stderr. Call before printing another line or ending the
// program.
void wipeProgress();

// "Sponza.gltf [=======>      ] 52 % images and meshes, 0:12 left", at most `columns` wide.
std::string progressLine(const std::string& what, double fraction, const std::string& step,
                         std::size_t columns);

// "3:20" or "1:02:05", rounded up to seconds.
std::string clockText(double seconds);

// Remaining time at the current rate: "0:07 left" or "1:02:05 left". Empty during the first two seconds or
// two percent, and above 100 hours.
std::string timeLeft(std::chrono::duration<double> elapsed, double fraction);

}  // namespace diptych
