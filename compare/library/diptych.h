// SPDX-License-Identifier: MIT
// Library API: compares two images in memory with the metrics and rules of `diptych diff`. Depends only on
// the standard library.
//
//     find_package(Diptych REQUIRED)
//     target_link_libraries(program PRIVATE Diptych::diptych)
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace diptych::library {

// Rows from the top, pixels from the left, R G B: 3 * width * height values. Linear Rec.709 radiance,
// unbounded, or sRGB values in [0, 1] with Options::display.
struct Picture {
    int width = 0, height = 0;
    std::span<const float> rgb;
};

// Largest allowed value of a metric (figureNames()); smallest for psnr and ssim.
struct Limit {
    std::string figure = "flip";
    double value = 0;
};

struct Options {
    bool display = false;                   // LDR-FLIP of sRGB values instead of HDR-FLIP of radiance
    double pixels_per_degree = 67.0206;     // of FLIP's viewer, in [1, 1000]
    std::span<const std::uint8_t> covered;  // nonzero: compare this pixel; empty: all pixels
    std::vector<Limit> limits;
};

struct Outcome {
    Limit limit;
    double measured = 0;
    bool holds = false;  // false for NaN
};

struct Result {
    std::map<std::string, double> figures;  // all defined metrics, by name
    std::vector<Outcome> outcomes;          // for Options::limits, same order
    bool passed = true;                     // all hold, and no NaN or infinity in only one image
    std::vector<float> flip;                // per pixel, in [0, 1]
    std::size_t compared = 0;               // number of compared pixels
    int worst_x = -1, worst_y = -1;         // pixel with the largest FLIP; -1: no difference
};

// Thread-safe. Throws std::runtime_error, one line, for images of different sizes or a wrong number of
// values, for an unknown or undefined metric, for an option out of range, and if no pixel is compared.
Result compare(const Picture& reference, const Picture& test, const Options& options = {});

// Names for Limit and Result, and the meaning of each: formula, unit and source in one line.
std::vector<std::string> figureNames();
std::string meaningOf(const std::string& figure);  // empty for unknown names

// "0.2.0"
std::string version();

}  // namespace diptych::library
