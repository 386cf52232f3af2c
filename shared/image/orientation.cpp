// SPDX-License-Identifier: MIT
#include "shared/image/orientation.h"

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <utility>

namespace diptych {
namespace {

std::string_view textAt(std::span<const std::byte> bytes, std::size_t at, std::size_t size) {
    return {reinterpret_cast<const char*>(bytes.data()) + at, size};
}

// An unsigned number of `size` bytes, which are there.
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
    // Where the first column and row come to stand once both are exchanged.
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
    constexpr std::uint32_t scan = 0xda, application = 0xe1;
    using namespace std::string_view_literals;
    constexpr std::string_view name = "Exif\0\0"sv;
    for (std::size_t at = 2; file.size() >= 4 && at <= file.size() - 4;) {
        if (file[at] != std::byte{0xff}) return 1;
        const auto marker = std::to_integer<std::uint32_t>(file[at + 1]);
        if (marker == 0xff) {  // a fill byte
            ++at;
            continue;
        }
        const std::size_t size = numberAt(file, at + 2, 2, true);  // its own two bytes are in it
        if (marker == scan || size < 2 || size > file.size() - at - 2) return 1;
        if (marker == application && size >= 2 + name.size() && textAt(file, at + 4, name.size()) == name)
            return orientationOf(file.subspan(at + 4 + name.size(), size - 2 - name.size()));
        at += 2 + size;
    }
    return 1;
}

int orientationOfPng(std::span<const std::byte> file) {
    constexpr std::size_t signature = 8, around = 12;  // length, name and checksum around a chunk's data
    for (std::size_t at = signature; file.size() >= around && at <= file.size() - around;) {
        const std::size_t size = numberAt(file, at, 4, true);
        if (size > file.size() - at - around) return 1;
        if (textAt(file, at + 4, 4) == "eXIf") return orientationOf(file.subspan(at + 8, size));
        at += around + size;
    }
    return 1;
}

Image turned(Image image, int orientation) {
    return turnedAny(std::move(image), orientation);
}
Image8 turned(Image8 image, int orientation) {
    return turnedAny(std::move(image), orientation);
}

}  // namespace diptych
