// SPDX-License-Identifier: MIT
// The file of an external renderer: its defaults, each input correction with its text, and its errors.
#include "compare/external/renderer_file.h"
#include "compare/external/calibration.h"

#include "tests/support/errors.h"
#include "tests/support/files.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

namespace diptych::external {
namespace {

using Json = nlohmann::ordered_json;
using Lines = std::vector<std::string>;

// A file of this JSON, with the required command unless `members` has one.
std::filesystem::path rendererFile(Json members, const std::string& name = "three.json") {
    if (!members.contains("command")) members["command"] = {"node", "three.mjs"};
    const std::filesystem::path file = testFolder() / name;
    std::ofstream(file) << members;
    return file;
}
ExternalRenderer rendererWith(const Json& members) {
    return readRendererFile(rendererFile(members));
}
std::string faultWith(const Json& members) {
    const std::filesystem::path file = rendererFile(members);
    const std::string fault = faultOf([&] { readRendererFile(file); }), who = file.string() + ": ";
    EXPECT_TRUE(fault.starts_with(who)) << fault;
    return fault.substr(std::min(fault.size(), who.size()));
}

TEST(RendererFile, OnlyTheCommandIsRequired) {
    const ExternalRenderer renderer = rendererWith({});
    EXPECT_EQ(renderer.name, "three");
    EXPECT_EQ(renderer.folder, testFolder());
    EXPECT_EQ(renderer.command, (Lines{"node", "three.mjs"}));
    EXPECT_EQ(renderer.timeout, 60);
    EXPECT_FALSE(renderer.posed);
    EXPECT_EQ(describe(renderer.corrections), Lines{});
    const ExternalRenderer other =
        rendererWith({{"$schema", "x"}, {"schema", 1}, {"timeout", 0.5}, {"scene", "copy"}});
    EXPECT_EQ(other.timeout, 0.5);
    EXPECT_TRUE(other.posed);
    EXPECT_FALSE(rendererWith({{"scene", "file"}}).posed);
    EXPECT_EQ(rendererWith({{"timeout", 86400}}).timeout, 86400);
}

// A correction in the file, the member that it sets, and how reports describe it.
struct CorrectionCase {
    Json granted;
    std::function<bool(const InputCorrections&)> set;
    Lines lines;
};

TEST(RendererFile, EachCorrectionSetsItsMemberAndHasItsText) {
    using In = const InputCorrections&;
    const CorrectionCase cases[] = {
        {{{"light_factor", 2}},
         [](In c) {
             return c.point_factor == 2 && c.spot_factor == 2 && c.directional_factor == 2 &&
                    c.area_factor == 2 && c.environment_factor == 1;
         },
         {"light_factor 2: it receives all lights 2 times as bright"}},
        {{{"light_factor", 2}, {"spot_factor", 3}},
         [](In c) { return c.point_factor == 2 && c.spot_factor == 3; },
         {"point_factor 2: it receives point lights 2 times as bright",
          "spot_factor 3: it receives spot lights 3 times as bright",
          "directional_factor 2: it receives directional lights 2 times as bright",
          "area_factor 2: it receives area lights 2 times as bright"}},
        {{{"point_factor", 0}},
         [](In c) { return c.point_factor == 0; },
         {"point_factor 0: it receives point lights 0 times as bright"}},
        {{{"spot_factor", 1e6}},
         [](In c) { return c.spot_factor == 1e6; },
         {"spot_factor 1000000: it receives spot lights 1000000 times as bright"}},
        {{{"directional_factor", 0.5}},
         [](In c) { return c.directional_factor == 0.5; },
         {"directional_factor 0.5: it receives directional lights 0.5 times as bright"}},
        {{{"area_factor", 0.25}},
         [](In c) { return c.area_factor == 0.25; },
         {"area_factor 0.25: it receives area lights 0.25 times as bright"}},
        {{{"environment_factor", 4}},
         [](In c) { return c.environment_factor == 4 && c.point_factor == 1; },
         {"environment_factor 4: it receives an environment 4 times as bright"}},
        {{{"environment_rotation", -360}},
         [](In c) { return c.environment_rotation == -360; },
         {"environment_rotation -360: it receives an environment rotated by -360 degrees more"}},
        {{{"fov_offset", 90}},
         [](In c) { return c.fov_offset == 90; },
         {"fov_offset 90: it receives a field of view 90 degrees wider"}},
        {{{"shift_x", -1000}},
         [](In c) { return c.shift_x == -1000; },
         {"shift_x -1000: it receives a projection -1000 pixels further right"}},
        {{{"shift_y", 0.5}},
         [](In c) { return c.shift_y == 0.5; },
         {"shift_y 0.5: it receives a projection 0.5 pixels further down"}},
        {{{"environment_mirrored", true}},
         [](In c) { return c.environment_mirrored; },
         {"environment_mirrored: it receives the environment mirrored, left for right"}},
        {{{"upside_down", true}},
         [](In c) { return c.upside_down && !c.mirrored; },
         {"upside_down: its picture is read from the bottom up"}},
        {{{"mirrored", true}},
         [](In c) { return c.mirrored && !c.environment_mirrored; },
         {"mirrored: its picture is read from right to left"}},
        {{{"transfer", "srgb"}},
         [](In c) { return c.transfer == Transfer::srgb; },
         {"transfer srgb: its pixels are decoded from this curve"}},
        {{{"primaries", "display_p3"}},
         [](In c) { return c.primaries == Primaries::display_p3; },
         {"primaries display_p3: its pixels are converted from these"}},
        {{{"primaries", "rec2020"}},
         [](In c) { return c.primaries == Primaries::rec2020; },
         {"primaries rec2020: its pixels are converted from these"}},
        {{{"primaries", "rec709"}, {"transfer", "linear"}, {"mirrored", false}, {"light_factor", 1}},
         [](In c) { return c.primaries == Primaries::rec709 && c.transfer == Transfer::linear; },
         {}},
    };
    std::vector<std::string> proved;
    for (const CorrectionCase& one : cases) {
        const InputCorrections corrections = rendererWith({{"granted", one.granted}}).corrections;
        EXPECT_TRUE(one.set(corrections)) << one.granted;
        EXPECT_EQ(describe(corrections), one.lines) << one.granted;
        for (const auto& item : one.granted.items()) proved.push_back(item.key());
    }
    for (const std::string_view name : correctionNames())
        EXPECT_TRUE(std::ranges::count(proved, name) > 0) << name << " has no case here";
}

TEST(RendererFile, ErrorsSayWhatMayStandThere) {
    const std::string command =
        "the renderer: command: must be the program and its arguments, e.g. "
        "[\"node\", \"three.mjs\"]; no shell is used";
    for (const Json& bad : {Json("node x"), Json::array(), Json{"node", 1}, Json{""}, Json(nullptr),
                            Json{"node", std::string("a\0b", 3)}})
        EXPECT_EQ(faultWith({{"command", bad}}), command) << bad;
    const auto granted = [](const Json& corrections) { return faultWith({{"granted", corrections}}); };
    EXPECT_EQ(faultWith({{"schema", 2}}),
              "the renderer: schema: must be 1, the only version that this diptych reads");
    EXPECT_EQ(faultWith({{"timeout", 0}}), "the renderer: timeout: must be above 0 s");
    EXPECT_EQ(faultWith({{"timeout", 86401}}), "the renderer: timeout: 86401 is above 86400");
    EXPECT_EQ(faultWith({{"scene", "copied"}}), "the renderer: scene: \"copied\" is not one of file, copy");
    EXPECT_EQ(faultWith({{"tmeout", 1}}), "the renderer: tmeout: is not a known field of a renderer");
    EXPECT_EQ(granted({{"transfer", "gamma"}}), "granted: transfer: \"gamma\" is not one of linear, srgb");
    EXPECT_EQ(granted({{"primaries", "p3"}}),
              "granted: primaries: \"p3\" is not one of rec709, display_p3, rec2020");
    EXPECT_EQ(granted({{"sun_factor", 1}}), "granted: sun_factor: is not a known field of granted");
    for (const char* const factor : {"light_factor", "point_factor", "spot_factor", "directional_factor",
                                     "area_factor", "environment_factor"}) {
        EXPECT_EQ(granted({{factor, -0.5}}), std::string("granted: ") + factor + ": -0.5 is below 0");
        EXPECT_EQ(granted({{factor, 1.5e6}}), std::string("granted: ") + factor + ": 1.5e+06 is above 1e+06");
    }
    EXPECT_EQ(granted({{"environment_rotation", 361}}), "granted: environment_rotation: 361 is above 360");
    EXPECT_EQ(granted({{"environment_rotation", -361}}), "granted: environment_rotation: -361 is below -360");
    EXPECT_EQ(granted({{"fov_offset", 91}}), "granted: fov_offset: 91 is above 90");
    EXPECT_EQ(granted({{"fov_offset", -91}}), "granted: fov_offset: -91 is below -90");
    for (const char* const shift : {"shift_x", "shift_y"}) {
        EXPECT_EQ(granted({{shift, 1001}}), std::string("granted: ") + shift + ": 1001 is above 1000");
        EXPECT_EQ(granted({{shift, -1001}}), std::string("granted: ") + shift + ": -1001 is below -1000");
    }
}

TEST(RendererFile, AnArgumentIsANameAndAFile) {
    const std::string file = rendererFile({}).string(), longest(64, 'n');
    for (const std::string& name : {std::string("three"), std::string("aZ09-_."), longest})
        EXPECT_EQ(readRenderer(name + "=" + file).name, name);
    const auto fault = [](const std::string& argument) {
        const std::string who = "--renderer " + argument + ": ",
                          said = faultOf([&] { readRenderer(argument); });
        EXPECT_TRUE(said.starts_with(who)) << said;
        return said.substr(std::min(said.size(), who.size()));
    };
    for (const std::string& argument : {std::string("three"), std::string("three="), file})
        EXPECT_EQ(fault(argument), "give NAME=FILE.json, e.g. three=three.json") << argument;
    for (const std::string& name :
         {std::string(), std::string(".three"), std::string("a b"), longest + "n", std::string("a/b"),
          std::string("a:b"), std::string("a@b"), std::string("a[b"), std::string("a`b"), std::string("a{b")})
        EXPECT_EQ(fault(name + "=" + file),
                  "its name may have up to 64 letters, digits, \"-\", \"_\" and "
                  "dots, e.g. three=three.json")
            << name;
    for (const std::string name : {"deferred", "forward_plus", "reference"})
        EXPECT_EQ(fault(name + "=" + file), name + " is the name of a path of diptych; choose another");
    EXPECT_EQ(fault("baseline=" + file), "this name is reserved for the file of --baseline; choose another");
}

TEST(RendererFile, ACalibrationSaysWhatIsGrantedAndWhatToAdd) {
    ExternalRenderer renderer;
    renderer.file = "three.json";
    EXPECT_EQ(describe(renderer, {}), "pass: it interprets its inputs as Diptych does\n");
    EXPECT_EQ(toJson(renderer, {}), (Json{{"schema", 1},
                                          {"renderer", "three.json"},
                                          {"verdict", "pass"},
                                          {"granted_already", Json::array()},
                                          {"deviations", Json::array()},
                                          {"granted", Json::object()}}));
    std::vector<Deviation> deviations{{"fov", "1 degree wider", {{"fov_offset", -1}}},
                                      {"tone_curve", "pixels have a tone curve"},
                                      {"shift", "down", {{"shift_x", 2}, {"shift_y", 3}}}};
    EXPECT_EQ(describe(renderer, deviations),
              "FAIL fov: 1 degree wider\n"
              "FAIL tone_curve: pixels have a tone curve; no input correction exists for it\n"
              "FAIL shift: down\n"
              "to correct its inputs, add to three.json: \"granted\": "
              "{\"fov_offset\":-1,\"shift_x\":2,\"shift_y\":3}\n");
    renderer.corrections.mirrored = true;
    deviations.resize(1);
    EXPECT_EQ(
        describe(renderer, deviations),
        "granted mirrored: its picture is read from right to left\n"
        "FAIL fov: 1 degree wider\n"
        "to correct its inputs, add to three.json, on top of the present \"granted\" (factors multiply, "
        "offsets add): \"granted\": {\"fov_offset\":-1}\n");
    deviations.erase(deviations.begin());
    deviations.push_back({"tone_curve", "pixels have a tone curve"});
    EXPECT_EQ(toJson(renderer, deviations),
              (Json{{"schema", 1},
                    {"renderer", "three.json"},
                    {"verdict", "fail"},
                    {"granted_already", {"mirrored: its picture is read from right to left"}},
                    {"deviations", Json::array({{{"name", "tone_curve"},
                                                 {"words", "pixels have a tone curve"},
                                                 {"grant", Json::object()}}})},
                    {"granted", Json::object()}}));
}

}  // namespace
}  // namespace diptych::external
