// SPDX-License-Identifier: MIT
#include "shared/image/pfm.h"
#include "tests/fuzz/fuzz.h"

using namespace diptych;

FUZZ_TARGET(pfm)(const std::uint8_t* data, std::size_t size) {
    fuzz::readOrSayWhy([&] {
        const PfmImage decoded = readPfm(fuzz::bytesAt(data, size), "fuzz.pfm", fuzz::max_bytes);
        const Image& image = decoded.image;
        fuzz::require(image.width > 0 && image.height > 0, "a picture has pixels");
        fuzz::require(image.components == 1 || image.components == 3, "a picture is grey or RGB");
        fuzz::require(image.data.size() == image.pixels() * static_cast<std::size_t>(image.components),
                      "a number for every component");
        fuzz::require(decoded.behind + 4 * image.data.size() < size, "every number stands in the file");
    });
    return 0;
}
