// SPDX-License-Identifier: MIT
// Radiance images (.hdr, .pic): three 8-bit mantissas with a shared exponent. Ward, "Real Pixels",
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

// RGB, linear, row 0 on top for all eight orientations. Values are divided by EXPOSURE and COLORCORR,
// which gives the measured radiance. They are converted if PRIMARIES are not Rec. 709, the default. Reads
// plain pixels and both run-length codes. Rejects XYZE and files that need more than `max` bytes decoded.
// Throws std::runtime_error, one line that names file and fault.
struct HdrImage {
    Image image;
    FileNotes notes{};
};
HdrImage readHdr(std::span<const std::byte> bytes, const std::string& name,
                 std::uint64_t max = limits::imageBytes());

// Reads only the header. Throws std::runtime_error without the file's name.
ImageSize hdrSize(std::span<const std::byte> bytes);

// Writes an RGB image, run-length coded; values read back are within 0.4 % of each pixel's largest
// component. Returns the number of pixels that RGBE cannot represent: negative and NaN components become
// 0, those above 1.7e38 become that, pixels below 2.9e-39 black. Replaces `file` atomically. Throws
// std::runtime_error that names the file.
std::size_t writeHdr(const std::filesystem::path& file, const Image& image);

}  // namespace diptych
