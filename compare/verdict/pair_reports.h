// SPDX-License-Identifier: MIT
// Reports made from Frames that come in pairs, beside a reference, or beside an earlier Frame.
#pragma once

#include "compare/render/render_options.h"
#include "compare/verdict/across_devices.h"
#include "compare/verdict/comparison.h"

#include <span>
#include <string>
#include <vector>

namespace diptych {

// What must be drawn of a path for a verdict on the channels of `render`: with what its G-buffer's encoding
// makes of them, drawn twice, and with channels that nobody asked for but that tell which pixels count.
// `traced`: some comparison is with a reference in mode scene; `across`: of two devices.
RenderOptions judgedOptions(RenderOptions render, std::span<const Settings> settings, bool traced,
                            bool across = false, Twice twice = Twice::lit);

// The main job of the tool: frames come two by two, both paths of one scene and camera side by side; the one
// drawn by `options.baseline` becomes the left panel. `needs`: one entry per frame; `checks`: one per pair,
// or none.
Report makeReport(std::vector<Frame> frames, const std::vector<Requirements>& needs, ReportDevice device,
                  const CompareOptions& options = {}, std::vector<std::vector<FeatureChecks>> checks = {});

// The reference as the left panel: frames come three by three, the reference and both paths of one scene and
// camera; both paths against it, then against each other. `needs`: one entry per frame; `checks` and
// `materials`, the names of these by id: one per scene and camera.
Report makeReferenceReport(std::vector<Frame> frames, const std::vector<Requirements>& needs,
                           ReportDevice device, const CompareOptions& options,
                           std::vector<std::vector<FeatureChecks>> checks,
                           const std::vector<std::vector<std::string>>& materials);

// Both paths on two devices: frames come four by four, both paths of one scene and camera on `device` and on
// `against`. Compares both paths on each device, and each path on both. `across`: one per scene, camera and
// path; `needs`: one per frame of `device`; `checks`: one per scene and camera, or none.
Report makeDeviceReport(std::vector<Frame> frames, const std::vector<Requirements>& needs,
                        ReportDevice device, ReportDevice against, const CompareOptions& options,
                        std::vector<AcrossDevices> across,
                        std::vector<std::vector<FeatureChecks>> checks = {});

// An earlier Frame as the left panel: both paths against it, then against each other. `mismatches` are
// printed first.
Report makeBaselineReport(Frame baseline, std::vector<Frame> frames, const Requirements& needs,
                          ReportDevice device, const CompareOptions& options,
                          const std::vector<std::string>& mismatches);

// Another renderer's picture beside a report's Frames: `baseline` is the left panel's place among them.
struct ExternalPicture {
    Frame frame;
    Requirements needs;
    std::size_t baseline = 0;
    std::vector<std::string> words{};  // of the command line that name the renderer
};

// Another renderer seldom says where it shows no surface, so that `ours` says it for both, where it does.
// There it shows our picture: what is seen behind everything is not compared, and must not reach into what is
// by a filter, as FLIP's does. Its own channels become those that were asked for; a note of it says at how
// many pixels it showed something there.
void showOurBackground(Frame& external, const Frame& ours);

// Adds the pictures to the report's Frames and compares each with its baseline.
void addExternalPictures(Report& report, std::vector<ExternalPicture> pictures,
                         const CompareOptions& options);

}  // namespace diptych
