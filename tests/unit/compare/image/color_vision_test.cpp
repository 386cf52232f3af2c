// SPDX-License-Identifier: MIT
// Colour maps for readers with normal, protan and deutan vision: lightness rises all the way, neighbours
// differ, and the colours of special values are none of the map's.
#include "tests/support/color_vision.h"
#include "compare/image/channel_image.h"
#include "compare/image/heat.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace diptych {
namespace {

constexpr int samples = 64;

// Lightness must rise over each 64th of the map. Fifths must differ by 15 (CIELAB), halves in lightness
// by 30.
void expectReadable(Rgb8 (*colorAt)(double), const ColorVision& vision) {
    for (int i = 1; i <= samples; ++i)
        EXPECT_GT(labOf(colorAt(1.0 * i / samples), vision)[0],
                  labOf(colorAt((i - 1.0) / samples), vision)[0] + 0.2)
            << vision.name << ", step " << i;
    for (int i = 1; i <= 5; ++i)
        EXPECT_GT(distance(colorAt((i - 1) / 5.0), colorAt(i / 5.0), vision), 15)
            << vision.name << ", fifth " << i;
    for (const double t : {0.0, 0.5})
        EXPECT_GT(labOf(colorAt(t + 0.5), vision)[0] - labOf(colorAt(t), vision)[0], 30) << vision.name;
}

double nearest(const Rgb8& color, Rgb8 (*colorAt)(double), const ColorVision& vision) {
    double min = HUGE_VAL;
    for (int i = 0; i <= samples; ++i)
        min = std::min(min, distance(color, colorAt(1.0 * i / samples), vision));
    return min;
}

TEST(ColorMaps, LightnessRisesForEveryReader) {
    for (const ColorVision& vision : colorVisions)
        for (const auto map : {heatColor, errorColor}) expectReadable(map, vision);
}

TEST(ColorMaps, SpecialValuesAreNoneOfTheMaps) {
    for (const ColorVision& vision : colorVisions) {
        EXPECT_GT(nearest(nonfiniteColor, heatColor, vision), 25) << vision.name;
        EXPECT_GT(nearest(nonfiniteColor, errorColor, vision), 25) << vision.name;
        EXPECT_GT(nearest(beyondColor, errorColor, vision), 20) << vision.name;
        EXPECT_GT(distance(beyondColor, nonfiniteColor, vision), 25) << vision.name;
        EXPECT_GT(distance({0, 0, 0}, errorColor(0), vision), 15) << vision.name << ": no error is black";
    }
}

// Negative control: the map from blue over green, yellow and red to white falls from yellow to red.
TEST(ColorMaps, ARainbowDoesNotRise) {
    for (const ColorVision& vision : colorVisions)
        EXPECT_LT(labOf({250, 150, 110}, vision)[0], labOf({235, 215, 60}, vision)[0]) << vision.name;
}

}  // namespace
}  // namespace diptych
