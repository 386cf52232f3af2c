// SPDX-License-Identifier: MIT
#include "compare/image/heat.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

namespace diptych {

namespace {

using Rgb8 = std::array<std::uint8_t, 3>;

// Digits and the letters of the legend, 3 x 5 pixels, each row as three bits, from the top.
constexpr std::string_view glyphs = "0123456789.kEGHILPRSTX ";
constexpr std::array<std::array<unsigned, 5>, 23> rows{
    {{7, 5, 5, 5, 7}, {2, 6, 2, 2, 7}, {7, 1, 7, 4, 7}, {7, 1, 7, 1, 7}, {5, 5, 7, 1, 1}, {7, 4, 7, 1, 7},
     {7, 4, 7, 5, 7}, {7, 1, 1, 1, 1}, {7, 5, 7, 5, 7}, {7, 5, 7, 1, 7}, {0, 0, 0, 0, 2}, {4, 5, 6, 6, 5},
     {7, 4, 6, 4, 7}, {3, 4, 5, 5, 3}, {5, 5, 7, 5, 5}, {7, 2, 2, 2, 7}, {4, 4, 4, 4, 7}, {6, 5, 6, 4, 4},
     {6, 5, 6, 5, 5}, {3, 4, 2, 1, 6}, {7, 2, 2, 2, 2}, {5, 5, 2, 5, 5}, {0, 0, 0, 0, 0}}};

void fill(Image8& image, int left, int top, int width, int height, const Rgb8& color) {
    for (int y = std::max(top, 0); y < std::min(top + height, image.height); ++y)
        for (int x = std::max(left, 0); x < std::min(left + width, image.width); ++x)
            std::copy(color.begin(), color.end(),
                      image.data.begin() + 3 * (std::ptrdiff_t{y} * image.width + x));
}

void write(Image8& image, std::string_view text, int left, int top, int size) {
    for (const char c : text) {
        const std::size_t glyph = glyphs.find(c);
        for (int y = 0; y < 5; ++y)
            for (int x = 0; x < 3; ++x)
                if ((rows[glyph][static_cast<std::size_t>(y)] >> (2 - x)) & 1)
                    fill(image, left + x * size, top + y * size, size, size, {255, 255, 255});
        left += 4 * size;
    }
}

std::string text(double count) {
    return count >= 10000 ? fmt::format("{:g}k", count / 1000) : fmt::format("{:g}", count);
}

}  // namespace

std::array<std::uint8_t, 3> heatColor(double t) {
    constexpr std::array<std::array<double, 3>, 6> stops{
        {{20, 20, 90}, {40, 70, 155}, {30, 122, 145}, {75, 170, 110}, {220, 210, 85}, {255, 255, 255}}};
    const double at = std::clamp(t, 0.0, 1.0) * (stops.size() - 1);
    const auto i = std::min(static_cast<std::size_t>(at), stops.size() - 2);
    Rgb8 color{};
    for (std::size_t c = 0; c < 3; ++c)
        color[c] = static_cast<std::uint8_t>(
            std::lround(std::lerp(stops[i][c], stops[i + 1][c], at - static_cast<double>(i))));
    return color;
}

double heatTop(double largest) {
    if (!(largest > 1)) return 1;
    const double ten = std::pow(10.0, std::floor(std::log10(largest)));
    for (const double step : {1.0, 2.0, 5.0})
        if (largest <= step * ten) return step * ten;
    return 10 * ten;
}

Image8 withHeatLegend(const Image8& plain, double top) {
    if (plain.width < 80) return plain;
    const int size = std::max(1, plain.width / 480);  // size of a glyph's pixel
    const int margin = 3 * size, width = std::min(plain.width - 2 * margin, 100 * size), bar = 5 * size;
    const int title = plain.height + margin, above = title + 7 * size, line = above + bar + 2 * size;
    Image8 image = plain;
    image.height = line + 5 * size + margin;
    image.data.resize(3 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
    write(image, "LIGHTS PER PIXEL", margin, title, size);
    for (int x = 0; x < width; ++x) fill(image, margin + x, above, 1, bar, heatColor((x + 0.5) / width));
    for (const double part : {0.0, 0.5, 1.0}) {
        const std::string label = text(part * top);
        const int wide = static_cast<int>(label.size()) * 4 * size - size;
        write(image, label, margin + static_cast<int>(part * (width - wide)), line, size);
    }
    return image;
}

}  // namespace diptych
