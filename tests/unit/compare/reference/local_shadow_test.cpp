// SPDX-License-Identifier: MIT
// The reference's results for shadows of point and spot lights: their visibility, and the distance to a
// shadow's edge.
#include "tests/support/reference_scene.h"

namespace diptych::reference {
namespace {

// A floor at z = 0 under a point light 2 m above the origin and a spot light 2 m to the left of it. A
// screen 1 m above the floor covers x > 0; its edge casts the point light's shadow from x = 0 on. The
// image's only pixel is at x.
ReferenceImage seenAt(double x, std::vector<std::size_t> casters, bool edges = true) {
    Scene scene = floorScene();
    add(scene, quad({0, -4, 1}, {4, 0, 0}, {0, 8, 0}));
    scene.lights = {lightOf(LightKind::point, {0, 0, 2}), lightOf(LightKind::spot, {-2, 0, 2}, {1, 0, -1}),
                    lightOf(LightKind::rect, {0, 0, 2})};
    const View view = viewFrom({x - 2, 0, 0.5}, {x, 0, 0}, 1, 1);
    const Pose pose = poseAt(scene, 0);
    return draw({.scene = scene,
                 .pose = pose,
                 .view = view,
                 .lights = pose.lights,
                 .casters = std::move(casters),
                 .shadow_edges = edges,
                 .mode = ReferenceMode::scene,
                 .keep = {},
                 .progress = {}});
}

double visibility(const ReferenceImage& image) {
    return double{image.channels.at(Channel::local_visibility).at(0, 0)};
}

TEST(ReferenceLocalShadow, IsTheMeanWeightedByIrradiance) {
    EXPECT_EQ(visibility(seenAt(-0.2, {0})), 1);
    EXPECT_EQ(visibility(seenAt(0.2, {0})), 0);
    EXPECT_EQ(visibility(seenAt(0.2, {})), 1) << "none casts";
    EXPECT_EQ(visibility(seenAt(0.2, {2})), 1) << "an area light is none of these";
    // The point light is occluded. The spot light is visible: the direction is 47.7 degrees from the
    // vertical, 2.7 degrees off the axis of its cone of 45 degrees.
    const double point = 1 / (4 + 0.04);
    const glm::dvec3 path = glm::normalize(glm::dvec3(2.2, 0, -2));
    const double cone = coneFactor(0, pi / 4, glm::dot(path, glm::normalize(glm::dvec3(1, 0, -1))));
    const double spot = cone * cone / (4 + 2.2 * 2.2);
    EXPECT_NEAR(visibility(seenAt(0.2, {0, 1})), spot / (point + spot), 1e-6);
}

// Relative to the distance from the light, across its rays; slightly less, because only eight directions
// are searched.
TEST(ReferenceLocalShadow, EdgesAreFoundWhereTheyAre) {
    for (const double x : {-0.4, -0.05, 0.05, 0.4}) {
        const ReferenceImage image = seenAt(x, {0});
        const double distance = std::hypot(x, 2.0), across = std::abs(x) * 2 / distance;
        const double found = double{image.local_shadow_edge.at(0, 0, 0)};
        EXPECT_LE(found, across / distance * 1.15) << x << ": lines that leave the light are not parallel";
        EXPECT_GE(found, 0.8 * across / distance) << x;
        EXPECT_NEAR(double{image.local_shadow_edge.at(0, 0, 1)}, 2 / distance / (distance * distance) / pi,
                    1e-5)
            << "what it would reflect unshadowed";
        EXPECT_TRUE(image.shadow_edge.empty()) << "no sun casts";
    }
    EXPECT_TRUE(seenAt(0.2, {}).local_shadow_edge.empty());
}

// Without edges and visibility the light is the same, and the image has neither channel.
TEST(ReferenceLocalShadow, LightNeedsNoEdges) {
    for (const double x : {-0.2, 0.2}) {
        const ReferenceImage with = seenAt(x, {0, 1}), without = seenAt(x, {0, 1}, false);
        EXPECT_EQ(without.channels.at(Channel::lit).data, with.channels.at(Channel::lit).data);
        EXPECT_TRUE(without.local_shadow_edge.empty());
        for (const Channel channel : {Channel::shadow_visibility, Channel::local_visibility}) {
            EXPECT_EQ(with.channels.count(channel), 1u);
            EXPECT_EQ(without.channels.count(channel), 0u);
        }
    }
}

}  // namespace
}  // namespace diptych::reference
