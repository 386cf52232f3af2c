// SPDX-License-Identifier: MIT
// PNG files of every color type, written by libpng from rows in stored form.
#pragma once

#include <png.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace diptych {

struct MadePng {
    int color = PNG_COLOR_TYPE_RGB, bits = 8;
    std::uint32_t width = 1;
    std::vector<std::vector<std::uint8_t>> rows;  // 16 bits: high byte first
    bool interlaced = false;
    std::vector<png_color> palette{};
    std::vector<std::uint8_t> palette_alpha{};
    int transparent_gray = -1;  // -1: none
    double gamma = 0;           // 0: none
    bool srgb = false;
    bool profile = false;
    std::vector<std::pair<std::string, std::string>> chunks{};  // before the pixels
    std::string exif{};                                         // after the pixels
    std::vector<png_uint_16> transparent_color{};               // red, green, blue
};

// An error terminates the program (libpng's default): it would be a bug in the test.
inline std::string pngOf(const MadePng& made) {
    std::string bytes;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_set_write_fn(
        png, &bytes,
        [](png_structp to, png_bytep from, std::size_t size) {
            static_cast<std::string*>(png_get_io_ptr(to))->append(reinterpret_cast<const char*>(from), size);
        },
        nullptr);
    png_set_IHDR(png, info, made.width, static_cast<png_uint_32>(made.rows.size()), made.bits, made.color,
                 made.interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    if (!made.palette.empty())
        png_set_PLTE(png, info, made.palette.data(), static_cast<int>(made.palette.size()));
    if (!made.palette_alpha.empty())
        png_set_tRNS(png, info, made.palette_alpha.data(), static_cast<int>(made.palette_alpha.size()),
                     nullptr);
    png_color_16 transparent{};
    transparent.gray = static_cast<png_uint_16>(made.transparent_gray);
    if (!made.transparent_color.empty()) {
        transparent.red = made.transparent_color[0];
        transparent.green = made.transparent_color[1];
        transparent.blue = made.transparent_color[2];
    }
    if (made.transparent_gray >= 0 || !made.transparent_color.empty())
        png_set_tRNS(png, info, nullptr, 0, &transparent);
    png_write_info(png, info);
    // Written by hand: libpng writes neither a gamma that contradicts sRGB nor an invalid profile.
    const auto chunk = [&](const char* name, const std::vector<png_byte>& data) {
        png_write_chunk(png, reinterpret_cast<png_const_bytep>(name), data.data(), data.size());
    };
    const auto gamma = static_cast<std::uint32_t>(made.gamma * 100000 + 0.5);
    if (gamma > 0)
        chunk("gAMA", {png_byte(gamma >> 24), png_byte(gamma >> 16), png_byte(gamma >> 8), png_byte(gamma)});
    if (made.srgb) chunk("sRGB", {0});
    for (const auto& [name, data] : made.chunks) chunk(name.c_str(), {data.begin(), data.end()});
    if (made.profile) chunk("iCCP", {'a', 0, 0});  // name, method, no data: profiles are not decompressed
    const int passes = png_set_interlace_handling(png);
    for (int pass = 0; pass < passes; ++pass)
        for (const std::vector<std::uint8_t>& row : made.rows) png_write_row(png, row.data());
    if (!made.exif.empty()) chunk("eXIf", {made.exif.begin(), made.exif.end()});
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    return bytes;
}

}  // namespace diptych
