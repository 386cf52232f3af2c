// SPDX-License-Identifier: MIT
// The reference's images of animated scenes: skins, morph targets and animations at a given time.
#include "tests/support/reference_scene.h"

#include "compare/reference/scene/geometry.h"
#include "tests/support/files.h"

#include <atomic>
#include <stdexcept>

namespace diptych::reference {
namespace {

ReferenceImage drawnAt(const Scene& scene, double seconds, const View& view,
                       const std::filesystem::path& keep = {},
                       const std::function<void(double)>& progress = {}) {
    const Pose pose = poseAt(scene, seconds);
    std::optional<Checkpoint> checkpoint;
    return draw({.scene = scene,
                 .pose = pose,
                 .view = view,
                 .lights = pose.lights,
                 .casters = everyLight(pose.lights),
                 .shadowed_environment = true,
                 .mode = ReferenceMode::scene,
                 .samples = 1,
                 .surfaces = nullptr,
                 .keep = keptAt(keep, checkpoint),
                 .progress = progress});
}

glm::vec3 at(const ReferenceImage& drawn, Channel channel, int x, int y) {
    const Image& image = drawn.channels.at(channel);
    glm::vec3 result(0);
    for (int c = 0; c < image.components; ++c) result[c] = image.at(x, y, c);
    return result;
}
bool isSurface(const ReferenceImage& drawn, int x, int y) {
    return at(drawn, Channel::material_id, x, y).x >= 0;
}

// A patch of 1 m at x = -1, animated from 0 s to 1 s, without other objects. Seen from +Z with one pixel
// per metre: 5 by 5 pixels around the origin.
Scene patch() {
    Scene scene;
    scene.materials = {matte()};
    scene.meshes.resize(1);
    scene.meshes[0].primitives = {quad({-1.5f, -0.5f, 0}, {1, 0, 0}, {0, 1, 0})};
    scene.nodes.resize(3);
    scene.nodes[0].mesh = 0;
    scene.lights = {lightOf(LightKind::directional, {0, 0, 0})};
    return scene;
}
const View fromAbove = viewFrom({0, 0, 10}, {0, 0, 0}, 5, 5, 2 * std::atan(0.25));
constexpr int left = 1, right = 3, row = 2;

void animate(Scene& scene, int node, AnimatedPart part, std::vector<float> values, std::size_t width) {
    Animation a;
    a.keyframes = {{Interpolation::linear, {0, 1}, std::move(values), width}};
    a.channels = {{node, 0, part}};
    scene.animations.push_back(a);
    if (part == AnimatedPart::weights) return;
    scene.nodes[static_cast<std::size_t>(node)].transform = static_cast<int>(scene.transforms.size());
    scene.transforms.emplace_back();
}

// Each moves the patch from x = -1 to x = 1, and 1 m up.
Scene byItsNode() {
    Scene scene = patch();
    animate(scene, 0, AnimatedPart::translation, {0, 0, 0, 2, 0, 1}, 3);
    return scene;
}
Scene byAJoint() {
    Scene scene = patch();
    Primitive& p = scene.meshes[0].primitives[0];
    p.joint_sets = {{std::vector<glm::u16vec4>(4, {1, 0, 0, 0}), std::vector<glm::vec4>(4, {1, 0, 0, 0})}};
    // The first joint does not move.
    scene.skins = {{"", {2, 1}, {glm::mat4(1), glm::mat4(1)}, -1}};
    scene.nodes[0].skin = 0;
    animate(scene, 1, AnimatedPart::translation, {0, 0, 0, 2, 0, 1}, 3);
    return scene;
}
Scene byATarget() {
    Scene scene = patch();
    scene.meshes[0].primitives[0].targets = {{std::vector<glm::vec3>(4, {2, 0, 1}), {}, {}}};
    scene.meshes[0].weights = {0};
    animate(scene, 0, AnimatedPart::weights, {0, 1}, 1);
    return scene;
}
struct Mover {
    const char* name;
    Scene (*scene)();
};
const Mover movers[] = {{"node", byItsNode}, {"joint", byAJoint}, {"target", byATarget}};

TEST(ReferenceMotion, WhatMovesIsDrawnWhereItIs) {
    for (const Mover& mover : movers) {
        const Scene scene = mover.scene();
        const ReferenceImage start = drawnAt(scene, 0, fromAbove), end = drawnAt(scene, 1, fromAbove);
        EXPECT_TRUE(isSurface(start, left, row)) << mover.name;
        EXPECT_FALSE(isSurface(start, right, row)) << mover.name;
        EXPECT_FALSE(isSurface(end, left, row)) << mover.name;
        ASSERT_TRUE(isSurface(end, right, row)) << mover.name;
        EXPECT_NEAR(at(start, Channel::depth, left, row).x, 10, 1e-5) << mover.name;
        EXPECT_NEAR(at(end, Channel::depth, right, row).x, 9, 1e-5) << mover.name;
        EXPECT_NEAR(at(end, Channel::lit, right, row).x, 1 / pi, 1e-6) << mover.name;
    }
}

// Half the weight of a joint at rest, half of one with half the width; by hand, see
// Posed.ANormalIsTheMean...
TEST(ReferenceMotion, NormalsOfSkinsGoByEachJointOrByTheirMean) {
    Scene scene = patch();
    Primitive& p = scene.meshes[0].primitives[0];
    p.normals.assign(4, glm::normalize(glm::vec3(1, 0, 1)));
    p.joint_sets = {
        {std::vector<glm::u16vec4>(4, {0, 1, 0, 0}), std::vector<glm::vec4>(4, {0.5f, 0.5f, 0, 0})}};
    scene.skins = {{"", {1, 2}, {glm::mat4(1), glm::mat4(1)}, -1}};
    scene.nodes[0].skin = 0;
    scene.nodes[2].parent_from_node[0].x = 0.5;
    const Pose pose = poseAt(scene, 0);
    for (const auto& [normals, expected] : {std::pair{SkinNormals::joints, glm::vec3(1.5f, 0, 1)},
                                            {SkinNormals::blended, glm::vec3(4, 0, 3)}}) {
        const ReferenceImage drawn = draw({.scene = scene,
                                           .pose = pose,
                                           .view = fromAbove,
                                           .lights = pose.lights,
                                           .skin_normals = normals,
                                           .mode = ReferenceMode::scene});
        ASSERT_TRUE(isSurface(drawn, left, row));
        const glm::vec3 off = at(drawn, Channel::normals, left, row) - glm::normalize(expected);
        EXPECT_LT(glm::length(off), 1e-6) << nameOf(normals);
    }
}

// The patch changes from black to white and begins to glow.
TEST(ReferenceMotion, MaterialsAreThoseOfTheTime) {
    Scene scene = patch();
    Animation a;
    a.keyframes = {{Interpolation::linear, {0, 1}, {0, 0, 0, 1, 1, 1, 1, 1}, 4},
                   {Interpolation::linear, {0, 1}, {0, 0, 0, 2, 2, 2}, 3}};
    a.channels = {{.keyframes = 0, .part = AnimatedPart::base_color, .object = 0},
                  {.keyframes = 1, .part = AnimatedPart::emissive, .object = 0}};
    scene.animations.push_back(a);
    for (const auto& [seconds, expected] : {std::pair{0.0, 0.0}, {0.5, 0.5 / pi + 1}, {1.0, 1 / pi + 2}})
        EXPECT_NEAR(at(drawnAt(scene, seconds, fromAbove), Channel::lit, left, row).x, expected, 1e-6)
            << seconds;
}

// A joint with half the weight bends the patch: the shading normal follows the joints, the geometric
// normal the corners.
TEST(ReferenceMotion, NormalsArePosedToo) {
    Scene scene = byAJoint();
    scene.animations.clear();
    const double angle = 0.3;
    scene.nodes[1].parent_from_node = glm::rotate(glm::dmat4(1), angle, glm::dvec3(0, 1, 0));
    const ReferenceImage turned = drawnAt(scene, 0, fromAbove);
    const glm::vec3 expected(std::sin(angle), 0, std::cos(angle));
    for (const Channel channel : {Channel::normals, Channel::geometric_normal})
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(at(turned, channel, left, row)[c], expected[c], 1e-6) << debugMode(channel).name;
    EXPECT_NEAR(at(turned, Channel::lit, left, row).x, std::cos(angle) / pi, 1e-6);
}

// The patch moves between a floor and the sun, and its shadow moves with it.
TEST(ReferenceMotion, ShadowsGoWithWhatMoves) {
    for (const Mover& mover : movers) {
        Scene scene = mover.scene();
        scene.meshes.emplace_back().primitives = {quad({-10, -10, -1}, {20, 0, 0}, {0, 20, 0})};
        scene.nodes.emplace_back().mesh = 1;
        // Light from the side, so that the patch does not hide its own shadow.
        scene.lights[0].direction = glm::normalize(glm::dvec3(0, -2, -1));
        const auto shaded = [&](double seconds, double x, double z) {
            const View view = viewFrom({x, -2 * (z + 1), 8}, {x, -2 * (z + 1), 0}, 1, 1, 0.01);
            return at(drawnAt(scene, seconds, view), Channel::lit, 0, 0).x == 0;
        };
        EXPECT_TRUE(shaded(0, -1, 0)) << mover.name;
        EXPECT_FALSE(shaded(0, 1, 1)) << mover.name;
        EXPECT_FALSE(shaded(1, -1, 0)) << mover.name;
        EXPECT_TRUE(shaded(1, 1, 1)) << mover.name;
    }
}

// Morphed colours and texture coordinates affect visible surfaces and shadow casters.
TEST(ReferenceMotion, ColorsAndTexcoordsAreMorphed) {
    Scene scene = patch();
    Primitive& p = scene.meshes[0].primitives[0];
    p.colors.assign(4, glm::vec4(1));
    MorphTarget target;
    target.colors.assign(4, {-1, -0.5f, 0, 0});
    target.texcoords[0].assign(4, {0.25f, -0.5f});
    p.targets = {target};
    scene.meshes[0].weights = {0};
    animate(scene, 0, AnimatedPart::weights, {0, 1}, 1);
    const ReferenceImage start = drawnAt(scene, 0, fromAbove), half = drawnAt(scene, 0.5, fromAbove);
    const glm::vec3 expected(0.5f, 0.75f, 1);
    for (int c = 0; c < 3; ++c) {
        EXPECT_EQ(at(start, Channel::albedo, left, row)[c], 1);
        EXPECT_NEAR(at(half, Channel::albedo, left, row)[c], expected[c], 1e-6);
    }
    EXPECT_NEAR(at(half, Channel::texcoords, left, row).x, 0.5 + 0.125, 1e-6);
    EXPECT_NEAR(at(half, Channel::texcoords, left, row).y, 0.5 - 0.25, 1e-6);
}

TEST(ReferenceMotion, AMaskThatIsMorphedAwayThrowsNoShadow) {
    Scene scene = patch();
    scene.meshes.emplace_back().primitives = {quad({-10, -10, -1}, {20, 0, 0}, {0, 20, 0}, 1)};
    scene.nodes.emplace_back().mesh = 1;
    scene.materials.push_back(scene.materials[0]);
    scene.materials[0].alpha_mode = AlphaMode::mask;
    Primitive& p = scene.meshes[0].primitives[0];
    p.colors.assign(4, glm::vec4(1));
    p.targets.resize(1);
    p.targets[0].colors.assign(4, {0, 0, 0, -1});
    scene.meshes[0].weights = {0};
    animate(scene, 0, AnimatedPart::weights, {0, 1}, 1);
    scene.lights[0].direction = glm::normalize(glm::dvec3(0, -2, -1));
    const View view = viewFrom({-1, -2, 8}, {-1, -2, 0}, 1, 1, 0.01);
    EXPECT_EQ(at(drawnAt(scene, 0.25, view), Channel::lit, 0, 0).x, 0) << "alpha is 0.75";
    EXPECT_GT(at(drawnAt(scene, 0.75, view), Channel::lit, 0, 0).x, 0) << "alpha is 0.25";
}

// In mode surface, too, shadow and occlusion rays hit the posed geometry.
TEST(ReferenceMotion, RaysMeetThePose) {
    for (const Mover& mover : movers) {
        const Scene scene = mover.scene();
        for (const double seconds : {0.0, 1.0}) {
            const Pose pose = poseAt(scene, seconds);
            const Geometry geometry(scene, pose, {0, 0, 10});
            const auto met = [&](double x) {
                return geometry.meets({{x, 0, 0}, {0, 0, -1}, 0, 100, {}}, [](const Hit&) { return true; });
            };
            EXPECT_EQ(met(-1), seconds == 0) << mover.name;
            EXPECT_EQ(met(1), seconds == 1) << mover.name;
        }
    }
}

// A vertex without a valid position removes its triangle and nothing else.
TEST(ReferenceMotion, WhatIsMovedOutOfReachIsNotThere) {
    Scene scene = byATarget();
    scene.meshes[0].primitives[0].targets[0].positions = {{0, 0, 0}, {1e18f, 0, 0}, {0, 0, 0}, {0, 0, 0}};
    scene.animations.clear();
    scene.meshes[0].weights = {100};
    const ReferenceImage drawn =
        drawnAt(scene, 0, viewFrom({-1, 0, 10}, {-1, 0, 0}, 9, 9, 2 * std::atan(0.05)));
    EXPECT_FALSE(isSurface(drawn, 7, 6)) << "below the diagonal, of the corner that is gone";
    EXPECT_TRUE(isSurface(drawn, 1, 2)) << "above it";
}

// A checkpoint of the same image at another time is not used, whatever moves.
TEST(ReferenceMotion, AnImageOfAnotherTimeIsBegunAnew) {
    View view = fromAbove;
    view.width = view.height = 40;  // nine tiles
    for (const Mover& mover : movers)
        for (const double seconds : {1.0, 0.5}) {
            const Scene scene = mover.scene();
            const std::filesystem::path keep = folder() / "kept";
            std::atomic<int> done{0}, again{0};
            EXPECT_THROW(drawnAt(scene, 1, view, keep,
                                 [&](double) {
                                     if (++done == 4) throw std::runtime_error("stop");
                                 }),
                         std::runtime_error);
            drawnAt(scene, seconds, view, keep, [&](double) { ++again; });
            if (seconds == 1)
                EXPECT_LE(again, 9 - 4) << mover.name << ": the same time";
            else
                EXPECT_EQ(again, 9) << mover.name << ": another";
        }
}

}  // namespace
}  // namespace diptych::reference
