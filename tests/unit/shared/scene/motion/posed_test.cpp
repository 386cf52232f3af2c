// SPDX-License-Identifier: MIT
// Vertices deformed by joints and morph targets, compared with values computed by hand.
#include "shared/scene/motion/posed.h"

#include "shared/scene/motion/bounds.h"
#include "shared/scene/motion/deformation_bounds.h"
#include "shared/scene/view.h"
#include "tests/support/shapes.h"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>

#include <cmath>
#include <numbers>
#include <string>

namespace diptych {
namespace {

constexpr double quarter = std::numbers::pi / 2;
const glm::dvec3 X(1, 0, 0), Y(0, 1, 0), Z(0, 0, 1);

glm::dmat4 moved(const glm::dvec3& by) {
    return glm::translate(glm::dmat4(1), by);
}
glm::dmat4 turned(double angle, const glm::dvec3& about) {
    return glm::rotate(glm::dmat4(1), angle, about);
}

// One triangle in z = 0 that faces +Z, on node 0. Nodes 1 and 2 are the joints of skin 0.
Scene triangle() {
    Scene scene;
    scene.materials.resize(1);
    scene.meshes.resize(1);
    scene.meshes[0].primitives = {triangleOfAMetre()};
    scene.nodes.resize(3);
    scene.nodes[0].mesh = 0;
    return scene;
}
Primitive& only(Scene& scene) {
    return scene.meshes[0].primitives[0];
}

// Vertex 0 follows the first joint, vertex 1 both joints by half, vertex 2 the second.
Scene skinned(const glm::dmat4& first, const glm::dmat4& second) {
    Scene scene = triangle();
    only(scene).joint_sets = {
        {{{0, 1, 0, 0}, {0, 1, 0, 0}, {0, 1, 0, 0}}, {{1, 0, 0, 0}, {0.5f, 0.5f, 0, 0}, {0, 1, 0, 0}}}};
    scene.skins.resize(1);
    scene.skins[0].joints = {1, 2};
    scene.skins[0].joint_from_mesh.assign(2, glm::mat4(1));
    scene.nodes[0].skin = 0;
    scene.nodes[1].parent_from_node = first;
    scene.nodes[2].parent_from_node = second;
    return scene;
}

PosedVertices posed(const Scene& scene) {
    const Pose pose = poseAt(scene, 0);
    return posedVertices(scene, pose, pose.instances.at(0));
}
void expectNear(const glm::dvec3& got, const glm::dvec3& expected, const std::string& what,
                double tolerance = 1e-15) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(got[c], expected[c], tolerance) << what << " component " << c;
}

// ---- skins -------------------------------------------------------------------------------------------

TEST(Posed, AVertexStandsAtTheMeanOfItsJoints) {
    const PosedVertices v = posed(skinned(moved({0, 0, 2}), moved({0, 4, 0}) * turned(quarter, Z)));
    expectNear(v.positions[0], {0, 0, 2}, "the first joint alone");
    // half of (1, 0, 0) + (0, 0, 2), and half of (1, 0, 0) rotated to +Y and moved by 4
    expectNear(v.positions[1], {0.5, 2.5, 1}, "half and half");
    expectNear(v.positions[2], {-1, 4, 0}, "the second joint alone");
    expectNear(v.tangents[0], X, "a tangent of the first");
    expectNear(v.tangents[2], Y, "a tangent of the second");
    expectNear(v.tangents[1], glm::normalize(X + Y), "half and half");
    for (int i = 0; i < 3; ++i) expectNear(v.normals[static_cast<std::size_t>(i)], Z, "both turn about it");
}

TEST(Posed, InverseBindMatricesComeFirst) {
    Scene scene = skinned(turned(quarter, Z), glm::dmat4(1));
    scene.skins[0].joint_from_mesh[0] = glm::mat4(moved({3, 0, 0}));
    expectNear(posed(scene).positions[0], {0, 3, 0}, "moved to (3, 0, 0), then turned");
}

TEST(Posed, TheTransformOfASkinnedMeshsOwnNodeCountsNothing) {
    Scene scene = skinned(moved({0, 0, 2}), moved({0, 4, 0}));
    const PosedVertices before = posed(scene);
    scene.nodes.push_back({});
    scene.nodes[3].parent_from_node = turned(1, X);
    scene.nodes[0].parent = 3;
    scene.nodes[0].parent_from_node = moved({100, 0, 0});
    const PosedVertices after = posed(scene);
    EXPECT_EQ(before.positions, after.positions);
    EXPECT_EQ(before.normals, after.normals);
    // The node's transform applies to a primitive without joints.
    only(scene).joint_sets.clear();
    EXPECT_GT(posed(scene).positions[0].x, 99);
}

TEST(Posed, JointsFollowTheirParentsAndAnimations) {
    Scene scene = skinned(glm::dmat4(1), glm::dmat4(1));
    scene.nodes[2].parent = 1;
    scene.nodes[1].transform = 0;
    scene.transforms = {{}};
    Animation raise;
    raise.keyframes = {{Interpolation::linear, {0, 2}, {0, 0, 0, 0, 0, 6}, 3}};
    raise.channels = {{1, 0, AnimatedPart::translation}};
    scene.animations = {raise};
    const Pose pose = poseAt(scene, 1);
    for (const glm::dvec3& p : posedPositions(scene, pose, pose.instances.at(0))) EXPECT_EQ(p.z, 3);
}

TEST(Posed, TheSecondSetOfJointsCountsToo) {
    Scene scene = skinned(glm::dmat4(1), moved({0, 0, 8}));
    std::vector<JointSet>& sets = only(scene).joint_sets;
    sets[0].weights.assign(3, {0.5f, 0.25f, 0, 0});
    sets.push_back({std::vector<glm::u16vec4>(3, {0, 0, 0, 1}), std::vector<glm::vec4>(3, {0, 0, 0, 0.25f})});
    for (const glm::dvec3& p : posed(scene).positions) EXPECT_EQ(p.z, 4) << "two quarters of 8";
}

// float32 weights of 1/3 add up to 1 + 3e-8, which would be an error of 30 m at a million kilometres.
TEST(Posed, WeightsThatRoundDoNotMove) {
    Scene scene = skinned(moved({1e9, 0, 0}), moved({1e9, 0, 0}));
    const float third = 1.0f / 3;
    only(scene).joint_sets[0] = {std::vector<glm::u16vec4>(3, {0, 1, 1, 0}),
                                 std::vector<glm::vec4>(3, {third, third, third, 0})};
    expectNear(posed(scene).positions[2], {1e9, 1, 0}, "as both joints have it", 1e-6);
}

// Scaled by half along x: the inverse transpose transforms the normal of the plane x + z = 0 to (2, 0, 1).
TEST(Posed, NormalsMoveByTheInverseTranspose) {
    Scene scene = skinned(glm::scale(glm::dmat4(1), {0.5, 1, 1}), glm::dmat4(1));
    only(scene).normals.assign(3, glm::normalize(glm::vec3(1, 0, 1)));
    only(scene).tangents.assign(3, glm::vec4(glm::normalize(glm::vec3(1, 0, -1)), 1));
    const PosedVertices v = posed(scene);
    expectNear(v.normals[0], glm::normalize(glm::dvec3(2, 0, 1)), "squashed", 1e-7);
    EXPECT_NEAR(glm::dot(v.normals[0], v.tangents[0]), 0, 1e-7) << "the tangent stays in the plane";
    expectNear(v.normals[2], glm::normalize(glm::dvec3(1, 0, 1)), "not", 1e-7);
}

// Vertex 1 follows both joints by half; values by hand. First case: joints at rest and scaled by half
// along x. The mean of the inverse transposes 1 and (2, 1, 1) takes (1, 0, 1) to (1.5, 0, 1). The mean of
// the matrices is (0.75, 1, 1), and its inverse takes it to (4/3, 0, 1). Second case: joints at rest and
// twice as large, rotated from +Z to +X. Half the latter's inverse takes +Z to (0.5, 0, 1); cofactors
// would give (4, 0, 1).
TEST(Posed, ANormalIsTheMeanOfWhatEachJointMakesOfIt) {
    const glm::dmat4 squashed = glm::scale(glm::dmat4(1), {0.5, 1, 1}),
                     larger = turned(quarter, Y) * glm::scale(glm::dmat4(1), glm::dvec3(2));
    const auto normals = [](const glm::dmat4& second, const glm::vec3& rest, bool blended) {
        Scene scene = skinned(glm::dmat4(1), second);
        only(scene).normals.assign(3, rest);
        const Pose pose = poseAt(scene, 0);
        return posedVertices(scene, pose, pose.instances.at(0), blended).normals;
    };
    const glm::vec3 slope = glm::normalize(glm::vec3(1, 0, 1));
    expectNear(normals(squashed, slope, false)[1], glm::normalize(glm::dvec3(1.5, 0, 1)), "joints", 1e-7);
    expectNear(normals(squashed, slope, true)[1], glm::normalize(glm::dvec3(4, 0, 3)), "blended", 1e-7);
    expectNear(normals(larger, Z, false)[1], glm::normalize(glm::dvec3(0.5, 0, 1)), "joints");
    // The mean of the matrices has the columns (0.5, 0, -1), (0, 1.5, 0), (1, 0, 0.5).
    expectNear(normals(larger, Z, true)[1], glm::normalize(glm::dvec3(1, 0, 0.5)), "blended");
    for (const std::size_t one : {0u, 2u}) {
        expectNear(normals(squashed, slope, false)[one], normals(squashed, slope, true)[one], "one joint");
        expectNear(normals(larger, Z, false)[one], normals(larger, Z, true)[one], "one joint");
    }
    // Mirrored as a whole, both stay on the front side.
    const glm::dmat4 mirror = glm::scale(glm::dmat4(1), {1, 1, -1});
    for (const bool blended : {false, true}) {
        Scene scene = skinned(mirror, mirror * squashed);
        only(scene).normals.assign(3, slope);
        const Pose pose = poseAt(scene, 0);
        EXPECT_LT(posedVertices(scene, pose, pose.instances.at(0), blended).normals[1].z, 0);
    }
}

// A joint with scale 0 contributes no normal; a joint that flattens determines it.
TEST(Posed, JointsWithoutAnInverseLeaveNoNaN) {
    const glm::vec3 slope = glm::normalize(glm::vec3(1, 0, 1));
    for (const auto& [factors, expected] :
         {std::pair{glm::dvec3(0), glm::dvec3(slope)}, {glm::dvec3(1, 1, 0), Z}}) {
        Scene scene = skinned(glm::dmat4(1), glm::scale(glm::dmat4(1), factors));
        only(scene).normals.assign(3, slope);
        expectNear(posed(scene).normals[1], expected, "half and half", 1e-7);
    }
}

// Mirrored by its joints: the triangle's winding is reversed, and its front stays on the same side.
TEST(Posed, MirroredJointsKeepTheFront) {
    const glm::dmat4 mirror = glm::scale(glm::dmat4(1), {-1, 1, 1});
    Scene scene = skinned(mirror, mirror);
    for (const bool flat : {false, true}) {
        only(scene).flat = flat;
        const PosedVertices v = posed(scene);
        expectNear(v.positions[1], -X, "mirrored");
        for (const glm::dvec3& n : v.normals) expectNear(n, Z, flat ? "flat" : "smooth");
    }
}

// A joint that moves little of the mesh does not affect its front, wherever it is in the list.
TEST(Posed, AMirroredJointOfFewVerticesLeavesTheFront) {
    Scene scene = skinned(glm::scale(glm::dmat4(1), {-1, 1, 1}), glm::dmat4(1));
    only(scene).joint_sets[0].weights.assign(3, {0, 1, 0, 0});
    for (const bool prepared : {false, true}) {
        if (prepared) prepareDeformationBounds(scene);
        const Pose pose = poseAt(scene, 0);
        EXPECT_GT(glm::determinant(glm::dmat3(pose.instances.at(0).world_from_object)), 0);
        for (const glm::dvec3& n : posed(scene).normals) expectNear(n, Z, "not turned round");
    }
}

// ---- morph targets -----------------------------------------------------------------------------------

TEST(Posed, TargetsAddTheirShare) {
    Scene scene = triangle();
    only(scene).targets = {{{{0, 0, 4}, {0, 0, 0}, {0, 0, 0}}, {{2, 0, 0}, {0, 0, 0}, {0, 0, 0}}, {}},
                           {{}, {}, {{-1, 1, 0}, {0, 0, 0}, {0, 0, 0}}}};
    scene.meshes[0].weights = {0.5f, 1};
    scene.nodes[0].parent_from_node = moved({0, 0, 10});
    const PosedVertices v = posed(scene);
    EXPECT_EQ(v.positions[0], glm::dvec3(0, 0, 12));
    EXPECT_EQ(v.positions[1], glm::dvec3(1, 0, 10));
    expectNear(v.normals[0], glm::normalize(glm::dvec3(1, 0, 1)), "(0, 0, 1) + half of (2, 0, 0)");
    expectNear(v.tangents[0], Y, "(1, 0, 0) + (-1, 1, 0)");
    expectNear(v.tangents[1], X, "nothing is added");
}

// glTF 2.0, 3.7.2.2: a colour with its deltas is clamped to 0..1; texture coordinates are not.
TEST(Posed, TargetsMoveColorsAndTexcoords) {
    Scene scene = triangle();
    Primitive& p = only(scene);
    p.colors.assign(3, {0.5f, 0.5f, 0.5f, 1});
    p.texcoords[1] = {{0, 0}, {1, 0}, {0, 1}};
    p.targets.resize(2);
    p.targets[0].colors = {{2, -2, 0.25f, -0.5f}, {0, 0, 0, 0}, {0, 0, 0, 0}};
    p.targets[1].texcoords[1] = {{0, 0}, {4, -4}, {0, 0}};
    scene.meshes[0].weights = {0.5f, 0.25f};
    PosedVertices v = posed(scene);
    EXPECT_TRUE(v.texcoords[0].empty()) << "nothing moves them";
    EXPECT_EQ(v.texcoords[1], (std::vector<glm::dvec2>{{0, 0}, {2, -1}, {0, 1}}));
    EXPECT_EQ(v.colors,
              (std::vector<glm::dvec4>{{1, 0, 0.625, 0.75}, {0.5, 0.5, 0.5, 1}, {0.5, 0.5, 0.5, 1}}));
    scene.meshes[0].weights = {0, 0.25f};
    v = posed(scene);
    EXPECT_TRUE(v.colors.empty()) << "no target with a weight moves them";
    EXPECT_FALSE(v.texcoords[1].empty());
}

TEST(Posed, ANodesWeightsComeBeforeItsMeshsAndAnAnimationsBeforeBoth) {
    Scene scene = triangle();
    only(scene).targets = {{{{0, 0, 8}, {0, 0, 8}, {0, 0, 8}}, {}, {}}};
    const auto heightAt = [&](double seconds) {
        const Pose pose = poseAt(scene, seconds);
        return posedPositions(scene, pose, pose.instances.at(0))[0].z;
    };
    scene.meshes[0].weights = {0.5f};
    EXPECT_EQ(heightAt(0), 4);
    scene.weights = {{0.25f}};
    scene.nodes[0].weights = 0;
    EXPECT_EQ(heightAt(0), 2);
    Animation grow;
    grow.keyframes = {{Interpolation::linear, {0, 1}, {0, 1}, 1}};
    grow.channels = {{0, 0, AnimatedPart::weights}};
    scene.animations = {grow};
    EXPECT_FALSE(poseAt(scene, 0).instances.at(0).deformed()) << "all weights are 0";
    EXPECT_EQ(heightAt(0), 0);
    EXPECT_EQ(heightAt(0.75), 6);
}

// The target moves the vertex to (1, 0, 0), then the joint rotates it to +Y. In the other order it would
// stay on +X.
TEST(Posed, TargetsComeBeforeJoints) {
    Scene scene = skinned(turned(quarter, Z), glm::dmat4(1));
    only(scene).targets = {{{{2, 0, 0}, {0, 0, 0}, {0, 0, 0}}, {}, {}}};
    scene.meshes[0].weights = {0.5f};
    expectNear(posed(scene).positions[0], Y, "moved, then turned");
}

// The target tilts the triangle by 45 degrees; the NORMAL at rest has no effect.
TEST(Posed, AFlatTrianglesNormalFollowsIt) {
    Scene scene = triangle();
    only(scene).targets = {{{{0, 0, 0}, {0, 0, 0}, {0, 0, 1}}, {}, {}}};
    scene.meshes[0].weights = {1};
    expectNear(posed(scene).normals[0], Z, "not flat: no target moves the normal");
    only(scene).flat = true;
    for (const glm::dvec3& n : posed(scene).normals)
        expectNear(n, glm::normalize(glm::dvec3(0, -1, 1)), "flat");
}

// ---- undeformed primitives, and limits ---------------------------------------------------------------

TEST(Posed, WithoutJointsAndTargetsItIsTheNodesTransform) {
    Scene scene = triangle();
    scene.nodes[0].parent_from_node =
        moved({1, 2, 3}) * turned(quarter, X) * glm::scale(glm::dmat4(1), {1, 2, 1});
    const Pose pose = poseAt(scene, 0);
    EXPECT_FALSE(pose.instances.at(0).deformed());
    const PosedVertices v = posed(scene);
    expectNear(v.positions[2], {1, 2, 5}, "(0, 1, 0), twice as long, turned to +Z");
    expectNear(v.normals[2], -Y, "+Z turned to -Y");
    EXPECT_EQ(v.positions, posedPositions(scene, pose, pose.instances[0]));
}

TEST(Posed, BoundsAreThoseOfWhatIsPosed) {
    Scene scene = skinned(glm::dmat4(1), moved({0, 0, 8}));
    Bounds bounds = worldBounds(scene, poseAt(scene, 0));
    EXPECT_EQ(bounds.min, glm::dvec3(0, 0, 0));
    EXPECT_EQ(bounds.max, glm::dvec3(1, 1, 8));
    scene.nodes[2].parent_from_node = moved({0, 0, 2e18});
    EXPECT_TRUE(std::isnan(posed(scene).positions[2].z)) << "beyond maxCoordinate is nowhere";
    bounds = worldBounds(scene, poseAt(scene, 0));
    EXPECT_EQ(bounds.max, glm::dvec3(1, 0, 1e18)) << "the vertex between them is at its edge";
}

// The default view does not follow motion; neither do lights placed around the scene.
TEST(Posed, TheDefaultViewIsThatOfTheStart) {
    Scene scene = triangle();
    scene.nodes[0].transform = 0;
    scene.transforms = {{}};
    Animation leave;
    leave.keyframes = {{Interpolation::linear, {0, 1}, {0, 0, 0, 50, 0, 0}, 3}};
    leave.channels = {{0, 0, AnimatedPart::translation}};
    scene.animations = {leave};
    const Pose start = poseAt(scene, 0), end = poseAt(scene, 1);
    EXPECT_EQ(worldBounds(scene, end).min.x, 50);
    EXPECT_EQ(boundsAtStart(scene, end).min.x, 0);
    EXPECT_EQ(makeView(scene, start, "", 4, 3).eye(), makeView(scene, end, "", 4, 3).eye());
}

}  // namespace
}  // namespace diptych
