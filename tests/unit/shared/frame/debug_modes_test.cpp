// SPDX-License-Identifier: MIT
// Channels of layers, and the names of metrics.
#include "shared/frame/debug_modes.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace diptych {
namespace {

TEST(DebugModes, MetricsHaveNamesOfTheirOwn) {
    std::set<std::string_view> names;
    for (const Metric metric :
         {Metric::relative, Metric::absolute, Metric::angular, Metric::axial, Metric::exact})
        names.insert(nameOf(metric));
    EXPECT_EQ(names.size(), 5u);
    EXPECT_FALSE(names.contains("?"));
    EXPECT_EQ(nameOf(Metric::axial), "axial");
}

// Angles need three components, and a range of unit vectors.
TEST(DebugModes, AnglesAreBetweenUnitVectors) {
    for (const DebugMode& mode : debugModes()) {
        EXPECT_EQ(isAngle(mode.metric), mode.domain == Domain::unit || mode.domain == Domain::unit_or_zero)
            << mode.name;
        EXPECT_TRUE(!isAngle(mode.metric) || mode.width == 3) << mode.name;
    }
    EXPECT_EQ(debugMode(gpu::DEBUG_anisotropy_direction).metric, Metric::axial) << "it has no sign";
}

TEST(DebugModes, LayersHaveTheirChannels) {
    for (const DebugMode& mode : debugModes()) {
        const std::string name(mode.name);
        const auto names = [&](const char* word) { return name.find(word) != std::string::npos; };
        const gpu::uint layer = names("clearcoat")     ? gpu::LAYER_CLEARCOAT
                                : names("anisotropy")  ? gpu::LAYER_ANISOTROPY
                                : names("sheen")       ? gpu::LAYER_SHEEN
                                : names("iridescence") ? gpu::LAYER_IRIDESCENCE
                                                       : 0u;
        EXPECT_EQ(layerOf(mode.number), layer) << name;
    }
}

}  // namespace
}  // namespace diptych
