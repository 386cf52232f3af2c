// SPDX-License-Identifier: MIT
// Results for the interface.
#pragma once

#include "compare/explain/pixel_breakdown.h"
#include "compare/verdict/comparison.h"
#include "compare/viewer/drawing/request.h"
#include "shared/image/image.h"
#include "shared/image/png.h"
#include "shared/scene/requirements.h"
#include "shared/scene/view.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace diptych::viewer {

// One panel.
struct Panel {
    std::string name;     // "deferred"
    Image8 image;         // RGB, as `render` writes it
    Image values;         // of the channel
    std::string missing;  // why there is no image; empty if there is one
};

struct DifferencePanel {
    Image8 image;
    Image values;    // W x H x 1
    double top = 0;  // the value at the end of the colours; the other end is 0 or, if signed, -top
    bool is_signed = false;
    std::string text;     // description of the values, with their unit
    std::string missing;  // why there is no image
};

// Times and memory of a path's last frames.
struct PathProperties {
    std::string name;
    double ms = 0;  // of the whole frame; while moving, the sum of its passes
    std::vector<PassTime> passes;
    std::uint64_t measurement = 0;  // increases with every new time
    FrameBytes bytes;
    FrameCounters counters;
    std::vector<std::string> notes;
    std::optional<double> mean_lights,
        max_lights;  // lights that a pixel evaluates; known once light_count is rendered
};

// Immutable once published.
struct DrawnView {
    DrawRequest request;
    Size size;                    // of the images; smaller than requested while moving
    std::array<Panel, 2> panels;  // left, right
    std::optional<DifferencePanel> difference;
    std::string scale;    // how values map to colours
    double heat_top = 0;  // light_count: the count at the end of the colours; 0: no heat map
    FrameCamera camera;
    View view;
    std::vector<Light> lights;             // of the view, world
    std::vector<Requirements::Line> plan;  // modelled and omitted features
    Image depth;  // W x H x 1, m along the view direction, 0: background; empty while moving
    std::array<PathProperties, 2> paths;  // deferred, forward+
    double reference_done = 1;            // finished fraction of the left panel
    std::string uncertainty_text;         // of a sampled reference
    double made_in_ms = 0;                // from request to publication
};

// The verdict on both paths, or on both compared with the left panel's image.
struct EvaluatedPair {
    Subject subject;
    Report report;
};

struct Breakdown {
    Subject subject;
    PixelPosition pixel;
    PixelBreakdown breakdown;
    std::string text;
};

// Properties of the loaded scene.
struct SceneProperties {
    std::string scene;  // as on the command line
    std::string name;
    std::vector<std::string> cameras;  // names, may be empty
    std::vector<std::string> animations;
    double duration = 0;  // s, of the longest animation
    std::size_t own_lights = 0;
    std::vector<std::string> notes;
};

// Current activity of the drawing thread.
struct Status {
    std::string doing;    // "read images"; empty: none
    double fraction = 0;  // 0 to 1
    std::string error;    // the last error, until that step succeeds; one line
    bool loading = false;
};

}  // namespace diptych::viewer
