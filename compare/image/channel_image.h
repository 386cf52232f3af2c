// SPDX-License-Identifier: MIT
// Converts numbers to displayable images. Nothing is compared after this step.
#pragma once

#include "compare/metrics/channel.h"
#include "shared/frame/debug_modes.h"
#include "shared/frame/frame.h"
#include "shared/image/png.h"

#include <array>
#include <span>
#include <string>

namespace diptych {

// Display options for radiance; EXR files do not depend on them.
struct ImageChoice {
    std::optional<double> exposure;  // factor
    std::optional<double> ev100;     // or exposure value at ISO 100
    bool tonemap = true;
};

// Mapping of radiance to an image, shared by panels side by side.
struct Exposure {
    double factor = 1;
    bool tonemap = true;
    std::string because;  // "exposure 1.3, automatic: 0.18 / log-average luminance 0.14; ..."
};

// The exposure of `choice`, or an automatic one: 0.18 over the log-average luminance of the covered pixels
// of `lit` (Reinhard et al. 2002, "Photographic Tone Reproduction for Digital Images", equation 1).
// Luminances count as at least 1e-3 of the mean, so that unlit pixels do not dominate. The 95th percentile
// maps to at most 0.7, below the tone curve's shoulder, so that a dark room with lamps stays dark.
// EV100: 1 / (1.2 x 2^EV) (Lagarde and de Rousiers 2014, "Moving Frostbite to PBR", 4.6). `lit` may be
// nullptr: factor 1.
Exposure exposureFor(const ImageChoice& choice, const Image* lit, const Coverage& coverage);

// Mapping of a channel's numbers to colours; the same for every panel.
struct ImageScale {
    // The values shown as black and white in channels normalised to their range.
    double low = 0, high = 1;
    Exposure exposure;  // for radiance
    std::string text;   // for the report: "grey, 0.4 to 12 m"
};
ImageScale scaleFor(const DebugMode& mode, const Exposure& exposure, std::span<const Frame* const> frames);

// Whether the channel is shown as a heat map, with withHeatLegend() of heat.h.
bool isHeat(const DebugMode& mode);

// The image of one of the frame's channels. Black background pixels of lit show frame.background; the
// background of other channels is black. NaN, infinity and repaired pixels are magenta.
Image8 channelImage(const DebugMode& mode, const Frame& frame, const ImageScale& scale);

// The tone curve: Khronos PBR Neutral (Khronos Group 2024), which nearly preserves values below 0.8.
std::array<float, 3> pbrNeutral(std::array<float, 3> rgb);

// IEC 61966-2-1; clamps to [0, 1].
double srgbFromLinear(double linear);

// The colour map of error images, t in [0, 1]: black to pale yellow through violet, red and orange.
// Lightness is linear in t. Computed in Oklab (B. Ottosson 2020, "A perceptual color space").
std::array<std::uint8_t, 3> errorColor(double t);

// W x H x 1 errors by errorColor(sqrt(error / top)), so that small errors of a skewed distribution are
// visible. Above `top` cyan, paler for larger errors, white from 1000 times `top`; infinity is magenta, 0
// black.
Image8 errorMap(const Image& errors, double top);
constexpr std::array<std::uint8_t, 3> beyondColor{40, 230, 240}, nonfiniteColor{255, 0, 255};
constexpr double farBeyond = 1000;  // times the top: white

// Half as wide and high: means of 2x2 encoded pixels; at least 1x1.
Image8 halfSize(const Image8& image);

}  // namespace diptych
