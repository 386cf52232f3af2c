// SPDX-License-Identifier: MIT
// Turns numbers into pictures for people. Nothing is compared after this step.
#pragma once

#include "compare/metrics/channel.h"
#include "shared/frame/debug_modes.h"
#include "shared/frame/frame.h"
#include "shared/image/png.h"

#include <array>
#include <span>
#include <string>

namespace diptych {

// How a picture is made from radiance; an EXR never changes with it.
struct PictureChoice {
    std::optional<double> exposure;  // factor
    std::optional<double> ev100;     // or exposure value at ISO 100
    bool tonemap = true;
};

// How radiance becomes a picture, chosen once for all panels that stand side by side.
struct Exposure {
    double factor = 1;
    bool tonemap = true;
    std::string because;  // "automatic, 0.18 / log-average luminance 1.3"
};

// The exposure asked for, or an automatic one: 0.18 over the log-average luminance of the covered pixels of
// `lit` (Reinhard et al. 2002, "Photographic Tone Reproduction for Digital Images", equation 1), each
// luminance at least 1e-3 of the mean so that unlit pixels do not decide; but no more than shows the 95th
// percentile at 0.7, short of the tone curve's shoulder, so that a dark room with lamps stays one.
// EV100: 1 / (1.2 x 2^EV) (Lagarde and de Rousiers 2014, "Moving Frostbite to PBR", 4.6). `lit` may be
// nullptr: factor 1.
Exposure exposureFor(const PictureChoice& choice, const Image* lit, const Coverage& coverage);

// How the numbers of a channel become colours; the same for every panel.
struct PictureScale {
    // The values shown as black and white in channels that are normalised to their range.
    double low = 0, high = 1;
    Exposure exposure;  // for radiance
    std::string words;  // for the report: "grey, 0.4 to 12 m"
};
PictureScale scaleFor(const DebugMode& mode, const Exposure& exposure, std::span<const Frame* const> frames);

// Whether the channel is shown as a heat map, whose legend is withHeatLegend() of heat.h.
bool isHeat(const DebugMode& mode);

// The picture of one channel that `frame` has. Background pixels of lit show frame.background, of others
// nothing; a NaN or infinity is magenta, and so is what was
// repaired of them.
Image8 channelPicture(const DebugMode& mode, const Frame& frame, const PictureScale& scale);

// One tone curve: Khronos PBR Neutral (Khronos Group 2024), which leaves what is below 0.8 nearly as it is.
std::array<float, 3> pbrNeutral(std::array<float, 3> rgb);

// IEC 61966-2-1; clamps to [0, 1].
double srgbFromLinear(double linear);

// The map of error pictures, t in [0, 1]: black to a pale yellow, its lightness linear in t and its hue
// turning once through violet, red and orange, computed in Oklab (B. Ottosson 2020, "A perceptual color
// space").
std::array<std::uint8_t, 3> errorColor(double t);

// W x H x 1 errors by errorColor(sqrt(error / top)), so that the small ones of a skewed lot are seen too;
// above `top` cyan, paler the more often it is exceeded, white from 1000 times; infinite magenta, 0 black.
Image8 errorPicture(const Image& errors, double top);
constexpr std::array<std::uint8_t, 3> beyondColor{40, 230, 240}, nonfiniteColor{255, 0, 255};
constexpr double farBeyond = 1000;  // times the top: white

// Half as wide and high, 2x2 pixels averaged as they are encoded; at least 1x1.
Image8 halfSize(const Image8& image);

}  // namespace diptych
