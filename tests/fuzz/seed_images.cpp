// SPDX-License-Identifier: MIT
// Small images of every format that the readers support.
#include "tests/fuzz/seeds.h"
#include "tests/support/png_builder.h"
#include "tests/support/webp_builder.h"

#include <cstdio>  // jpeglib.h asks for its FILE

#include <jpeglib.h>
#include <tiffio.h>

#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

namespace diptych::fuzz {

namespace fs = std::filesystem;

namespace {

constexpr int jpegSide = 20;

std::string seedPng(int color, int depth, bool interlaced) {
    const bool indexed = color == PNG_COLOR_TYPE_PALETTE;
    MadePng made{color, depth, 9, {}, interlaced};
    for (std::size_t y = 0; y < 9; ++y)
        for (std::size_t i = 0; i < 9 * 8; ++i) {
            if (i == 0) made.rows.emplace_back();
            made.rows[y].push_back(static_cast<std::uint8_t>(indexed ? (depth == 8 ? i % 2 : 0) : i * y));
        }
    if (indexed) {
        made.palette = {{255, 0, 0}, {0, 255, 0}};
        made.palette_alpha = {255, 128};
    }
    if (depth == 16) made.gamma = 0.5;
    return pngOf(made);
}

void writePngSeeds(const fs::path& out) {
    for (const int color : {PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_RGB, PNG_COLOR_TYPE_PALETTE,
                            PNG_COLOR_TYPE_GRAY_ALPHA, PNG_COLOR_TYPE_RGB_ALPHA})
        for (const int depth : {1, 8, 16}) {
            const bool few = color == PNG_COLOR_TYPE_GRAY || color == PNG_COLOR_TYPE_PALETTE;
            if ((depth == 1 && !few) || (depth == 16 && color == PNG_COLOR_TYPE_PALETTE)) continue;
            for (const bool interlaced : {false, true}) {
                const std::string name = std::to_string(color) + "-" + std::to_string(depth) +
                                         (interlaced ? "-interlaced.png" : ".png");
                for (const char* target : {"png", "texture"})
                    writeSeed(out, target, name, seedPng(color, depth, interlaced));
            }
        }
}

// Grey and colour, sequential and progressive, with restart markers.
std::string jpegOf(J_COLOR_SPACE colors, bool progressive) {
    jpeg_compress_struct jpeg{};
    jpeg_error_mgr errors{};
    jpeg.err = jpeg_std_error(&errors);
    jpeg_create_compress(&jpeg);
    unsigned char* bytes = nullptr;
    unsigned long size = 0;
    jpeg_mem_dest(&jpeg, &bytes, &size);
    jpeg.image_width = jpeg.image_height = jpegSide;
    jpeg.in_color_space = colors;
    jpeg.input_components = colors == JCS_GRAYSCALE ? 1 : colors == JCS_CMYK ? 4 : 3;
    jpeg_set_defaults(&jpeg);
    jpeg_set_quality(&jpeg, 40, TRUE);
    if (progressive) jpeg_simple_progression(&jpeg);
    jpeg.restart_interval = progressive ? 0 : 2;
    jpeg_start_compress(&jpeg, TRUE);
    std::vector<unsigned char> row(4 * jpegSide);
    for (std::size_t y = 0; y < jpegSide; ++y) {
        for (std::size_t i = 0; i < row.size(); ++i) row[i] = static_cast<unsigned char>(i * y);
        unsigned char* rows[] = {row.data()};
        jpeg_write_scanlines(&jpeg, rows, 1);
    }
    jpeg_finish_compress(&jpeg);
    jpeg_destroy_compress(&jpeg);
    const std::string result(reinterpret_cast<const char*>(bytes), size);
    std::free(bytes);
    return result;
}

void writeJpegSeeds(const fs::path& out) {
    for (const J_COLOR_SPACE colors : {JCS_GRAYSCALE, JCS_RGB, JCS_CMYK})
        for (const bool progressive : {false, true})
            writeSeed(out, "texture", std::to_string(colors) + (progressive ? "-progressive.jpg" : ".jpg"),
                      jpegOf(colors, progressive));
}

void writeWebpSeeds(const fs::path& out) {
    for (const bool opaque : {false, true}) {
        const WebpPixels pixels = colourfulWebp(20, 20, opaque);
        const std::string name = opaque ? "opaque.webp" : "alpha.webp";
        writeSeed(out, "texture", "lossless-" + name, losslessWebp(pixels));
        writeSeed(out, "texture", "lossy-" + name, lossyWebp(pixels, 40));
        writeSeed(out, "texture", "animated-" + name, animatedWebp(pixels));
    }
    writeSeed(out, "texture", "plain.webp", losslessWebp(plainWebp(20, 20, {1, 2, 3, 255})));
}

void writeHdrSeeds(const fs::path& out) {
    using namespace std::string_literals;
    const auto head = [](const std::string& resolution) {
        return "#?RADIANCE\n# seed\nFORMAT=32-bit_rle_rgbe\nEXPOSURE=2\nCOLORCORR=1 2 0.5\n\n" + resolution +
               "\n";
    };
    const std::string pixel = "\x80\x40\x20\x81";
    for (const char* order : {"-Y 2 +X 3", "+Y 2 -X 3", "+X 3 -Y 2", "-X 3 +Y 2"}) {
        std::string pixels;
        for (int i = 0; i < 6; ++i) pixels += pixel;
        writeSeed(out, "hdr", "flat"s + order + ".hdr", head(order) + pixels);
    }
    writeSeed(out, "hdr", "old-runs.hdr", head("-Y 1 +X 300") + pixel + "\x01\x01\x01\x2b\x01\x01\x01\x01");
    writeSeed(out, "hdr", "new-runs.hdr",
              head("-Y 1 +X 8") +
                  "\x02\x02\x00\x08\x88\xc8\x08\x01\x02\x03\x04\x05\x06\x07\x08\x83\x05\x85\x06\x88\x80"s);
}

void writePfmSeeds(const fs::path& out) {
    const std::string number("\x00\x00\x80\x3f", 4), turned(number.rbegin(), number.rend());
    writeSeed(out, "pfm", "grey.pfm", "Pf\n2 1\n-1.0\n" + number + number);
    writeSeed(out, "pfm", "color.pfm",
              "PF 1 2 0.5\n" + turned + turned + turned + turned + turned + turned + "\n");
}

// Written by libtiff: every compression, strips and tiles, integers and floats.
void writeTiffSeeds(const fs::path& out) {
    fs::create_directories(out / "tiff");
    for (const int packing :
         {COMPRESSION_NONE, COMPRESSION_LZW, COMPRESSION_ADOBE_DEFLATE, COMPRESSION_PACKBITS})
        for (const int bits : {8, 16, 32}) {
            const std::string name = std::to_string(packing) + "-" + std::to_string(bits) + ".tif";
            TIFF* tiff = TIFFOpen((out / "tiff" / name).c_str(), bits == 16 ? "wb" : "wl");
            if (!tiff) std::abort();
            TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, 17);
            TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, 17);
            TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, bits == 8 ? 3 : 1);
            TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, bits);
            TIFFSetField(tiff, TIFFTAG_SAMPLEFORMAT, bits == 32 ? SAMPLEFORMAT_IEEEFP : SAMPLEFORMAT_UINT);
            TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, bits == 8 ? PHOTOMETRIC_RGB : PHOTOMETRIC_MINISBLACK);
            TIFFSetField(tiff, TIFFTAG_COMPRESSION, packing);
            TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
            std::vector<unsigned char> tile(16 * 16 * 4, 17);
            if (bits == 16) {
                TIFFSetField(tiff, TIFFTAG_TILEWIDTH, 16);
                TIFFSetField(tiff, TIFFTAG_TILELENGTH, 16);
                for (std::uint32_t i = 0; i < 4; ++i) TIFFWriteEncodedTile(tiff, i, tile.data(), 16 * 16 * 2);
            } else {
                TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, 5);
                for (std::uint32_t y = 0; y < 17; ++y) TIFFWriteScanline(tiff, tile.data(), y, 0);
            }
            TIFFClose(tiff);
        }
}

}  // namespace

void writeImageSeeds(const fs::path& out) {
    writePngSeeds(out);
    writeJpegSeeds(out);
    writeWebpSeeds(out);
    writeHdrSeeds(out);
    writePfmSeeds(out);
    writeTiffSeeds(out);
}

}  // namespace diptych::fuzz
