// SPDX-License-Identifier: MIT
// diff as users and scripts run it: files of several formats, the deciding metric, the output.
#include "shared/image/exr.h"
#include "shared/image/pfm.h"
#include "shared/image/png.h"
#include "shared/image/radiance.h"
#include "tests/tool/run.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <map>
#include <sstream>
#include <string>

namespace diptych {
namespace {

using Json = nlohmann::json;

const fs::path published = fs::path(DIPTYCH_SOURCE_DIR) / "../shared/flip";

Image8 grey(std::uint8_t value, int width = 32, int height = 16) {
    return {width, height, 3, std::vector<std::uint8_t>(static_cast<std::size_t>(3 * width * height), value)};
}

Image noise(unsigned seed) {
    Image image(32, 16, 3);
    for (float& v : image.data) {
        seed = seed * 1664525u + 1013904223u;
        v = static_cast<float>(seed >> 8) * 0x1p-22f;
    }
    return image;
}

Json jsonOf(const Ran& ran) {
    EXPECT_TRUE(ran.err.empty()) << ran.err;
    return Json::parse(ran.out);
}

// sRGB grey 128 compared with itself and slightly brighter greys; values of the FLIP authors' program.
TEST(DiffCommand, FlipDecidesByItsMean) {
    const Folder folder;
    writePng(folder / "a.png", grey(128));
    const std::pair<int, double> steps[] = {{0, 0}, {1, 0.02986}, {2, 0.04849}, {4, 0.0787}, {16, 0.2065}};
    for (const auto& [step, mean] : steps) {
        writePng(folder / "b.png", grey(static_cast<std::uint8_t>(128 + step)));
        const Json json = jsonOf(runTool(folder, "diff a.png b.png --json"));
        EXPECT_NEAR(json["metrics"]["flip"].get<double>(), mean, 1e-4) << step;
        EXPECT_EQ(json["verdict"], step == 0 ? "pass" : "fail");
        EXPECT_EQ(json["schema"], 1);
        EXPECT_EQ(runTool(folder, "diff a.png b.png -q").code, step == 0 ? 0 : 1);
        EXPECT_EQ(runTool(folder, "diff a.png b.png -q --tolerance " + std::to_string(mean + 1e-4)).code, 0);
    }
    EXPECT_FALSE(fs::exists(folder / "diptych-report")) << "nothing is written without -o";
}

TEST(DiffCommand, TheAuthorsPairs) {
    if (!fs::exists(published))
        GTEST_SKIP() << "NO PICTURES at " << published << ": the pairs are not compared";
    const Folder folder;
    const auto diff = [&](const std::string& a, const std::string& b) {
        return jsonOf(runTool(folder, "diff '" + (published / a).string() + "' '" + (published / b).string() +
                                          "' --json"))["channels"][0]["flip_pooled"];
    };
    const Json tree = diff("tree-ref.png", "tree-test.png"), city = diff("city-ref.exr", "city-test.exr");
    EXPECT_EQ(tree["kind"], "LDR");
    EXPECT_NEAR(tree["mean"].get<double>(), 0.133276, 1e-4);
    EXPECT_EQ(city["kind"], "HDR");
    EXPECT_NEAR(city["mean"].get<double>(), 0.109993, 1e-4);
    EXPECT_NEAR(city["start_exposure"].get<double>(), -12.8397, 5e-5);
    EXPECT_EQ(city["exposures"], 15);
}

// Means, percentiles, FLIP and SSIM round, or leave pixels out; SSIM sees no colour.
TEST(DiffCommand, WithoutAToleranceOnlyEqualValuesPass) {
    const Folder folder;
    Image8 pixel = grey(128, 64, 64), luma = pixel;
    pixel.data[999] = 129;
    for (std::size_t i = 0; i < luma.data.size(); i += 3) {
        luma.data[i] = 255;
        luma.data[i + 1] = 65;
    }
    writePng(folder / "a.png", grey(128, 64, 64));
    writePng(folder / "pixel.png", pixel);
    writePng(folder / "luma.png", luma);
    const Image image = noise(3);
    Image ulp = image;
    ulp.data[40] = std::nextafter(ulp.data[40], 9.0f);
    writePfm(folder / "a.pfm", image);
    writePfm(folder / "ulp.pfm", ulp);
    for (const char* metric : {"flip", "flip_median", "ssim", "p99", "p999", "relative_p99", "psnr", "max",
                               "rmse", "mean", "angle_max"}) {
        const std::string of = std::string(" -q --metric ") + metric;
        const int undefined = metric == std::string("angle_max") ? 2 : 0;  // defined for no channel
        EXPECT_EQ(runTool(folder, "diff a.png a.png" + of).code, undefined) << metric;
        EXPECT_EQ(runTool(folder, "diff a.png pixel.png" + of).code, undefined ? 2 : 1) << metric;
        EXPECT_EQ(runTool(folder, "diff a.png luma.png" + of).code, undefined ? 2 : 1) << metric;
        EXPECT_EQ(runTool(folder, "diff a.pfm ulp.pfm" + of).code, undefined ? 2 : 1) << metric;
        EXPECT_EQ(runTool(folder, "diff a.pfm a.pfm" + of).code, undefined) << metric;
    }
    EXPECT_NE(runTool(folder, "diff a.png pixel.png --metric p99").out.find("1 of 4096 pixels differs"),
              std::string::npos);
}

// FLIP and SSIM take negative values as 0, and see ids and vectors as light.
TEST(DiffCommand, WhatIsNoLightIsNotEvaluatedByEyes) {
    const Folder folder;
    const Image light = noise(5);
    const auto write = [&](const char* name, const std::string& layer, const Image& data) {
        writeExr(folder / name,
                 {{{"R", "G", "B"}, &light}, {{layer + ".R", layer + ".G", layer + ".B"}, &data}});
    };
    Image some(32, 16, 3, 0.25f), turned(32, 16, 3, 0.2501f);
    for (const char* layer : {"N", "ViewLayer.Normal", "velocity", "CryptoObject00", "P", "normal_ws",
                              "denoisingNormal", "uCryptoAsset00", "objectId", "IndexOB", "mv", "material"}) {
        write("a.exr", layer, some);
        write("b.exr", layer, turned);
        const Ran ran = runTool(folder, "diff a.exr b.exr --tolerance 0.5");
        EXPECT_EQ(ran.code, 1) << layer;
        EXPECT_NE(ran.out.find(std::string(layer) + ": not light, by its name"), ran.out.npos) << ran.out;
        EXPECT_NE(ran.out.find("FAIL: " + std::string(layer)), ran.out.npos) << ran.out;
        EXPECT_EQ(runTool(folder, "diff a.exr a.exr --tolerance 0.5 -q").code, 0) << layer;
        EXPECT_EQ(runTool(folder, "diff a.exr b.exr --tolerance 0.5 --channels lit -q").code, 0) << layer;
    }
    write("a.exr", "diffuse", some);
    write("b.exr", "diffuse", turned);
    EXPECT_EQ(runTool(folder, "diff a.exr b.exr --tolerance 0.5 -q").code, 0) << "a colour";
    for (const char* layer : {"material color", "Pale", "identical", "indirect"}) {
        write("a.exr", layer, some);
        write("b.exr", layer, turned);
        EXPECT_EQ(runTool(folder, "diff a.exr b.exr --tolerance 0.5 -q").code, 0) << layer;
    }
    // Of this layer a tenth is negative, and then one pixel.
    for (const std::size_t every : {8u, 512u}) {
        Image first = some, second = some;
        for (std::size_t i = 0; i < first.pixels(); i += every) {
            first.pixel(i)[0] = -3;
            second.pixel(i)[0] = -1;
        }
        write("a.exr", "diffuse", first);
        write("b.exr", "diffuse", second);
        const std::string pair = "diff a.exr b.exr --tolerance ", min = every == 8 ? "0.5" : "0.0019";
        const Ran ran = runTool(folder, pair + min);
        EXPECT_EQ(ran.code, 1) << every;
        EXPECT_NE(ran.out.find(every == 8 ? "diffuse: not light, by its negative values"
                                          : "diffuse: FLIP cannot see 1 pixel that differs"),
                  ran.out.npos)
            << ran.out;
        EXPECT_EQ(runTool(folder, pair + "0.1 --metric ssim -q").code, 1) << every;
        if (every == 512) {
            EXPECT_EQ(runTool(folder, pair + "0.002 -q").code, 0) << "1 / 512";
        }
    }
}

// One image in four formats: equal up to the rounding of RGBE and of 8 bits.
TEST(DiffCommand, FormatsMeet) {
    const Folder folder;
    const Image image = noise(7);
    writeExr(folder / "a.exr", {{{"R", "G", "B"}, &image}});
    writePfm(folder / "a.pfm", image);
    writeHdr(folder / "a.hdr", image);
    EXPECT_EQ(runTool(folder, "diff a.exr a.pfm --metric max -q").code, 0);
    EXPECT_EQ(runTool(folder, "diff a.pfm a.hdr --metric max -q").code, 1);
    EXPECT_EQ(runTool(folder, "diff a.pfm a.hdr --metric max --tolerance 0.016 -q").code, 0)
        << "half a step of 8 bits under 4";
    writePng(folder / "a.png", grey(188));
    Image half(32, 16, 3, 0.5f);
    writePfm(folder / "half.pfm", half);
    const Ran ran = runTool(folder, "diff half.pfm a.png --metric max --tolerance 0.005");
    EXPECT_EQ(ran.code, 0) << ran.out << ran.err;
    EXPECT_NE(ran.out.find("a.png is PNG; it was decoded from sRGB to linear"), std::string::npos) << ran.out;
}

// A TIFF of one white pixel, byte by byte, compared with PNGs of equal and different colour.
TEST(DiffCommand, TiffsMeetPngs) {
    const Folder folder;
    std::string tiff("II*\0\x08\0\0\0\x08\0", 10);
    const std::uint8_t tags[][2] = {{0, 1}, {1, 1}, {2, 8}, {3, 1}, {6, 1}, {17, 110}, {21, 1}, {23, 1}};
    for (const auto& [tag, value] : tags)
        tiff += std::string{static_cast<char>(tag), 1, 4, 0, 1, 0, 0, 0, static_cast<char>(value), 0, 0, 0};
    folder.write("a.tif", tiff + std::string("\0\0\0\0\xff", 5));
    writePng(folder / "same.png", {1, 1, 3, {255, 255, 255}});
    writePng(folder / "other.png", {1, 1, 3, {255, 250, 255}});
    EXPECT_EQ(runTool(folder, "diff a.tif same.png --metric max").code, 0);
    EXPECT_EQ(runTool(folder, "diff a.tif other.png --metric max").code, 1);
    folder.write("cut.tif", tiff);
    EXPECT_TRUE(runTool(folder, "diff cut.tif same.png").failedOver("cut.tif"));
}

// 3 x 1 pixels with alpha 255, 0, 0. An image without alpha is opaque.
TEST(DiffCommand, AlphaOfOneSideIsComparedAndHiddenColoursAreSaid) {
    const Folder folder;
    writePng(folder / "a.png", {3, 1, 4, {9, 9, 9, 255, 9, 9, 9, 0, 9, 9, 9, 0}});
    writePng(folder / "hidden.png", {3, 1, 4, {9, 9, 9, 255, 9, 9, 9, 0, 7, 9, 9, 0}});
    writePng(folder / "shown.png", {3, 1, 4, {7, 9, 9, 255, 9, 9, 9, 0, 7, 9, 9, 0}});
    writePng(folder / "colour.png", {3, 1, 3, {9, 9, 9, 9, 9, 9, 9, 9, 9}});
    writePng(folder / "opaque.png", {3, 1, 4, {9, 9, 9, 255, 9, 9, 9, 255, 9, 9, 9, 255}});
    EXPECT_EQ(runTool(folder, "diff colour.png opaque.png --metric max").code, 0);
    const Ran alpha = runTool(folder, "diff colour.png a.png --metric max");
    EXPECT_EQ(alpha.code, 1) << "the background shows through";
    EXPECT_NE(alpha.out.find("A: the reference has none, so it counts as opaque: 1 everywhere"),
              std::string::npos);
    const char* const said = "A is 0 in both wherever they differ, so the difference is invisible";
    const Ran hidden = runTool(folder, "diff a.png hidden.png --metric max");
    EXPECT_EQ(hidden.code, 1);
    EXPECT_NE(hidden.out.find(said), std::string::npos) << hidden.out;
    EXPECT_EQ(runTool(folder, "diff a.png shown.png --metric max").out.find(said), std::string::npos);
}

// PNG colours are unassociated; OpenEXR's are premultiplied.
TEST(DiffCommand, ColoursMeetMultipliedByTheirAlpha) {
    const Folder folder;
    writePng(folder / "straight.png", {1, 1, 4, {255, 255, 0, 51}});
    Image multiplied(1, 1, 4);
    multiplied.data = {0.2f, 0.2f, 0, 0.2f};
    writeExr(folder / "multiplied.exr", {{{"R", "G", "B", "A"}, &multiplied}});
    multiplied.data = {1, 1, 0, 0.2f};
    writeExr(folder / "straight.exr", {{{"R", "G", "B", "A"}, &multiplied}});
    const Ran same = runTool(folder, "diff straight.png multiplied.exr --metric max --tolerance 1e-6");
    EXPECT_EQ(same.code, 0) << same.out;
    EXPECT_NE(same.out.find("straight.png: colours were multiplied by alpha to match the other"),
              std::string::npos)
        << same.out;
    EXPECT_EQ(runTool(folder, "diff straight.exr straight.png --metric max --tolerance 1e-6").code, 1);
}

TEST(DiffCommand, NanAgainstANumberIsADifference) {
    const Folder folder;
    Image a = noise(3), b = a;
    b.data[17] = std::nanf("");
    writePfm(folder / "a.pfm", a);
    writePfm(folder / "b.pfm", b);
    for (const char* metric : {"flip", "max", "rmse", "relative", "ulp", "ssim", "psnr", "p999"}) {
        EXPECT_EQ(runTool(folder, std::string("diff b.pfm b.pfm -q --metric ") + metric).code, 0) << metric;
        // p999 of 512 pixels is the worst one.
        EXPECT_EQ(runTool(folder, std::string("diff a.pfm b.pfm -q --metric ") + metric).code, 1) << metric;
    }
    EXPECT_EQ(runTool(folder, "diff a.pfm b.pfm -q --metric max --tolerance 1e30").code, 1);
}

TEST(DiffCommand, ChannelsAreMatchedByName) {
    const Folder folder;
    const Image color = noise(1), other = noise(2);
    writeExr(folder / "a.exr", {{{"R", "G", "B"}, &color}, {{"albedo.R", "albedo.G", "albedo.B"}, &other}});
    writeExr(folder / "b.exr",
             {{{"R", "G", "B"}, &color}, {{"diffuse.R", "diffuse.G", "diffuse.B"}, &other}});
    Ran ran = runTool(folder, "diff a.exr b.exr");
    EXPECT_EQ(ran.code, 0);
    EXPECT_NE(ran.out.find("albedo is in the reference only: not compared"), std::string::npos) << ran.out;
    EXPECT_TRUE(
        runTool(folder, "diff a.exr b.exr --channels albedo").failedOver("--channels albedo: not in both"));
    ran = runTool(folder,
                  "diff a.exr b.exr --channels albedo --map albedo=diffuse.R,diffuse.G,diffuse.B --json");
    EXPECT_EQ(jsonOf(ran)["channels"][0]["name"], "albedo");
    EXPECT_EQ(ran.code, 0);
    EXPECT_EQ(
        runTool(folder, "diff a.exr b.exr --map lit=diffuse.R,diffuse.G,diffuse.B --channels lit -q").code,
        1);
}

TEST(DiffCommand, WhatIsAskedForAndNotThereIsSaid) {
    const Folder folder;
    writePng(folder / "a.png", grey(100));
    EXPECT_TRUE(
        runTool(folder, "diff a.png a.png --map x=foo.R").failedOver("--map x=foo.R: neither file has"));
    EXPECT_TRUE(
        runTool(folder, "diff a.png a.png --metric angle").failedOver("--metric angle_max: not defined"));
    EXPECT_TRUE(runTool(folder, "diff a.png a.png --exposures 100000000").failedOver("--exposures"));
    EXPECT_TRUE(runTool(folder, "diff a.png a.png --blur nan").failedOver("--blur"));
    folder.write("t.json", R"({"rules": [{"channel": "LIT", "max": 1, "because": "x"}]})");
    const Ran ran = runTool(folder, "diff a.png a.png --tolerances t.json");
    EXPECT_EQ(ran.code, 1);
    EXPECT_NE(ran.out.find("FAIL a.png: t.json, rule 1: no channel here is called LIT; did you mean lit?\n"),
              std::string::npos)
        << ran.out;
}

// Every value is in the column of its own heading.
TEST(DiffCommand, TheTableHasAColumnForEachMetric) {
    const Folder folder;
    writePng(folder / "a.png", grey(100));
    writePng(folder / "b.png", grey(151));  // 0.2 of 1: 20 log10(5) = 13.98 dB
    const Ran ran = runTool(folder, "diff a.png b.png --metric max --tolerance 0.3");
    std::istringstream lines(ran.out);
    std::string head, row;
    std::getline(lines, head);
    std::getline(lines, head);
    std::getline(lines, row);
    head.replace(head.find("judged by"), 9, "judged_by");
    std::istringstream heads(head), cells(row);
    const std::map<std::string, std::string> expected{
        {"psnr", "14"},       {"p99.9", "0.2"},    {"rmse", "0.2"},  {"max", "0.2"},
        {"judged_by", "max"}, {"measured", "0.2"}, {"limit", "0.3"}, {"verdict", "pass"}};
    std::size_t found = 0;
    for (std::string name, cell; heads >> name;) {
        ASSERT_TRUE(cells >> cell) << row;
        if (const auto value = expected.find(name); value != expected.end()) {
            EXPECT_EQ(cell, value->second) << name;
            ++found;
        }
    }
    EXPECT_EQ(found, expected.size()) << head;
}

// Two folders: images of the same name are compared, unmatched ones fail, and one report contains all.
TEST(DiffCommand, FoldersAreComparedByName) {
    const Folder folder;
    const Image grey(8, 4, 3, 0.5f), other(8, 4, 3, 0.6f);
    for (const char* side : {"a", "b"}) {
        fs::create_directories(folder / side / "deep");
        writeExr(folder / side / "same.exr", {{{"R", "G", "B"}, &grey}});
        writeExr(folder / side / "deep/one.exr", {{{"R", "G", "B"}, side[0] == 'a' ? &grey : &other}});
    }
    folder.write("a/notes.txt", "no picture");
    folder.write("a/.hidden.png", "no picture");
    Ran ran = runTool(folder, "diff a b -o report");
    EXPECT_EQ(ran.code, 1) << ran.err;
    EXPECT_NE(ran.out.find("\nFAIL: 1 of 2 comparisons failed: deep/one.exr (lit beyond tolerance)\n"),
              std::string::npos)
        << ran.out;
    const Json report = Json::parse(contentsOf(folder / "report/report.json"));
    ASSERT_EQ(report["comparisons"].size(), 2u);
    EXPECT_EQ(report["comparisons"][0]["scene"], "deep/one.exr");
    EXPECT_EQ(report["comparisons"][0]["verdict"], "fail");
    EXPECT_EQ(report["comparisons"][1]["verdict"], "pass");
    EXPECT_TRUE(fs::exists(folder / "report/index.html"));
    // A missing file, and an unreadable one.
    fs::copy_file(folder / "a/same.exr", folder / "a/alone.exr");
    EXPECT_EQ(runTool(folder, "diff a a -q").code, 0);
    ran = runTool(folder, "diff b a --metric max --tolerance 0.2 -o missing");
    EXPECT_EQ(ran.code, 1);
    EXPECT_NE(ran.out.find("FAIL alone.exr: is in a only\n"), std::string::npos) << ran.out;
    const Json missing = Json::parse(contentsOf(folder / "missing/report.json"));
    EXPECT_EQ(missing["verdict"], "fail");
    EXPECT_EQ(missing["failures"][0]["scene"], "alone.exr");
    EXPECT_NE(contentsOf(folder / "missing/index.html").find("<li>alone.exr: is in a only</li>"),
              std::string::npos);
    EXPECT_NE(contentsOf(folder / "missing/junit.xml")
                  .find("<failure type=\"scene\" message=\"alone.exr: is in a only\"/>"),
              std::string::npos);
    folder.write("b/alone.exr", "no picture");
    ran = runTool(folder, "diff b a --metric max --tolerance 0.2 --json");
    EXPECT_EQ(ran.code, 2);
    const Json json = Json::parse(ran.out);
    EXPECT_EQ(json["pictures"].size(), 2u);
    EXPECT_EQ(json["errors"][0]["name"], "alone.exr");
    EXPECT_EQ(json["verdict"], "fail");
    EXPECT_TRUE(
        runTool(folder, "diff a b -o x.exr").failedOver("comparing two folders writes a report folder"));
    fs::create_directories(folder / "c");
    EXPECT_TRUE(runTool(folder, "diff a c").failedOver("share no picture name"));
}

}  // namespace
}  // namespace diptych
