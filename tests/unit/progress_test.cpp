// SPDX-License-Identifier: MIT
#include "compare/progress.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace diptych;

TEST(Progress, LineShowsHowFar) {
    EXPECT_EQ(progressLine("a.gltf", 0.5, "images", 60), "a.gltf [==========           ]  50 % images");
    EXPECT_EQ(progressLine("a.gltf", 0, "x", 24), "a.gltf [      ]   0 % x");
    EXPECT_EQ(progressLine("a.gltf", 1, "x", 24), "a.gltf [======] 100 % x");
}

// A line that is too wide would wrap and could not be wiped.
TEST(Progress, LineNeverExceedsItsColumns) {
    const std::string name(300, 'n');
    for (const std::string& what : {std::string(), std::string("a.gltf"), name})
        for (std::size_t columns = 0; columns < 120; ++columns)
            for (const double fraction : {-1.0, 0.0, 0.3, 1.0, 7.0, std::nan("")})
                EXPECT_LE(progressLine(what, fraction, "images and meshes", columns).size(), columns);
}

// "...and the end of the name", which tells more than its beginning.
TEST(Progress, LongNamesKeepTheirEnd) {
    EXPECT_TRUE(progressLine("a/long/way/to/Sponza.gltf", 0.5, "x", 40).starts_with("..."))
        << progressLine("a/long/way/to/Sponza.gltf", 0.5, "x", 40);
}
