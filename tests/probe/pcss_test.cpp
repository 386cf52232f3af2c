// SPDX-License-Identifier: MIT
// Width of the soft shadows' filter on steep receivers, compared with sums in double: the mean over many
// positions within a texel is an integral.
#include "shared/contract/features.h"
#include "tests/probe/probe.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace diptych {
namespace {

// Lengths in texels. A blocker of one depth covers everything on one side, from `edge` on across the
// receiver's slope. The other side has a low one that no direction to the disc meets: it is farther than
// the cone is wide there.
struct Steep {
    static constexpr double scale = 1.0 / 1024;  // depth per texel
    static constexpr int kernel = 3, parts = 16;

    double slope, blocker;  // the plane's rise per texel; height above the receiver
    double disc, edge, depth = 0.7, widest = 40;

    double low() const { return 0.75 * blocker; }
    double wanted() const { return std::min(2 * disc * blocker, widest); }
    double maxBias() const { return std::max(2.0, blocker / 2); }  // rise of the plane that is compared
    double limit() const { return 2 * maxBias() / slope - 1; }
    double width() const { return std::max(std::min(wanted(), limit()), double{kernel}); }
};

// Mean visibility over positions within a texel, with the slope in the direction `up`.
double seen(const Steep& of, const glm::dvec2& up) {
    const glm::dvec3 normal = glm::normalize(glm::dvec3(-of.slope * up, 1));
    constexpr double other_side = 9;
    std::vector<float> in;
    for (int i = 0; i < Steep::parts * Steep::parts; ++i)
        for (const double value :
             {100 + (i % Steep::parts + 0.5) / Steep::parts, 100 + (i / Steep::parts + 0.5) / Steep::parts,
              normal.x, normal.y, normal.z, of.depth, Steep::scale, -up.y, up.x, of.edge,
              of.depth + of.blocker * Steep::scale, other_side, of.depth + of.low() * Steep::scale, of.disc,
              of.widest})
            in.push_back(static_cast<float>(value));
    double sum = 0;
    for (const float visibility :
         Probes().run("pcss", in, 15, 1, {{gpu::FEATURE_shadow_kernel, Steep::kernel}}))
        sum += double{visibility};
    return sum / (Steep::parts * Steep::parts);
}

// Lit part of a disc whose rim fades over a texel, without what rises too high.
double litPart(const Steep& of, double width) {
    double lit = 0, all = 0;
    const int reach = Steep::parts * static_cast<int>(width / 2 + 2);
    for (int j = -reach; j < reach; ++j)
        for (int i = -reach; i < reach; ++i) {
            const double x = (i + 0.5) / Steep::parts, y = (j + 0.5) / Steep::parts;
            const double weight = std::clamp(width / 2 + 0.5 - std::hypot(x, y), 0.0, 1.0) *
                                  std::clamp(of.maxBias() - of.slope * x, 0.0, 1.0);
            all += weight;
            if (y <= of.edge) lit += weight;
        }
    return lit / all;
}

const glm::dvec2 slopeWays[] = {{1, 0}, {0, 1}, {0.6, 0.8}};

// Half the blocker's height limits the filter, or two texels under low blockers, and the kernel's width is
// the least.
TEST(Pcss, ASteepReceiverNarrowsTheFilter) {
    const Steep limited[] = {
        {.slope = 20, .blocker = 200, .disc = 0.035, .edge = 2.25},
        {.slope = 40, .blocker = 200, .disc = 0.035, .edge = 1},
        {.slope = 0.5, .blocker = 3.5, .disc = 1.5, .edge = 1.75, .depth = 1 - 10 * Steep::scale}};
    for (const Steep& of : limited)
        for (const glm::dvec2& up : slopeWays) {
            ASSERT_LT(of.limit(), of.wanted());
            const double visibility = seen(of, up);
            EXPECT_NEAR(visibility, litPart(of, of.width()), 0.002) << of.slope << " " << up.x;
            // Negative controls: another limit, or none, would show.
            for (const double other : {0.9 * of.width(), 1.1 * of.width(), 2 * of.width(), of.wanted()})
                EXPECT_GT(std::abs(visibility - litPart(of, other)), 0.02) << of.slope << " " << other;
        }
    const Steep steepest{.slope = 100, .blocker = 200, .disc = 0.035, .edge = 0.75};
    ASSERT_LT(steepest.limit(), Steep::kernel);
    for (const glm::dvec2& up : slopeWays)
        EXPECT_NEAR(seen(steepest, up), litPart(steepest, Steep::kernel), 0.002);
}

// Less steep, it is as wide as the disc seen through the blocker, up to the widest. The low blocker on the
// other side would make it narrower.
TEST(Pcss, OtherwiseTheConeOfTheDiscIsTheFilter) {
    const Steep flat{.slope = 2, .blocker = 200, .disc = 0.035, .edge = 3.5};
    Steep widest = flat;
    widest.widest = 10;
    for (const Steep& of : {flat, widest})
        for (const glm::dvec2& up : slopeWays) {
            ASSERT_EQ(of.width(), of.wanted());
            EXPECT_NEAR(seen(of, up), litPart(of, of.wanted()), 0.002) << up.x;
            EXPECT_GT(std::abs(seen(of, up) - litPart(of, 2 * of.disc * (of.blocker + of.low()) / 2)), 0.02)
                << "without the cone";
        }
}

}  // namespace
}  // namespace diptych
