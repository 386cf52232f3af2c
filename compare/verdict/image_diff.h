// SPDX-License-Identifier: MIT
// Compares two image files from any renderer, channel by channel: metrics and a verdict.
#pragma once

#include "compare/files/layers.h"
#include "compare/run/progress.h"
#include "compare/verdict/measurement.h"
#include "compare/verdict/rules.h"
#include "compare/verdict/selection.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace diptych {

struct ImageDiffOptions {
    std::string metric = "flip";        // decides for channels without a rule; as from metricOfOption()
    bool metric_requested = false;      // by the user
    double tolerance = 0;               // largest value that passes; for psnr and ssim the smallest
    std::optional<double> warn;         // values beyond it give a warning
    std::optional<double> failing;      // instead: the fraction of pixels that may exceed `tolerance`
    std::vector<Rule> rules;            // decide for the channels that they name
    std::vector<std::string> channels;  // patterns of names; empty: all
    std::vector<std::string> names;     // --map
    SelectionOptions selection;
    bool tolerance_requested =
        false;                 // without it, and for channels without the metric, only equal values pass
    bool strict = false;       // fails on channels, or meanings of values, that only one image has
    bool allow_empty = false;  // two black images are expected
    double blur = 0;           // standard deviation, pixels
    int shift = 0;             // pixels
    double output_bytes = 0;   // per pixel, for the caller's output while the images are in memory
    HdrFlipOptions flip;
    Stage progress{};
};

struct ImageDiff;

// One channel of both images and all its measurements.
struct ImageChannelDiff {
    MatchedChannel pair;
    std::unique_ptr<Measurement> measurement;  // refers to `pair`
    bool display = false;
    Rule rule;  // the deciding rule
    Decision decision;
    int worst_x = -1, worst_y = -1;  // the pixel with the largest deciding error; -1: none
};

// Errors of the deciding metric.
struct DecidingErrors {
    std::shared_ptr<const Image> image;  // W x H x 1
    std::string name;                    // "FLIP", "relative"; empty: the channel's error kind
    double top = 0;                      // the end of their colour map
};
DecidingErrors decidingErrors(const ImageDiff& diff, const ImageChannelDiff& channel);

struct ImageDiff {
    std::string reference, test;  // file names as given
    std::string name;             // common name in two folders; empty for two files
    std::string reference_format, test_format;
    int width = 0, height = 0;
    bool display = false;                // both are display-referred
    std::unique_ptr<Coverage> coverage;  // on the heap, because measurements refer to it
    std::vector<std::unique_ptr<ImageChannelDiff>> channels;
    std::vector<std::string> failures;  // beside the channels'
    std::vector<std::string> notes;
    std::string emptiness;  // why the verdict is weak: both images are black

    bool passed() const;
};

// Whether the rule is not from a file: the command line's, or the default of diff.
bool isOwnRule(const Rule& rule);

// Throws std::runtime_error, one line, if a file cannot be read, sizes differ, or no channel is shared.
ImageDiff diffImages(const std::string& reference, const std::string& test, const ImageDiffOptions& options);

// The metric for --metric NAME: metrics() and "relative" (relative_max), "angular" (angle_max), "ulp"
// (ulp_max). Throws std::runtime_error naming all.
std::string metricOfOption(const std::string& name);

}  // namespace diptych
