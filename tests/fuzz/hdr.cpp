// SPDX-License-Identifier: MIT
#include "shared/image/radiance.h"
#include "tests/fuzz/fuzz.h"

#include <cmath>

using namespace diptych;

FUZZ_TARGET(hdr)(const std::uint8_t* data, std::size_t size) {
    fuzz::readOrSayWhy([&] {
        const Image image = readHdr(fuzz::bytesAt(data, size), "fuzz.hdr", fuzz::max_bytes).image;
        fuzz::require(image.width > 0 && image.height > 0 && image.components == 3,
                      "a picture has RGB pixels");
        fuzz::require(image.data.size() == 3 * image.pixels(), "a number for every component");
        for (const float value : image.data) fuzz::require(std::isfinite(value), "radiance is finite");
    });
    return 0;
}
