// SPDX-License-Identifier: MIT
// Marks in an image that is flipped, scaled and shifted; the median colour of a chart.
#include "compare/external/placement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace diptych::external {
namespace {

constexpr int ids_width = 160, ids_height = 120, mark_side = 12;
const std::vector<int> mark_ids{3, 4, 5, 6, 7};
// Left and top corners of the marks, from the image's centre; no flip or rotation maps them to themselves.
constexpr std::pair<int, int> mark_corners[] = {{-58, -44}, {30, -40}, {-40, 10}, {44, 24}, {-10, -20}};

Image markIds() {
    Image ids(ids_width, ids_height, 1, 1.0f);
    for (std::size_t i = 0; i < mark_ids.size(); ++i)
        for (int v = 0; v < mark_side; ++v)
            for (int u = 0; u < mark_side; ++u)
                ids.at(ids_width / 2 + mark_corners[i].first + u,
                       ids_height / 2 + mark_corners[i].second + v) = static_cast<float>(mark_ids[i]);
    return ids;
}
// The marks as another renderer draws them: `bright` where a pixel's centre shows one.
Image marksDrawn(const Placement& placement, float bright = 1) {
    const Image ids = markIds();
    Image image(ids_width, ids_height, 3);
    for (int y = 0; y < ids_height; ++y)
        for (int x = 0; x < ids_width; ++x) {
            const double u = (x + 0.5 - ids_width / 2.0 - placement.shift.x) / placement.scale.x,
                         v = (y + 0.5 - ids_height / 2.0 - placement.shift.y) / placement.scale.y;
            const int i = static_cast<int>(std::floor((placement.mirrored ? -u : u) + ids_width / 2.0)),
                      j = static_cast<int>(std::floor((placement.upside_down ? -v : v) + ids_height / 2.0));
            if (i >= 0 && j >= 0 && i < ids_width && j < ids_height && ids.at(i, j) >= 3)
                image.at(x, y, 1) = bright;
        }
    return image;
}

TEST(CalibrationMarks, AreFoundWhereTheyAre) {
    for (const Placement& placed : {Placement{},
                                    {true, false, {1, 1}, {0, 0}},
                                    {false, true, {1, 1}, {0, 0}},
                                    {true, true, {1, 1}, {2, -1}},
                                    {false, false, {1.1, 1.1}, {0, 0}},
                                    {false, false, {0.7, 0.7}, {0, 3}},
                                    {false, false, {1, 1}, {-2, 1}},
                                    {false, false, {1.0, 0.95}, {1, 0}}}) {
        const std::optional<Placement> found = findPlacement(markIds(), mark_ids, marksDrawn(placed, 0.01f));
        ASSERT_TRUE(found);
        EXPECT_EQ(found->upside_down, placed.upside_down);
        EXPECT_EQ(found->mirrored, placed.mirrored);
        EXPECT_NEAR(found->scale.x, placed.scale.x, 0.01);
        EXPECT_NEAR(found->scale.y, placed.scale.y, 0.01);
        EXPECT_NEAR(found->shift.x, placed.shift.x, 0.3);
        EXPECT_NEAR(found->shift.y, placed.shift.y, 0.3);
        EXPECT_LT(found->residual, 0.4);
    }
}

TEST(CalibrationMarks, AreNotFoundWhereTheyAreMissingDarkOrMoved) {
    const Image ids = markIds();
    EXPECT_FALSE(findPlacement(ids, mark_ids, marksDrawn({}, 1e-6f))) << "black";
    EXPECT_TRUE(findPlacement(ids, mark_ids, marksDrawn({}, 2e-6f)));
    const std::vector<int> four{3, 4, 5, 6, 99}, three{3, 4, 5};
    EXPECT_TRUE(findPlacement(ids, four, marksDrawn({}))) << "a mark that the view does not show";
    EXPECT_FALSE(findPlacement(ids, three, marksDrawn({}))) << "too few";
    Image moved = marksDrawn({});
    for (int y = 0; y < ids_height / 2; ++y)  // one mark, 4 pixels to the right
        for (int x = ids_width - 5; x > ids_width / 2 + 20; --x)
            moved.at(x, y, 1) = x - 4 > ids_width / 2 + 20 ? moved.at(x - 4, y, 1) : 0.0f;
    EXPECT_FALSE(findPlacement(ids, mark_ids, moved)) << "they are on no common line";
}

// Within three pixels of a chart's edge a filter mixes it with others.
TEST(CalibrationMarks, AColourIsTheMedianAwayFromTheEdge) {
    Image ids(20, 10, 1, 1.0f), image(20, 10, 3, 9.0f);
    for (int y = 1; y < 9; ++y)
        for (int x = 2; x < 13; ++x) ids.at(x, y) = 2;  // inside: x 5 to 9, y 4 and 5
    for (int y = 4; y < 6; ++y)
        for (int x = 5; x < 10; ++x)
            for (int c = 0; c < 3; ++c)
                image.at(x, y, c) = static_cast<float>(c + 1) + 0.01f * static_cast<float>(x + 5 * (y - 4));
    std::optional<glm::dvec3> median = medianColor(ids, 2, image, {});
    ASSERT_TRUE(median);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR((*median)[c], c + 1.1, 1e-6) << "the upper of ten values' middle two";
    EXPECT_FALSE(medianColor(ids, 7, image, {})) << "no such chart";
    // Where the other renderer shows it: a pixel to the right.
    const Placement right{false, false, {1, 1}, {1, 0}};
    median = medianColor(ids, 2, image, right);
    ASSERT_TRUE(median);
    EXPECT_NEAR(median->x, 1.12, 1e-6) << "two of ten show what is beside it, 9";
    EXPECT_FALSE(medianColor(ids, 2, image, {false, false, {1, 1}, {15, 0}})) << "outside the image";
    Image grey(20, 10, 1, 4.0f);
    median = medianColor(ids, 2, grey, {});
    ASSERT_TRUE(median);
    EXPECT_EQ(*median, glm::dvec3(4));
}

}  // namespace
}  // namespace diptych::external
