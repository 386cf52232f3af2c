// SPDX-License-Identifier: MIT
// Visual checks: their position in the image, their number, and their names.
#include "compare/checks/material_pixels.h"
#include "shared/contract/debug_mode.h"
#include "shared/scene/motion/bounds.h"
#include "tests/support/checks_builder.h"

#include <glm/ext/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <random>

namespace diptych {

// ---- where -------------------------------------------------------------------------------------------

// From (-1, -1) to (1, 1) at 2 m: 25 pixels per metre around (100, 50).
TEST(VisualChecks, TheBoxOfATriangleByHand) {
    const Scene scene = sceneOf(shapeOf({{-1, -1, -2}, {1, -1, -2}, {0, 1, -2}}));
    EXPECT_EQ(boxesOf(checksIn(scene, viewOf())), (Boxes{{75, 25, 125, 75}}));
}

TEST(VisualChecks, NothingBehindTheCameraOrBesideTheImage) {
    EXPECT_EQ(boxesOf(checksIn(sceneOf(squareAt(0, 0, 2)), viewOf())), Boxes{});
    EXPECT_EQ(boxesOf(checksIn(sceneOf(squareAt(0, 0, -0.5f)), viewOf())), Boxes{})
        << "before the near plane";
    EXPECT_EQ(boxesOf(checksIn(sceneOf(squareAt(0, 0, -9)), viewOf(1, 8))), Boxes{})
        << "beyond the far plane";
    EXPECT_EQ(boxesOf(checksIn(sceneOf(squareAt(5.5f, 0, -2)), viewOf())), Boxes{}) << "from pixel 212 on";
}

// A floor 1 m below the eye, from 2 m ahead to 5 m behind, is visible from 1 m on, where 2 m cover 100
// pixels. With a far plane at 3 m, a floor up to 10 m ends at 50 + 50 / 3 = 66.7 pixels.
TEST(VisualChecks, WhatReachesThroughAPlaneIsCutOff) {
    const Scene through = sceneOf(shapeOf({{-1, -1, -2}, {1, -1, -2}, {1, -1, 5}, {-1, -1, 5}}));
    EXPECT_EQ(boxesOf(checksIn(through, viewOf())), (Boxes{{50, 75, 150, 100}}));
    const Scene away = sceneOf(shapeOf({{-1, -1, -2}, {1, -1, -2}, {1, -1, -10}, {-1, -1, -10}}));
    EXPECT_EQ(boxesOf(checksIn(away, viewOf(1, 3))), (Boxes{{75, 66, 125, 75}}));
}

TEST(VisualChecks, WhatReachesOutOfTheImageEndsAtItsEdge) {
    EXPECT_EQ(boxesOf(checksIn(sceneOf(squareAt(4, 2, -2)), viewOf())), (Boxes{{175, 0, 200, 25}}));
}

// Half the height is 2 m: 25 pixels per metre at any distance.
TEST(VisualChecks, OrthographicByHand) {
    View view = viewOf(0, 100);
    view.camera.orthographic = true;
    view.camera.ymag = 2;
    EXPECT_EQ(boxesOf(checksIn(sceneOf(squareAt(1, 0, -7)), view)), (Boxes{{100, 25, 150, 75}}));
}

TEST(VisualChecks, InstancesStandWhereTheirNodesPutThem) {
    Scene scene = sceneOf(squareAt(0, 0, 0));
    scene.nodes[0].parent_from_node = glm::translate(glm::dmat4(1), glm::dvec3(1e7, 2, -4));
    View view = viewOf();
    view.camera.world_from_camera[3] = {1e7, 2, 0, 1};
    EXPECT_EQ(boxesOf(checksIn(scene, view)), (Boxes{{87, 37, 113, 63}})) << "12.5 pixels a metre";
}

TEST(VisualChecks, TransformsThatAreNoNumbersNeedNoCheck) {
    const Scene scene = sceneOf(squareAt(0, 0, -2));
    for (const double bad : {infinity, std::nan("")}) {
        Pose pose = poseAt(scene, 0);
        pose.instances[0].world_from_object[3] = glm::dvec4(glm::dvec3(bad), 1);
        for (const FeatureChecks& feature : visualChecksOf(scene, pose, viewOf(), nullptr, nullptr))
            for (const VisualCheck& check : feature.checks) EXPECT_FALSE(check.box.empty());
    }
}

// ---- whether it is seen ------------------------------------------------------------------------------

TEST(VisualChecks, WhatNoPixelShowsIsHidden) {
    const Scene scene = sceneOf(squareAt(0, 0, -2));
    Image ids(200, 100, 1, -1);
    ids.at(10, 10) = 0;  // outside its box
    ids.at(100, 50) = 7;
    EXPECT_EQ(boxesOf(checksIn(scene, viewOf(), &ids)), Boxes{});
    ids.at(80, 30) = ids.at(90, 70) = 0;
    const std::vector<FeatureChecks> seen = checksIn(scene, viewOf(), &ids);
    EXPECT_EQ(boxesOf(seen), (Boxes{{80, 30, 91, 71}}));
    EXPECT_EQ(seen[0].checks[0].pixels, 2u);
}

// Two instances of one material, one behind the other; only the closer one is visible.
TEST(VisualChecks, PositionsTellInstancesOfOneMaterialApart) {
    Scene scene = sceneOf(squareAt(0, 0, -2));
    scene.nodes.emplace_back().mesh = 0;
    scene.nodes[1].parent_from_node = glm::translate(glm::dmat4(1), glm::dvec3(0, 0, -2));
    Image ids(200, 100, 1, -1), positions(200, 100, 3);
    for (int y = 25; y < 75; ++y)
        for (int x = 75; x < 125; ++x) {
            ids.at(x, y) = 0;
            positions.at(x, y, 0) = (static_cast<float>(x) + 0.5f - 100) / 25;
            positions.at(x, y, 1) = (50 - static_cast<float>(y) - 0.5f) / 25;
            positions.at(x, y, 2) = -2;
        }
    EXPECT_EQ(checksIn(scene, viewOf(), &ids).at(0).found, 2u);
    const std::vector<FeatureChecks> checks = checksIn(scene, viewOf(), &ids, &positions);
    ASSERT_EQ(boxesOf(checks), (Boxes{{75, 25, 125, 75}}));
    EXPECT_EQ(checks[0].checks[0].pixels, 2500u);
}

// Positions may err by 1e-3 of the box's largest coordinate, here 3.5 m.
TEST(VisualChecks, PositionsAreLookedForInAnExpandedBox) {
    const Scene scene = sceneOf(squareAt(2.5f, 0, -2));
    const auto found = [&](float z) {
        Image ids(200, 100, 1, -1), positions(200, 100, 3);
        ids.at(160, 50) = 0;
        const glm::vec3 there(60.5f / 25, -0.5f / 25, z);
        for (int c = 0; c < 3; ++c) positions.at(160, 50, c) = there[c];
        return !boxesOf(checksIn(scene, viewOf(), &ids, &positions)).empty();
    };
    EXPECT_TRUE(found(-2.003f));
    EXPECT_FALSE(found(-2.004f));
}

// Compared with counting pixel by pixel, for sizes that are not multiples of the tile size.
TEST(VisualChecks, MaterialPixelsAreWhatIsThere) {
    std::mt19937 random(1);
    Image ids(53, 37, 1), positions(53, 37, 3);
    for (float& id : ids.data)
        id = static_cast<float>(random() % 40 == 0 ? random() % 4 : random() % 20 / 19) - 1;
    for (float& p : positions.data) p = static_cast<float>(random() % 5);
    const MaterialPixels byMaterial(ids, nullptr), byBoth(ids, &positions);
    const Bounds reach{{1, 0, 0}, {3, 4, 2}};
    for (int round = 0; round < 500; ++round) {
        const int x = static_cast<int>(random() % 53), y = static_cast<int>(random() % 37);
        const PixelBox box{x, y, x + 1 + static_cast<int>(random() % static_cast<unsigned>(53 - x)),
                           y + 1 + static_cast<int>(random() % static_cast<unsigned>(37 - y))};
        const int material = static_cast<int>(random() % 4);
        MaterialPixels::Visible all, near;
        for (int v = box.y0; v < box.y1; ++v)
            for (int u = box.x0; u < box.x1; ++u) {
                if (ids.at(u, v) != static_cast<float>(material)) continue;
                all.add(1, {u, v, u + 1, v + 1});
                const float px = positions.at(u, v, 0), pz = positions.at(u, v, 2);
                if (px >= 1 && px <= 3 && pz <= 2) near.add(1, {u, v, u + 1, v + 1});
            }
        const MaterialPixels::Visible a = byMaterial.within(material, box, reach),
                                      b = byBoth.within(material, box, reach);
        ASSERT_EQ(a.pixels, all.pixels);
        ASSERT_EQ(a.box, all.box);
        ASSERT_EQ(b.pixels, near.pixels);
        ASSERT_EQ(b.box, near.box);
    }
}

// ---- how many ----------------------------------------------------------------------------------------

TEST(VisualChecks, TheLargestComeFirstAndAllAreCounted) {
    Scene scene = sceneOf(squareAt(0, 0, 0));
    scene.nodes.clear();
    for (int i = 0; i < 30; ++i) {  // the 10th is nearest, two are equally far away
        Node& node = scene.nodes.emplace_back();
        node.name = "node " + std::to_string(i);
        node.mesh = 0;
        node.parent_from_node = glm::translate(glm::dmat4(1), glm::dvec3(0, 0, -2 - std::abs(i - 10)));
    }
    const std::vector<FeatureChecks> features = checksIn(scene, viewOf());
    ASSERT_EQ(features.size(), 1u);
    EXPECT_EQ(features[0].found, 30u);
    ASSERT_EQ(features[0].checks.size(), maxChecks);
    EXPECT_EQ(features[0].checks[0].name, "node 10");
    EXPECT_EQ(features[0].checks[1].name, "node 9");
    EXPECT_EQ(features[0].checks[2].name, "node 11");
    EXPECT_TRUE(std::ranges::is_sorted(features[0].checks, std::greater<>(), &VisualCheck::pixels));
}

TEST(VisualChecks, ManyInstancesLeaveFewChecks) {
    const Scene scene = sceneOf(squareAt(0, 0, -20));
    Pose pose = poseAt(scene, 0);
    pose.instances.resize(100'000, pose.instances[0]);
    const Image ids(200, 100, 1, 0);
    const std::vector<FeatureChecks> features = visualChecksOf(scene, pose, viewOf(), &ids, nullptr);
    EXPECT_EQ(features.at(0).found, 100'000u);
    EXPECT_EQ(features.at(0).checks.size(), maxChecks);
}

// ---- names -------------------------------------------------------------------------------------------

TEST(VisualChecks, PlacesAreNamedByWhatTheFileNames) {
    Scene scene = sceneOf(squareAt(0, 0, -2));
    const auto check = [&] { return checksIn(scene, viewOf()).at(0).checks.at(0); };
    scene.meshes[0].name.clear();
    EXPECT_EQ(check().name, "mesh 0");
    EXPECT_EQ(check().where, "material 0, mesh 0");
    scene.materials[0].name = "leaf";
    scene.meshes[0].name = "plane";
    scene.nodes[0].name = "tree";
    EXPECT_EQ(check().name, "tree");
    EXPECT_EQ(check().where, "material 0 \"leaf\", mesh 0 \"plane\", node \"tree\"");
    scene.meshes[0].primitives.push_back(scene.meshes[0].primitives[0]);
    EXPECT_EQ(check().name, "tree \u00b7 leaf");
}

TEST(VisualChecks, LongNamesAreCutBetweenCharacters) {
    Scene scene = sceneOf(squareAt(0, 0, -2));
    scene.nodes[0].name = "x";
    for (int i = 0; i < 1000; ++i)
        scene.nodes[0].name += "\u00e9";  // two bytes; the second is the name's 60th byte
    const std::string name = checksIn(scene, viewOf()).at(0).checks.at(0).name;
    std::string expected = "x";
    for (int i = 0; i < 29; ++i) expected += "\u00e9";
    EXPECT_EQ(name, expected + "...");
    scene.nodes[0].name = std::string(60, 'n');
    EXPECT_EQ(checksIn(scene, viewOf()).at(0).checks.at(0).name, scene.nodes[0].name);
}

}  // namespace diptych
