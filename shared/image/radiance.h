// SPDX-License-Identifier: MIT
// Radiance pictures (.hdr, .pic): three 8 bit mantissas with a shared exponent. Ward, "Real Pixels",
// Graphics Gems II, 1991; Ward, "The Radiance Picture File Format" (filefmts.pdf of the Radiance
// distribution).
#pragma once

#include "shared/image/image.h"
#include "shared/image/limits.h"
#include "shared/image/primaries.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace diptych {

// RGB, linear, row 0 on top whichever of the eight orientations the file has; divided by the file's
// EXPOSUREs and COLORCORRs, so that values are the radiance that was measured, and converted where PRIMARIES
// are not Rec. 709's, which are assumed. Reads flat pixels and both run-length codes. Refuses XYZE (with an
// error that names it) and what needs more than `most` bytes decoded. Throws std::runtime_error, one line
// naming file and fault.
struct HdrPicture {
    Image image;
    FileNotes notes{};
};
HdrPicture readHdr(std::span<const std::byte> bytes, const std::string& name,
                   std::uint64_t most = limits::imageBytes());

// From its header. Throws std::runtime_error without the file's name.
PictureSize hdrSize(std::span<const std::byte> bytes);

// Writes an RGB image, run-length coded; values read back are within 0.4 % of each pixel's largest
// component. Returns the number of pixels that RGBE cannot hold: negative and NaN components are written as
// 0, those above 1.7e38 as that, pixels below 2.9e-39 as black. Written beside `file` and renamed. Throws
// std::runtime_error naming the file.
std::size_t writeHdr(const std::filesystem::path& file, const Image& image);

}  // namespace diptych
