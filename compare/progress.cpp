// SPDX-License-Identifier: MIT
#include "compare/progress.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace diptych {

namespace {

constexpr std::chrono::milliseconds patience{1000}, pause{50};
constexpr const char* wipeLine = "\r\x1b[K";  // ECMA-48: erase to the end of the line

std::size_t terminalColumns() {
    winsize size{};
    return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

}  // namespace

ProgressBar::ProgressBar(std::string what, bool on)
    : what_(std::move(what)), on_(on && isatty(STDERR_FILENO) != 0), next_(Clock::now() + patience) {}

ProgressBar::~ProgressBar() {
    if (!shown_) return;
    std::fputs(wipeLine, stderr);
    std::fflush(stderr);
}

void ProgressBar::at(double fraction, const char* step) {
    if (!on_) return;
    const std::lock_guard lock(mutex_);
    if (Clock::now() < next_) return;
    next_ = Clock::now() + pause;
    shown_ = true;
    // One column stays free: a full line would wrap.
    std::fputs((wipeLine + progressLine(what_, fraction, step, terminalColumns() - 1)).c_str(), stderr);
    std::fflush(stderr);
}

std::string progressLine(const std::string& what, double fraction, const std::string& step,
                         std::size_t columns) {
    constexpr std::size_t widest = 30;
    const double part = std::clamp(std::isfinite(fraction) ? fraction : 0.0, 0.0, 1.0);
    const std::string numbers = fmt::format(" {:3.0f} % {}", std::floor(part * 100), step);
    if (columns < numbers.size()) return numbers.substr(0, columns);
    std::size_t room = columns - numbers.size();
    // The bar first, then as much of the end of the name as fits.
    const std::size_t bar = room >= 12 ? std::min(widest, room / 2) : 0;
    std::string line;
    if (bar > 2) {
        const auto filled = static_cast<std::size_t>(part * static_cast<double>(bar - 2));
        line = fmt::format(" [{}{}]", std::string(filled, '='), std::string(bar - 2 - filled, ' '));
        room -= line.size();
    }
    const std::string name = what.size() <= room ? what
                             : room > 3          ? "..." + what.substr(what.size() - (room - 3))
                                                 : "";
    return name + line + numbers;
}

}  // namespace diptych
