// SPDX-License-Identifier: MIT
// Multi-part EXR files: names of layers, positions of pixels, and refused files with the reason.
#include "shared/image/exr.h"
#include "shared/image/image_file.h"
#include "tests/support/errors.h"
#include "tests/support/exr_builder.h"

#include <OpenEXR/ImfStringAttribute.h>
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

namespace diptych {
namespace {

using namespace std::string_literals;
using Names = std::vector<std::string>;

ImageFile partsOf(const std::string& file, std::string_view part = {},
                  std::uint64_t max = limits::imageBytes()) {
    return readExr(std::as_bytes(std::span(file)), "a.exr", max, part);
}
std::string partFault(const std::string& file, std::string_view part = {},
                      std::uint64_t max = limits::imageBytes()) {
    return faultOf([&] { partsOf(file, part, max); });
}

Names layerNames(const ImageFile& file) {
    Names names;
    for (const ImageLayer& layer : file.layers) names.push_back(layer.name);
    return names;
}

// Component i of the layer must equal the part's channel `made[i]`, and 0 outside its data window.
void expectMade(const ImageLayer& layer, int part, const std::vector<int>& made, const Imath::Box2i& data,
                const Imath::Box2i& display) {
    SCOPED_TRACE(layer.name);
    ASSERT_EQ(layer.image.width, display.size().x + 1);
    ASSERT_EQ(layer.image.height, display.size().y + 1);
    ASSERT_EQ(layer.image.components, static_cast<int>(made.size()));
    for (int y = 0; y < layer.image.height; ++y)
        for (int x = 0; x < layer.image.width; ++x)
            for (int c = 0; c < layer.image.components; ++c) {
                const Imath::V2i at(display.min.x + x, display.min.y + y);
                const int expected =
                    data.intersects(at) ? valueAt(part, made[static_cast<std::size_t>(c)], at.x, at.y) : 0;
                ASSERT_EQ(layer.image.at(x, y, c), static_cast<float>(expected))
                    << x << ", " << y << ", " << c;
            }
}

const MadePart colorPart{"beauty",
                         {{"A", Imf::HALF},
                          {"B", Imf::HALF},
                          {"G", Imf::HALF},
                          {"R", Imf::HALF},
                          {"albedo.blue", Imf::FLOAT},
                          {"albedo.green", Imf::FLOAT},
                          {"albedo.red", Imf::FLOAT}}};
const MadePart normalsPart{"normals",
                           {{"normals.X", Imf::FLOAT}, {"normals.Y", Imf::HALF}, {"normals.Z", Imf::FLOAT}}};
const MadePart idsPart{"ids", {{"material", Imf::UINT}, {"object", Imf::UINT}}};

TEST(ExrParts, EveryPartIsReadAndItsLayersAreNamedByBoth) {
    MadePart tiled = normalsPart;
    tiled.tile = 4;
    const ImageFile file = partsOf(exrOf({colorPart, tiled, idsPart}));
    EXPECT_EQ(file.format, "OpenEXR");
    EXPECT_EQ(file.width, 9);
    EXPECT_EQ(file.height, 6);
    EXPECT_FALSE(file.display_referred);
    EXPECT_TRUE(file.notes.lines.empty());
    ASSERT_EQ(layerNames(file), (Names{"beauty", "beauty.albedo", "normals", "ids"}));
    EXPECT_EQ(file.layers[0].channels, (Names{"beauty.R", "beauty.G", "beauty.B", "beauty.A"}));
    EXPECT_EQ(file.layers[1].channels,
              (Names{"beauty.albedo.red", "beauty.albedo.green", "beauty.albedo.blue"}));
    EXPECT_EQ(file.layers[2].channels, (Names{"normals.X", "normals.Y", "normals.Z"}));
    EXPECT_EQ(file.layers[3].channels, (Names{"ids.material", "ids.object"}));
    EXPECT_EQ(file.layers[0].sample, "half");
    EXPECT_EQ(file.layers[1].sample, "float");
    EXPECT_EQ(file.layers[2].sample, "mixed");
    EXPECT_EQ(file.layers[3].sample, "uint");
    const Imath::Box2i whole = box(0, 0, 8, 5);
    expectMade(file.layers[0], 0, {3, 2, 1, 0}, whole, whole);
    expectMade(file.layers[1], 0, {6, 5, 4}, whole, whole);
    expectMade(file.layers[2], 1, {0, 1, 2}, whole, whole);
    expectMade(file.layers[3], 2, {0, 1}, whole, whole);
}

TEST(ExrParts, EveryCompressionInLinesAndTilesOfSeveralParts) {
    // Integers below 2048 in half: exact with all compressions that are lossless for them.
    for (const Imf::Compression compression :
         {Imf::NO_COMPRESSION, Imf::RLE_COMPRESSION, Imf::ZIPS_COMPRESSION, Imf::ZIP_COMPRESSION,
          Imf::PIZ_COMPRESSION, Imf::PXR24_COMPRESSION})
        for (const int tile : {0, 4}) {
            SCOPED_TRACE(testing::Message() << "compression " << compression << ", tiles of " << tile);
            MadePart first = colorPart, second = idsPart;
            first.compression = second.compression = compression;
            first.tile = tile;
            first.data = second.data = first.display = second.display = box(0, 0, 20, 40);
            const ImageFile file = partsOf(exrOf({first, second}));
            ASSERT_EQ(file.layers.size(), 3u);
            expectMade(file.layers[0], 0, {3, 2, 1, 0}, first.data, first.data);
            expectMade(file.layers[2], 1, {0, 1}, first.data, first.data);
        }
}

TEST(ExrParts, LevelZeroOfMipAndRipMaps) {
    for (const Imf::LevelMode levels : {Imf::MIPMAP_LEVELS, Imf::RIPMAP_LEVELS}) {
        MadePart tiled = normalsPart;
        tiled.tile = 4;
        tiled.levels = levels;
        const ImageFile file = partsOf(exrOf({colorPart, tiled}));
        expectMade(file.layers[2], 1, {0, 1, 2}, tiled.data, tiled.data);
        EXPECT_EQ(file.notes.in_part,
                  Names{levels == Imf::MIPMAP_LEVELS
                            ? "part \"normals\": is mip-mapped; only its largest level is read"
                            : "part \"normals\": is rip-mapped; only its largest level is read"});
        EXPECT_EQ(partsOf(exrOf({tiled})).notes.in_part,
                  Names{levels == Imf::MIPMAP_LEVELS ? "is mip-mapped; only its largest level is read"
                                                     : "is rip-mapped; only its largest level is read"});
    }
}

// Data windows inside the display window, across its edge, around it, and outside.
TEST(ExrParts, DataWindowsOfTheirOwn) {
    const Imath::Box2i display = box(-3, -2, 6, 5);
    for (const Imath::Box2i& data :
         {box(-1, 0, 2, 3), box(-7, -9, -2, 1), box(-5, -4, 9, 8), box(40, 40, 44, 44), display}) {
        MadePart first = colorPart, second = idsPart;
        first.display = second.display = display;
        first.data = data;
        second.data = box(0, 0, 1, 1);
        const ImageFile file = partsOf(exrOf({first, second}));
        ASSERT_EQ(file.layers.size(), 3u);
        expectMade(file.layers[0], 0, {3, 2, 1, 0}, data, display);
        // The reader cuts pixels outside the display window; --strict refuses that.
        const auto said = [](const char* part, const Imath::Box2i& is) {
            return "part \"" + std::string(part) + "\": its data window is " +
                   std::to_string(is.size().x + 1) + "x" + std::to_string(is.size().y + 1) + " at " +
                   std::to_string(is.min.x) + "," + std::to_string(is.min.y) +
                   ", its display window 10x8 at -3,-2; missing pixels are 0";
        };
        const bool inside = data == display || data == box(-1, 0, 2, 3);
        Names lines{said("ids", second.data)}, in_part;
        if (data != display)
            (inside ? lines : in_part).insert((inside ? lines : in_part).begin(), said("beauty", data));
        EXPECT_EQ(file.notes.lines, lines);
        EXPECT_EQ(file.notes.in_part, in_part);
        expectMade(file.layers[2], 1, {0, 1}, second.data, display);
    }
}

TEST(ExrParts, OneAskedForIsAsTheOnlyOne) {
    MadePart deep = idsPart;
    deep.deep = true;
    deep.compression = Imf::ZIPS_COMPRESSION;
    const std::string file = exrOf({colorPart, normalsPart, deep});
    EXPECT_EQ(partFault(file), "a.exr: part \"ids\": holds deep samples, which are not supported");
    const ImageFile asked = partsOf(file, "beauty");
    EXPECT_EQ(layerNames(asked), (Names{"", "albedo"}));
    EXPECT_EQ(asked.layers[0].channels, (Names{"R", "G", "B", "A"}));
    expectMade(asked.layers[0], 0, {3, 2, 1, 0}, colorPart.data, colorPart.data);
    expectMade(partsOf(file, "normals").layers[0], 1, {0, 1, 2}, colorPart.data, colorPart.data);
    EXPECT_EQ(partFault(file, "fog"), "a.exr: has no part \"fog\"");
    EXPECT_EQ(partFault(file, "ids"), "a.exr: part \"ids\": holds deep samples, which are not supported");
}

// Changes the right end of the last part's display window; OpenEXR writes the same for all parts.
std::string withLastDisplay(std::string file, std::int32_t right) {
    const std::size_t at = file.rfind("displayWindow\0box2i\0"s) + 14 + 6 + 4 + 8;
    std::memcpy(file.data() + at, &right, 4);
    return file;
}

TEST(ExrParts, APartIsNamedBehindTheFile) {
    const std::string file = withLastDisplay(exrOf({colorPart, normalsPart}), 11);
    const std::filesystem::path path = testFolder() / "a.exr";
    std::ofstream(path, std::ios::binary) << file;
    EXPECT_EQ(readImage(path.string() + "?part=beauty").width, 9);
    EXPECT_EQ(readImage(path.string() + "?part=1").width, 12);
    EXPECT_EQ(faultOf([&] { readImage(path.string() + "?part=fog"); }),
              path.string() + "?part=fog: has no part \"fog\"");
    // A file with this exact name is read as a whole.
    std::ofstream(path.string() + "?part=x", std::ios::binary) << file;
    EXPECT_EQ(imageName(path.string() + "?part=x").part, "");
}

TEST(ExrParts, DifferentDisplayWindowsOneAtATime) {
    const std::string file = withLastDisplay(exrOf({colorPart, normalsPart}), 11);
    EXPECT_EQ(partFault(file),
              "a.exr: part \"normals\": its display window is 12 x 6 at 0, 0, but 9 x 6 at 0, 0 in the parts "
              "before it; read one part, for example FILE.exr?part=1");
    EXPECT_EQ(partsOf(file, "1").width, 12);
    EXPECT_EQ(partsOf(file, "beauty").width, 9);
    const ImageFile wide = partsOf(file, "normals");
    EXPECT_EQ(wide.width, 12);
    expectMade(wide.layers[0], 1, {0, 1, 2}, normalsPart.data, box(0, 0, 11, 5));
}

TEST(ExrParts, StringsAreKeptTheFirstPartsFirst) {
    const ImageFile file = partsOf(exrOf({colorPart, normalsPart}, [](std::vector<Imf::Header>& heads) {
        heads[0].insert("software", Imf::StringAttribute("one"));
        heads[1].insert("software", Imf::StringAttribute("two"));
        heads[1].insert("view", Imf::StringAttribute("left\neye"));
    }));
    EXPECT_EQ(file.attributes,
              (std::map<std::string, std::string>{{"software", "one"}, {"view", "left\neye"}}));
}

TEST(ExrParts, TwoSpellingsOfOneChannelAreRefused) {
    const MadePart a{"a", {{"b.R", Imf::HALF}}}, ab{"a.b", {{"R", Imf::HALF}}};
    EXPECT_EQ(partFault(exrOf({a, ab})), "a.exr: channel a.b.R: appears in two parts");
}

TEST(ExrParts, ClaimsCountTogether) {
    std::vector<MadePart> parts{colorPart, normalsPart, idsPart};
    for (MadePart& part : parts) part.compression = Imf::NO_COMPRESSION;  // else 16 lines are decoded at once
    const std::string file = exrOf(parts);
    // 54 pixels of 7 floats, of 3, and of 2 with their 2 uint32: 1512, 648 and 864 bytes.
    EXPECT_EQ(partFault(file, {}, 1512 + 648 + 864), "");
    EXPECT_EQ(partFault(file, {}, 1512 + 648 + 863),
              "a.exr: part \"ids\": this part and the parts before it claim 0 MiB; the limit is 0 MiB");
    EXPECT_EQ(partFault(file, {}, 1511),
              "a.exr: part \"beauty\": claims 9 x 6 pixels of 28 bytes; the limit is 0 MiB");
    EXPECT_EQ(partFault(file, "normals", 648), "") << "only what is asked for counts";

    // 1 GiB of zeros around few pixels is allowed once, not for each part.
    std::vector<MadePart> small;
    for (const char* name : {"a", "b", "c"}) {
        small.push_back({name, {{"R", Imf::HALF}, {"G", Imf::HALF}}});
        small.back().display = box(0, 0, 7999, 5999);
    }
    EXPECT_EQ(partFault(exrOf(small)),
              "a.exr: part \"c\": this part and the parts before it claim 1098 MiB; the limit is 1024 MiB");
}

// Replaces the 32-bit number `index` of the part's attribute; `part` counts the file's headers.
std::string with(std::string file, int part, const std::string& attribute, std::size_t index,
                 std::int32_t value) {
    std::size_t at = file.find(attribute + '\0');
    for (int i = 0; i < part; ++i) at = file.find(attribute + '\0', at + 1);
    at = file.find('\0', at + attribute.size() + 1) + 1 + 4 + 4 * index;
    std::memcpy(file.data() + at, &value, 4);
    return file;
}

TEST(ExrParts, LiesOfALaterPartAreNamedByIt) {
    const std::string file = exrOf({colorPart, normalsPart}), size = std::to_string(file.size());
    EXPECT_EQ(partFault(with(file, 1, "dataWindow", 2, 65535)),
              "a.exr: part \"normals\": claims 65536 x 6 pixels, too many for its " + size + " bytes");
    EXPECT_EQ(partFault(with(file, 1, "dataWindow", 3, 1 << 20)),
              "a.exr: part \"normals\": claims 9 x 1048577 pixels, too many for its " + size + " bytes");
    std::string unknown = file;
    unknown[unknown.rfind("compression\0compression\0"s) + 24 + 4] = 77;
    EXPECT_EQ(partFault(unknown), "a.exr: part \"normals\": unknown compression 77");
    std::string kind = file;
    kind.replace(kind.rfind("scanlineimage"), 4, "\nscn");
    EXPECT_EQ(partFault(kind), "a.exr: part \"normals\": has the unknown type \"?scnlineimage\"");
    std::string name = file;
    name[name.rfind("normals")] = '\n';
    EXPECT_EQ(partFault(name), "a.exr: part \"?ormals\": has a line break in its name");
    EXPECT_EQ(partFault(file.substr(0, file.rfind("displayWindow") + 3)),
              "a.exr: its header holds a name without an end");
    // If pixels are missing, the library's message is prefixed with the part's name.
    const std::string cut = partFault(file.substr(0, file.size() - 40));
    EXPECT_TRUE(cut.starts_with("a.exr: part \"normals\": ")) << cut;
    EXPECT_EQ(cut.find('\n'), cut.npos);
}

TEST(ExrParts, SubsampledPartsAreRefusedByName) {
    const auto sampled = [](const std::string& name) {
        return exrOf(
            {colorPart, {"fog", {{"Y", Imf::HALF}, {name, Imf::HALF}}, box(0, 0, 7, 5), box(0, 0, 8, 5)}});
    };
    // The library also checks the sampling when it writes pixels, so the written file is changed afterwards.
    const auto halved = [&](const std::string& name) {
        std::string file = sampled(name);
        const std::size_t at = file.find(name + "\0\1\0\0\0"s) + name.size() + 1 + 8;
        file[at] = 2;
        return file;
    };
    EXPECT_EQ(partFault(sampled("BY")), "") << "at full size a name is a name";
    EXPECT_EQ(partFault(halved("BY")),
              "a.exr: part \"fog\": channel BY is subsampled, which is not supported: the file has luminance "
              "and chroma (Y, RY, BY) instead of R, G, B");
    EXPECT_EQ(partFault(halved("mist.U")),
              "a.exr: part \"fog\": channel mist.U is subsampled, which is not supported");
    EXPECT_EQ(partFault(halved("BY"), "beauty"), "") << "the other part alone";
}

}  // namespace
}  // namespace diptych
