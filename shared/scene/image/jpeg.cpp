// SPDX-License-Identifier: MIT
#include "shared/image/jpeg_decoder.h"
#include "shared/scene/image/codecs.h"

namespace diptych::codec {

ImageHeader readJpegHeader(Bytes encoded) {
    const JpegSize size = readJpegSize(encoded);
    return {ImageHeader::Kind::jpeg, size.width, size.height, false, jpeg_pixels_per_byte};
}

void decodeJpeg(Bytes encoded, const ImageHeader& header, unsigned char* pixels) {
    readJpegRgba(encoded, {header.width, header.height}, pixels);
}

}  // namespace diptych::codec
