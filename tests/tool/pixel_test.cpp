// SPDX-License-Identifier: MIT
// compare --pixel as users see it.
#include "shared/image/exr.h"
#include "tests/tool/run.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>

namespace diptych {
namespace {

using nlohmann::json;

json breakdownOf(const Folder& folder, const std::string& arguments) {
    const Ran ran = runTool(folder, "compare " + arguments + " --json");
    EXPECT_EQ(ran.code, 0) << ran.err;
    return ran.code == 0 ? json::parse(ran.out) : json();
}

const json& named(const json& list, const char* key, std::string_view name) {
    static const json none;
    const auto found = std::ranges::find_if(list, [&](const json& one) { return one[key] == name; });
    EXPECT_NE(found, list.end()) << name;
    return found == list.end() ? none : *found;
}

double largest(const json& values) {
    double max = 0;
    for (const json& value : values) max = std::max(max, std::abs(value.get<double>()));
    return max;
}

// Every term of lit is counted exactly once. The residual is the rounding of float32 sums; for the
// reference, in double, it is almost zero or within its known uncertainty.
void expectTermsAddUp(const json& breakdown) {
    const json& terms = breakdown["terms"];
    const json& residual = named(terms, "kind", "residual");
    const std::array sides{"baseline", "test", "reference"};
    for (std::size_t side = 0; side < 3; ++side)
        EXPECT_LE(largest(residual[sides.at(side)]), breakdown["residual_rounding"][side].get<double>())
            << sides.at(side) << ": " << residual << named(terms, "kind", "lit");
    EXPECT_GT(largest(named(terms, "kind", "lit")["test"]), 0) << "a pixel that nothing lights shows nothing";
}

// The list has as many lights as the pixel evaluates, and includes every light that lights it.
void expectListsAreTold(const json& breakdown) {
    const json& count = named(breakdown["steps"], "name", "light_count");
    for (const std::string side : {"baseline", "test"}) {
        const auto isListed = [&](const json& light) { return light["in_" + side + "_list"] == true; };
        EXPECT_EQ(static_cast<double>(std::ranges::count_if(breakdown["lights"], isListed)),
                  count[side][0].get<double>())
            << side;
        for (const json& term : breakdown["terms"])
            if (term["kind"] == "light" && largest(term[side]) > 0) {
                EXPECT_TRUE(isListed(breakdown["lights"][term["lights"][0].get<std::size_t>()]))
                    << side << term;
            }
    }
}

// Per-object lights cannot be rendered one by one; their sum is still reported.
TEST(PixelTool, LightsByObjectAreOneTerm) {
    const Folder folder;
    for (const std::string scene : {"builtin:points", "builtin:furnace"}) {
        const json breakdown = breakdownOf(
            folder, scene + " --size 64x36 --forward-plus assign=per_object,pixel-lights=2 --pixel 30,24");
        expectTermsAddUp(breakdown);
        const json& lights = named(breakdown["terms"], "kind", "other_lights");
        EXPECT_EQ(lights["lights"].size(), breakdown["lights"].size());
        EXPECT_GT(lights["difference"], 0) << "and they are not the same lights";
    }
}

TEST(PixelTool, WithAFullGBufferNoStepDiffers) {
    const Folder folder;
    for (const std::string scene : {"builtin:points", "builtin:areas"}) {
        const std::string command = scene + " --size 64x36 --gbuffer full --pixel 30,24";
        const json breakdown = breakdownOf(folder, command);
        EXPECT_EQ(breakdown["first_difference"], nullptr) << breakdown["summary"];
        EXPECT_EQ(breakdown["summary"], "no step differs by more than rounding");
        for (const json& step : breakdown["steps"]) EXPECT_EQ(step.value("difference", 0.0), 0.0) << step;
        expectTermsAddUp(breakdown);
        expectListsAreTold(breakdown);
    }
    const Ran ran = runTool(folder, "compare builtin:points --size 64x36 --gbuffer full --pixel 30,24");
    EXPECT_EQ(ran.code, 0);
    EXPECT_NE(ran.out.find("\nno step differs by more than rounding\npass: at this pixel all "),
              std::string::npos)
        << ran.out;
    EXPECT_FALSE(fs::exists(folder / "diptych-report")) << "a breakdown is no report";
}

TEST(PixelTool, NamesTheStepThatAnEncodingChanges) {
    const Folder folder;
    const json breakdown = breakdownOf(folder, "builtin:points --size 64x36 --gbuffer compact --pixel 30,24");
    EXPECT_EQ(breakdown["first_difference"], "geometric_normal") << breakdown["summary"];
    EXPECT_EQ(breakdown["size"], json({64, 36}));
    const json& albedo = named(breakdown["steps"], "name", "albedo");
    EXPECT_GT(albedo["difference"], 0.0);
    EXPECT_LE(albedo["difference"], albedo["tolerance"]);
    EXPECT_NE(albedo["because"].get<std::string>().find("square root in 8 bits"), std::string::npos)
        << albedo;
    EXPECT_EQ(named(breakdown["steps"], "name", "lit")["explained"], true);
    expectTermsAddUp(breakdown);
    // Swapping the baseline swaps both columns.
    const json turned = breakdownOf(
        folder, "builtin:points --size 64x36 --gbuffer compact --pixel 30,24 --baseline forward_plus");
    EXPECT_EQ(turned["baseline"], "forward_plus");
    EXPECT_EQ(named(turned["steps"], "name", "albedo")["test"], albedo["baseline"]);
}

// Light through a leaf has terms of its lights, of the environment and of ambient light, from behind too;
// that through glass is one term with what blends.
TEST(PixelTool, TermsAddUpOnALeafAndOnGlass) {
    const Folder folder;
    Image sky(8, 4, 3, 0.2f);
    writeExr(folder / "sky.exr", {{{"R", "G", "B"}, &sky}});
    const std::string leaf = "61,38", glass = "61,15";
    for (const std::string& pixel : {leaf, glass}) {
        const json breakdown = breakdownOf(
            folder, "builtin:transmission --size 96x54 --ambient 0.1,0.2,0.3 --env sky.exr --pixel " + pixel);
        expectTermsAddUp(breakdown);
        EXPECT_GT(largest(named(breakdown["steps"], "name", "lit_transmission")["test"]), 0) << pixel;
        EXPECT_EQ(breakdown["blended"], pixel == glass);
    }
}

// A user's rule decides instead of the encoding.
TEST(PixelTool, ARuleDecidesWhatIsBeyond) {
    const Folder folder;
    folder.write("t.json", R"({"rules": [{"channel": "albedo", "max": 0, "because": "no bit may change"}]})");
    const Ran ran = runTool(
        folder, "compare builtin:points --size 64x36 --gbuffer compact --pixel 30,24 --tolerances t.json");
    EXPECT_EQ(ran.code, 0) << "the breakdown was printed: " << ran.err;
    EXPECT_NE(ran.out.find("FAIL: beyond tolerance: no bit may change"), std::string::npos) << ran.out;
    EXPECT_NE(ran.out.find("\nFAIL: at this pixel beyond tolerance: albedo"), std::string::npos) << ran.out;
}

// Every light at the pixel is a term of its own; the other lights stay in lists and maps while one is
// rendered.
TEST(PixelTool, TermsAddUpWithShadowsHazeEnvironmentAndBlendedSurfaces) {
    const Folder folder;
    Image sky(8, 4, 3, 0.2f);
    sky.at(2, 1, 0) = 3;
    writeExr(folder / "sky.exr", {{{"R", "G", "B"}, &sky}});
    const auto has = [](const json& breakdown, const std::string& kind) {
        return std::ranges::any_of(breakdown["terms"],
                                   [&](const json& term) { return term["kind"] == kind; });
    };
    const json hall = breakdownOf(folder,
                                  "builtin:gallery --size 64x36 --pixel 30,24 --shadow-lights 4 --haze on "
                                  "--haze-density 50 --ambient 0.1,0.2,0.3 --env sky.exr");
    expectTermsAddUp(hall);
    expectListsAreTold(hall);
    for (const std::string kind :
         {"light", "other_lights", "environment", "ambient", "transmittance", "haze"})
        EXPECT_TRUE(has(hall, kind)) << kind;
    EXPECT_FALSE(has(hall, "blended"));
    EXPECT_TRUE(
        std::ranges::any_of(hall["lights"], [](const json& light) { return light["casts"] == true; }));
    const json glass =
        breakdownOf(folder, "builtin:glass --size 64x36 --pixel 50,20 --haze on --haze-density 50");
    expectTermsAddUp(glass);
    EXPECT_TRUE(has(glass, "blended"));
    for (const std::string assign : {"every", "tiled"}) {
        const json breakdown =
            breakdownOf(folder, "builtin:points --size 64x36 --pixel 34,14 --assign " + assign);
        expectTermsAddUp(breakdown);
        expectListsAreTold(breakdown);
    }
}

// With MSAA lit is the mean of the samples. The breakdown says so if its terms, of the first sample, do
// not add up.
TEST(PixelTool, SaysWhyTermsOfOneSampleAreNotTheMeanOfFour) {
    const Folder folder;
    const std::string command = "compare builtin:points --size 64x36 --msaa 4 --pixel ";
    bool said = false;
    for (const std::string pixel : {"20,18", "32,18", "30,8", "40,20"}) {
        const Ran ran = runTool(folder, command + pixel);
        ASSERT_EQ(ran.code, 0) << ran.err;
        EXPECT_EQ(ran.out.find("that rounding explains"), std::string::npos) << ran.out;
        said =
            said || ran.out.find("lit is the mean of 4 samples, the terms are of the first") != ran.out.npos;
    }
    EXPECT_TRUE(said);
}

TEST(PixelTool, SaysThatNothingIsDrawnInTheBackground) {
    const Folder folder;
    const Ran ran = runTool(folder, "compare builtin:spheres --size 64x36 --pixel 0,0");
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_NE(ran.out.find("\nbackground: no surface\n"), std::string::npos) << ran.out;
    EXPECT_EQ(ran.out.find("albedo"), std::string::npos) << ran.out;
    // Only blended fragments contribute light; there is no opaque surface.
    const Ran pane = runTool(folder, "compare builtin:glass --size 64x36 --pixel 10,20");
    EXPECT_NE(pane.out.find("\nbackground: no opaque surface, only blended fragments\n"), std::string::npos)
        << pane.out;
}

TEST(PixelTool, RefusesWhatNoStoryIsOf) {
    const Folder folder;
    const std::string pixel = " --size 64x36 --pixel 3,4 ";
    EXPECT_TRUE(runTool(folder, "compare builtin:points --size 64x36 --pixel 64,0")
                    .failedOver("--pixel 64,0: is outside the image (pixels 0,0 to 63,35); --size "));
    EXPECT_TRUE(
        runTool(folder, "compare builtin:points --pixel 3").failedOver("--pixel 3: takes X,Y in pixels"));
    EXPECT_TRUE(runTool(folder, "compare builtin:points builtin:spheres" + pixel)
                    .failedOver("--pixel 3,4: takes one scene, and 2 are given"));
    EXPECT_TRUE(
        runTool(folder, "compare builtin:points --times 0,1" + pixel).failedOver("one view; give one"));
    EXPECT_TRUE(runTool(folder, "compare builtin:points --baseline reference" + pixel)
                    .failedOver("--baseline reference: --pixel 3,4 compares the two paths"));
    EXPECT_TRUE(runTool(folder, "compare builtin:points --baseline old.exr" + pixel)
                    .failedOver("--baseline old.exr: --pixel 3,4 compares the two paths"));
    EXPECT_TRUE(
        runTool(folder, "compare builtin:points -o report" + pixel).failedOver("--pixel writes no file"));
}

}  // namespace
}  // namespace diptych
