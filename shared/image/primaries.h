// SPDX-License-Identifier: MIT
// Colour spaces of images. The default is Rec. 709, as in OpenEXR and PNG.
#pragma once

#include "shared/image/image.h"

#include <glm/glm.hpp>

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace diptych {

// CIE 1931 x, y of red, green, blue and white.
using Primaries = std::array<double, 8>;

// A file's declarations about colours and display, as text that follows the file's name.
struct FileNotes {
    std::vector<std::string> lines{};        // such as "its colours were converted from ..."
    std::vector<std::string> not_applied{};  // declarations that the values read do not reflect
    std::vector<std::string> in_part{};      // contents that are not read: "only its first page is read"
};

// Converts linear RGB of `primaries` to Rec. 709 (ITU-R BT.709-6). White points are adapted by Bradford's
// matrix (Lam 1985, as in OpenEXR's ImfAcesFile.h). Empty if they are Rec. 709 within four digits, or span
// no colour space. `notes` says which.
std::optional<glm::dmat3> matrixToRec709(const Primaries& primaries, FileNotes& notes);

// Converts components 0 to 2 of every finite pixel. `encoded`: decodes sRGB before and encodes it after,
// with the curve mirrored below 0.
void convertColors(Image& image, const glm::dmat3& matrix, bool encoded = false);

// Notes non-square pixels; `aspect`: their width over height.
void noteAspect(double aspect, FileNotes& notes);
// Notes that an ICC profile is not applied; `taken_as`: the assumed encoding. Equal notes mean equal
// profiles.
void noteProfile(std::string_view profile, std::string_view taken_as, FileNotes& notes);

}  // namespace diptych
