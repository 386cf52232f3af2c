// SPDX-License-Identifier: MIT
#include "shared/scene/default_view.h"

#include "shared/scene/lights/rig.h"
#include "shared/scene/scene_view.h"
#include "shared/scene/visible_surface.h"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <cmath>
#include <limits>
#include <string>

using namespace diptych;

namespace {

using Place = DefaultView::Viewpoint;

const glm::dvec3 standardSide = glm::normalize(glm::dvec3(1, 0.6, 1));

// A box with one primitive per side, facing outwards or, if `inwards`, inwards.
void addBox(Scene& scene, const glm::vec3& low, const glm::vec3& high, bool inwards, int without = -1) {
    if (scene.materials.empty()) scene.materials.resize(1);
    Mesh mesh;
    for (int side = 0; side < 6; ++side) {
        if (side == without) continue;
        const int axis = side / 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
        const bool positive = side % 2 == 1;
        Primitive p;
        for (const auto& [s, t] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
            glm::vec3 at;
            at[axis] = positive ? high[axis] : low[axis];
            at[u] = s ? high[u] : low[u];
            at[v] = t ? high[v] : low[v];
            p.positions.push_back(at);
        }
        p.normals.assign(4, glm::vec3(0, 1, 0));
        p.tangents.assign(4, glm::vec4(1, 0, 0, 1));
        if (positive != inwards)
            p.indices = {0, 1, 2, 0, 2, 3};
        else
            p.indices = {0, 2, 1, 0, 3, 2};
        mesh.primitives.push_back(std::move(p));
    }
    Node node;
    node.mesh = static_cast<int>(scene.meshes.size());
    scene.meshes.push_back(std::move(mesh));
    scene.nodes.push_back(node);
}

// Walls of 0.2 m around a room of 8 x 3 x 6 m with four crates.
Scene closedRoom(bool crates = true) {
    Scene scene;
    addBox(scene, {0, 0, 0}, {8, 3, 6}, true);
    addBox(scene, {-0.2f, -0.2f, -0.2f}, {8.2f, 3.2f, 6.2f}, false);
    for (const float x : {1.0f, 6.0f})
        for (const float z : {1.0f, 4.0f})
            if (crates) addBox(scene, {x, 0, z}, {x + 1, 1, z + 1}, false);
    return scene;
}

std::string wordsOf(const DefaultView& view) {
    return view.describe();
}

}  // namespace

TEST(ViewEntropy, OfPartsByHand) {
    EXPECT_EQ(viewEntropy({}), 0);
    EXPECT_EQ(viewEntropy({100}), 0);
    EXPECT_DOUBLE_EQ(viewEntropy({50, 50}), 1);
    EXPECT_DOUBLE_EQ(viewEntropy({25, 25, 0, 50}), 1.5);
    EXPECT_DOUBLE_EQ(viewEntropy(std::vector<std::size_t>(32, 7)), 5);
}

TEST(VisibleSurface, IsTheNearestThatIsDrawn) {
    Scene scene;
    addBox(scene, {1, -1, -1}, {3, 1, 1}, false);
    scene.materials.resize(2);
    const Pose pose = poseAt(scene, 0);
    const VisibleSurface box(scene, pose, worldBounds(scene, pose));
    const auto front = box.nearest({0, 0, 0}, {1, 0, 0});
    ASSERT_TRUE(front);
    EXPECT_NEAR(front->distance, 1, 1e-6);
    EXPECT_NEAR(glm::length(front->normal - glm::dvec3(-1, 0, 0)), 0, 1e-6);
    EXPECT_TRUE(front->front);
    EXPECT_FALSE(box.nearest({0, 5, 0}, {1, 0, 0}));
    EXPECT_FALSE(box.nearest({2, 0, 0}, {1, 0, 0})) << "from inside only back faces, which are not drawn";

    scene.materials[0].double_sided = true;
    const VisibleSurface both(scene, pose, worldBounds(scene, pose));
    const auto back = both.nearest({2, 0, 0}, {1, 0, 0});
    ASSERT_TRUE(back);
    EXPECT_FALSE(back->front);
    EXPECT_NEAR(glm::length(back->normal - glm::dvec3(-1, 0, 0)), 0, 1e-6);

    // A mirrored box keeps its front faces.
    scene.materials[0].double_sided = false;
    scene.nodes[0].parent_from_node = glm::scale(glm::dmat4(1), glm::dvec3(-1, 1, 1));
    const Pose mirrored = poseAt(scene, 0);
    const auto near =
        VisibleSurface(scene, mirrored, worldBounds(scene, mirrored)).nearest({0, 0, 0}, {-1, 0, 0});
    ASSERT_TRUE(near);
    EXPECT_NEAR(near->distance, 1, 1e-6) << "not the far side, whose back is towards us";
}

// Skinning or morphing may produce a NaN vertex; the rest of the surface stays.
TEST(VisibleSurface, VerticesThatAreNoNumbersAreLeftOut) {
    Scene scene;
    addBox(scene, {-1, -1, -1}, {1, 1, 1}, false);
    scene.meshes[0].primitives[1].positions[2].y = std::numeric_limits<float>::quiet_NaN();
    const VisibleSurface box(scene, poseAt(scene, 0), {{-1, -1, -1}, {1, 1, 1}});
    EXPECT_FALSE(box.nearest({5, 0.5, 0.4}, {-1, 0, 0}));
    EXPECT_TRUE(box.nearest({-5, 0.5, 0.4}, {1, 0, 0}));
    const glm::dvec3 nowhere(std::numeric_limits<double>::quiet_NaN());
    EXPECT_FALSE(box.nearest(nowhere, {1, 0, 0}));
}

// A wall of 128 x 128 squares; an eighth of the triangles is kept. Rays hit about as much of the wall, by
// fewer and larger triangles, reproducibly.
TEST(VisibleSurface, ASampleCoversWhatTheWholeDoes) {
    Scene scene;
    scene.materials.resize(1);
    Primitive p;
    constexpr std::uint32_t side = 128;
    for (std::uint32_t i = 0; i < side * side; ++i) {
        // Every second square: half of the wall is open.
        if ((i / side + i % side) % 2 == 0) continue;
        const auto x = static_cast<float>(i % side), y = static_cast<float>(i / side);
        const auto first = static_cast<std::uint32_t>(p.positions.size());
        for (const glm::vec3 at : {glm::vec3(x, y, 0), {x + 1, y, 0}, {x + 1, y + 1, 0}, {x, y + 1, 0}})
            p.positions.push_back(at);
        for (const std::uint32_t k : {0u, 1u, 2u, 0u, 2u, 3u}) p.indices.push_back(first + k);
    }
    p.normals.assign(p.positions.size(), {0, 0, 1});
    p.tangents.assign(p.positions.size(), {1, 0, 0, 1});
    scene.meshes.push_back({"wall", {p}});
    scene.nodes.emplace_back().mesh = 0;
    const Pose pose = poseAt(scene, 0);
    const Bounds bounds = worldBounds(scene, pose);
    const auto fraction = [&](std::uint64_t limit) {
        const VisibleSurface wall(scene, pose, bounds, limit);
        int met = 0;
        for (int i = 0; i < 64 * 64; ++i)
            met += wall.nearest({1.97 * (i % 64) + 0.37, 1.97 * (i / 64) + 0.61, 5}, {0, 0, -1}).has_value();
        return met / (64.0 * 64.0);
    };
    EXPECT_NEAR(fraction(side * side), 0.5, 0.01);
    const double sampled = fraction(side * side / 8);
    // Triangles with eight times the area at random positions overlap: 1 - e^-0.5 of the wall instead of a
    // half.
    EXPECT_NEAR(sampled, 1 - std::exp(-0.5), 0.03);
    EXPECT_EQ(fraction(side * side / 8), sampled);
}

TEST(DefaultView, OfAnObjectIsTheUsual) {
    Scene crate;
    addBox(crate, {3, 4, 5}, {4, 5, 7}, false);
    const DefaultView view = chooseDefaultView(crate);
    EXPECT_EQ(view.viewpoint, Place::standard);
    EXPECT_EQ(view.backward, standardSide);
    EXPECT_GT(view.covered, 0.1);
    EXPECT_LT(view.covered, 0.6);
    EXPECT_NE(wordsOf(view).find("from outside; "), std::string::npos) << wordsOf(view);
}

// A room of 8 x 3 x 6 m is no smaller than many objects: the surrounding surface decides.
TEST(DefaultView, OfASolidBlockAsLargeAsARoomIsTheUsual) {
    Scene block;
    addBox(block, {0, 0, 0}, {8, 3, 6}, false);
    EXPECT_EQ(chooseDefaultView(block).viewpoint, Place::standard);
}

TEST(DefaultView, OfAClosedRoomIsFromInside) {
    const Scene scene = closedRoom();
    const DefaultView view = chooseDefaultView(scene);
    ASSERT_EQ(view.viewpoint, Place::inside) << wordsOf(view);
    EXPECT_DOUBLE_EQ(view.covered, 1);
    EXPECT_NEAR(view.eye.y, 1.6, 1e-3) << "a person's eye over the floor";
    EXPECT_TRUE(view.eye.x > 0 && view.eye.x < 8 && view.eye.z > 0 && view.eye.z < 6);
    EXPECT_EQ(view.backward.y, 0);
    EXPECT_EQ(wordsOf(view), "from inside; the scene covers 100 % of the image");
}

// Low like a doll's house or a crawl space: nobody can stand in it.
TEST(DefaultView, OfARoomTooLowToStandInIsFromOutside) {
    for (const auto& [scale, place] :
         {std::pair{0.1, Place::standard}, {0.65, Place::standard}, {0.7, Place::inside}}) {
        Scene scene = closedRoom();
        for (Node& node : scene.nodes) node.parent_from_node = glm::scale(glm::dmat4(1), glm::dvec3(scale));
        EXPECT_EQ(chooseDefaultView(scene).viewpoint, place) << 3 * scale << " m";
    }
}

// Surfaces facing other ways are other parts of the image, in one primitive or several.
TEST(DefaultView, SidesOfOnePrimitiveArePartsOfTheImage) {
    Scene scene;
    addBox(scene, {-1, -1, -1}, {1, 1, 1}, false);
    const double apart = chooseDefaultView(scene).entropy;
    Primitive whole;
    for (const Primitive& side : scene.meshes[0].primitives) {
        const auto first = static_cast<std::uint32_t>(whole.positions.size());
        whole.positions.insert(whole.positions.end(), side.positions.begin(), side.positions.end());
        for (const std::uint32_t i : side.indices) whole.indices.push_back(first + i);
    }
    whole.normals.assign(whole.positions.size(), glm::vec3(0, 1, 0));
    whole.tangents.assign(whole.positions.size(), glm::vec4(1, 0, 0, 1));
    scene.meshes[0].primitives = {whole};
    EXPECT_DOUBLE_EQ(chooseDefaultView(scene).entropy, apart);
    EXPECT_GT(apart, 1) << "more than two parts can have: three sides and what is around them";
}

TEST(DefaultView, OfAnOpenFloorIsFromOutside) {
    Scene floor;
    addBox(floor, {0, 0, 0}, {20, 0.1f, 20}, false);
    for (const float x : {2.0f, 8.0f, 14.0f}) addBox(floor, {x, 0.1f, x}, {x + 2, 3, x + 2}, false);
    EXPECT_EQ(chooseDefaultView(floor).viewpoint, Place::standard) << "half of what is around is sky";
}

// A stage with its back to the default view, and much to see on the other side.
TEST(DefaultView, ChangesSidesWhereThatShowsTwiceAsMuch) {
    Scene stage;
    addBox(stage, {0, 0, 0}, {20, 10, 0.2f}, false);
    for (int i = 0; i < 24; ++i) {
        const auto x = static_cast<float>(3 * (i % 6) + 1), y = static_cast<float>(2 * (i / 6) + 1);
        addBox(stage, {x, y, -0.2f}, {x + 2, y + 1.5f, 0}, false);
    }
    const DefaultView view = chooseDefaultView(stage);
    ASSERT_EQ(view.viewpoint, Place::outside) << wordsOf(view);
    EXPECT_LT(view.backward.z, 0);
    EXPECT_NE(wordsOf(view).find("from another side"), std::string::npos);
}

TEST(DefaultView, IsTheSameEveryTimeAndForEverySize) {
    const Scene scene = closedRoom();
    const DefaultView a = chooseDefaultView(scene), b = chooseDefaultView(scene);
    EXPECT_EQ(a.eye, b.eye);
    EXPECT_EQ(a.backward, b.backward);
    EXPECT_EQ(a.covered, b.covered);
    SceneViews views(scene);
    ViewRequest wide, tall;
    wide.width = tall.height = 900;
    wide.height = tall.width = 100;
    EXPECT_EQ(views.at(wide).view.eye(), a.eye);
    EXPECT_EQ(views.at(tall).view.eye(), a.eye);
    EXPECT_NEAR(glm::length(views.at(wide).view.backward() - a.backward), 0, 1e-12);
    EXPECT_EQ(views.at(wide).default_view, a.describe());
}

// The default sun is behind the default view's viewer, even if another camera is requested.
TEST(DefaultView, HasTheSunBehindIt) {
    const Scene scene = closedRoom();
    const glm::dvec3 expected = defaultSun(chooseDefaultView(scene).backward).direction;
    for (const std::string camera : {"", "eye=1,1,1 target=2,1,1"}) {
        const SceneView view = makeSceneView(scene, {0, camera, 64, 36, "", 0});
        ASSERT_EQ(view.lights.size(), 1u);
        EXPECT_EQ(view.lights[0].direction, expected) << camera;
        EXPECT_EQ(view.default_view.empty(), !camera.empty());
    }
}

// Behind the first camera at 0 s, whatever camera and time are requested.
TEST(DefaultView, HasTheSunBehindTheScenesFirstCamera) {
    Scene scene = closedRoom();
    scene.cameras.resize(2);
    scene.cameras[0].node = static_cast<int>(scene.nodes.size());
    scene.cameras[1].world_from_camera = lookAt({1, 2, 1}, {2, 1, 1});
    scene.nodes.emplace_back().transform = 0;
    scene.transforms = {{}};
    Animation turn;
    turn.keyframes = {{Interpolation::linear, {0, 1}, {0, 0, 0, 1, 0, 1, 0, 0}, 4}};
    turn.channels = {{scene.cameras[0].node, 0, AnimatedPart::rotation}};
    scene.animations = {turn};
    ASSERT_LT(poseAt(scene, 1).cameras.at(0).world_from_camera[2].z, -0.9) << "it turns";
    const glm::dvec3 expected = defaultSun({0, 0, 1}).direction;
    for (const double seconds : {0.0, 1.0})
        for (const char* camera : {"", "1", "eye=1,1,1 target=2,1,1"}) {
            const SceneView view = makeSceneView(scene, {seconds, camera, 64, 36, "", 0});
            ASSERT_EQ(view.lights.size(), 1u);
            EXPECT_EQ(view.lights[0].direction, expected) << camera << " at " << seconds;
        }
}

TEST(DefaultView, OfHostileScenesIsFinite) {
    const float huge = 9e17f;
    std::vector<std::pair<const char*, Scene>> scenes(5);
    scenes[0].first = "empty";
    scenes[1].first = "a point";
    addBox(scenes[1].second, glm::vec3(3), glm::vec3(3), false);
    scenes[2].first = "as large as may be";
    addBox(scenes[2].second, glm::vec3(-huge), glm::vec3(huge), true);
    scenes[3].first = "a room beside something at the end of the world";
    scenes[3].second = closedRoom();
    addBox(scenes[3].second, {huge, 0, 0}, {huge, 1, 1}, false);
    scenes[4].first = "no indices";
    addBox(scenes[4].second, glm::vec3(0), glm::vec3(1), false);
    for (Primitive& p : scenes[4].second.meshes[0].primitives) p.indices.clear();
    for (const auto& [name, scene] : scenes) {
        const DefaultView view = chooseDefaultView(scene);
        EXPECT_TRUE(std::isfinite(view.entropy) && view.covered >= 0 && view.covered <= 1) << name;
        const View made = makeView(scene, poseAt(scene, 0), "", 64, 36);
        EXPECT_TRUE(std::isfinite(glm::length(made.eye()))) << name;
        EXPECT_NEAR(glm::length(made.backward()), 1, 1e-9) << name;
        EXPECT_GT(made.camera.near, 0) << name;
    }
}
