// SPDX-License-Identifier: MIT
#include "shared/image/limits.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <stdexcept>

namespace diptych {

std::uint64_t limits::imageBytes() {
    static const std::uint64_t bytes = [] {
        constexpr std::uint64_t max = std::uint64_t{8} << 30;
        const long pages = ::sysconf(_SC_PHYS_PAGES), size = ::sysconf(_SC_PAGESIZE);
        if (pages <= 0 || size <= 0) return max;
        return std::min(max, static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(size) / 2);
    }();
    return bytes;
}

void checkImageSize(std::int64_t width, std::int64_t height, std::int64_t bytesPerPixel, std::uint64_t max) {
    constexpr std::int64_t side = limits::image_side;
    if (width < 1 || height < 1 || width > side || height > side)
        throw std::runtime_error(
            fmt::format("claims {} x {} pixels; each side must be 1 to {}", width, height, side));
    const std::uint64_t bytes =
        static_cast<std::uint64_t>(width * height) * static_cast<std::uint64_t>(bytesPerPixel);
    if (bytes > max)
        throw std::runtime_error(fmt::format("claims {} x {} pixels of {} bytes; the limit is {} MiB", width,
                                             height, bytesPerPixel, max >> 20));
}

void failToHold(std::int64_t width, std::int64_t height, std::size_t fileBytes) {
    throw std::runtime_error(
        fmt::format("claims {} x {} pixels, too many for its {} bytes", width, height, fileBytes));
}

}  // namespace diptych
