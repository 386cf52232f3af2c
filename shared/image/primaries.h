// SPDX-License-Identifier: MIT
// What R, G and B of a picture stand for. Without a word they are Rec. 709's, as in OpenEXR and PNG.
#pragma once

#include "shared/image/image.h"

#include <glm/glm.hpp>

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace diptych {

// CIE 1931 x, y of red, green, blue and white, one after the other.
using Primaries = std::array<double, 8>;

// What a file says of its colours and how it is to be shown, in words that follow the file's name.
struct FileNotes {
    std::vector<std::string> lines{};        // as "its colours were converted from ..."
    std::vector<std::string> not_applied{};  // the file means something else than the values that are read
};

// Linear R, G, B of `primaries` to those of Rec. 709 (ITU-R BT.709-6), whites adapted by Bradford's matrix
// (Lam 1985, as OpenEXR's ImfAcesFile.h uses it). Empty where they are Rec. 709's within what four digits
// round to, and where they span no colours. Says in `notes` which it was.
std::optional<glm::dmat3> matrixToRec709(const Primaries& primaries, FileNotes& notes);

// Components 0 to 2 of every pixel that is finite; `encoded`: by the sRGB curve, before and after, continued
// below 0 by its mirror image.
void convertColors(Image& image, const glm::dmat3& matrix, bool encoded = false);

// Says that pixels are not square; `aspect`: of their sides.
void noteAspect(double aspect, FileNotes& notes);
// Says that an ICC profile is not applied; `taken_as`: what the values are taken as. Two profiles have one
// note only where they are the same.
void noteProfile(std::string_view profile, std::string_view taken_as, FileNotes& notes);

}  // namespace diptych
