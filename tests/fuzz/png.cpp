// SPDX-License-Identifier: MIT
#include "shared/image/png.h"
#include "tests/fuzz/fuzz.h"

using namespace diptych;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::readOrSayWhy(
        [&] {
            const Image8 image = readPng(fuzz::bytesAt(data, size), "fuzz.png", fuzz::most_bytes);
            fuzz::require(image.width > 0 && image.height > 0 && image.components == 4,
                          "a picture has RGBA pixels");
            fuzz::require(image.data.size() == 4 * static_cast<std::size_t>(image.width) *
                                                   static_cast<std::size_t>(image.height),
                          "a byte for every component");
            // Bits, colours, interlaced or not.
            fuzz::observe(std::size_t{data[24]} * 64 + std::size_t{data[25]} * 8 + data[28]);
        },
        fuzz::Behind::a_library);
    return 0;
}
