// SPDX-License-Identifier: MIT
// Times interleaved frames, so that a temporary slowdown of the machine affects all of them.
#pragma once

#include "compare/render/prepared_frames.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace diptych {

struct TimedFrame {
    std::vector<double> ms;        // of each frame, in rendering order
    FrameTime time;                // summary of `ms`
    std::vector<PassTime> passes;  // medians over the profiled frames
    double made_in_ms = 0;         // wall clock, without warming up
};

// Renders frames `which` of `frames` until a GPU has left its idle clocks (DeviceProfile::warm_up_ms).
// Then renders `runs` rounds of one frame each, and `profiled` rounds in which each pass is timed by
// itself. Each frame's first draw, in which drivers compile, must be over. Results are in the order of
// `which`. `step`, if any, is called before each frame of a round with its index in `frames` and a label,
// "frame 2 of 5".
std::vector<TimedFrame> timeInterleaved(
    PreparedFrames& frames, std::span<const std::size_t> which, int runs, int profiled,
    const std::function<void(std::size_t, const std::string&)>& step = {});

// Number of frames whose passes are timed one by one, apart from `runs` timed frames.
constexpr int profiledOf(int runs) {
    return runs < 3 ? std::min(runs, 1) : 3;
}

// Calls draw(round, i) for each of `count` frames in every round.
void interleave(int rounds, std::size_t count, const std::function<void(int, std::size_t)>& draw);

// Medians of frame times `ms` and of their recording times `recording`.
FrameTime timeWithRecording(const std::vector<double>& ms, const std::vector<double>& recording);

// The passes of the first frame, each with its median time over all frames, which must have the same
// passes. Empty without frames.
std::vector<PassTime> mediansOf(const std::vector<std::vector<PassTime>>& frames);

// Copies the times to the Frame.
void addTimes(const TimedFrame& timed, Frame& frame);

}  // namespace diptych
