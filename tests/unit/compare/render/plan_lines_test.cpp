// SPDX-License-Identifier: MIT
// Lines of the plan that do not come from the scene's file.
#include "compare/render/path_plan.h"

#include "compare/render/frame_facts.h"
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

}  // namespace
}  // namespace diptych
