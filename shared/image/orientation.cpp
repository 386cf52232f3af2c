// SPDX-License-Identifier: MIT
#include "shared/image/orientation.h"

#include "shared/image/chunks.h"

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <utility>

namespace diptych {
namespace {

std::string_view textAt(std::span<const std::byte> bytes, std::size_t at, std::size_t size) {
    return {reinterpret_cast<const char*>(bytes.data()) + at, size};
}

// Unsigned number of `size` bytes, without a bounds check.
std::uint32_t numberAt(std::span<const std::byte> bytes, std::size_t at, std::size_t size, bool big) {
    std::uint32_t number = 0;
    for (std::size_t i = 0; i < size; ++i)
        number = number << 8 | std::to_integer<std::uint32_t>(bytes[at + (big ? i : size - 1 - i)]);
    return number;
}

template <class AnyImage>
AnyImage turnedAny(AnyImage image, int orientation) {
    if (orientation == 1) return image;
    const bool exchanged = orientation >= 5;
    // Where the first column and row are, after a transposition if any.
    const bool right = orientation == 2 || orientation == 3 || orientation == 6 || orientation == 7,
               bottom = orientation == 3 || orientation == 4 || orientation == 7 || orientation == 8;
    AnyImage shown = image;
    if (exchanged) std::swap(shown.width, shown.height);
    const auto n = static_cast<std::size_t>(image.components), width = static_cast<std::size_t>(image.width),
               height = static_cast<std::size_t>(image.height),
               shown_width = static_cast<std::size_t>(shown.width);
    for (std::size_t y = 0; y < height; ++y)
        for (std::size_t x = 0; x < width; ++x) {
            std::size_t to_x = exchanged ? y : x, to_y = exchanged ? x : y;
            if (right) to_x = shown_width - 1 - to_x;
            if (bottom) to_y = static_cast<std::size_t>(shown.height) - 1 - to_y;
            std::copy_n(image.data.data() + (y * width + x) * n, n,
                        shown.data.data() + (to_y * shown_width + to_x) * n);
        }
    return shown;
}

}  // namespace

int orientationOf(std::span<const std::byte> exif) {
    constexpr std::size_t header = 8, entry = 12;
    constexpr std::uint32_t orientation = 0x0112, shorts = 3;
    if (exif.size() < header) return 1;
    const bool big = textAt(exif, 0, 2) == "MM";
    if (!big && textAt(exif, 0, 2) != "II") return 1;
    const std::size_t directory = numberAt(exif, 4, 4, big);
    if (directory > exif.size() - 2) return 1;
    const std::size_t count = numberAt(exif, directory, 2, big);
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t at = directory + 2 + entry * i;
        if (at > exif.size() || exif.size() - at < entry) return 1;
        if (numberAt(exif, at, 2, big) != orientation) continue;
        const auto value = static_cast<int>(numberAt(exif, at + 8, 2, big));
        return numberAt(exif, at + 2, 2, big) == shorts && value >= 1 && value <= 8 ? value : 1;
    }
    return 1;
}

int orientationOfJpeg(std::span<const std::byte> file) {
    using namespace std::string_view_literals;
    constexpr std::string_view name = "Exif\0\0"sv;
    int orientation = 1;
    visitJpeg(file, [&](const Chunk& segment) {
        if (segment.name != "\xe1" || !segment.data.starts_with(name)) return true;
        orientation = orientationOf(std::as_bytes(std::span(segment.data.substr(name.size()))));
        return false;
    });
    return orientation;
}

int orientationOfPng(std::span<const std::byte> file) {
    int orientation = 1;
    visitPng(file, [&](const Chunk& chunk) {
        if (chunk.name != "eXIf") return true;
        orientation = orientationOf(std::as_bytes(std::span(chunk.data)));
        return false;
    });
    return orientation;
}

Image oriented(Image image, int orientation) {
    return turnedAny(std::move(image), orientation);
}
Image8 oriented(Image8 image, int orientation) {
    return turnedAny(std::move(image), orientation);
}

}  // namespace diptych
