// SPDX-License-Identifier: MIT
#include "shared/image/tiff.h"
#include "tests/fuzz/fuzz.h"

using namespace diptych;

FUZZ_TARGET(tiff)(const std::uint8_t* data, std::size_t size) {
    fuzz::readOrSayWhy([&] {
        const TiffImage decoded = readTiff(fuzz::bytesAt(data, size), "fuzz.tif", fuzz::max_bytes);
        const Image& image = decoded.image;
        fuzz::require(image.width > 0 && image.height > 0, "a picture has pixels");
        fuzz::require(image.components >= 1 && image.components <= 4,
                      "a picture is grey or RGB, with alpha or not");
        fuzz::require(image.data.size() == image.pixels() * static_cast<std::size_t>(image.components),
                      "a number for every component");
    });
    return 0;
}
