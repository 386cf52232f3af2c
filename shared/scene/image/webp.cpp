// SPDX-License-Identifier: MIT
#include "shared/scene/image/codecs.h"

#include "shared/text/fail.h"

#include <webp/decode.h>

#include <limits>

namespace diptych::codec {

namespace {

// A lossy macroblock of 16 x 16 pixels takes at least two bits, for its prediction modes, whose
// probabilities are fixed (RFC 6386, 2011, 11.2 and 11.3).
constexpr std::int64_t lossyPixelsPerByte = 16 * 16 * 8 / 2;
// A lossless image of one colour takes no bits per pixel: a prefix code with one symbol has length 0.
constexpr std::int64_t losslessPixelsPerByte = std::numeric_limits<std::int64_t>::max();

void check(VP8StatusCode status) {
    if (status == VP8_STATUS_OK) return;
    failDecoding(status == VP8_STATUS_NOT_ENOUGH_DATA || status == VP8_STATUS_SUSPENDED ? "it ends early"
                 : status == VP8_STATUS_OUT_OF_MEMORY ? "there is not enough memory"
                                                      : "its data is damaged");
}

}  // namespace

ImageHeader readWebpHeader(Bytes encoded) {
    WebPBitstreamFeatures found{};
    check(WebPGetFeatures(encoded.data(), encoded.size(), &found));
    if (found.has_animation) fail("is an animated WebP, which is not supported; use a still image");
    constexpr int lossless = 2;
    return {ImageHeader::Kind::webp, found.width, found.height, false,
            found.format == lossless ? losslessPixelsPerByte : lossyPixelsPerByte};
}

void decodeWebp(Bytes encoded, const ImageHeader& header, unsigned char* pixels) {
    WebPDecoderConfig config;
    if (!WebPInitDecoderConfig(&config)) failDecoding("libwebp is older than its headers");
    config.output.colorspace = MODE_RGBA;
    config.output.is_external_memory = 1;
    config.output.u.RGBA = {pixels, static_cast<int>(4 * header.width),
                            static_cast<std::size_t>(header.bytes())};
    check(WebPDecode(encoded.data(), encoded.size(), &config));
}

}  // namespace diptych::codec
