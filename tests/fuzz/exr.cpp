// SPDX-License-Identifier: MIT
#include "shared/image/exr.h"
#include "tests/fuzz/fuzz.h"

using namespace diptych;

namespace {

std::size_t compressionOf(std::string_view file) {
    constexpr std::string_view attribute("compression\0compression\0\1\0\0\0", 28);
    const std::size_t at = file.find(attribute);
    return at == file.npos ? 0 : static_cast<unsigned char>(file.substr(at + attribute.size())[0]);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::readOrSayWhy(
        [&] {
            const std::vector<ExrLayer> layers =
                readExr(fuzz::bytesAt(data, size), "fuzz.exr", fuzz::most_bytes);
            fuzz::require(!layers.empty(), "a file has a layer");
            for (const auto& [name, channels, image] : layers) {
                fuzz::require(image.width > 0 && image.height > 0, "a layer has pixels");
                fuzz::require(image.components == static_cast<int>(channels.size()),
                              "a component for every channel");
                fuzz::require(image.data.size() == image.pixels() * channels.size(),
                              "a number for every component");
                fuzz::require(image.pixels() == layers[0].image.pixels(), "layers are of one size");
            }
            const std::size_t tiled = data[5] & 2u;
            fuzz::observe(16 * tiled + compressionOf(fuzz::textAt(data, size)));
        },
        fuzz::Behind::a_library);
    return 0;
}
