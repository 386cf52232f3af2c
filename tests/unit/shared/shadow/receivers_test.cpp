// SPDX-License-Identifier: MIT
// Only casters whose shadows cannot reach the visible receivers of a map may be skipped.
#include "shared/shadow/receivers.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <random>

namespace diptych {
namespace {

View viewFrom(const glm::dvec3& eye, const glm::dvec3& target, bool orthographic) {
    View view;
    view.width = 320;
    view.height = 180;
    view.camera.near = 0.1;
    view.camera.orthographic = orthographic;
    view.camera.ymag = 3;
    view.camera.world_from_camera = glm::inverse(glm::lookAt(eye, target, {0.01, 1, 0.02}));
    return view;
}

const glm::dvec3 toSun = glm::normalize(glm::dvec3(0.3, 1, 0.2));

// A view into a box of 40 m x 10 m x 40 m, and its cascades.
struct Case {
    View view;
    CascadeRequest request;
    Cascades cascades;
    explicit Case(bool orthographic = false, int kernel = 3)
        : view(viewFrom({1, 3, 2}, {-12, 1, -9}, orthographic)),
          request{.size = 512, .count = 3, .kernel = kernel},
          cascades(fitCascades(view, bounds(), toSun, request)) {}
    static Bounds bounds() {
        Bounds box;
        box.min = {-20, 0, -20};
        box.max = {20, 10, 20};
        return box;
    }
    // x and y are -1 to 1 over the image; world axes from the eye.
    glm::dvec3 at(double x, double y, double depth) const {
        const double side =
            view.camera.orthographic ? view.camera.ymag : depth * std::tan(view.camera.yfov / 2);
        return view.right() * (x * side * view.width / view.height) + view.up() * (y * side) -
               view.backward() * depth;
    }
    glm::dvec3 clip(const CascadeArea& area, const glm::dvec3& position) const {
        return cascades.clipFromWorld(area, request.size, view.eye()) * glm::dvec4(position, 1);
    }
    ReceiverMask mask(const CascadeArea& area, const std::vector<VisibleBox>& seen,
                      bool compares = true) const {
        return {cascades, area, view, seen, request, compares};
    }
    double texel() const { return 2.0 / request.size; }
    double cell() const { return 2.0 / ReceiverMask::cells; }
};

ClipBox pointBox(const glm::dvec3& at) {
    return {at, at};
}

// Everything that is drawn, in one box larger than the view.
const std::vector<VisibleBox> everything{{{0, 0, 0}, {glm::dvec3(90, 0, 0), {0, 90, 0}, {0, 0, 90}}}};

// Takes any visible point in a cascade's part of the view, up to its edges. Casters between it and the
// light matter, and so do casters beside these within the filter.
TEST(ReceiverMask, HoldsWhateverCastsOnWhatIsSeen) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> part(-1, 1);
    for (const bool orthographic : {false, true}) {
        const Case test(orthographic);
        for (const CascadeArea& area : test.cascades.areas) {
            const ReceiverMask ofAll = test.mask(area, everything);
            for (int i = 0; i < 4000; ++i) {
                // Half of them on the sides of the image, a third at the end of the cascade.
                const double x = i % 4 == 0 ? std::copysign(1, part(random)) : part(random);
                const double y = i % 4 == 1 ? std::copysign(1, part(random)) : part(random);
                const double fraction = i % 3 == 0 ? 1 : std::abs(part(random));
                const glm::dvec3 seen = test.at(x, y, area.begin + (area.end - area.begin) * fraction);
                const double angle = 3.15 * part(random);
                glm::dvec3 caster = test.clip(area, seen);
                if (std::abs(caster.x) > 0.95 || std::abs(caster.y) > 0.95) continue;
                // The filter's radius from the centre, plus the surface's sideways bias.
                const double beside = (2 + 2 * std::sqrt(2.0) + 0.5) * test.texel();
                caster += glm::dvec3(std::cos(angle) * beside, std::sin(angle) * beside, 0);
                caster.z = std::abs(part(random));
                EXPECT_TRUE(ofAll.reachedBy(pointBox(caster))) << area.begin << " " << i;
                if (i % 40 != 0) continue;
                const ReceiverMask ofOne = test.mask(area, {{seen, {}}});
                caster.z = test.clip(area, seen).z;
                EXPECT_TRUE(ofOne.reachedBy(pointBox(caster))) << area.begin << " " << i;
            }
        }
    }
}

// A single receiver: casters behind it by a thousandth of the range do not matter. Neither do casters
// beside it by a hundredth of the map beyond the filter. With moments, casters behind it matter.
TEST(ReceiverMask, LeavesOutWhatIsBehindAndBeside) {
    const Case test;
    const CascadeArea& area = test.cascades.areas[1];
    const glm::dvec3 seen = test.at(0.3, -0.2, (area.begin + area.end) / 2), at = test.clip(area, seen);
    const ReceiverMask mask = test.mask(area, {{seen, {}}}), moments = test.mask(area, {{seen, {}}}, false);
    EXPECT_TRUE(mask.reachedBy(pointBox(at)));
    EXPECT_FALSE(mask.reachedBy(pointBox(at - glm::dvec3(0, 0, 1e-3))));
    EXPECT_TRUE(moments.reachedBy(pointBox(at - glm::dvec3(0, 0, 1e-3))));
    const double far = marginOf(test.request) * test.texel() + test.cell() + 0.01;
    for (const glm::dvec3& away : {glm::dvec3(far, 0, 0), {-far, 0, 0}, {0, far, 0}, {0, -far, 0}}) {
        EXPECT_FALSE(mask.reachedBy(pointBox(at + away)));
        EXPECT_FALSE(moments.reachedBy(pointBox(at + away)));
        // A box that extends from there over the receiver matters.
        EXPECT_TRUE(mask.reachedBy({glm::min(at, at + away), glm::max(at, at + away)}));
    }
    // It is not a receiver in another cascade's part of the view.
    const CascadeArea& last = test.cascades.areas[2];
    EXPECT_FALSE(test.mask(last, {{seen, {}}}).reachedBy({{-1, -1, 0}, {1, 1, 1}}));
}

// Geometry outside the view is not a receiver: seen from the light, a view of 60 degrees is a wedge of its
// bounding sphere.
TEST(ReceiverMask, IsNoLargerThanTheView) {
    const Case test;
    for (const CascadeArea& area : test.cascades.areas) {
        const ReceiverMask mask = test.mask(area, everything);
        int held = 0;
        for (int y = 0; y < ReceiverMask::cells; ++y)
            for (int x = 0; x < ReceiverMask::cells; ++x) held += std::isfinite(mask.deepest(x, y));
        EXPECT_GT(held, ReceiverMask::cells * ReceiverMask::cells / 20) << area.begin;
        EXPECT_LT(held, ReceiverMask::cells * ReceiverMask::cells / 2) << area.begin;
    }
}

// The drawn part of the map contains all texels that a filter reads around a point of a cascade's part of
// the view. Either everything or only that point is visible. For one point, the part is no wider than the
// filter and the cells it meets. The first cascade also covers closer points.
void expectDrawn(const Case& test) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> part(-1, 1);
    const double size = test.request.size;
    for (const CascadeArea& area : test.cascades.areas) {
        const ReceiverMask::Texels all = test.mask(area, everything).read();
        const bool first = &area == &test.cascades.areas.front();
        for (int i = 0; i < 180; ++i) {
            const double x = i % 4 == 0 ? std::copysign(1, part(random)) : part(random);
            const double y = i % 4 == 1 ? std::copysign(1, part(random)) : part(random);
            const double fraction = i % 3 == 0 ? 1 : std::abs(part(random));
            const double begin = first && i % 2 == 0 ? 0 : area.begin;
            const glm::dvec3 seen = test.at(x, y, begin + (area.end - begin) * fraction);
            const glm::dvec2 texel = (glm::dvec2(test.clip(area, seen)) + 1.0) / 2.0 * size;
            // Beyond the scene's bounds, which no map covers.
            if (std::min(texel.x, texel.y) < 0 || std::max(texel.x, texel.y) > size) continue;
            const ReceiverMask::Texels one = test.mask(area, {{seen, {}}}).read();
            // Two cells if the point is on their edge, and a texel of rounding on either side.
            const double widest = 2 * marginOf(test.request) + 2 * size / ReceiverMask::cells + 2;
            EXPECT_LE(one.width, widest) << area.begin << " " << i;
            EXPECT_LE(one.height, widest) << area.begin << " " << i;
            for (const double turn : {0.0, 0.7, 1.6, 2.3, 3.2, 3.9, 4.7, 5.5}) {
                // The filter's half diagonal, one more texel, and the surface's bias.
                const double beside = test.request.kernel / std::sqrt(2.0) + 1 + 0.5;
                const glm::dvec2 read = texel + beside * glm::dvec2(std::cos(turn), std::sin(turn));
                const auto column = static_cast<int>(std::floor(read.x)),
                           row = static_cast<int>(std::floor(read.y));
                if (column < 0 || row < 0 || column >= size || row >= size) continue;
                for (const ReceiverMask::Texels& drawn : {all, one})
                    EXPECT_TRUE(column >= drawn.x && column < drawn.x + drawn.width && row >= drawn.y &&
                                row < drawn.y + drawn.height)
                        << area.begin << " " << i << " " << turn;
            }
        }
        const ReceiverMask::Texels none = test.mask(area, {}).read();
        EXPECT_EQ(none.width * none.height, 0);
    }
}

TEST(ReceiverMask, ReadsNothingBesideWhatIsDrawn) {
    for (const bool orthographic : {false, true})
        for (const int kernel : {3, 16}) {  // PCSS's filter is at most 1/32 of the map
            SCOPED_TRACE(kernel);
            expectDrawn(Case(orthographic, kernel));
        }
}

// A cascade's area is a sphere around a part of the view; its map shows a wedge. The wedge's rectangle
// takes a fraction of the square in any rotation, here 0.62, 0.62 and 0.46. A value of 1 would mean that
// nothing is skipped, and a view as wide as this one fills more than a fifth.
TEST(ReceiverMask, DrawsAboutHalfOfAMap) {
    const Case test;
    for (const CascadeArea& area : test.cascades.areas) {
        const ReceiverMask::Texels drawn = test.mask(area, everything).read();
        const double fraction =
            double{1} * drawn.width * drawn.height / (test.request.size * test.request.size);
        EXPECT_GT(fraction, 0.2) << area.begin;
        EXPECT_LT(fraction, 0.75) << area.begin;
    }
}

}  // namespace
}  // namespace diptych
