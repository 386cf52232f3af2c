// SPDX-License-Identifier: MIT
// The PNG and JPEG images inside glTF files.
#include "shared/scene/image_decode.h"
#include "tests/fuzz/fuzz.h"

using namespace diptych;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::readOrSayWhy(
        [&] {
            bool sixteenBits = false;
            const TextureImage image = decodeImage({data, size}, sixteenBits);
            fuzz::require(image.width > 0 && image.height > 0, "an image has pixels");
            fuzz::require(image.rgba.size() == 4 * static_cast<std::size_t>(image.width) *
                                                   static_cast<std::size_t>(image.height),
                          "a byte for every component");
            const bool png = data[0] == 0x89;  // then its bits, its colours, and whether it is interlaced
            fuzz::observe(png ? std::size_t{data[24]} * 64 + std::size_t{data[25]} * 8 + data[28] : 1);
        },
        fuzz::Behind::a_library);
    return 0;
}
