// SPDX-License-Identifier: MIT
#include "compare/viewer/latencies.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace diptych::viewer {

namespace {

double secondsFrom(Latencies::Clock::time_point from, Latencies::Clock::time_point to) {
    return std::chrono::duration<double>(to - from).count();
}

}  // namespace

bool isWhole(const DrawnView& shown) {
    return shown.size == shown.request.subject.settings.size;
}

Latencies::Latencies(std::function<void(const std::string&)> report, Clock::time_point begun)
    : report_(std::move(report)), begun_(begun) {}

void Latencies::pressed(std::string_view key, std::uint64_t request) {
    waiting_.push_back({std::string(key), Clock::now(), 0, request});
}

void Latencies::asked(std::uint64_t request) {
    for (Waiting& waiting : waiting_)
        if (waiting.request == 0) waiting.request = request;
}

void Latencies::seen(const DrawnView& shown, std::uint64_t request) {
    const Clock::time_point now = Clock::now();
    const auto reportImage = [&](bool& reported, std::string_view what) {
        if (std::exchange(reported, true)) return;
        report_(fmt::format("{} after {:.2f} s, {}x{}", what, secondsFrom(begun_, now), shown.size.width,
                            shown.size.height));
    };
    reportImage(reported_first_, "first picture");
    if (isWhole(shown)) reportImage(reported_whole_, "first whole picture");
    std::erase_if(waiting_, [&](const Waiting& waiting) {
        if (waiting.request == 0 ? request != waiting.before : shown.request.id < waiting.request)
            return false;
        report_(fmt::format("key {}: seen after {:.0f} ms, {}x{}", waiting.key,
                            1000 * secondsFrom(waiting.pressed, now), shown.size.width, shown.size.height));
        return true;
    });
}

void Latencies::frame(double ms) {
    frames_.push_back(ms);
    if (frames_.size() % 30 == 0) percentile_ = percentileOf(0.99);
}

double Latencies::percentileOf(double fraction) const {
    if (frames_.empty()) return 0;
    std::vector<double> sorted = frames_;
    const auto rank = static_cast<std::ptrdiff_t>(fraction * static_cast<double>(sorted.size() - 1));
    std::ranges::nth_element(sorted, sorted.begin() + rank);
    return sorted[static_cast<std::size_t>(rank)];
}

void Latencies::reportFrames() const {
    if (!frames_.empty())
        report_(fmt::format(
            "interface: {} frames, median {:.1f} ms, 99th percentile {:.1f} ms, longest {:.1f} ms",
            frames_.size(), percentileOf(0.5), percentileOf(0.99), percentileOf(1)));
}

}  // namespace diptych::viewer
