// SPDX-License-Identifier: MIT
// What was drawn for the interface.
#pragma once

#include "compare/explain/pixel_story.h"
#include "compare/verdict/comparison.h"
#include "compare/viewer/order.h"
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
    Image8 picture;       // RGB, as `render` writes it
    Image values;         // of the channel
    std::string missing;  // why there is no picture; empty where there is one
};

struct DifferencePanel {
    Image8 picture;
    Image values;    // W x H x 1
    double top = 0;  // the value at the end of the colours; at their other end 0 or, signed, -top
    bool is_signed = false;
    std::string words;    // what the values are, with their unit
    std::string missing;  // why there is no picture
};

// What a path's last frames were.
struct PathFacts {
    std::string name;
    double ms = 0;  // the whole frame: of a picture that moves the sum of its passes
    std::vector<PassTime> passes;
    std::uint64_t measurement = 0;  // rises with each of these two
    FrameBytes bytes;
    FrameCounters counters;
    std::vector<std::string> notes;
    std::optional<double> mean_lights,
        most_lights;  // that a pixel evaluates; known once light_count is drawn
};

// Never changes once it is handed out.
struct Shown {
    Order order;                  // that it answers
    Size size;                    // of the pictures: smaller than order's while it moves
    std::array<Panel, 2> panels;  // left, right
    std::optional<DifferencePanel> difference;
    std::string scale;    // how numbers became colours
    double heat_top = 0;  // of light_count, the count at the end of the colours; 0: no heat map
    FrameCamera camera;
    View view;
    std::vector<Light> lights;             // of the view, world
    std::vector<Requirements::Line> plan;  // what is modelled of it and what is left out
    Image depth;  // W x H x 1, m along the view's direction, 0: background; none while it moves
    std::array<PathFacts, 2> paths;    // deferred, forward+
    double reference_done = 1;         // share of the left panel that is drawn
    std::string words_of_uncertainty;  // of a reference that was sampled
    double made_in_ms = 0;             // from taking the order to handing it out
};

// The verdict on both paths, and on both against what stands in the left panel.
struct Judged {
    Subject subject;
    Report report;
};

struct Story {
    Subject subject;
    PixelPlace pixel;
    PixelStory story;
    std::string words;
};

// What is known of the scene that is loaded.
struct SceneFacts {
    std::string scene;  // as on the command line
    std::string name;
    std::vector<std::string> cameras;  // names, may be empty
    std::vector<std::string> animations;
    double duration = 0;  // s, of the longest animation
    std::size_t own_lights = 0;
    std::vector<std::string> notes;
};

// What the drawing thread is at.
struct Status {
    std::string doing;    // "read images"; empty: nothing
    double fraction = 0;  // of it, 0 to 1
    std::string error;    // of the last thing that failed, until it succeeds; one line
    bool loading = false;
};

}  // namespace diptych::viewer
