// SPDX-License-Identifier: MIT
// Options of diff for two image files: channels, filters, and the metric and tolerance that decide.
#pragma once

#include "compare/run/progress.h"
#include "compare/verdict/measurement.h"
#include "compare/verdict/rules.h"
#include "compare/verdict/selection.h"

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

}  // namespace diptych
