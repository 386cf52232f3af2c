// SPDX-License-Identifier: MIT
// Text of a pixel breakdown for given steps and light terms, without drawing.
#include "compare/explain/pixel_breakdown.h"
#include "compare/files/frame_json.h"
#include "compare/output/writers.h"
#include "shared/contract/debug_mode.h"
#include "shared/frame/debug_modes.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace diptych {
namespace {

PixelStep stepOf(Channel mode, const PixelValue& a, const PixelValue& b, double tolerance) {
    PixelStep step;
    step.mode = &debugMode(mode);
    step.values = {a, b, {}};
    step.difference = 0;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
        step.difference = std::max(step.difference, std::abs(a[i] - b[i]));
    step.differs = step.difference > 0;
    step.tolerance = {tolerance, "half a step"};
    step.beyond = step.isCompared() && step.difference > tolerance;
    return step;
}

PixelBreakdown breakdownOf(std::vector<PixelStep> steps) {
    PixelBreakdown breakdown;
    breakdown.names = {"deferred", "forward_plus"};
    breakdown.shown = true;
    breakdown.steps = std::move(steps);
    for (const PixelTerm::Kind kind : {PixelTerm::Kind::sum, PixelTerm::Kind::lit, PixelTerm::Kind::residual})
        breakdown.terms.push_back({.kind = kind});
    return breakdown;
}

// A channel that is not a step would be omitted silently.
TEST(PixelBreakdown, EveryChannelIsAStepOnce) {
    std::vector<Channel> steps(pixelSteps().begin(), pixelSteps().end()), all;
    std::ranges::sort(steps);
    for (const DebugMode& mode : debugModes()) all.push_back(mode.channel);
    EXPECT_EQ(steps, all);
    EXPECT_EQ(pixelSteps().back(), Channel::lit) << "what all else makes";
    // The light terms come after the inputs of lighting and before its results.
    EXPECT_TRUE(std::ranges::is_partitioned(pixelSteps(), [](Channel mode) { return !isAfterTerms(mode); }));
}

TEST(PixelBreakdown, NamesTheFirstStepThatDiffers) {
    PixelBreakdown breakdown =
        breakdownOf({stepOf(Channel::depth, {1}, {1}, 0), stepOf(Channel::roughness, {0.3}, {0.30012}, 0.002),
                     stepOf(Channel::lit, {1, 1, 1}, {1, 1, 1.5}, 0.01)});
    EXPECT_EQ(
        firstDifference(breakdown),
        "the first step that differs by more than rounding: roughness (0.30012 against 0.3, 0.00012 in its "
        "metric, absolute, tolerance 0.002: half a step)");
    std::string text = inText(blocksOf(breakdown));
    EXPECT_NE(text.find("2 channels differ: roughness, lit\n"), std::string::npos) << text;
    EXPECT_NE(text.find("FAIL: at this pixel beyond tolerance: lit\n"), std::string::npos) << text;
    // Rounding does not count as a difference.
    breakdown.steps[1].differs = breakdown.steps[2].differs = false;
    breakdown.steps[2].beyond = false;
    EXPECT_EQ(firstDifference(breakdown), "no step differs by more than rounding");
    text = inText(blocksOf(breakdown));
    EXPECT_NE(text.find("pass: at this pixel all 3 shared channels"), std::string::npos) << text;
    EXPECT_EQ(toJson(breakdown)["first_difference"], nullptr);
}

// If only light differs, its term comes before the channels it affects.
TEST(PixelBreakdown, ATermComesBeforeTheLightItMakes) {
    PixelBreakdown breakdown = breakdownOf(
        {stepOf(Channel::depth, {1}, {1}, 0), stepOf(Channel::lit, {1, 1, 1}, {1, 1, 1.5}, 0.01)});
    breakdown.lights.push_back({.name = "lamp", .kind = "point"});
    PixelTerm lamp{.lights = {0}};
    lamp.values = {glm::dvec3(1), glm::dvec3(1, 1, 1.5), glm::dvec3(0)};
    lamp.has_reference = false;
    lamp.difference = 0.5;
    lamp.differs = true;
    breakdown.terms.insert(breakdown.terms.begin(), lamp);
    EXPECT_EQ(
        firstDifference(breakdown),
        "the first step that differs by more than rounding: light 0, point \"lamp\" (1 1 1.5 against 1 1 1 "
        "W/(sr m^2), relative difference 0.5; the surfaces are the same)");
    EXPECT_EQ(toJson(breakdown)["first_difference"], "light 0");
}

TEST(PixelBreakdown, ShowsAsManyDigitsAsADifferenceTakes) {
    const PixelBreakdown breakdown = breakdownOf({stepOf(Channel::metallic, {0.25}, {0.25000003}, 1)});
    EXPECT_NE(firstDifference(breakdown).find("0.25000003 against 0.25,"), std::string::npos)
        << firstDifference(breakdown);
}

// A pixel of three lights with all kinds of steps and terms.
PixelBreakdown wholeBreakdown() {
    constexpr double none = std::numeric_limits<double>::infinity();
    PixelBreakdown b = breakdownOf(
        {stepOf(Channel::material_id, {1}, {1}, 0), stepOf(Channel::depth, {2}, {2.5}, 1),
         stepOf(Channel::roughness, {0.3}, {0.30000001}, 1), stepOf(Channel::albedo, {1, 2, 3}, {1, 2, 5}, 1),
         stepOf(Channel::texcoords, {}, {0.25, 0.5}, 0), stepOf(Channel::metallic, {0}, {1}, none),
         stepOf(Channel::lit, {1, 1, 1}, {1, 1, 1.5}, 1)});
    b.scene = "lamps.glb";
    b.camera = "main";
    b.x = 3, b.y = 4;
    b.names = {"deferred", "forward_plus"};
    b.settings[0].size = {20, 12};
    b.settings[1].size = {21, 13};
    b.material = 1;
    b.material_name = "brass";
    b.position = {1.5, -2, 3.25};
    b.steps[2].differs = false;
    b.steps[3].values[2] = {1, 2, 4};
    b.steps[6].explained = false;
    b.steps[6].beyond = true;
    b.lights = {{"lamp", "point", 2, 5, true}, {"", "directional", none, none, false}, {"", "spot", 3, none}};
    b.lists = {std::vector<std::size_t>{0, 1, 2}, std::vector<std::size_t>{1, 2}};
    b.drawn_alone = 2;
    const auto term = [](PixelTerm::Kind kind, double a, double test, double reference) {
        PixelTerm of{.kind = kind};
        of.values = {glm::dvec3(a), glm::dvec3(test), glm::dvec3(reference)};
        return of;
    };
    using Kind = PixelTerm::Kind;
    b.terms = {term(Kind::light, 1, 1.25, 1.125),  term(Kind::light, 0, 0, 0),
               term(Kind::other_lights, 2, 2, 0),  term(Kind::environment, 3, 3.5, 3),
               term(Kind::ambient, 4, 4, 4),       term(Kind::emission, 5, 5, 5),
               term(Kind::transmittance, 1, 1, 1), term(Kind::haze, 6, 6, 6),
               term(Kind::blended, 7, 7, 7),       term(Kind::sum, 8, 8.5, 9),
               term(Kind::lit, 8.25, 8.5, 9),      term(Kind::residual, 0.25, 0, 0.0078125)};
    b.terms[0].lights = {0};
    b.terms[0].uncertainty = 0.25;
    b.terms[0].difference = 0.25;
    b.terms[0].differs = true;
    b.terms[1].lights = {1};
    b.terms[2].lights = {2};
    b.terms[2].has_reference = false;
    b.terms[3].difference = 0.125;
    b.terms[9].difference = 0.0625;
    b.residual_rounding = {0.125, 0.125, 0.0625};
    return b;
}

TEST(PixelBreakdown, ATerminalShowsAllOfIt) {
    EXPECT_EQ(
        inText(blocksOf(wholeBreakdown())),
        "lamps.glb, main: pixel 3,4 of 20x12, forward_plus against deferred\n"
        "material 1, \"brass\"; at 1.5, -2, 3.25 m\n"
        "  step         deferred  forward_plus  reference  difference        tolerance  because\n"
        "  material_id  1         1             -          0                 0          half a step\n"
        "  depth        2         2.5           -          0.5               1          half a step\n"
        "  roughness    0.3       0.30000001    -          1e-08 (rounding)  1          half a step\n"
        "  albedo       1 2 3     1 2 5         1 2 4      2                 1          FAIL: beyond "
        "tolerance: half a step\n"
        "  texcoords    -         0.25 0.5      -          -                 -          half a step\n"
        "  metallic     0         1             -          1                 none       half a step\n"
        "  lit          1 1 1     1 1 1.5       -          0.5               1          FAIL: the encoding "
        "does not explain it: forward+ shades the decoded surface differently; half a step\n"
        "  deferred evaluates 3 of 3 lights (--assign clustered): 0, 1, 2\n"
        "  forward_plus evaluates 2 of 3 lights (--assign clustered): 1, 2\n"
        "  2 of 3 lights rendered alone by both paths, the others black in the same lists and shadow maps: "
        "those evaluated here; the other 1 together\n"
        "  no contribution in any of the three by 1 light rendered alone: 1\n"
        "  lit minus the sum: deferred: 0.25, more than the 0.12 that rounding explains; forward_plus: 0; "
        "reference: 0.0078, within its uncertainty (0.062 at most)\n"
        "  term, W/(sr m^2)                 deferred        forward_plus    reference                      "
        "difference\n"
        "  light 0, point \"lamp\"            1 1 1           1.25 1.25 1.25  1.125 1.125 1.125              "
        "0.25              2 m away (range 5 m), casts a shadow, not in the list of forward_plus, "
        "uncertainty of the reference 0.25\n"
        "  1 other light                    2 2 2           2 2 2           -                              "
        "0\n"
        "  environment                      3 3 3           3.5 3.5 3.5     3 3 3                          "
        "0.125 (rounding)\n"
        "  ambient, lightmap                4 4 4           4 4 4           4 4 4                          "
        "0\n"
        "  emission                         5 5 5           5 5 5           5 5 5                          "
        "0\n"
        "  times transmittance              1 1 1           1 1 1           1 1 1                          "
        "0\n"
        "  haze                             6 6 6           6 6 6           6 6 6                          "
        "0\n"
        "  blended fragments, transmission  7 7 7           7 7 7           7 7 7                          "
        "0\n"
        "  sum of the terms                 8 8 8           8.5 8.5 8.5     9 9 9                          "
        "0.0625\n"
        "  lit                              8.25 8.25 8.25  8.5 8.5 8.5     9 9 9                          "
        "0\n"
        "  lit minus the sum                0.25 0.25 0.25  0 0 0           0.0078125 0.0078125 0.0078125\n"
        "the first step that differs by more than rounding: depth (2.5 against 2, 0.5 in its metric, "
        "relative, tolerance 1: half a step)\n"
        "4 channels differ: depth, albedo, metallic, lit\n"
        "FAIL: at this pixel beyond tolerance: albedo, lit\n");
}

// Lines that depend on how lights were evaluated and on what else makes lit.
TEST(PixelBreakdown, EachReasonHasItsLine) {
    struct Row {
        std::function<void(PixelBreakdown&)> change;
        const char* line;
    };
    const auto residual = [](std::size_t side, double value) {
        return [=](PixelBreakdown& b) { b.terms.back().values.at(side) = {0, -value, 0}; };
    };
    const Row rows[] = {
        {[](PixelBreakdown& b) { b.camera.clear(); },
         "lamps.glb: pixel 3,4 of 20x12, forward_plus against deferred"},
        {[](PixelBreakdown& b) { b.material_name.clear(); }, "material 1; at 1.5, -2, 3.25 m"},
        {[](PixelBreakdown& b) { b.steps[0].differs = true; },
         "material 1, \"brass\" (missing or different in forward_plus); at 1.5, -2, 3.25 m"},
        {[](PixelBreakdown& b) { b.shown = false; }, "background: no surface"},
        {[](PixelBreakdown& b) { b.shown = false, b.blended = true; },
         "background: no opaque surface, only blended fragments"},
        {[](PixelBreakdown& b) { b.lists[1] = b.lists[0]; },
         "  both paths evaluate 3 of 3 lights (--assign clustered): 0, 1, 2"},
        {[](PixelBreakdown& b) { b.lists[0] = std::vector<std::size_t>(); },
         "  deferred evaluates 0 of 3 lights (--assign clustered)"},
        {[](PixelBreakdown& b) { b.lists[1] = {}; },
         "  forward_plus evaluates an unknown list: the length read differs from light_count"},
        {[](PixelBreakdown& b) { b.lists[1] = {}, b.settings[1].assign = Assignment::per_object; },
         "  forward_plus evaluates the object's lights (--assign per_object)"},
        {[](PixelBreakdown& b) { b.settings[1].assign = Assignment::per_object; },
         "  --assign per_object: spherical harmonics combine all lights, so the lights are one term"},
        {[](PixelBreakdown& b) { b.drawn_alone = 3; },
         "  3 of 3 lights rendered alone by both paths, the others black in the same lists and shadow maps"},
        {[](PixelBreakdown& b) { b.drawn_alone = 0; },
         "  0 of 3 lights rendered alone by both paths: those evaluated here; the other 3 together"},
        {[](PixelBreakdown& b) { b.drawn_alone = 32, b.lights.resize(40); },
         "  32 of 40 lights rendered alone by both paths, the others black in the same lists and shadow "
         "maps: "
         "the 32 brightest here by the reference; the other 8 together"},
        {[](PixelBreakdown& b) {
             b.terms[2].lights = {0, 1, 2};
         },
         "  3 lights "},
        {residual(0, 0),
         "  lit minus the sum: deferred: 0; forward_plus: 0; reference: 0.0078, within its uncertainty "
         "(0.062 "
         "at most)"},
        {residual(1, 0.125),
         "  lit minus the sum: deferred: 0.25, more than the 0.12 that rounding explains; forward_plus: "
         "0.12, "
         "within the rounding of float32 sums (0.12 at most); reference: 0.0078, within its uncertainty "
         "(0.062 at most)"},
        {[](PixelBreakdown& b) { b.settings[0].msaa = 4, b.mode = ReferenceMode::scene; },
         "  lit minus the sum: deferred: 0.25: lit is the mean of 4 samples, the terms are of the first; "
         "forward_plus: 0; reference: 0.0078, within its uncertainty (0.062 at most)"},
        {[&](PixelBreakdown& b) { b.mode = ReferenceMode::scene, residual(2, 1)(b); },
         "  lit minus the sum: deferred: 0.25, more than the 0.12 that rounding explains; forward_plus: 0; "
         "reference: 1: lit is the mean over the pixel, the terms are of its centre"}};
    for (const Row& row : rows) {
        PixelBreakdown b = wholeBreakdown();
        row.change(b);
        const std::string text = "\n" + inText(blocksOf(b));
        EXPECT_NE(
            text.find("\n" + std::string(row.line) + (std::string_view(row.line).ends_with(' ') ? "" : "\n")),
            std::string::npos)
            << row.line << text;
    }
    PixelBreakdown dark =
        breakdownOf({stepOf(Channel::depth, {1}, {1}, 0), stepOf(Channel::lit, {1}, {1}, 0)});
    EXPECT_NE(inText(blocksOf(dark)).find("\n  no lights\n"), std::string::npos);
    // In the background, other channels than lit and material_id have no meaning.
    dark.shown = false;
    EXPECT_EQ(inText(blocksOf(dark)).find("depth"), std::string::npos);
}

TEST(PixelBreakdown, TermsHaveAsManyDigitsAsTheyTake) {
    PixelBreakdown b = wholeBreakdown();
    b.terms[3].values[1] = glm::dvec3(3.00000003);
    b.terms.back().values[1] = glm::dvec3(0.250000003);
    const std::string text = inText(blocksOf(b));
    EXPECT_NE(text.find("3.00000003 3.00000003 3.00000003"), std::string::npos) << text;
    EXPECT_EQ(text.find("0.250000003"), std::string::npos) << "of a difference";
}

TEST(PixelBreakdown, JsonHasAllOfIt) {
    PixelBreakdown b = wholeBreakdown();
    nlohmann::ordered_json json = toJson(b);
    EXPECT_EQ(json["settings"], (nlohmann::ordered_json{jsonOf(b.settings[0]), jsonOf(b.settings[1])}));
    EXPECT_EQ(json["summary"], firstDifference(b));
    for (const char* told : {"settings", "summary"}) json.erase(told);
    EXPECT_EQ(json, nlohmann::ordered_json::parse(
                        R"(
{"schema":1,"scene":"lamps.glb","camera":"main","pixel":[3,4],"size":[20,12],"baseline":"deferred",
"test":"forward_plus","background":false,"blended":false,"material":{"id":1,"name":"brass"},
"position":[1.5,-2.0,3.25],"steps":[{"number":8,"name":"material_id","metric":"exact",
"baseline":[1.0],"test":[1.0],"reference":null,"difference":0.0,"differs":false,"tolerance":0.0,
"within":true,"because":"half a step"},{"number":10,"name":"depth","metric":"relative",
"baseline":[2.0],"test":[2.5],"reference":null,"difference":0.5,"differs":true,"tolerance":1.0,
"within":true,"because":"half a step"},{"number":4,"name":"roughness","metric":"absolute",
"baseline":[0.3],"test":[0.30000001],"reference":null,"difference":9.999999994736442e-09,
"differs":false,"tolerance":1.0,"within":true,"because":"half a step"},{"number":1,
"name":"albedo","metric":"absolute","baseline":[1.0,2.0,3.0],"test":[1.0,2.0,5.0],
"reference":[1.0,2.0,4.0],"difference":2.0,"differs":true,"tolerance":1.0,"within":false,
"because":"half a step"},{"number":9,"name":"texcoords","metric":"absolute","baseline":null,
"test":[0.25,0.5],"reference":null,"because":"half a step"},{"number":3,"name":"metallic",
"metric":"absolute","baseline":[0.0],"test":[1.0],"reference":null,"difference":1.0,
"differs":true,"tolerance":null,"within":true,"because":"half a step"},{"number":0,
"name":"lit","metric":"relative","baseline":[1.0,1.0,1.0],"test":[1.0,1.0,1.5],"reference":null,
"difference":0.5,"differs":true,"tolerance":1.0,"within":false,"explained":false,
"because":"half a step"}],"lights":[{"light":0,"name":"lamp","kind":"point","distance":2.0,
"range":5.0,"casts":true,"in_baseline_list":true,"in_test_list":false},{"light":1,
"name":"","kind":"directional","distance":null,"range":null,"casts":false,"in_baseline_list":true,
"in_test_list":true},{"light":2,"name":"","kind":"spot","distance":3.0,"range":null,
"casts":false,"in_baseline_list":true,"in_test_list":true}],"drawn_alone":2,"terms":[{"kind":"light",
"lights":[0],"baseline":[1.0,1.0,1.0],"test":[1.25,1.25,1.25],"reference":[1.125,
1.125,1.125],"uncertainty":0.25,"difference":0.25,"differs":true},{"kind":"light",
"lights":[1],"baseline":[0.0,0.0,0.0],"test":[0.0,0.0,0.0],"reference":[0.0,0.0,0.0],
"uncertainty":0.0,"difference":0.0,"differs":false},{"kind":"other_lights","lights":[2],
"baseline":[2.0,2.0,2.0],"test":[2.0,2.0,2.0],"reference":null,"uncertainty":0.0,
"difference":0.0,"differs":false},{"kind":"environment","lights":[],"baseline":[3.0,
3.0,3.0],"test":[3.5,3.5,3.5],"reference":[3.0,3.0,3.0],"uncertainty":0.0,"difference":0.125,
"differs":false},{"kind":"ambient","lights":[],"baseline":[4.0,4.0,4.0],"test":[4.0,
4.0,4.0],"reference":[4.0,4.0,4.0],"uncertainty":0.0,"difference":0.0,"differs":false},
{"kind":"emission","lights":[],"baseline":[5.0,5.0,5.0],"test":[5.0,5.0,5.0],"reference":[5.0,
5.0,5.0],"uncertainty":0.0,"difference":0.0,"differs":false},{"kind":"transmittance",
"lights":[],"baseline":[1.0,1.0,1.0],"test":[1.0,1.0,1.0],"reference":[1.0,1.0,1.0],
"uncertainty":0.0,"difference":0.0,"differs":false},{"kind":"haze","lights":[],"baseline":[6.0,
6.0,6.0],"test":[6.0,6.0,6.0],"reference":[6.0,6.0,6.0],"uncertainty":0.0,"difference":0.0,
"differs":false},{"kind":"blended","lights":[],"baseline":[7.0,7.0,7.0],"test":[7.0,
7.0,7.0],"reference":[7.0,7.0,7.0],"uncertainty":0.0,"difference":0.0,"differs":false},
{"kind":"sum","lights":[],"baseline":[8.0,8.0,8.0],"test":[8.5,8.5,8.5],"reference":[9.0,
9.0,9.0],"uncertainty":0.0,"difference":0.0625,"differs":false},{"kind":"lit","lights":[],
"baseline":[8.25,8.25,8.25],"test":[8.5,8.5,8.5],"reference":[9.0,9.0,9.0],"uncertainty":0.0,
"difference":0.0,"differs":false},{"kind":"residual","lights":[],"baseline":[0.25,
0.25,0.25],"test":[0.0,0.0,0.0],"reference":[0.0078125,0.0078125,0.0078125],"uncertainty":0.0,
"difference":0.0,"differs":false}],"residual_rounding":[0.125,0.125,0.0625],"first_difference":"depth"})"));
    b.shown = false;
    json = toJson(b);
    EXPECT_EQ(json["background"], true);
    EXPECT_EQ(json["material"], nullptr);
    EXPECT_EQ(json["position"], nullptr);
}

}  // namespace
}  // namespace diptych
