// SPDX-License-Identifier: MIT
// Cascades that only cover the visible view depths.
#include "shared/shadow/cascades.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>

#include <algorithm>

namespace diptych {
namespace {

Cascades fitTo(const std::optional<DepthRange>& shown, int count) {
    View view;
    view.width = 320;
    view.height = 180;
    view.camera.near = 0.1;
    view.camera.world_from_camera =
        glm::inverse(glm::lookAt(glm::dvec3(0, 2, 0), glm::dvec3(30, 0, 0), {0.01, 1, 0.02}));
    Bounds bounds;
    bounds.min = {-200, -1, -200};
    bounds.max = {200, 30, 200};
    return fitCascades(view, bounds, glm::normalize(glm::dvec3(0.3, 1, 0.2)),
                       {.size = 1024, .count = count, .shown = shown});
}

TEST(CascadesShown, BeginAndEndWithWhatIsShown) {
    for (const int count : {1, 2, 4})
        for (const DepthRange& shown : {DepthRange{0.2, 90}, {5, 40}, {50, 60}, {33, 33}}) {
            const Cascades cascades = fitTo(shown, count);
            ASSERT_EQ(cascades.areas.size(), static_cast<std::size_t>(count));
            EXPECT_LE(cascades.areas.front().begin, shown.near);
            EXPECT_NEAR(cascades.areas.front().begin, shown.near, 1e-4 * shown.near);
            EXPECT_GE(cascades.areas.back().end, shown.far);
            EXPECT_NEAR(cascades.areas.back().end, shown.far, 1e-4 * shown.far);
            for (std::size_t i = 1; i < cascades.areas.size(); ++i)
                EXPECT_GE(cascades.areas[i].end, cascades.areas[i - 1].end);
        }
}

TEST(CascadesShown, AreNoCoarserThanThoseOfTheView) {
    for (const int count : {1, 2, 3, 4}) {
        const std::vector<CascadeArea> view = fitTo({}, count).areas;
        for (const DepthRange& shown : {DepthRange{0.1, 500}, {0.2, 90}, {5, 40}, {50, 60}, {33, 33}}) {
            const std::vector<CascadeArea> fitted = fitTo(shown, count).areas;
            EXPECT_LE(fitted.back().texel, view.back().texel) << count << " " << shown.far;
            const auto finer = [](const CascadeArea& a, const CascadeArea& b) { return a.texel < b.texel; };
            EXPECT_LE(std::ranges::max_element(fitted, finer)->texel,
                      std::ranges::max_element(view, finer)->texel);
        }
        EXPECT_LT(fitTo(DepthRange{5, 40}, count).areas.back().texel, 0.5 * view.back().texel) << count;
    }
}

}  // namespace
}  // namespace diptych
