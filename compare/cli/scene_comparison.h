// SPDX-License-Identifier: MIT
// What compare does with a scene: draws it by all paths and cameras and compares the Frames.
#pragma once

#include "compare/checks/visual_checks.h"
#include "compare/cli/options.h"
#include "compare/render/render_many.h"
#include "compare/render/render_options.h"
#include "compare/verdict/comparison.h"
#include "compare/verdict/pair_reports.h"
#include "shared/frame/frame.h"
#include "shared/material/texture_probe.h"
#include "shared/scene/model/scene.h"
#include "shared/vulkan/device.h"

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace diptych::cli {

bool againstReference(const Options& options);
std::vector<Path> comparedPaths(const Options& options);

// Whether a comparison is with a reference in mode scene, drawn now or read from a file.
bool isTraced(const std::vector<Settings>& settings, const std::optional<Frame>& baseline);

// The reference must have samples where the paths have them; and what is compared with it then is lit. Throws
// std::runtime_error, one line.
void checkSamples(const Options& options, const std::vector<Settings>& settings,
                  const std::optional<Frame>& baseline);

// Throws std::runtime_error, one line, over what two devices are not compared with.
void checkAgainstDevice(const Options& options, const std::vector<Settings>& settings);

// Where in a scene's time drawing ends, and comparing. In frames drawn, to a Frame: comparing takes one,
// writing the report three (lavapipe, the gallery at 1280x720: 4.8 s, 0.3 s and 0.9 s).
struct Shares {
    double drawn, compared;
};
Shares sharesOf(const RenderOptions& render);

// What was drawn of a scene.
struct DrawnScene {
    std::vector<Frame> frames;  // two by two; three by three where the reference comes first
    std::vector<Requirements> needs;
    // Per camera and time: what a person must look at, and the materials' names by id.
    std::vector<std::vector<FeatureChecks>> visual_checks;
    std::vector<std::vector<std::string>> materials;
    std::optional<TextureSampling> texels{};  // of a scene with textures beside a reference in mode scene
    std::vector<ExternalPicture> external{};  // of --renderer
    std::vector<SceneError> errors{};         // of renderers that failed
    // With --against-device: one per view and path, and frames are four by four.
    std::vector<AcrossDevices> across{};
};

// The other device of --against-device, and what scenes share: its pipelines, and the precision of both, with
// what is measured of textures once a scene has some.
struct AgainstDevice {
    Device& device;
    std::shared_ptr<PipelineSet> pipelines;
    std::array<DevicePrecision, 2> precision;
};

// What the device makes of texels, measured when the first scene asks.
using TextureProbe = std::optional<TextureSampling>;
// `outside`: while other renderers draw. `pipelines`: shared with other scenes; nullptr: its own. `against`:
// every Frame is drawn there, too.
DrawnScene drawScene(const Scene& scene, const Options& options, const std::vector<Settings>& settings,
                     Device& device, const RenderOptions& render, TextureProbe& probe, const Stage& outside,
                     const std::shared_ptr<PipelineSet>& pipelines = nullptr,
                     AgainstDevice* against = nullptr);

// How much of drawing a scene, 0 to 1, is ours, and not the other renderers'.
double ourShare(const Options& options);

// Its comparisons, and what failed; the commands of them write to `again`.
Report reportOf(const Options& options, CompareOptions compare, DrawnScene drawn,
                std::optional<Frame> baseline, const ReportDevice& device, const ReportDevice& against,
                const std::string& again, const Stage& progress);

}  // namespace diptych::cli
