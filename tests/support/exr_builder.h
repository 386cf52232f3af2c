// SPDX-License-Identifier: MIT
// Multi-part EXR files written by OpenEXR, with known values per part, channel and pixel.
#pragma once

#include "tests/support/files.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfTiledOutputPart.h>

#include <cstdint>
#include <list>
#include <string>
#include <utility>
#include <vector>

#include <half.h>

namespace diptych {

inline Imath::Box2i box(int left, int top, int right, int bottom) {
    return {Imath::V2i(left, top), Imath::V2i(right, bottom)};
}

// Value of channel `c` of a part at a pixel of the data window, in a mip level: an integer that half
// represents exactly.
inline int valueAt(int part, int c, int x, int y, int level = 0) {
    return 100 * part + 40 * c + 5 * (y & 7) + (x & 3) + 1000 * level;
}

struct MadePart {
    std::string name;
    std::vector<std::pair<std::string, Imf::PixelType>> channels;
    Imath::Box2i data = box(0, 0, 8, 5), display = box(0, 0, 8, 5);
    Imf::Compression compression = Imf::ZIP_COMPRESSION;
    int tile = 0;  // tile edge, pixels; 0: scan lines
    Imf::LevelMode levels = Imf::ONE_LEVEL;
    bool deep = false;  // declared only, without pixels
};

inline Imf::Header headerOf(const MadePart& part) {
    Imf::Header head(part.display, part.data, 1, Imath::V2f(0, 0), 1, Imf::INCREASING_Y, part.compression);
    head.setName(part.name);
    head.setType(part.deep ? Imf::DEEPSCANLINE : part.tile > 0 ? Imf::TILEDIMAGE : Imf::SCANLINEIMAGE);
    if (part.tile > 0) {
        const auto side = static_cast<unsigned>(part.tile);
        head.setTileDescription(Imf::TileDescription(side, side, part.levels));
    }
    for (const auto& [name, type] : part.channels) head.channels().insert(name, Imf::Channel(type));
    return head;
}

// Pixels of one level; must live until they are written.
class MadePixels {
public:
    MadePixels(const MadePart& part, int number, const Imath::Box2i& window, int level) {
        const int width = window.size().x + 1, height = window.size().y + 1;
        for (int c = 0; c < static_cast<int>(part.channels.size()); ++c) {
            const auto& [name, type] = part.channels[static_cast<std::size_t>(c)];
            const std::size_t size = type == Imf::HALF ? 2 : 4;
            std::string& bytes = bytes_.emplace_back();
            for (int i = 0; i < width * height; ++i)
                append(bytes, type,
                       valueAt(number, c, window.min.x + i % width, window.min.y + i / width, level));
            buffer.insert(name, Imf::Slice::Make(type, bytes.data(), window, size));
        }
    }
    Imf::FrameBuffer buffer;

private:
    static void append(std::string& bytes, Imf::PixelType type, int value) {
        const half h(static_cast<float>(value));
        const auto f = static_cast<float>(value);
        const auto u = static_cast<std::uint32_t>(value);
        const void* from = type == Imf::HALF    ? static_cast<const void*>(&h)
                           : type == Imf::FLOAT ? &f
                                                : static_cast<const void*>(&u);
        bytes.append(static_cast<const char*>(from), type == Imf::HALF ? 2 : 4);
    }
    std::list<std::string> bytes_;
};

inline void writePart(Imf::MultiPartOutputFile& file, const MadePart& part, int number) {
    if (part.deep) return;
    if (part.tile == 0) {
        Imf::OutputPart out(file, number);
        const MadePixels pixels(part, number, part.data, 0);
        out.setFrameBuffer(pixels.buffer);
        return out.writePixels(part.data.size().y + 1);
    }
    Imf::TiledOutputPart out(file, number);
    for (int y = 0; y < out.numYLevels(); ++y)
        for (int x = 0; x < out.numXLevels(); ++x) {
            if (!out.isValidLevel(x, y)) continue;
            const MadePixels pixels(part, number, out.dataWindowForLevel(x, y), x + y);
            out.setFrameBuffer(pixels.buffer);
            out.writeTiles(0, out.numXTiles(x) - 1, 0, out.numYTiles(y) - 1, x, y);
        }
}

// Returns the file's bytes; `change` may modify the headers.
template <class Change>
std::string exrOf(const std::vector<MadePart>& parts, const Change& change) {
    std::vector<Imf::Header> heads;
    for (const MadePart& part : parts) heads.push_back(headerOf(part));
    change(heads);
    const std::filesystem::path path = folder() / "made.exr";
    {
        Imf::MultiPartOutputFile file(path.c_str(), heads.data(), static_cast<int>(heads.size()));
        for (int i = 0; i < static_cast<int>(parts.size()); ++i)
            writePart(file, parts[static_cast<std::size_t>(i)], i);
    }
    return contentsOf(path);
}
inline std::string exrOf(const std::vector<MadePart>& parts) {
    return exrOf(parts, [](std::vector<Imf::Header>&) {});
}

}  // namespace diptych
