// SPDX-License-Identifier: MIT
// The PNG, JPEG and WebP decoders behind decode.h. `read...Header` expects a checked signature, `decode...` a
// checked header. `pixels` has header.bytes() bytes: rows from top to bottom, RGBA, 16-bit components in
// native byte order. Both throw std::runtime_error without the file's name.
#pragma once

#include "shared/scene/image/header.h"

#include <span>
#include <stdexcept>
#include <string>

namespace diptych::codec {

using Bytes = std::span<const unsigned char>;

ImageHeader readPngHeader(Bytes encoded);
ImageHeader readJpegHeader(Bytes encoded);
ImageHeader readWebpHeader(Bytes encoded);

void decodePng(Bytes encoded, const ImageHeader& header, unsigned char* pixels);
void decodeJpeg(Bytes encoded, const ImageHeader& header, unsigned char* pixels);
void decodeWebp(Bytes encoded, const ImageHeader& header, unsigned char* pixels);

// Throws "does not decode: WHY", for errors of the decoder library.
[[noreturn]] inline void failDecoding(const char* why) {
    throw std::runtime_error(std::string("does not decode: ") + why);
}

}  // namespace diptych::codec
