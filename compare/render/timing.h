// SPDX-License-Identifier: MIT
// Times of frames that are drawn in turn: what slows the machine down for a while slows all of them.
#pragma once

#include "compare/render/prepared_frames.h"

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace diptych {

struct TimedFrame {
    std::vector<double> ms;        // of each frame, in the order they were drawn
    FrameTime time;                // of these
    std::vector<PassTime> passes;  // medians over the profiled frames
    double made_in_ms = 0;         // wall clock of all that, without warming up
};

// Each frame's first draw, in which drivers compile, must be over. Draws frames `which` of `frames` until a
// GPU has left its idle clocks (DeviceProfile::warm_up_ms), then in `runs` rounds of one frame each, then in
// `profiled` rounds in which each pass is timed by itself. In the order of `which`. `step`, if any, is called
// before each frame of a round with its number in `frames` and what it is, "frame 2 of 5".
std::vector<TimedFrame> timeInTurns(PreparedFrames& frames, std::span<const std::size_t> which, int runs,
                                    int profiled,
                                    const std::function<void(std::size_t, const std::string&)>& step = {});

// Calls draw(round, i) for each of `count` frames once a round, one round after the other.
void takeTurns(int rounds, std::size_t count, const std::function<void(int, std::size_t)>& draw);

// The time of frames that took `ms`, of which recording took `recording`: medians of each.
FrameTime timeWithRecording(const std::vector<double>& ms, const std::vector<double>& recording);

// The passes of the first frame, each with the median of its times over all frames, which have the same
// passes. Empty of no frames.
std::vector<PassTime> mediansOf(const std::vector<std::vector<PassTime>>& frames);

// Where a frame keeps them.
void addTimes(const TimedFrame& timed, Frame& frame);

}  // namespace diptych
