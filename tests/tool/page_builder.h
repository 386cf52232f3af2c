// SPDX-License-Identifier: MIT
// Reports for the tests of pages.
#pragma once

#include "compare/report/report.h"
#include "tests/support/report_builder.h"
#include "tests/tool/browser.h"

#include <string>
#include <vector>

namespace diptych {

#define SKIP_WITHOUT_BROWSER() \
    if (browser().empty()) GTEST_SKIP() << "no chromium here: the page is not looked at"

// Both paths of one scene, all pixels covered: lit is a ramp without repeated rows, roughness fails at
// (40, 20) and, by less, elsewhere.
inline std::vector<Frame> rampFrames(int width = 96, int height = 54) {
    std::vector<Frame> frames = bothFrames();
    for (Frame& frame : frames) {
        frame.settings.size = {width, height};
        for (auto& [number, image] : frame.channels) {
            const DebugMode& mode = debugMode(number);
            image = Image(width, height, mode.width, mode.kind == ChannelKind::id ? 3.0f : 0.5f);
            if (isAngle(mode.error_kind))
                for (std::size_t i = 0; i < image.pixels(); ++i)
                    std::ranges::copy(std::array{0.6f, 0.0f, 0.8f}, image.pixel(i));
        }
        Image& lit = frame.channels.at(Channel::lit);
        for (std::size_t i = 0; i < lit.data.size(); ++i) lit.data[i] = 0.1f + 1e-3f * static_cast<float>(i);
        frame.through_gbuffer.clear();
    }
    Image& roughness = frames[1].channels.at(Channel::roughness);
    roughness.at(40, 20) = 0.75f;
    roughness.at(80, 50) = 0.625f;
    for (const Channel mode : litModes) frames[1].through_gbuffer[mode] = frames[0].channels.at(mode);
    return frames;
}

inline fs::path written(const Folder& folder, const Report& report, const ReportOptions& options = {}) {
    writeReport(report, folder / "report", options);
    return folder / "report/index.html";
}

}  // namespace diptych
