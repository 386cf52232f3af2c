// SPDX-License-Identifier: MIT
// Pictures of an explanation: which cause counts most at each pixel, and how much each counts where.
#pragma once

#include "compare/explain/explanation.h"
#include "shared/image/png.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace diptych {

using Color8 = std::array<std::uint8_t, 3>;  // sRGB

// The colour of a cause by its place in Explanation::causes. The first seven have one of their own, after
// Okabe and Ito 2008, "Color Universal Design", as parts have in plots; the others share a pale grey.
Color8 causeColor(std::size_t place);
inline constexpr std::size_t ownColors = 7;

// "#56b4e9".
std::string cssColor(const Color8& color);

struct NamedPicture {
    std::string name;  // of its file
    Image8 picture;
};

// The names of the files of explanationMaps().
inline constexpr const char* dominantFile = "dominant.png";
inline constexpr const char* differenceFile = "difference.png";
inline constexpr const char* unexplainedFile = "unexplained.png";
std::string shareFile(const Explanation& explanation, std::size_t cause);  // "share-1.albedo.png"

// The colour of the cause with the largest share at each pixel. Where no cause brings lit nearer stands
// `shown`, a picture of the scene, dark and grey.
Image8 dominantPicture(const Explanation& explanation, const Image8& shown);

// The difference that explanationMaps() shows as the end of its colours, W/(sr m^2): 999 of 1000 of the
// pixels that differ are below it.
double topOfMaps(const Explanation& explanation);

// W x H x 1 shares as errorPicture() shows errors; green where they are negative.
Image8 sharePicture(const Image& shares, double top);

// The difference of both pictures, each cause's share of it, and what is unexplained, all on one scale.
std::vector<NamedPicture> explanationMaps(const Explanation& explanation);

}  // namespace diptych
