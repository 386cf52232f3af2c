// SPDX-License-Identifier: MIT
// EXR files of other programs: every compression, tiles, crops, integers; and files with wrong headers.
#include "shared/image/exr.h"
#include "shared/image/exr_header.h"
#include "tests/support/errors.h"
#include "tests/support/files.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringVectorAttribute.h>
#include <OpenEXR/ImfTiledOutputFile.h>
#include <gtest/gtest.h>

#include <half.h>

#include <cstring>
#include <stdexcept>
#include <string>

namespace diptych {
namespace {

using namespace std::string_literals;

std::span<const std::byte> bytesIn(const std::string& file) {
    return std::as_bytes(std::span(file));
}
std::string exrFault(const std::string& file, std::uint64_t max = limits::imageBytes()) {
    return faultOf([&] { readExr(bytesIn(file), "a.exr", max); });
}

// Pixels of channels i (half), j (float), k (uint): 0.5, 0.25 and 3, from the window's top left.
struct Pixels {
    explicit Pixels(const Imath::Box2i& window)
        : a(area(window), half(0.5f)), b(area(window), 0.25f), c(area(window), 3u) {
        buffer.insert("i", Imf::Slice::Make(Imf::HALF, a.data(), window));
        buffer.insert("j", Imf::Slice::Make(Imf::FLOAT, b.data(), window));
        buffer.insert("k", Imf::Slice::Make(Imf::UINT, c.data(), window));
    }
    static std::size_t area(const Imath::Box2i& window) {
        return static_cast<std::size_t>((window.size().x + 1) * (window.size().y + 1));
    }
    std::vector<half> a;
    std::vector<float> b;
    std::vector<unsigned> c;
    Imf::FrameBuffer buffer;
};

Imf::Header header(const Imath::Box2i& display, const Imath::Box2i& data, Imf::Compression compression) {
    Imf::Header result(display, data, 1, Imath::V2f(0, 0), 1, Imf::INCREASING_Y, compression);
    result.channels().insert("i", Imf::Channel(Imf::HALF));
    result.channels().insert("j", Imf::Channel(Imf::FLOAT));
    result.channels().insert("k", Imf::Channel(Imf::UINT));
    return result;
}

const Imath::Box2i wholeWindow(Imath::V2i(0, 0), Imath::V2i(69, 299));

std::string written(const Imf::Header& head) {
    const std::filesystem::path file = folder() / "a.exr";
    const Pixels pixels(head.dataWindow());
    if (head.hasTileDescription()) {
        Imf::TiledOutputFile out(file.c_str(), head);
        out.setFrameBuffer(pixels.buffer);
        for (int level = 0; level < out.numLevels(); ++level) {
            const Pixels smaller(out.dataWindowForLevel(level));
            out.setFrameBuffer(smaller.buffer);
            out.writeTiles(0, out.numXTiles(level) - 1, 0, out.numYTiles(level) - 1, level);
        }
    } else {
        Imf::OutputFile out(file.c_str(), head);
        out.setFrameBuffer(pixels.buffer);
        out.writePixels(head.dataWindow().size().y + 1);
    }
    return contentsOf(file);
}

void expectFull(const Image& image, int width, int height) {
    ASSERT_EQ(image.width, width);
    ASSERT_EQ(image.height, height);
    ASSERT_EQ(image.components, 3);
    for (std::size_t i = 0; i < image.pixels(); ++i) {
        ASSERT_EQ(image.pixel(i)[0], 0.5f) << i;
        ASSERT_EQ(image.pixel(i)[1], 0.25f) << i;
        ASSERT_EQ(image.pixel(i)[2], 3.0f) << i;
    }
}

// Constant pixels reach the highest compression ratios, and are exact even with lossy compressors.
TEST(ExrOfOthers, EveryCompressorInLinesAndTiles) {
    for (int compression = 0; compression < Imf::NUM_COMPRESSION_METHODS; ++compression)
        for (const int tile : {0, 16, 200}) {
            Imf::Header head = header(wholeWindow, wholeWindow, static_cast<Imf::Compression>(compression));
            if (tile > 0)
                head.setTileDescription(
                    Imf::TileDescription(64, 32 + static_cast<unsigned>(tile), Imf::MIPMAP_LEVELS));
            SCOPED_TRACE(testing::Message() << "compression " << compression << ", tiles of " << tile);
            const std::string file = written(head);
            const std::vector<ImageLayer> layers = readExr(bytesIn(file), "a.exr").layers;
            ASSERT_EQ(layers.size(), 1u);
            expectFull(layers[0].image, 70, 300);
        }
}

TEST(ExrOfOthers, ACropStandsWhereItBelongs) {
    // The data window is (-1, 2) to (2, 4), the display window (1, 1) to (4, 3): columns 1 to 2 and rows 2
    // to 3 overlap.
    const Imath::Box2i display(Imath::V2i(1, 1), Imath::V2i(4, 3)), data(Imath::V2i(-1, 2), Imath::V2i(2, 4));
    const std::string file = written(header(display, data, Imf::ZIP_COMPRESSION));
    const Image image = readExr(bytesIn(file), "a.exr").layers[0].image;
    ASSERT_EQ(image.width, 4);
    ASSERT_EQ(image.height, 3);
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 4; ++x) EXPECT_EQ(image.at(x, y, 2), x < 2 && y > 0 ? 3 : 0) << x << ", " << y;

    const Imath::Box2i aside(Imath::V2i(500000, -7), Imath::V2i(500001, -6));
    const std::string far = written(header(display, aside, Imf::ZIP_COMPRESSION));
    const std::vector<ImageLayer> unseen = readExr(bytesIn(far), "a.exr").layers;
    for (const float value : unseen[0].image.data) EXPECT_EQ(value, 0);
}

// float32 represents all integers up to 2^24, and only some of the larger ones.
TEST(ExrOfOthers, NumbersThatFloat32WouldRoundAreKept) {
    const Imath::Box2i window(Imath::V2i(0, 0), Imath::V2i(2, 0));
    const auto fileOf = [&](const std::vector<unsigned>& ids) {
        Imf::Header head(window, window);
        head.channels().insert("id", Imf::Channel(Imf::UINT));
        head.channels().insert("Z", Imf::Channel(Imf::FLOAT));
        Imf::FrameBuffer buffer;
        const std::vector<float> depths{1, 2, 3};
        buffer.insert("id", Imf::Slice::Make(Imf::UINT, ids.data(), window));
        buffer.insert("Z", Imf::Slice::Make(Imf::FLOAT, depths.data(), window));
        const std::filesystem::path path = folder() / "a.exr";
        {
            Imf::OutputFile out(path.c_str(), head);
            out.setFrameBuffer(buffer);
            out.writePixels(1);
        }
        return readExr(path).layers.at(0);
    };
    const ImageLayer small = fileOf({0, 16777216, 0x80000000}), large = fileOf({7, 16777217, 4294967295});
    ASSERT_EQ(large.channels, (std::vector<std::string>{"Z", "id"}));
    EXPECT_EQ(large.sample, "mixed");
    EXPECT_TRUE(small.exact.empty()) << "nothing is rounded";
    EXPECT_EQ(small.image.data, (diptych::PixelData{1, 0, 2, 16777216, 3, 2147483648}));
    ASSERT_EQ(large.exact.size(), 2u);
    EXPECT_TRUE(large.exact[0].empty());
    EXPECT_EQ(large.exact[1], (std::vector<std::uint32_t>{7, 16777217, 4294967295}));
    EXPECT_EQ(large.image.pixel(1)[1], small.image.pixel(1)[1]) << "float32 cannot tell them apart";
    EXPECT_NE(large.value(1, 1), small.value(1, 1)) << "the file can";
    EXPECT_EQ(large.value(2, 1), 4294967295.0);
    EXPECT_EQ(large.value(2, 0), 3.0);
}

TEST(ExrOfOthers, ComponentsStandInTheirOrderHoweverTheyAreSpelled) {
    const Imath::Box2i window(Imath::V2i(0, 0), Imath::V2i(0, 0));
    Imf::Header head(window, window);
    const std::vector<float> zero{0};
    Imf::FrameBuffer buffer;
    for (const char* name : {"A", "B", "G", "R", "Z", "c.blue", "c.green", "c.red", "n.x", "n.y", "n.z",
                             "t.V", "t.U", "t.weight", "m.depth.Z"}) {
        head.channels().insert(name, Imf::Channel(Imf::FLOAT));
        buffer.insert(name, Imf::Slice::Make(Imf::FLOAT, zero.data(), window));
    }
    const std::filesystem::path path = folder() / "a.exr";
    {
        Imf::OutputFile out(path.c_str(), head);
        out.setFrameBuffer(buffer);
        out.writePixels(1);
    }
    std::vector<std::string> names;
    for (const ImageLayer& layer : readExr(path).layers) {
        names.push_back(layer.name + ":");
        names.insert(names.end(), layer.channels.begin(), layer.channels.end());
    }
    EXPECT_EQ(names,
              (std::vector<std::string>{
                  ":",        "R",         "G",  "B",   "A",   "Z",   "c:", "c.red", "c.green", "c.blue",
                  "m.depth:", "m.depth.Z", "n:", "n.x", "n.y", "n.z", "t:", "t.U",   "t.V",     "t.weight"}));
}

// The library gets only the attributes that pixels need; none of them contains lengths of its own.
TEST(ExrOfOthers, OtherAttributesAreLeftOutOfTheHeader) {
    Imf::Header head = header(wholeWindow, wholeWindow, Imf::ZIP_COMPRESSION);
    head.insert("layers", Imf::StringVectorAttribute({"one", "two"}));
    std::string file = written(head);
    const std::size_t lengths = file.find("stringvector") + std::strlen("stringvector") + 1 + 4;
    file.replace(lengths, 4, "\xff\xff\xff\x7f");  // "one" is 2 GiB long
    EXPECT_EQ(exrFault(file), "");
    const ExrHeader read = readExrHeader(bytesIn(file), limits::imageBytes());
    const std::string kept(reinterpret_cast<const char*>(read.bytes.data()), read.bytes.size());
    EXPECT_EQ(kept.find("stringvector"), std::string::npos);
    EXPECT_NE(kept.find("dataWindow"), std::string::npos);
    EXPECT_EQ(kept.size(),
              lengths + 4 + 3 + 4 + 3 + (file.size() - lengths > 0 ? kept.size() - lengths - 14 : 0))
        << "pixels stay where the offsets say";
}

// A small file written by diptych, with type, size and 32-bit number after `attribute` replaced.
std::string with(std::string file, const std::string& attribute, const std::string& type, std::size_t index,
                 std::int32_t value) {
    const std::size_t at = file.find(attribute + '\0' + type + '\0');
    EXPECT_NE(at, std::string::npos);
    std::memcpy(file.data() + at + attribute.size() + type.size() + 2 + 4 + 4 * index, &value, 4);
    return file;
}

TEST(ExrOfOthers, FaultsAreNamed) {
    const std::string file = written(header(wholeWindow, wholeWindow, Imf::ZIP_COMPRESSION));
    const std::string size = std::to_string(file.size());
    EXPECT_EQ(exrFault(file), "");
    EXPECT_EQ(exrFault(""), "a.exr: is not an EXR file");
    EXPECT_EQ(exrFault(file.substr(0, 50)),
              "a.exr: attribute channels: claims 55 bytes, but the file has only 22 left");
    EXPECT_EQ(exrFault(file.substr(0, file.find("dataWindow") + 4)),
              "a.exr: its header holds a name without an end");
    EXPECT_EQ(exrFault(file.substr(0, file.find("box2i") + 7)), "a.exr: its header is cut short");
    EXPECT_EQ(exrFault(with(file, "dataWindow", "box2i", 3, 1 << 20)),
              "a.exr: claims 70 x 1048577 pixels, too many for its " + size + " bytes");
    EXPECT_EQ(exrFault(with(file, "dataWindow", "box2i", 2, 1 << 20)),
              "a.exr: claims 1048577 x 300 pixels; each side must be 1 to 65536");
    EXPECT_EQ(exrFault(with(file, "dataWindow", "box2i", 2, 65535)),
              "a.exr: claims 65536 x 300 pixels, too many for its " + size + " bytes");
    EXPECT_EQ(exrFault(with(file, "dataWindow", "box2i", 2, 0x7fffffff)),
              "a.exr: attribute dataWindow: coordinate 2147483647 is out of range");
    EXPECT_EQ(exrFault(with(file, "dataWindow", "box2i", 2, -5)), "a.exr: has no pixels");
    EXPECT_EQ(
        exrFault(with(with(file, "displayWindow", "box2i", 2, 65535), "displayWindow", "box2i", 3, 65535)),
        "a.exr: claims 65536 x 65536 pixels of 16 bytes; the limit is 1024 MiB")
        << "zeros around a crop";
    EXPECT_EQ(exrFault(file, 70 * 300 * 16 - 1),
              "a.exr: claims 70 x 300 pixels of 16 bytes; the limit is 0 MiB");

    std::string longer = file;
    longer.replace(longer.find("dataWindow") + 10 + 1 + 6, 4, "\x0f\x00\x00\x00"s);
    EXPECT_EQ(exrFault(longer),
              "a.exr: attribute dataWindow: is a box2i of 15 bytes instead of a valid box2i");
    longer.replace(longer.find("dataWindow") + 10 + 1 + 6, 4, "\xff\xff\xff\x7f"s);
    EXPECT_NE(exrFault(longer).find("a.exr: attribute dataWindow: claims 2147483647 bytes"),
              std::string::npos);
    std::string deep = file;
    deep[5] = '\x08';
    EXPECT_EQ(exrFault(deep), "a.exr: holds deep samples, which are not supported");
    std::string none = file;
    none.replace(none.find("compression\0compression"s), 4, "Comp");
    EXPECT_EQ(exrFault(none), "a.exr: has no attribute compression");

    Imf::Header half = header(wholeWindow, wholeWindow, Imf::ZIP_COMPRESSION);
    std::string sampled = file;
    const std::size_t channel = sampled.find("chlist\0"s) + 7 + 4;  // "i", type, four bytes, x and y sampling
    sampled[channel + 2 + 4 + 4] = 2;
    EXPECT_EQ(exrFault(sampled), "a.exr: channel i is subsampled, which is not supported");
    sampled[channel] = '\n';
    EXPECT_EQ(exrFault(sampled), "a.exr: channel ?: has a line break in its name");
}

TEST(ExrOfOthers, TilesBeyondTheImageAreRefused) {
    Imf::Header head = header(wholeWindow, wholeWindow, Imf::ZIP_COMPRESSION);
    head.setTileDescription(Imf::TileDescription(64, 64));
    const std::string file = written(head);
    EXPECT_EQ(exrFault(with(file, "tiles", "tiledesc", 1, 65536)),
              "a.exr: tiles of 64 x 65536 pixels are larger than the image of 70 x 300");
    EXPECT_EQ(exrFault(with(file, "tiles", "tiledesc", 0, 0)),
              "a.exr: tiles of 0 x 64 pixels: each side must be 1 to 65536");
    EXPECT_EQ(exrFault(with(file, "tiles", "tiledesc", 0, -1)),
              "a.exr: tiles of 4294967295 x 64 pixels: each side must be 1 to 65536");
}

}  // namespace
}  // namespace diptych
