// SPDX-License-Identifier: MIT
#include "shared/scene/image_decode.h"

#include <fmt/format.h>
#include <stb_image.h>

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <stdexcept>

namespace diptych {

namespace {

// The largest image side that GPUs and lavapipe take (maxImageDimension2D); a few bytes of PNG can claim
// far more.
constexpr int maxSide = 16384;

// The library would also guess at formats without a signature: only what glTF allows gets that far.
bool isPngOrJpeg(std::span<const unsigned char> encoded) {
    constexpr std::array<unsigned char, 8> png{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    constexpr std::array<unsigned char, 3> jpeg{0xff, 0xd8, 0xff};
    const auto begins = [&](const auto& signature) {
        return encoded.size() > signature.size() &&
               std::equal(signature.begin(), signature.end(), encoded.begin());
    };
    return begins(png) || begins(jpeg);
}

[[noreturn]] void failDecoding() {
    throw std::runtime_error(fmt::format("does not decode: {}", stbi_failure_reason()));
}

}  // namespace

TextureImage decodeImage(std::span<const unsigned char> encoded, bool& sixteenBits) {
    if (!isPngOrJpeg(encoded)) throw std::runtime_error("is neither PNG nor JPEG");
    if (encoded.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
        throw std::runtime_error("is larger than 2 GiB");
    const int size = static_cast<int>(encoded.size());

    TextureImage image;
    int components = 0;
    if (!stbi_info_from_memory(encoded.data(), size, &image.width, &image.height, &components))
        failDecoding();
    if (image.width < 1 || image.height < 1 || image.width > maxSide || image.height > maxSide)
        throw std::runtime_error(fmt::format("is {} x {} pixels: from 1 to {} a side are read", image.width,
                                             image.height, maxSide));
    sixteenBits = stbi_is_16_bit_from_memory(encoded.data(), size) != 0;

    const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> pixels(
        stbi_load_from_memory(encoded.data(), size, &image.width, &image.height, &components, 4),
        stbi_image_free);
    if (!pixels) failDecoding();
    image.rgba.assign(pixels.get(), pixels.get() + 4 * static_cast<std::size_t>(image.width) *
                                                       static_cast<std::size_t>(image.height));
    return image;
}

}  // namespace diptych
