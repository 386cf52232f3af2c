// SPDX-License-Identifier: MIT
// Images of an explanation: the dominant cause at each pixel, and a map of each cause.
#pragma once

#include "compare/explain/explanation.h"
#include "compare/image/channel_image.h"
#include "shared/image/png.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace diptych {

using Color8 = std::array<std::uint8_t, 3>;  // sRGB

// The colour of a cause by its index in Explanation::causes. The first seven have their own, after Okabe
// and Ito 2008, "Color Universal Design", as in plots; all others are pale grey.
Color8 causeColor(std::size_t index);
inline constexpr std::size_t ownColors = 7;

struct NamedImage {
    std::string name;  // of its file
    Image8 image;
};

// The names of the files of explanationMaps().
inline constexpr const char* dominantFile = "dominant.png";
inline constexpr const char* differenceFile = "difference.png";
inline constexpr const char* unexplainedFile = "unexplained.png";
std::string contributionFile(const Explanation& explanation, std::size_t cause);  // "share-1.albedo.png"

// The colour of the cause with the largest contribution at each pixel. Where no cause brings lit nearer,
// `shown`, an image of the scene, is visible, dark and grey.
Image8 dominantImage(const Explanation& explanation, const Image8& shown);

// The value at the end of the colours of explanationMaps(), W/(sr m^2): the 99.9th percentile of the
// pixels that differ.
double topOfMaps(const Explanation& explanation);

// W x H x 1 contributions in the colours of errorMap(); blue where negative.
Image8 contributionImage(const Image& contributions, double top);

// lit of one side as an image (channelImage()), at the exposure of `baseline`.
Image8 litImage(const Frame& frame, const Frame& baseline, const ImageChoice& choice);

// The difference of both images, each cause's contribution to it, and the unexplained remainder, all on one
// scale.
std::vector<NamedImage> explanationMaps(const Explanation& explanation);

}  // namespace diptych
