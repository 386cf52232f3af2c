// SPDX-License-Identifier: MIT
// Reports from Frames in pairs, with a reference, or with an earlier Frame.
#pragma once

#include "compare/frames/render_options.h"
#include "compare/verdict/across_devices.h"
#include "compare/verdict/comparison.h"

#include <array>
#include <span>
#include <string>
#include <vector>

namespace diptych {

// Options to render a path for a verdict on the channels of `render`: also through its G-buffer's
// encoding, a second time, and with further channels that decide which pixels count. `traced`: some
// comparison is with a reference in mode scene; `across`: with another device.
RenderOptions judgedOptions(RenderOptions render, std::span<const Settings> settings, bool traced,
                            bool across = false, Twice twice = Twice::lit);

// The main task of the tool. Frames come in pairs, both paths of one scene and camera; the one of
// `options.baseline` is the left panel. `needs`: one entry per frame; `checks`: one per pair, or none.
Report makeReport(std::vector<Frame> frames, const std::vector<Requirements>& needs, ReportDevice device,
                  const CompareOptions& options = {}, std::vector<std::vector<FeatureChecks>> checks = {});

// With the reference as the left panel. Frames come in threes: the reference and both paths of one scene
// and camera. Compares both paths with it, then with each other. `needs`: one entry per frame; `checks`
// and `materials` (names by id): one per scene and camera.
Report makeReferenceReport(std::vector<Frame> frames, const std::vector<Requirements>& needs,
                           ReportDevice device, const CompareOptions& options,
                           std::vector<std::vector<FeatureChecks>> checks,
                           const std::vector<std::vector<std::string>>& materials);

// Both paths on two devices. Frames come in fours: both paths of one scene and camera on the first of
// `devices` and on the other. Compares both paths on each device, and each path on both. `across`: one per
// scene, camera and path; `needs`: one per frame of the first device; `checks`: one per scene and camera, or
// none.
Report makeDeviceReport(std::vector<Frame> frames, const std::vector<Requirements>& needs,
                        std::array<ReportDevice, 2> devices, const CompareOptions& options,
                        std::vector<AcrossDevices> across,
                        std::vector<std::vector<FeatureChecks>> checks = {});

// With an earlier Frame as the left panel. Compares both paths with it, then with each other. `mismatches`
// are printed first.
Report makeBaselineReport(Frame baseline, std::vector<Frame> frames, const Requirements& needs,
                          ReportDevice device, const CompareOptions& options,
                          const std::vector<std::string>& mismatches);

// Another renderer's image beside a report's Frames; `baseline` is the index of the left panel's Frame.
struct ExternalPicture {
    Frame frame;
    Requirements needs;
    std::size_t baseline = 0;
    std::vector<std::string> words{};  // words of the command line that name the renderer
};

// Replaces the external image's background by ours, if ours has one: other renderers seldom say where no
// surface is. Background is not compared and must not affect surfaces through a filter such as FLIP's. The
// external Frame's own channels become its requested ones. A note states at how many pixels it showed
// something there.
void showOurBackground(Frame& external, const Frame& ours);

// Adds the images to the report's Frames and compares each with its baseline.
void addExternalPictures(Report& report, std::vector<ExternalPicture> pictures,
                         const CompareOptions& options);

}  // namespace diptych
