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

// Checks that all layers have one size and every channel a value in each pixel.
void requireImage(const ImageFile& file) {
    fuzz::require(!file.layers.empty(), "a file has a layer");
    for (const ImageLayer& layer : file.layers) {
        const Image& image = layer.image;
        fuzz::require(image.width > 0 && image.height > 0, "a layer has pixels");
        fuzz::require(image.width == file.width && image.height == file.height, "layers are of one size");
        fuzz::require(image.components == static_cast<int>(layer.channels.size()),
                      "a component for every channel");
        fuzz::require(image.data.size() == image.pixels() * layer.channels.size(),
                      "a number for every component");
        fuzz::require(layer.exact.empty() || layer.exact.size() == layer.channels.size(),
                      "exact numbers by channel");
        for (const std::vector<std::uint32_t>& exact : layer.exact)
            fuzz::require(exact.empty() || exact.size() == image.pixels(), "an exact number for every pixel");
    }
}

}  // namespace

FUZZ_TARGET(exr)(const std::uint8_t* data, std::size_t size) {
    const auto read = [&](std::string_view part) {
        fuzz::readOrSayWhy(
            [&] {
                requireImage(readExr(fuzz::bytesAt(data, size), "fuzz.exr", fuzz::max_bytes, part));
                const std::size_t tiled = data[5] & 2u, several = data[5] & 16u;
                fuzz::observe(64 * several + 16 * tiled + compressionOf(fuzz::textAt(data, size)));
            },
            fuzz::Behind::a_library);
    };
    read("");
    const bool several = size > 5 && (data[5] & 16u) != 0;
    if (several) read("b");
    return 0;
}
