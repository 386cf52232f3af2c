// SPDX-License-Identifier: MIT
#include "compare/run/progress.h"

#include "compare/run/color.h"
#include "shared/text/one_line.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace diptych {

namespace {

constexpr std::chrono::milliseconds patience{1000}, pause{50};
constexpr std::chrono::seconds logPause{10};
constexpr const char* wipeLine = "\r\x1b[K";  // ECMA-48: erase to the end of the line

// The Progress that writes to stderr, if any. The thread that handles signals also uses it.
std::timed_mutex drawingMutex;
Progress* drawing = nullptr;

// Maximum wait for a writing thread, which a stopped terminal may block. The line then remains.
constexpr std::chrono::milliseconds wipePatience{100};

std::size_t progressColumns() {
    const std::size_t columns = terminalColumns(stderr);
    return columns > 0 ? columns : 80;
}

std::string withTime(const std::string& step, const std::string& left) {
    return left.empty() ? step : step + ", " + left;
}

}  // namespace

ProgressOutput ProgressOutput::standardError() {
    return {isatty(STDERR_FILENO) != 0, progressColumns,
            [](const std::string& text) {
                std::fputs(text.c_str(), stderr);
                std::fflush(stderr);
            },
            std::chrono::steady_clock::now};
}

Progress::Progress(std::optional<ProgressOutput> output) : output_(std::move(output)) {
    if (!output_) return;
    start_ = output_->now();
    next_ = start_ + (output_->terminal ? std::chrono::milliseconds(patience) : logPause);
    const std::lock_guard lock(drawingMutex);
    drawing = this;
}

Progress::Progress(Listener listener) : listener_(std::move(listener)) {}

Progress::~Progress() {
    wipe();
    const std::lock_guard lock(drawingMutex);
    if (drawing == this) drawing = nullptr;
}

void Progress::at(const std::string& what, double fraction, const std::string& step) {
    if (listener_) return listener_(what, std::clamp(fraction, 0.0, 1.0), step);
    if (!output_) return;
    const std::lock_guard lock(mutex_);
    furthest_ = std::max(furthest_, std::clamp(std::isfinite(fraction) ? fraction : 0.0, 0.0, 1.0));
    const ProgressOutput::Time now = output_->now();
    if (now < next_) return;
    next_ = now + (output_->terminal ? pause : std::chrono::milliseconds(logPause));
    const std::string sentence = withTime(step, timeLeft(now - start_, furthest_));
    if (!output_->terminal)
        return output_->write(messageLine(fmt::format("diptych: {}: {:.0f} % {}", what,
                                                      std::floor(furthest_ * 100), sentence)) +
                              "\n");
    shown_ = true;
    // Leaves one column free: a full line would wrap.
    const std::size_t columns = output_->columns() - 1;
    output_->write(wipeLine + oneLine(progressLine(what, furthest_, sentence, columns), columns));
}

void Progress::wipe() {
    const std::unique_lock lock(mutex_, wipePatience);
    if (lock && std::exchange(shown_, false)) output_->write(wipeLine);
}

void wipeProgress() {
    const std::unique_lock lock(drawingMutex, wipePatience);
    if (lock && drawing) drawing->wipe();
}

Stage::Stage(Progress& progress, std::string what) : progress_(&progress), what_(std::move(what)) {}

void Stage::at(double fraction, const std::string& step) const {
    if (progress_) progress_->at(what_, from_ + std::clamp(fraction, 0.0, 1.0) * (to_ - from_), step);
}

Stage Stage::part(double from, double to) const {
    Stage stage = *this;
    stage.from_ = from_ + from * (to_ - from_);
    stage.to_ = from_ + to * (to_ - from_);
    return stage;
}

Stage Stage::about(std::string what) const {
    Stage stage = *this;
    stage.what_ = std::move(what);
    return stage;
}

std::string clockText(double seconds) {
    const auto whole = static_cast<long>(std::ceil(seconds));
    return whole >= 3600 ? fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60)
                         : fmt::format("{}:{:02}", whole / 60, whole % 60);
}

std::string timeLeft(std::chrono::duration<double> elapsed, double fraction) {
    constexpr double soonest = 2, min = 0.02;
    // Longer estimates are noise.
    constexpr double longest = 100.0 * 3600;
    if (!(elapsed.count() >= soonest) || !(fraction >= min)) return "";
    const double seconds = std::ceil(elapsed.count() * (1 - std::min(fraction, 1.0)) / fraction);
    if (seconds >= longest) return "";
    return clockText(seconds) + " left";
}

std::string progressLine(const std::string& what, double fraction, const std::string& step,
                         std::size_t columns) {
    constexpr std::size_t widest = 30;
    const double part = std::clamp(std::isfinite(fraction) ? fraction : 0.0, 0.0, 1.0);
    const std::string numbers = fmt::format(" {:3.0f} % {}", std::floor(part * 100), step);
    if (columns < numbers.size()) return numbers.substr(0, columns);
    std::size_t space = columns - numbers.size();
    // The bar has priority; the name is truncated at its start.
    const std::size_t bar = space >= 12 ? std::min(widest, space / 2) : 0;
    std::string line;
    if (bar > 2) {
        const auto filled = static_cast<std::size_t>(part * static_cast<double>(bar - 2));
        line = fmt::format(" [{}{}]", std::string(filled, '='), std::string(bar - 2 - filled, ' '));
        space -= line.size();
    }
    const std::string name = what.size() <= space ? what
                             : space > 3          ? "..." + what.substr(what.size() - (space - 3))
                                                  : "";
    return name + line + numbers;
}

}  // namespace diptych
