// SPDX-License-Identifier: MIT
#include "compare/render/timing.h"

#include "compare/frames/frame_properties.h"
#include "compare/run/progress.h"

#include <fmt/format.h>

#include <chrono>

namespace diptych {

std::vector<PassTime> mediansOf(const std::vector<std::vector<PassTime>>& frames) {
    if (frames.empty()) return {};
    std::vector<PassTime> passes = frames.front();
    for (std::size_t pass = 0; pass < passes.size(); ++pass) {
        std::vector<double> ms;
        for (const std::vector<PassTime>& frame : frames) ms.push_back(frame[pass].ms);
        passes[pass].ms = timeOf(std::move(ms)).median;
    }
    return passes;
}

FrameTime timeWithRecording(const std::vector<double>& ms, const std::vector<double>& recording) {
    FrameTime time = timeOf(ms);
    time.record = timeOf(recording).median;
    return time;
}

void interleave(int rounds, std::size_t count, const std::function<void(int, std::size_t)>& draw) {
    for (int round = 0; round < rounds; ++round)
        for (std::size_t i = 0; i < count; ++i) draw(round, i);
}

std::vector<TimedFrame> timeInterleaved(PreparedFrames& frames, std::span<const std::size_t> which, int runs,
                                        int profiled,
                                        const std::function<void(std::size_t, const std::string&)>& step) {
    std::vector<TimedFrame> timed(which.size());
    std::vector<std::vector<double>> recording(which.size());
    std::vector<std::vector<std::vector<PassTime>>> passes(which.size());
    frames.warmUp(which);
    const auto interleaved = [&](int rounds, const char* what, const std::function<void(std::size_t)>& draw) {
        interleave(rounds, which.size(), [&](int round, std::size_t i) {
            if (step) step(which[i], fmt::format("{} {} of {}", what, round + 1, rounds));
            const auto start = std::chrono::steady_clock::now();
            draw(i);
            timed[i].made_in_ms += msSince(start);
        });
    };
    interleaved(runs, "frame", [&](std::size_t i) {
        timed[i].ms.push_back(frames.draw(which[i]));
        recording[i].push_back(frames.recordMs(which[i]));
    });
    interleaved(profiled, "passes", [&](std::size_t i) { passes[i].push_back(frames.profile(which[i])); });
    for (std::size_t i = 0; i < which.size(); ++i) {
        timed[i].time = timeWithRecording(timed[i].ms, recording[i]);
        timed[i].time.object_lists = frames.objectListsMs(which[i]);
        timed[i].passes = mediansOf(passes[i]);
    }
    return timed;
}

void addTimes(const TimedFrame& timed, Frame& frame) {
    frame.time = timed.time;
    frame.passes = timed.passes;
    frame.made_in_ms += timed.made_in_ms;
}

}  // namespace diptych
