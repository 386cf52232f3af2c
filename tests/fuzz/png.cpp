// SPDX-License-Identifier: MIT
#include "shared/image/png.h"
#include "tests/fuzz/fuzz.h"

using namespace diptych;

FUZZ_TARGET(png)(const std::uint8_t* data, std::size_t size) {
    fuzz::readOrSayWhy(
        [&] {
            const PngImage decoded = readPngImage(fuzz::bytesAt(data, size), "fuzz.png", fuzz::max_bytes);
            const Image& image = decoded.image;
            fuzz::require(image.width > 0 && image.height > 0, "a picture has pixels");
            fuzz::require(image.components >= 1 && image.components <= 4, "a picture is Y, YA, RGB or RGBA");
            fuzz::require(decoded.bits == 8 || decoded.bits == 16, "a component has 8 or 16 bits");
            fuzz::require(image.data.size() == image.pixels() * static_cast<std::size_t>(image.components),
                          "a number for every component");
            for (const float value : image.data) fuzz::require(value >= 0 && value <= 1, "values are 0 to 1");
            // Bit depth, color type, interlacing.
            fuzz::observe(std::size_t{data[24]} * 64 + std::size_t{data[25]} * 8 + data[28]);
        },
        fuzz::Behind::a_library);
    return 0;
}
