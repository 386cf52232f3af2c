// SPDX-License-Identifier: MIT
// The two codecs behind decode.h. `read...Header` gets a file with the right signature; `decode...` one
// whose header has been found sound, and fills `pixels`, which has room for header.bytes(): rows from top to
// bottom, RGBA, 16 bit components in the machine's order. Both throw std::runtime_error without a name.
#pragma once

#include "shared/scene/image/header.h"

#include <span>
#include <stdexcept>
#include <string>

namespace diptych::codec {

using Bytes = std::span<const unsigned char>;

ImageHeader readPngHeader(Bytes encoded);
ImageHeader readJpegHeader(Bytes encoded);

void decodePng(Bytes encoded, const ImageHeader& header, unsigned char* pixels);
void decodeJpeg(Bytes encoded, const ImageHeader& header, unsigned char* pixels);

// What both say where a library gives up: "does not decode: WHY".
[[noreturn]] inline void failDecoding(const char* why) {
    throw std::runtime_error(std::string("does not decode: ") + why);
}

}  // namespace diptych::codec
