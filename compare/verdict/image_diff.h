// SPDX-License-Identifier: MIT
// Compares two image files from any renderer, channel by channel: metrics and a verdict.
#pragma once

#include "compare/files/layers.h"
#include "compare/verdict/image_diff_options.h"
#include "compare/verdict/measurement.h"
#include "compare/verdict/rules.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace diptych {

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
