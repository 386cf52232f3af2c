// SPDX-License-Identifier: MIT
// Stress parameters of an audit, varied one at a time, with the magnitudes to try.
#pragma once

#include "compare/audit/case.h"

#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace diptych::audit {

// A Setting in the syntax of Settings::set().
struct Change {
    std::string_view option, value;
};

// Predicted magnitudes at which arithmetic fails.
struct Predicted {
    static constexpr double never = std::numeric_limits<double>::infinity();
    double up = never, down = 0;  // above and below the default magnitude
    std::string because{};        // "float32 has 24 bits: ..."; empty: no prediction
    // Only arithmetic ends there; approximations of light may fail earlier, by an unpredicted amount.
    bool at_most = false;
};

struct Quantity {
    std::string_view name;               // "offset"
    std::string_view unit;               // "m"; may be empty
    std::string_view what;               // "scene, lights and camera moved together away from the origin"
    std::vector<double> magnitudes;      // ascending; above 0, but for a first one of 0
    double (*original)(const Subject&);  // that of the original scene, or the nearest that looks the same
    // Why this scene cannot be varied; empty if it can.
    std::string (*lacks)(const Subject&);
    // Modifies an original case.
    void (*push)(Case&, const Subject&, double magnitude);
    // Relevant Settings, each tried beside the original ones.
    std::vector<Change> variants = {};
    // Whether the image stays that of the original scene, which is then the truth. `light`, `lengths`:
    // except that its light or its lengths are multiplied by the magnitude.
    bool same_picture = false, light = false, lengths = false;
    bool of_pictures = false;  // only changes Case::exposure, so frames stay the same
    bool whole = false;        // magnitudes are integers
    // Magnitudes at which the relative error of a path with these Settings reaches `error`.
    Predicted (*predict)(const Subject&, const Settings&, double error) = nullptr;
    bool predicts_formats = false;  // also predicts depth formats other than reversed floats
};

// Whether arithmetic is the only error of a path with these Settings; predictions assume so.
bool isPrecise(const Settings& settings);

}  // namespace diptych::audit
