// SPDX-License-Identifier: MIT
// Fuzzes the PNG, JPEG and WebP images inside glTF files.
#include "shared/scene/image/decode.h"
#include "tests/fuzz/fuzz.h"

using namespace diptych;

FUZZ_TARGET(texture)(const std::uint8_t* data, std::size_t size) {
    fuzz::readOrSayWhy(
        [&] {
            const ImageHeader header = imageHeader({data, size});
            const std::int64_t pixels = header.width * header.height;
            fuzz::require(header.width > 0 && header.height > 0, "an image has pixels");
            fuzz::require(header.bytes() == static_cast<std::uint64_t>(pixels * (header.deep ? 8 : 4)),
                          "a header knows what its pixels take");
            if (header.bytes() > fuzz::max_bytes) return;
            const TextureImage image = decodeImage({data, size});
            fuzz::require(image.width == header.width && image.height == header.height,
                          "a header does not lie");
            fuzz::require(std::ssize(image.rgba) == (header.deep ? 0 : 4 * pixels) &&
                              std::ssize(image.rgba16) == (header.deep ? 4 * pixels : 0),
                          "a number for every component");
            const bool png = header.kind == ImageHeader::Kind::png;  // bit depth, color type, interlacing
            fuzz::observe(png ? std::size_t{data[24]} * 64 + std::size_t{data[25]} * 8 + data[28]
                              : static_cast<std::size_t>(header.kind));
        },
        fuzz::Behind::a_library);
    return 0;
}
