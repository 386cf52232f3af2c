// SPDX-License-Identifier: MIT
// The verdict on Frames of both paths.
#pragma once

#include "compare/verdict/pair_reports.h"
#include "shared/scene/requirements.h"
#include "tests/image/scenes.h"

#include <string>
#include <utility>
#include <vector>

namespace diptych::tests {

inline Report verdictOn(std::vector<Frame> frames, const Scene& scene) {
    const Requirements needs = requirements(scene, poseAt(scene, 0));
    const DeviceInfo& info = device().info();
    return makeReport({{std::move(frames), needs}}, {info.name, info.driver, info.type});
}

inline std::string failuresOf(const Report& report) {
    std::string text;
    for (const Comparison& comparison : report.comparisons) {
        for (const std::string& failure : comparison.failures) text += failure + "\n";
        for (const ChannelDiff& channel : comparison.channels)
            if (channel.verdict == Verdict::fail)
                text += std::string(channel.mode->name) + ": " + channel.reason + "\n";
    }
    return text;
}

}  // namespace diptych::tests
