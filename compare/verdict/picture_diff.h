// SPDX-License-Identifier: MIT
// Compares two picture files from any renderer, channel by channel: figures and a verdict.
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

struct PictureDiffOptions {
    std::string metric =
        "flip";  // the figure that decides for channels without a rule, as figureOfMetric() returns it
    bool metric_given = false;          // then a channel that has no such figure is not judged
    double tolerance = 0;               // the largest value that passes; for psnr and ssim the smallest
    std::optional<double> warn;         // values beyond it give a warning
    std::optional<double> failing;      // instead: `tolerance` may be exceeded by this share of the pixels
    std::vector<Rule> rules;            // a rule that names the channel decides instead
    std::vector<std::string> channels;  // patterns of names; empty: all
    std::vector<std::string> names;     // --map
    SelectionOptions selection;
    bool tolerance_given = false;
    bool strict = false;       // a channel, or what values mean, that one picture alone has is a failure
    bool allow_empty = false;  // two black pictures are what is wanted
    double blur = 0;           // standard deviation, pixels
    int shift = 0;             // pixels
    double output_bytes = 0;   // a pixel, that the caller takes for output while the pictures are in memory
    HdrFlipOptions flip;
    Stage progress{};
};

struct PictureDiff;

// One channel of both pictures and everything measured of it.
struct PictureChannelDiff {
    MatchedChannel pair;
    std::unique_ptr<Measurement> measurement;  // refers to `pair`
    bool display = false;
    Rule rule;  // the rule that decided
    Decision decision;
    int worst_x = -1, worst_y = -1;  // the pixel with the largest deciding error; -1: none
};

// The errors of the figure that decided.
struct DecidingErrors {
    std::shared_ptr<const Image> image;  // W x H x 1
    std::string name;                    // "FLIP", "relative"; empty: of the channel's metric
    double top = 0;                      // the end of their colour map
};
DecidingErrors decidingErrors(const PictureDiff& diff, const PictureChannelDiff& channel);

struct PictureDiff {
    std::string reference, test;  // file names as they were given
    std::string name;             // what both are called in two folders; empty of two files
    std::string reference_format, test_format;
    int width = 0, height = 0;
    bool display = false;                // both hold display colours
    std::unique_ptr<Coverage> coverage;  // on the heap, because measurements refer to it
    std::vector<std::unique_ptr<PictureChannelDiff>> channels;
    std::vector<std::string> failures;  // in addition to the channels'
    std::vector<std::string> notes;
    std::string emptiness;  // why the verdict says little: both pictures are black

    bool passed() const;
};

// Whether the rule is none of a file: the command line's, or what diff does by default.
bool isOwnRule(const Rule& rule);

// Throws std::runtime_error, one line, where a file cannot be read, sizes differ, or nothing is shared.
PictureDiff diffPictures(const std::string& reference, const std::string& test,
                         const PictureDiffOptions& options);

// The figure that --metric NAME stands for: figures() and "relative" (relative_max), "angular" (angle_max),
// "ulp" (ulp_max). Throws std::runtime_error naming all.
std::string figureOfMetric(const std::string& name);

}  // namespace diptych
