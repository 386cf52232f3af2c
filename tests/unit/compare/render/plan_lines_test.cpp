// SPDX-License-Identifier: MIT
// Lines of the plan that do not come from the scene's file.
#include "compare/render/path_plan.h"

#include "compare/frames/frame_properties.h"
#include "shared/contract/gbuffer.h"
#include "shared/scene/load.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

namespace diptych {
namespace {

Requirements::Line plannedLine(const std::string& what, const char* scene, const Settings& settings) {
    const Scene loaded = loadScene(scene);
    for (const Requirements::Line& line : planLines(makeSceneView(loaded, viewRequest(settings)), settings))
        if (line.what == what) return line;
    throw std::out_of_range(what + " is not planned");
}

TEST(PlanLines, NameShadowsAndHaze) {
    Settings settings;
    EXPECT_TRUE(plannedLine("shadows", "builtin:suns", settings).modelled);
    EXPECT_EQ(plannedLine("shadows", "builtin:suns", settings).why,
              "the brightest sun casts shadows: --shadows pcf");
    EXPECT_FALSE(plannedLine("haze", "builtin:suns", settings).modelled);
    settings.haze = true;
    EXPECT_TRUE(plannedLine("haze", "builtin:suns", settings).modelled);
    // Only punctual lights: they cast shadows only if selected.
    Settings lamps;
    EXPECT_FALSE(plannedLine("shadows", "builtin:spots", lamps).modelled);
    lamps.shadow_lights = 2;
    EXPECT_EQ(plannedLine("shadows", "builtin:spots", lamps).why,
              "2 point or spot lights cast shadows: --shadows pcf");
    lamps.shadow_lights = 0;
    lamps.shadows = Shadows::off;
    EXPECT_EQ(plannedLine("shadows", "builtin:spots", lamps).why, "--shadows off: no map, no pass");
}

TEST(PlanLines, SayWhatLayersCost) {
    Settings settings;
    settings.gbuffer = GBufferEncoding::standard;
    const auto ends = [](const Requirements::Line& line, const std::string& with) {
        EXPECT_TRUE(line.why.ends_with("; " + with)) << line.why;
    };
    const auto stored = [](gpu::uint words) {
        return std::to_string(4 * words) + " bytes per pixel in deferred's G-buffer, none in forward_plus";
    };
    ends(plannedLine("sheen", "builtin:layers", settings), stored(gpu::SHEEN_WORDS));
    settings.msaa = 4;
    ends(plannedLine("anisotropy", "builtin:layers", settings), stored(4 * gpu::ANISOTROPY_WORDS));
    settings.msaa = 1;
    settings.gbuffer = GBufferEncoding::full;
    ends(plannedLine("clear coats", "builtin:layers", settings), stored(gpu::CLEARCOAT_FULL_WORDS));
    settings.layers = Layers::forward;
    ends(plannedLine("iridescence", "builtin:layers", settings), "--layers forward: no G-buffer");
    EXPECT_EQ(plannedLine("transmission", "builtin:layers", settings).why.find("MiB"), std::string::npos);
}

TEST(PlanLines, SayWhatLayersLeaveOut) {
    Settings settings;
    const auto says = [&](const char* layer, const std::string& what) {
        return plannedLine(layer, "builtin:layers", settings).why.find("; " + what) != std::string::npos;
    };
    EXPECT_TRUE(says("sheen", "what lies below is dimmed by the view's share alone"));
    EXPECT_TRUE(says("iridescence", "evaluated at v.h as given"));
    EXPECT_TRUE(says("anisotropy", "its direction is made perpendicular to the mapped normal"));
    EXPECT_FALSE(says("anisotropy", "an environment's highlights")) << "it has none";
    EXPECT_NE(plannedLine("transmission", "builtin:transmission", settings).why.find("no highlights"),
              std::string::npos);
    Scene sky = loadScene("builtin:layers");
    sky.environment = Environment{"sky", Image(4, 2, 3, 1.0f)};
    for (const Ibl ibl : {Ibl::split, Ibl::sampled}) {
        settings.ibl = ibl;
        for (const Requirements::Line& line :
             planLines(makeSceneView(sky, viewRequest(settings)), settings)) {
            if (line.what != "anisotropy") continue;
            EXPECT_EQ(line.why.find("off by 20 to 50 % in the mean") != std::string::npos, ibl == Ibl::split);
        }
    }
}

TEST(PlanLines, SayWhatTransmissionCosts) {
    Settings settings;
    settings.size = {256, 192};  // 0.75 MiB of 16 bytes
    const auto why = [&] { return plannedLine("transmission", "builtin:transmission", settings).why; };
    EXPECT_TRUE(why().ends_with("both paths copy depth and the picture, 1.00 MiB with its mip chain"))
        << why();
    settings.transparency = Transparency::off;
    EXPECT_TRUE(why().ends_with("--transparency off: not drawn")) << why();
}

}  // namespace
}  // namespace diptych
