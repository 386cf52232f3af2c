// SPDX-License-Identifier: MIT
// What an audit pushes, one at a time: each quantity with the magnitudes that are tried.
#pragma once

#include "compare/audit/case.h"

#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace diptych::audit {

// A Setting in the words of Settings::set().
struct Change {
    std::string_view option, value;
};

// How far a quantity can be pushed before arithmetic fails, by what is known of it: magnitudes.
struct Predicted {
    static constexpr double never = std::numeric_limits<double>::infinity();
    double up = never, down = 0;  // of those above and below the usual one
    std::string because{};        // "float32 has 24 bits: ..."; empty: nothing is predicted
    // Arithmetic alone ends there; what approximates light may err before, by how much nothing predicts.
    bool at_most = false;
};

struct Quantity {
    std::string_view name;               // "offset"
    std::string_view unit;               // "m"; may be empty
    std::string_view what;               // "scene, lights and camera moved together away from the origin"
    std::vector<double> magnitudes;      // ascending; above 0, but for a first one of 0
    double (*original)(const Subject&);  // that of the scene as it is, or the nearest that shows it alike
    // Why this scene cannot be pushed so; empty where it can.
    std::string (*lacks)(const Subject&);
    // Pushes a case that is as given.
    void (*push)(Case&, const Subject&, double magnitude);
    // Settings that matter here, each beside those that are given.
    std::vector<Change> variants = {};
    // Whether the picture is that of the scene as it is at every magnitude, which is the truth then; but that
    // its light is multiplied by the magnitude, or its lengths are.
    bool same_picture = false, light = false, lengths = false;
    bool of_pictures = false;  // Case::exposure alone is pushed, so that frames stay the same
    bool whole = false;        // magnitudes are whole numbers
    // At which magnitude the relative error of a path with these Settings reaches `error`.
    Predicted (*predict)(const Subject&, const Settings&, double error) = nullptr;
    bool predicts_formats = false;  // also with other formats of depth than reversed floats
};

// Whether a path with these Settings has no other error than arithmetic's: predictions are of such.
bool isPrecise(const Settings& settings);

}  // namespace diptych::audit
