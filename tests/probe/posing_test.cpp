// SPDX-License-Identifier: MIT
// Skinned and morphed vertices of the compute shaders, compared with deformation in double.
#include "shared/draw/posing.h"

#include "shared/scene/builtin/builtin.h"
#include "shared/scene/load.h"
#include "shared/scene/model/tangents.h"
#include "shared/vulkan/device/device.h"
#include "tests/probe/posing_builder.h"
#include "tests/probe/posing_compare.h"
#include "tests/probe/probe.h"
#include "tests/support/errors.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace diptych {
namespace {

glm::dmat4 placed(const glm::dvec3& at, const glm::dvec3& scale = glm::dvec3(1)) {
    return glm::scale(glm::translate(glm::dmat4(1), at), scale);
}

PosingErrors compared(const Scene& scene, const std::string& what) {
    PosingErrors errors;
    comparePosing(scene, poseAt(scene, 0), what, errors);
    return errors;
}

TEST(Posing, OfTheSceneOfWhatMoves) {
    const Scene scene = loadScene("builtin:motion");
    PosingErrors errors;
    for (const double seconds : {0.0, 0.35, 1.0, 1.7, 3.1})
        for (const SkinNormals normals : {SkinNormals::joints, SkinNormals::blended})
            comparePosing(scene, poseAt(scene, seconds), fmt::format("at {} s", seconds), errors, normals);
    printErrors("builtin:motion", errors);
}

TEST(Posing, OfFilesAtThreeTimes) {
    const std::filesystem::path folder =
        std::filesystem::path(DIPTYCH_SOURCE_DIR) / "../shared/assets/scenes";
    bool any = false;
    for (const std::string file : {"cesium_man/CesiumMan.gltf", "morph_stress_test/morph_stress_test.glb"}) {
        if (!std::filesystem::exists(folder / file)) continue;
        any = true;
        const Scene scene = loadScene(folder / file);
        PosingErrors errors;
        for (const double seconds : {0.3, 0.6, 1.3})
            comparePosing(scene, poseAt(scene, seconds), fmt::format("{} at {} s", file, seconds), errors);
        printErrors(file, errors);
    }
    if (!any) GTEST_SKIP() << "there are no scenes in " << folder;
}

// Every combination of joint sets, flat and smooth surfaces, with and without targets, mirrored and not.
TEST(Posing, OfRandomMeshesInRandomPoses) {
    PosingErrors errors;
    for (int n = 0; n < 32; ++n) {
        PosingBuilder builder(static_cast<unsigned>(n));
        PosingChoice c;
        c.joint_sets = n % 4;
        c.targets = n / 4 % 2 == 0 && c.joint_sets > 0 ? 0 : 1 + builder.below(5);
        c.flat = n / 8 % 2 == 1;
        c.root = placed(10.0 * builder.vector(), glm::dvec3(n / 16 % 2 == 1 ? -1.5 : 1.5, 1.5, 1.5));
        c.inverse_binds = n % 8 != 3;
        Scene scene = builder.scene(c);
        if (c.joint_sets > 0) builder.addSkin(scene, c);  // two instances of the mesh, two skins
        const Pose pose = poseAt(scene, 0);
        ASSERT_EQ(pose.boxes.size(), c.joint_sets > 0 ? 2u : 1u);
        for (const SkinNormals normals : {SkinNormals::joints, SkinNormals::blended})
            comparePosing(scene, pose, fmt::format("mesh {}, {}", n, nameOf(normals)), errors, normals);
    }
    printErrors("random meshes", errors);
    EXPECT_EQ(errors.missing, 0u);
    EXPECT_GT(errors.normal, 0);  // some were checked
    EXPECT_GT(errors.tangent_bound, 0);
}

// Smooth and flat, with either texture coordinate set and a transform, before joints and without.
TEST(Posing, TangentsAreMadeOfTheMorphedSurface) {
    PosingErrors errors;
    for (int n = 0; n < 16; ++n) {
        PosingBuilder builder(static_cast<unsigned>(100 + n));
        PosingChoice c;
        c.fresh_tangents = true;
        c.targets = 3;
        c.flat = n % 2 == 1;
        c.map_texcoord = n / 2 % 2;
        c.joint_sets = n / 4 % 2;
        c.joints = 1;
        c.root = placed(builder.vector(), glm::dvec3(n / 8 % 2 == 1 ? -1 : 1, 1, 1));
        comparePosing(builder.scene(c), poseAt(builder.scene(c), 0), fmt::format("mesh {}", n), errors);
    }
    printErrors("tangents made anew", errors);
    EXPECT_GT(errors.fresh_tangent, 0);
}

TEST(Posing, TangentsFollowANormalMapThatAnAnimationTurnsAndMirrors) {
    const Scene scene = makeBuiltin("tangents");
    PosingErrors errors;
    for (const double seconds : {1.5, 3.5})
        comparePosing(scene, poseAt(scene, seconds), fmt::format("at {} s", seconds), errors);
    printErrors("of turned maps", errors);
    EXPECT_GT(errors.fresh_tangent, 0);
}

// A fan of triangles 40,000 times as long as wide, stretched unevenly by its map, and some triangles as
// wide as long on the other side. The tangent at the hub is the sum of all. Differences of products of the
// long edges were off by 25 degrees.
TEST(Posing, TangentsOfThinTrianglesKeepTheirDirection) {
    Primitive fan;
    fan.positions = {{0, 0, 0}};
    fan.texcoords[0] = {{0.5f, 0.5f}};
    const int thin = 6600, wide = 40;
    for (int n = 0; n <= thin + wide; ++n) {
        const double degrees = n <= thin ? 80 + 10.0 * n / thin : 90 + 200.0 * (n - thin) / wide;
        const glm::dvec2 at(std::cos(glm::radians(degrees)), std::sin(glm::radians(degrees)));
        fan.positions.push_back({at, 0});
        fan.texcoords[0].push_back({0.5 + 0.5 * at.x, 0.5 - 0.5 * (n <= thin ? at.y : at.y + 3 * at.x)});
        if (n == 0) continue;
        const auto last = static_cast<std::uint32_t>(n + 1);
        fan.indices.insert(fan.indices.end(), {0, last - 1, last});
    }
    fan.normals.assign(fan.positions.size(), {0, 0, 1});
    fan.targets.resize(1);
    fan.targets[0].positions.assign(fan.positions.size(), {0, 0, 0.05f});
    fan.targets[0].positions[0] = {0, 0, 0};
    Scene scene;
    scene.materials.resize(1);
    scene.materials[0].normal_texture.texture = 0;
    makeTangents(fan, scene.materials[0].normal_texture);
    fan.tangents_made = true;
    scene.meshes = {{"", {fan}, {1}}};
    scene.nodes.resize(1);
    scene.nodes[0].mesh = 0;
    scene.materials[0].normal_texture.texture = -1;
    PosingErrors errors;
    comparePosing(scene, poseAt(scene, 0), "fan", errors);
    printErrors("of thin triangles", errors);
    EXPECT_GT(errors.fresh_tangent, 0);
}

TEST(Posing, FarFromTheMeshsOrTheWorldsOriginAndAtAnyScale) {
    for (const auto& [what, offset, root, scale] :
         {std::tuple{"10,000 times its size from its own origin", glm::dvec3(6e3, -8e3, 0), placed({0, 0, 0}),
                     1.0},
          {"1,000 km from the world's origin", glm::dvec3(0), placed({6e5, 2e4, -8e5}), 1.0},
          {"joints scaled by 1e-6", glm::dvec3(0), placed({1, 2, 3}), 1e-6},
          {"joints scaled by 1e6", glm::dvec3(0), placed({1, 2, 3}), 1e6}})
        for (const bool flat : {false, true}) {
            PosingBuilder builder(7);
            PosingChoice c;
            c.joint_sets = 2;
            c.targets = 2;
            c.flat = flat;
            c.offset = offset;
            c.root = root;
            c.joint_scale = scale;
            printErrors(what, compared(builder.scene(c), what));
        }
}

TEST(Posing, OfAThousandTargets) {
    PosingBuilder builder(8);
    PosingChoice c;
    c.targets = 1000;
    c.cells = 4;
    printErrors("1,000 targets", compared(builder.scene(c), "a thousand targets"));
}

TEST(Posing, OfAsManyJointsAsNumbersOf16BitsName) {
    PosingBuilder builder(9);
    PosingChoice c;
    c.joint_sets = 1;
    c.joints = 65535;
    c.cells = 30;
    Scene scene = builder.scene(c);
    JointSet& set = scene.meshes[0].primitives[0].joint_sets[0];
    set.joints[0] = {65534, 0, 0, 0};
    set.weights[0] = {1, 0, 0, 0};
    printErrors("65,535 joints", compared(scene, "65,535 joints"));
}

TEST(Posing, AMeshWithJointsMovesAsAWholeWithoutASkin) {
    PosingBuilder builder(14);
    PosingChoice c;
    c.joint_sets = 2;
    c.targets = 2;
    c.root = placed({3, 4, 5}, glm::dvec3(1, 2, 1));
    Scene scene = builder.scene(c);
    scene.nodes[0].skin = -1;
    compared(scene, "without a skin");
}

// If a vertex follows one joint, any of its four, both methods give the same normal bits.
TEST(Posing, OneJointTurnsANormalEitherWayToTheSameBits) {
    PosingBuilder builder(15);
    PosingChoice c;
    c.joint_sets = 2;
    c.root = placed({3, 4, 5}, {-1.5, 0.7, 1.2});
    Scene scene = builder.scene(c);
    const Pose pose = poseAt(scene, 0);
    const auto differing = [&] {
        const std::vector<glm::vec3> a = posedNormals(scene, pose, SkinNormals::joints),
                                     b = posedNormals(scene, pose, SkinNormals::blended);
        std::size_t count = 0;
        for (std::size_t v = 0; v < a.size(); ++v) count += a[v] != b[v];
        return count;
    };
    EXPECT_GT(differing(), 10u) << "several joints";
    std::vector<JointSet>& sets = scene.meshes[0].primitives[0].joint_sets;
    for (std::size_t v = 0; v < sets[0].weights.size(); ++v)
        for (std::size_t s = 0; s < 2; ++s) {
            sets[s].weights[v] = glm::vec4(0);
            if (s == v / 4 % 2) sets[s].weights[v][static_cast<int>(v % 4)] = 1;
        }
    EXPECT_EQ(differing(), 0u) << "one";
}

// A joint of scale 0 collapses its vertices to a point, where no direction is defined.
TEST(Posing, ACollapsedJointHasNoDirections) {
    PosingBuilder builder(10);
    PosingChoice c;
    c.joint_sets = 1;
    Scene scene = builder.scene(c);
    glm::dmat4& joint = scene.nodes[2].parent_from_node;
    joint = glm::scale(joint, glm::dvec3(0));
    JointSet& set = scene.meshes[0].primitives[0].joint_sets[0];
    const std::size_t half = set.joints.size() / 2;
    for (std::size_t v = 0; v < half; ++v) {
        set.joints[v] = {};
        set.weights[v] = {1, 0, 0, 0};
    }
    const Pose pose = poseAt(scene, 0);
    const PosedVertices exact = posedVertices(scene, pose, pose.instances.at(0));
    for (std::size_t v = 0; v < half; ++v) ASSERT_EQ(exact.normals[v], glm::dvec3(0));
    PosingErrors errors;
    comparePosing(scene, pose, "collapsed", errors);
    printErrors("a collapsed joint", errors);
}

// NaN in float32 and in double, so the triangles are not rendered.
TEST(Posing, BeyondWhatCoordinatesMayBeIsNaN) {
    for (const bool skinned : {false, true}) {
        PosingBuilder builder(11);
        PosingChoice c;
        c.joint_sets = skinned ? 1 : 0;
        c.targets = 2;
        Scene scene = builder.scene(c);
        MorphTarget& target = scene.meshes[0].primitives[0].targets[0];
        scene.meshes[0].weights[0] = 2;
        for (std::size_t v = 0; v < target.positions.size(); v += 3) target.positions[v].y += 2e18f;
        PosingErrors errors;
        const Pose pose = poseAt(scene, 0);
        ASSERT_EQ(pose.boxes.size(), 1u);
        comparePosing(scene, pose, "beyond", errors);
        EXPECT_EQ(errors.missing, (target.positions.size() + 2) / 3);
        EXPECT_GT(errors.vertices, errors.missing);
    }
}

// On some devices all loops of a shader share an iteration limit; more targets would be dropped silently.
TEST(Posing, MoreTargetsAtOnceThanAShaderAddsUpAreAnError) {
    const auto posed = [](bool flat, std::size_t targets, bool positions_alone, const std::string& what) {
        PosingBuilder builder(12);
        PosingChoice c;
        c.targets = 1;
        c.cells = 1;
        c.flat = flat;
        Scene scene = builder.scene(c);
        Mesh& mesh = scene.meshes[0];
        MorphTarget& target = mesh.primitives[0].targets[0];
        if (positions_alone) target = {target.positions, {}, {}};
        mesh.primitives[0].targets.resize(targets, MorphTarget(target));
        mesh.weights.assign(targets, 1e-4f);
        mesh.weights.back() = 0;  // weight 0 does not count
        printErrors(what, compared(scene, what));
    };
    posed(false, 10001, false, "10,000 targets of every attribute");
    posed(false, 65001, true, "65,000 targets of positions");
    posed(true, 16251, true, "16,250 targets of flat triangles");
    for (const auto& [flat, targets, positions_alone, deltas, rounds] :
         {std::tuple{false, 10835, false, 65004, 65004},
          {false, 65002, true, 65001, 65001},
          {true, 16252, true, 16251, 65004}})
        EXPECT_EQ(
            faultOf([&, flat = flat, targets = targets, alone = positions_alone] {
                posed(flat, static_cast<std::size_t>(targets), alone, "too many");
            }),
            fmt::format("morph targets change {} attributes of a vertex at once, which needs {} additions; "
                        "the limit is 65000",
                        deltas, rounds));
}

// Views at one time share a pose; any change of its inputs makes a new one.
TEST(Posing, ViewsOfOneMomentShareAPose) {
    PosingBuilder builder(13);
    PosingChoice c;
    c.joint_sets = 1;
    c.targets = 2;
    Scene scene = builder.scene(c);
    Device& device = probeDevice();
    Uploader uploader(device);
    const Geometry geometry(device, uploader, scene);
    Posings posings(device, uploader, scene, geometry);
    uploader.flush();
    const OwnedPipelineLayout layout = makePosingLayout(device);
    Pipelines pipelines(device, layout);
    const Pose rest = poseAt(scene, 0);
    constexpr SkinNormals joints = SkinNormals::joints;
    auto first = posings.at(rest, Skinning::compute, joints, pipelines);
    EXPECT_EQ(posings.at(rest, Skinning::compute, joints, pipelines), first);
    EXPECT_EQ(posings.made(), 1u);
    EXPECT_NE(posings.at(rest, Skinning::vertex, joints, pipelines), first);
    EXPECT_NE(posings.at(rest, Skinning::compute, SkinNormals::blended, pipelines), first);
    std::size_t made = posings.made();
    for (const auto& change : std::vector<void (*)(Pose&)>{[](Pose& p) { p.skins[0][0][3].x += 1e-9; },
                                                           [](Pose& p) { p.weights[0][0] += 1e-9; },
                                                           [](Pose& p) { p.boxes[0].origin.x += 1; }}) {
        Pose other = rest;
        change(other);
        EXPECT_NE(posings.at(other, Skinning::compute, joints, pipelines), first);
        EXPECT_EQ(posings.made(), ++made);
    }
    Pose lit = rest;
    lit.lights.emplace_back();
    EXPECT_EQ(posings.at(lit, Skinning::compute, joints, pipelines), first);
    first.reset();
    posings.at(rest, Skinning::compute, joints, pipelines);
    EXPECT_EQ(posings.made(), made + 1);  // the old pose was released
}

}  // namespace
}  // namespace diptych
