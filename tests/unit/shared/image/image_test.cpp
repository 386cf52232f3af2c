// SPDX-License-Identifier: MIT
// Image files: written values are read back, and no incomplete file ever has the final name.
#include "shared/image/atomic_file.h"
#include "shared/image/exr.h"
#include "shared/image/image_file.h"
#include "shared/image/png.h"
#include "tests/support/errors.h"
#include "tests/support/files.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>

namespace diptych {
namespace {

namespace fs = std::filesystem;

bool sameBits(const Image& a, const Image& b) {
    return a.width == b.width && a.height == b.height && a.components == b.components &&
           std::ranges::equal(a.data, b.data, {}, std::bit_cast<std::uint32_t, float>,
                              std::bit_cast<std::uint32_t, float>);
}

Image pattern(int width, int height, int components) {
    Image image(width, height, components);
    for (std::size_t i = 0; i < image.data.size(); ++i) image.data[i] = 0.37f * static_cast<float>(i) - 5;
    return image;
}

TEST(Exr, EveryBitComesBackByLayerAndName) {
    const fs::path file = folder() / "a.exr";
    Image lit = pattern(7, 5, 3), depth = pattern(7, 5, 1), normals = pattern(7, 5, 3);
    lit.data[0] = std::numeric_limits<float>::infinity();
    lit.data[1] = std::numeric_limits<float>::quiet_NaN();
    lit.data[2] = -0.0f;
    lit.data[3] = std::numeric_limits<float>::denorm_min();
    writeExr(file,
             {{{"R", "G", "B"}, &lit}, {{"Z"}, &depth}, {{"normals.X", "normals.Y", "normals.Z"}, &normals}},
             {{"scene", "builtin:none"}});

    const std::vector<ImageLayer> layers = readExr(file).layers;
    ASSERT_EQ(layers.size(), 2u);
    EXPECT_EQ(layers[0].name, "");
    EXPECT_EQ(layers[0].channels, (std::vector<std::string>{"R", "G", "B", "Z"}));
    EXPECT_EQ(layers[1].channels, (std::vector<std::string>{"normals.X", "normals.Y", "normals.Z"}));
    EXPECT_TRUE(sameBits(layers[1].image, normals));
    for (int y = 0; y < 5; ++y)
        for (int x = 0; x < 7; ++x) {
            for (int c = 0; c < 3; ++c)
                EXPECT_EQ(std::bit_cast<std::uint32_t>(layers[0].image.at(x, y, c)),
                          std::bit_cast<std::uint32_t>(lit.at(x, y, c)));
            EXPECT_EQ(layers[0].image.at(x, y, 3), depth.at(x, y));
        }
    EXPECT_NE(contentsOf(file).find("builtin:none"), std::string::npos)
        << "the attribute stands in the header";
    EXPECT_EQ(namesIn(file.parent_path()), std::vector<std::string>{"a.exr"});
}

TEST(Exr, LayersMustAgree) {
    const fs::path file = folder() / "a.exr";
    const Image a = pattern(4, 4, 1), b = pattern(4, 5, 1);
    EXPECT_NE(faultOf([&] {
                  writeExr(file, {{{"a.Y"}, &a}, {{"b.Y"}, &b}});
              }).find("a.exr"),
              std::string::npos);
    EXPECT_NE(faultOf([&] {
                  writeExr(file, {{{"a.Y"}, &a}, {{"a.Y"}, &a}});
              }).find("a.Y"),
              std::string::npos);
    EXPECT_NE(faultOf([&] { writeExr(file, {}); }).find("layer"), std::string::npos);
    EXPECT_TRUE(namesIn(file.parent_path()).empty());
}

TEST(Exr, BrokenFilesAreNamed) {
    const fs::path file = folder() / "a.exr";
    const Image image = pattern(64, 64, 3);
    writeExr(file, {{{"R", "G", "B"}, &image}});
    const std::string whole = contentsOf(file);
    // A header that claims 2^20 x 2^20 pixels is refused before memory is allocated.
    std::string huge = whole;
    for (const char* window : {"dataWindow", "displayWindow"}) {
        const std::size_t box = huge.find(window) + std::string(window).size() + 1 + sizeof "box2i" + 4;
        for (const std::size_t corner : {box + 8, box + 12})
            huge.replace(corner, 4, std::string("\xff\xff\x0f\x00", 4));
    }
    writeFile(file, huge);
    EXPECT_NE(faultOf([&] { readExr(file); }).find("a.exr"), std::string::npos);
    EXPECT_NE(faultOf([&] { readExr(file.parent_path() / "none.exr"); }).find("none.exr"), std::string::npos);
}

Image8 colors(int width, int height, int components) {
    Image8 image{width, height, components, {}};
    for (int i = 0; i < width * height * components; ++i)
        image.data.push_back(static_cast<std::uint8_t>(i * 37));
    return image;
}

TEST(Png, EveryByteComesBackAsRgba) {
    const fs::path file = folder() / "a.png";
    for (const int components : {3, 4}) {
        const Image8 image = colors(9, 6, components);
        writePng(file, image);
        const Image8 back = readPng(file);
        ASSERT_EQ(back.width, 9);
        ASSERT_EQ(back.height, 6);
        ASSERT_EQ(back.components, 4);
        for (std::size_t i = 0; i < 9 * 6; ++i)
            for (std::size_t c = 0; c < 4; ++c)
                EXPECT_EQ(back.data[4 * i + c], c < static_cast<std::size_t>(components)
                                                    ? image.data[i * static_cast<std::size_t>(components) + c]
                                                    : 255);
    }
    EXPECT_NE(contentsOf(file).substr(0, 200).find("diptych"), std::string::npos)
        << "its own files are known by this";
    EXPECT_EQ(namesIn(file.parent_path()), std::vector<std::string>{"a.png"});
}

// Up to 256 colours take one byte per pixel before compression; one colour more takes three.
TEST(Png, FewColoursAreAPalette) {
    const fs::path file = folder() / "a.png";
    for (const int count : {1, 2, 256, 257}) {
        Image8 image{100, 60, 3, {}};
        for (int i = 0; i < 100 * 60; ++i)
            for (const int byte : {(i * 7 % count) % 251, (i * 7 % count) / 251, 9})
                image.data.push_back(static_cast<std::uint8_t>(byte));
        writePng(file, image);
        const std::string bytes = contentsOf(file);
        EXPECT_EQ(bytes[25], count <= 256 ? 3 : 2) << "the colour type of the header, of " << count;
        EXPECT_EQ(pngBytes(image), bytes);
        const Image8 back = readPng(file);
        for (std::size_t i = 0; i < 100 * 60; ++i)
            for (std::size_t c = 0; c < 3; ++c) ASSERT_EQ(back.data[4 * i + c], image.data[3 * i + c]) << i;
        EXPECT_EQ(readImage(file).layers[0].image.components, 3) << "read as any other picture of colours";
    }
}

TEST(Png, BrokenFilesAreNamed) {
    const fs::path file = folder() / "a.png";
    writePng(file, colors(64, 64, 3));
    const std::string whole = contentsOf(file);
    for (const std::size_t size : {std::size_t{0}, std::size_t{20}, whole.size() / 2}) {
        writeFile(file, whole.substr(0, size));
        EXPECT_NE(faultOf([&] { readPng(file); }).find("a.png"), std::string::npos) << size << " bytes";
    }
    EXPECT_NE(faultOf([&] { writePng(file, {3, 3, 3, {1, 2}}); }).find("a.png"), std::string::npos);
    EXPECT_NE(faultOf([&] { writePng(file, colors(2, 2, 1)); }).find("a.png"), std::string::npos);
}

// Only the header, with another size and a matching checksum.
std::string claiming(std::string png, std::uint32_t width, std::uint32_t height) {
    constexpr std::size_t chunk = 12, sum = 29;  // "IHDR" and 13 bytes, then their checksum
    const auto put = [&](std::size_t at, std::uint32_t value) {
        for (std::size_t i = 0; i < 4; ++i) png[at + i] = static_cast<char>(value >> (24 - 8 * i));
    };
    put(chunk + 4, width);
    put(chunk + 8, height);
    put(sum, static_cast<std::uint32_t>(
                 ::crc32(0, reinterpret_cast<const unsigned char*>(png.data()) + chunk, sum - chunk)));
    return png;
}

TEST(Png, ClaimsAreCheckedBeforeMemoryIsTaken) {
    const fs::path file = folder() / "a.png";
    writePng(file, colors(64, 64, 3));
    const std::string whole = contentsOf(file), size = std::to_string(whole.size());
    const auto fault = [&](std::uint32_t width, std::uint32_t height,
                           std::uint64_t max = limits::imageBytes()) {
        const std::string png = claiming(whole, width, height);
        return faultOf([&] { readPng(std::as_bytes(std::span(png)), "a.png", max); });
    };
    EXPECT_EQ(fault(64, 64), "");
    EXPECT_EQ(fault(64, 64, 64 * 64 * 12 - 1),
              "a.png: claims 64 x 64 pixels of 12 bytes; the limit is 0 MiB");
    EXPECT_EQ(fault(20000, 20000), "a.png: claims 20000 x 20000 pixels, too many for its " + size + " bytes");
    EXPECT_EQ(fault(70000, 1), "a.png: claims 70000 x 1 pixels; each side must be 1 to 65536");
    EXPECT_EQ(readPng(std::as_bytes(std::span(whole)), "a.png").data, readPng(file).data);
}

TEST(AtomicFile, WithoutACommitNothingIsLeftAndTheOldStays) {
    const fs::path file = folder() / "a.txt";
    writeFile(file, "old");
    {
        AtomicFile out(file);
        std::fputs("half of the n", out.stream());
        EXPECT_EQ(contentsOf(file), "old");
        EXPECT_EQ(namesIn(file.parent_path()).size(), 2u) << "written beside";
    }
    EXPECT_EQ(contentsOf(file), "old");
    EXPECT_EQ(namesIn(file.parent_path()), std::vector<std::string>{"a.txt"});
    writeFile(file, "new");
    EXPECT_EQ(contentsOf(file), "new");
}

TEST(AtomicFile, RefusesWhatIsNoFile) {
    const fs::path here = folder();
    EXPECT_NE(faultOf([&] { writeFile(here, "x"); }).find(here.string()), std::string::npos);
    EXPECT_NE(faultOf([&] { writeFile("/dev/null", "x"); }).find("/dev/null"), std::string::npos);
    EXPECT_NE(faultOf([&] { writeFile(here / "none" / "a", "x"); }).find("none/a"), std::string::npos);
    EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST(AtomicFile, ALinkIsReplacedAndNotFollowed) {
    const fs::path here = folder();
    writeFile(here / "real", "old");
    fs::create_symlink("real", here / "link");
    writeFile(here / "link", "new");
    EXPECT_FALSE(fs::is_symlink(here / "link"));
    EXPECT_EQ(contentsOf(here / "link"), "new");
    EXPECT_EQ(contentsOf(here / "real"), "old");
}

// A full disk: /dev/full accepts bytes and only fails when they are flushed.
TEST(AtomicFile, AFullDiskIsAnErrorAndLeavesTheOldFile) {
    if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
    const fs::path file = folder() / "a.txt";
    writeFile(file, "old");
    const std::string fault = faultOf([&] {
        AtomicFile out(file);
        ASSERT_NE(std::freopen("/dev/full", "wb", out.stream()), nullptr);
        std::fputs("new", out.stream());
        out.commit();
    });
    EXPECT_NE(fault.find("a.txt"), std::string::npos) << fault;
    EXPECT_NE(fault.find("space"), std::string::npos) << fault;
    EXPECT_EQ(contentsOf(file), "old");
}

// A disk that is full for one write in the middle of the file, and free again for all later ones.
TEST(AtomicFile, AWriteThatFailedIsRememberedUntilTheCommit) {
    if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
    const fs::path file = folder() / "a.txt";
    writeFile(file, "old");
    const std::string fault = faultOf([&] {
        AtomicFile out(file);
        std::setvbuf(out.stream(), nullptr, _IONBF, 0);
        const int descriptor = ::fileno(out.stream()), real = ::dup(descriptor),
                  full = ::open("/dev/full", O_WRONLY);
        ::dup2(full, descriptor);
        EXPECT_EQ(std::fputs("lost", out.stream()), EOF);
        ::dup2(real, descriptor);
        ::close(full);
        ::close(real);
        EXPECT_GE(std::fputs("kept", out.stream()), 0);
        out.commit();
    });
    EXPECT_NE(fault.find("a.txt: Input/output error; check the disk"), std::string::npos) << fault;
    EXPECT_EQ(contentsOf(file), "old");
    EXPECT_EQ(namesIn(file.parent_path()), std::vector<std::string>{"a.txt"});
}

}  // namespace
}  // namespace diptych
