// SPDX-License-Identifier: MIT
// Reports on the Frames of several views: by both paths, with a reference, or with an earlier Frame.
#pragma once

#include "compare/frames/render_options.h"
#include "compare/verdict/across_devices.h"
#include "compare/verdict/comparison.h"

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace diptych {

// Options to render a path for a verdict on the channels of `render`: also through its G-buffer's
// encoding, a second time, and with further channels that decide which pixels count. `traced`: some
// comparison is with a reference in mode scene; `across`: with another device.
RenderOptions evaluatedOptions(RenderOptions render, std::span<const Settings> settings, bool traced,
                               bool across = false, Twice twice = Twice::lit);

// Frames of one scene, camera and time, each found by its Settings' path, and inputs of their verdicts.
struct ViewFrames {
    std::vector<Frame> frames;  // by both paths, and perhaps the reference, which then is the left panel
    Requirements needs{};
    std::vector<FeatureChecks> checks{};     // pixels to inspect visually
    std::vector<std::string> materials{};    // names by ID; for the closer path
    std::vector<Frame> there{};              // by both paths on the other device
    std::map<Path, AcrossDevices> across{};  // for comparing a path with itself there; without texcoords
    std::vector<Frame> external{};           // by other renderers

    const Frame* by(Path path) const;  // of `frames`; nullptr: none
};

// The main task of the tool. Of each view, compares:
// - both paths; the one of `options.baseline` is the left panel;
// - with the reference or `earlier` as the left panel: both paths with it, then with each other;
// - with Frames of the device `against`: each path with itself, and both paths there;
// - external Frames with the left panel, after all views.
Report makeReport(std::vector<ViewFrames> views, ReportDevice device, const CompareOptions& options = {},
                  std::optional<Frame> earlier = {}, ReportDevice against = {});

// Replaces the external image's background by ours, if ours has one: other renderers seldom say where no
// surface is. Background is not compared and must not affect surfaces through a filter such as FLIP's. The
// external Frame's own channels become its requested ones. A note states at how many pixels it showed
// something there.
void showOurBackground(Frame& external, const Frame& ours);

}  // namespace diptych
