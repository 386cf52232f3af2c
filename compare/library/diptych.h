// SPDX-License-Identifier: MIT
// Diptych for other programs: two pictures in memory are compared, by the figures and rules of `diptych
// diff`. Needs nothing but the standard library.
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

// Rows from the top, pixels from the left, R G B: 3 * width * height numbers. Linear Rec.709 radiance of any
// size, or with Options::display sRGB values in [0, 1].
struct Picture {
    int width = 0, height = 0;
    std::span<const float> rgb;
};

// A figure (figureNames()) may be at most this, or of psnr and ssim at least.
struct Limit {
    std::string figure = "flip";
    double value = 0;
};

struct Options {
    bool display = false;                   // LDR-FLIP of display colours, else HDR-FLIP of radiance
    double pixels_per_degree = 67.0206;     // of FLIP's viewer, in [1, 1000]
    std::span<const std::uint8_t> covered;  // a pixel counts where it is not 0; empty: all do
    std::vector<Limit> limits;
};

struct Outcome {
    Limit limit;
    double measured = 0;
    bool holds = false;  // a NaN never does
};

struct Result {
    std::map<std::string, double> figures;  // all that are defined, by name
    std::vector<Outcome> outcomes;          // of Options::limits, in their order
    bool passed = true;                     // all hold, and nothing is NaN or infinite in one picture alone
    std::vector<float> flip;                // of each pixel, in [0, 1]
    std::size_t compared = 0;               // pixels that count
    int worst_x = -1, worst_y = -1;         // the pixel of the largest FLIP; -1: none differs
};

// Throws std::runtime_error, one line: the pictures are not of one size, a size does not fit its numbers, a
// figure is none or is not defined for colours, an option is out of its range, no pixel counts. May be called
// from several threads.
Result compare(const Picture& reference, const Picture& test, const Options& options = {});

// The names that Limit and Result know, and what each means: formula, unit and source in a line.
std::vector<std::string> figureNames();
std::string meaningOf(const std::string& figure);  // empty: there is no such figure

// "0.2.0"
std::string version();

}  // namespace diptych::library
