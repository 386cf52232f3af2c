// SPDX-License-Identifier: MIT
// Small EXR files of every kind: compressions in lines and tiles, levels, crops, parts, and unsupported
// features.
#include "tests/fuzz/seeds.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfRgbaFile.h>
#include <OpenEXR/ImfStdIO.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfTiledOutputFile.h>
#include <OpenEXR/ImfTiledOutputPart.h>

#include <cmath>
#include <string>
#include <vector>

namespace diptych::fuzz {

namespace fs = std::filesystem;

namespace {

constexpr int side = 20;

// R (half), G (float), B (uint): smooth, with noise in the left columns.
struct Pixels {
    Pixels() {
        for (int i = 0; i < side * side; ++i) {
            const int noise = i % side < 8 ? i * 7919 % 31 : 0;
            r.push_back(half(0.1f * static_cast<float>(i / side + noise)));
            g.push_back(std::sin(static_cast<float>(i)));
            b.push_back(static_cast<unsigned>(i + noise));
        }
        buffer.insert("R", Imf::Slice(Imf::HALF, reinterpret_cast<char*>(r.data()), 2, 2 * side));
        buffer.insert("G", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(g.data()), 4, 4 * side));
        buffer.insert("B", Imf::Slice(Imf::UINT, reinterpret_cast<char*>(b.data()), 4, 4 * side));
    }
    std::vector<half> r;
    std::vector<float> g;
    std::vector<unsigned> b;
    Imf::FrameBuffer buffer;
};

Imf::Header header(int compression) {
    Imf::Header result(side, side);
    result.compression() = static_cast<Imf::Compression>(compression);
    result.channels().insert("R", Imf::Channel(Imf::HALF));
    result.channels().insert("G", Imf::Channel(Imf::FLOAT));
    result.channels().insert("B", Imf::Channel(Imf::UINT));
    return result;
}

void writeCompressionSeeds(const fs::path& out) {
    const Pixels pixels;
    for (int compression = 0; compression < Imf::NUM_COMPRESSION_METHODS; ++compression) {
        const std::string number = std::to_string(compression);
        Imf::StdOSStream lines, tiles;
        {
            Imf::OutputFile file(lines, header(compression));
            file.setFrameBuffer(pixels.buffer);
            file.writePixels(side);
        }
        {
            Imf::Header head = header(compression);
            head.setTileDescription(
                Imf::TileDescription(8, 8, static_cast<Imf::LevelMode>(compression % Imf::NUM_LEVELMODES)));
            Imf::TiledOutputFile file(tiles, head);
            file.setFrameBuffer(pixels.buffer);
            for (int y = 0; y < file.numYLevels(); ++y)
                for (int x = 0; x < file.numXLevels(); ++x)
                    if (file.isValidLevel(x, y))
                        file.writeTiles(0, file.numXTiles(x) - 1, 0, file.numYTiles(y) - 1, x, y);
        }
        writeSeed(out, "exr", "lines-" + number + ".exr", lines.str());
        writeSeed(out, "exr", "tiles-" + number + ".exr", tiles.str());
    }
}

std::string lines(const Imf::Header& head, const Imf::FrameBuffer& buffer) {
    Imf::StdOSStream stream;
    {
        Imf::OutputFile file(stream, head);
        file.setFrameBuffer(buffer);
        file.writePixels(side);
    }
    return stream.str();
}

// Two parts: scan lines and 16 x 16 tiles, with equal or different display windows.
std::string parts(bool alike) {
    const Pixels pixels;
    Imf::Header heads[] = {header(Imf::ZIPS_COMPRESSION), header(Imf::NO_COMPRESSION)};
    heads[0].setName("a");
    heads[0].setType(Imf::SCANLINEIMAGE);
    heads[0].insert("software", Imf::StringAttribute("seed"));
    heads[1].setName("b");
    heads[1].setType(Imf::TILEDIMAGE);
    heads[1].setTileDescription(Imf::TileDescription(16, 16));
    Imf::StdOSStream stream;
    {
        Imf::MultiPartOutputFile file(stream, heads, 2);
        Imf::OutputPart first(file, 0);
        first.setFrameBuffer(pixels.buffer);
        first.writePixels(side);
        Imf::TiledOutputPart second(file, 1);
        second.setFrameBuffer(pixels.buffer);
        second.writeTiles(0, 1, 0, 1);
    }
    std::string bytes = stream.str();
    // Patched by hand, since the library writes no such file: the right end of the second window.
    const std::size_t window = bytes.rfind("displayWindow") + sizeof "displayWindow" + sizeof "box2i" + 4;
    if (!alike) bytes[window + 8] = 30;
    return bytes;
}

std::string luminanceChroma() {
    Imf::StdOSStream stream;
    {
        const std::vector<Imf::Rgba> pixels(side * side, Imf::Rgba(0.5f, 0.25f, 0.125f));
        Imf::RgbaOutputFile file(stream, Imf::Header(side, side), Imf::WRITE_YC);
        file.setFrameBuffer(pixels.data(), 1, side);
        file.writePixels(side);
    }
    return stream.str();
}

}  // namespace

void writeExrSeeds(const fs::path& out) {
    writeCompressionSeeds(out);
    Imf::Header crop = header(Imf::ZIP_COMPRESSION), inside = crop;
    crop.displayWindow() = Imath::Box2i(Imath::V2i(-3, 5), Imath::V2i(30, 12));
    inside.displayWindow() = Imath::Box2i(Imath::V2i(-3, -5), Imath::V2i(30, 22));
    const Pixels pixels;
    writeSeed(out, "exr", "crop.exr", lines(crop, pixels.buffer));
    writeSeed(out, "exr", "inside.exr", lines(inside, pixels.buffer));
    writeSeed(out, "exr", "parts.exr", parts(true));
    writeSeed(out, "exr", "parts-of-two-windows.exr", parts(false));
    writeSeed(out, "exr", "luminance-chroma.exr", luminanceChroma());
}

}  // namespace diptych::fuzz
