// SPDX-License-Identifier: MIT
// Draws a scene by all paths from all cameras and compares the Frames.
#pragma once

#include "compare/checks/visual_checks.h"
#include "compare/external/renderer_file.h"
#include "compare/frames/render_options.h"
#include "compare/render/render_many.h"
#include "compare/verdict/comparison.h"
#include "compare/verdict/pair_reports.h"
#include "shared/frame/frame.h"
#include "shared/material/texture_probe.h"
#include "shared/scene/model/scene.h"
#include "shared/vulkan/device/device.h"

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace diptych::experiment {

// The sides of a comparison.
struct Compared {
    Path baseline = Path::deferred;  // the left panel
    bool from_file = false;          // a file's Frame replaces it
    std::vector<external::ExternalRenderer> renderers{};
    std::vector<std::string> renderer_texts{};  // words of the command line that name them

    bool withReference() const { return isReference(baseline) && !from_file; }
    std::vector<Path> paths() const;
    // Fraction of a scene's rendering time that is not spent in external renderers, 0 to 1.
    double pathsFraction() const { return renderers.empty() ? 1 : 0.5; }
};

// Fractions of a scene's time after which rendering and comparing end. Per Frame, comparing takes one
// rendered frame, writing three (lavapipe, gallery, 1280x720: 4.8 s, 0.3 s and 0.9 s).
struct Fractions {
    double drawn, compared;
};
Fractions fractionsOf(const RenderOptions& render);

// The rendered Frames of a scene.
struct DrawnScene {
    std::vector<ViewFrames> views;
    std::optional<TextureSampling> texels{};  // for textured scenes with a reference in mode scene
    std::vector<SceneError> errors{};         // failed external renderers
};

// The device that renders, the other one of --against-device, and data that scenes share. Pipelines are
// nullptr if each scene has its own.
struct Devices {
    // Renders every Frame too. The precision is both devices'; of textures it is measured at the first
    // textured scene.
    struct Against {
        Device& device;
        std::shared_ptr<PipelineSet> pipelines;
        std::array<DevicePrecision, 2> precision;
    };
    // `sharePipelines`: of several scenes.
    Devices(Device& device, Device* other, bool sharePipelines);
    std::vector<const Device*> all() const;  // one or two

    Device& device;
    std::shared_ptr<PipelineSet> pipelines;
    std::optional<TextureSampling> texels{};  // measured at the first use
    std::optional<Against> against;
};

// `outside`: progress of external renderers.
DrawnScene drawScene(const Scene& scene, const Compared& compared, const std::vector<Settings>& settings,
                     Devices& devices, const RenderOptions& render, const Stage& outside);

// The scene's comparisons and errors. Commands in the report write to `again`.
Report reportOf(const Compared& compared, CompareOptions compare, DrawnScene drawn,
                std::optional<Frame> baseline, const Devices& devices, const std::string& again);

}  // namespace diptych::experiment
