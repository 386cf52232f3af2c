// SPDX-License-Identifier: MIT
// Keyframe interpolation, compared with values computed by hand, and the resulting poses of nodes, lights
// and cameras.
#include "shared/scene/motion/animation.h"

#include "shared/scene/motion/bounds.h"
#include "shared/scene/motion/pose.h"
#include "shared/scene/scene_view.h"
#include "tests/support/errors.h"
#include "tests/support/gltf_builder.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <numbers>

namespace diptych {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr auto translation = AnimatedPart::translation, rotation = AnimatedPart::rotation,
               scale = AnimatedPart::scale, weights = AnimatedPart::weights;

Keyframes keys(Interpolation interpolation, std::vector<float> times, std::vector<float> values,
               std::size_t width) {
    return {interpolation, std::move(times), std::move(values), width};
}

// A rotation around +Z as x, y, z, w.
std::vector<float> turn(double degrees) {
    const double half = degrees * degree / 2;
    return {0, 0, static_cast<float>(std::sin(half)), static_cast<float>(std::cos(half))};
}
double degreesAboutZ(const std::vector<double>& q) {
    EXPECT_NEAR(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3], 1, 1e-15) << "unit";
    EXPECT_EQ(q[0], 0);
    EXPECT_EQ(q[1], 0);
    return 2 * std::atan2(q[2], q[3]) / degree;
}
template <class T>
std::vector<T> appended(std::vector<T> a, const std::vector<T>& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

// Degrees. Sine and cosine of the half angle are rounded to float32.
constexpr double floatTurn = 2e-5;

// ---- between keys ------------------------------------------------------------------------------------

TEST(Animation, StepHoldsTheKeyBefore) {
    const Keyframes k = keys(Interpolation::step, {1, 3}, {5, 6, 7, 8, 9, 10}, 3);
    using Values = std::vector<double>;
    for (const double t : {0.0, 1.0, 2.999}) EXPECT_EQ(sampled(k, translation, t), (Values{5, 6, 7})) << t;
    for (const double t : {3.0, 100.0}) EXPECT_EQ(sampled(k, translation, t), (Values{8, 9, 10})) << t;
}

TEST(Animation, LinearBetweenKeysAndClampedBeyond) {
    const Keyframes k = keys(Interpolation::linear, {1, 3, 4}, {0, 8, 4, 0, 2, 2}, 2);
    using Values = std::vector<double>;
    EXPECT_EQ(sampled(k, weights, 0), (Values{0, 8}));
    EXPECT_EQ(sampled(k, weights, 1), (Values{0, 8}));
    EXPECT_EQ(sampled(k, weights, 1.5), (Values{1, 6})) << "a quarter of the way";
    EXPECT_EQ(sampled(k, weights, 3), (Values{4, 0}));
    EXPECT_EQ(sampled(k, weights, 3.5), (Values{3, 1}));
    EXPECT_EQ(sampled(k, weights, 4), (Values{2, 2}));
    EXPECT_EQ(sampled(k, weights, 1e9), (Values{2, 2}));
    EXPECT_EQ(sampled(keys(Interpolation::linear, {2}, {7}, 1), weights, 1), (Values{7})) << "one key";
}

// Before the first key, at a single key and long after the last, the value is constant, with either
// interpolation.
TEST(Animation, OneKeyAndTimesFarAway) {
    using Values = std::vector<double>;
    for (const auto interpolation : {Interpolation::step, Interpolation::linear}) {
        const Keyframes one = keys(interpolation, {2}, {7, 8}, 2);
        const Keyframes two = keys(interpolation, {2, 3}, {7, 8, 9, 10}, 2);
        for (const double t : {0.0, 1.999, 2.0, 1e6})
            EXPECT_EQ(sampled(one, weights, t), (Values{7, 8})) << t;
        for (const double t : {0.0, 2.0}) EXPECT_EQ(sampled(two, weights, t), (Values{7, 8})) << t;
        for (const double t : {3.0, 1e6}) EXPECT_EQ(sampled(two, weights, t), (Values{9, 10})) << t;
    }
    const Keyframes cubic = keys(Interpolation::cubic_spline, {2}, {99, 7, 99}, 1);
    for (const double t : {0.0, 2.0, 1e6}) EXPECT_EQ(sampled(cubic, weights, t), (Values{7})) << t;
}

// Several keys at one time are a step: the first counts before it, the last from it on.
TEST(Animation, KeysAtOneTimeAreAStep) {
    using Values = std::vector<double>;
    const Keyframes k = keys(Interpolation::linear, {0, 1, 1, 1, 2}, {0, 4, 50, 8, 10}, 1);
    EXPECT_EQ(sampled(k, weights, 0.75), (Values{3}));
    EXPECT_EQ(sampled(k, weights, 1), (Values{8}));
    EXPECT_EQ(sampled(k, weights, 1.5), (Values{9}));
    const Keyframes ends = keys(Interpolation::linear, {1, 1, 2, 2}, {1, 2, 3, 4}, 1);
    EXPECT_EQ(sampled(ends, weights, 0), (Values{1}));
    EXPECT_EQ(sampled(ends, weights, 1), (Values{2}));
    EXPECT_EQ(sampled(ends, weights, 2), (Values{4}));
    EXPECT_EQ(sampled(ends, weights, 9), (Values{4}));
    const Keyframes cubic =
        keys(Interpolation::cubic_spline, {0, 1, 1, 2}, {0, 0, 0, 0, 4, 0, 0, 8, 0, 0, 10, 0}, 1);
    EXPECT_EQ(sampled(cubic, weights, 0.5), (Values{2}));
    EXPECT_EQ(sampled(cubic, weights, 1), (Values{8}));
    EXPECT_EQ(sampled(cubic, weights, 1.5), (Values{9}));
}

// Linear interpolation and normalization of quaternions would give 26.6 degrees after a third of 0 to 90.
TEST(Animation, RotationsTurnEvenly) {
    const Keyframes k = keys(Interpolation::linear, {0, 3}, appended(turn(0), turn(90)), 4);
    for (const double t : {0.0, 0.5, 1.0, 2.0, 3.0, 4.0})
        EXPECT_NEAR(degreesAboutZ(sampled(k, rotation, t)), 30 * std::min(t, 3.0), floatTurn) << t;
    const Keyframes tiny = keys(Interpolation::linear, {0, 1}, {0, 0, 0, 1, 0, 0, 1e-10f, 1}, 4);
    EXPECT_NEAR(sampled(tiny, rotation, 0.25)[2], 0.25e-10, 1e-17) << "an angle that an arc cosine loses";
    const Keyframes none = keys(Interpolation::linear, {0, 1}, appended(turn(40), turn(40)), 4);
    EXPECT_NEAR(degreesAboutZ(sampled(none, rotation, 0.5)), 40, floatTurn);
}

// -q is the same rotation as q: 350 to 370 degrees is a rotation by 20, whichever sign the file has.
TEST(Animation, RotationsTakeTheShorterWay) {
    for (const double to : {10.0, 370.0}) {
        const Keyframes k = keys(Interpolation::linear, {0, 1}, appended(turn(-10), turn(to)), 4);
        EXPECT_NEAR(degreesAboutZ(sampled(k, rotation, 0.75)), 5, floatTurn) << to;
    }
}

// (2u^3-3u^2+1) v + d(u^3-2u^2+u) out + (3u^2-2u^3) w + d(u^3-u^2) in at u = 1/4, with an interval d of 2
// s: 0.84375 x 1 + 2 x 0.140625 x 3 + 0.15625 x 2 - 2 x 0.046875 x 5.
TEST(Animation, CubicSplinesScaleTheirTangentsByTheInterval) {
    const Keyframes k = keys(Interpolation::cubic_spline, {1, 3}, {99, 1, 3, 5, 2, 99}, 1);
    EXPECT_EQ(sampled(k, weights, 1.5), (std::vector<double>{1.53125}));
    EXPECT_EQ(sampled(k, weights, 0), (std::vector<double>{1})) << "beyond, a value and no tangent";
    EXPECT_EQ(sampled(k, weights, 1), (std::vector<double>{1}));
    EXPECT_EQ(sampled(k, weights, 3), (std::vector<double>{2}));
    EXPECT_EQ(sampled(k, weights, 4), (std::vector<double>{2}));
    // Two components: a key's tangents come before and after all its values.
    const Keyframes two =
        keys(Interpolation::cubic_spline, {0, 1}, {0, 0, 1, 10, 8, 0, 0, 8, 1, 10, 0, 0}, 2);
    EXPECT_EQ(sampled(two, weights, 0.5), (std::vector<double>{2, 9})) << "1 + 8/8 and 10 - 8/8";
}

TEST(Animation, CubicSplinesOfRotationsAreMadeUnit) {
    const std::vector<float> flat(4, 0);
    std::vector<float> values = appended(appended(flat, turn(0)), flat);
    values = appended(appended(appended(values, flat), turn(120)), flat);
    Keyframes k = keys(Interpolation::cubic_spline, {0, 1}, values, 4);
    EXPECT_NEAR(degreesAboutZ(sampled(k, rotation, 0.5)), 60, floatTurn);
    // A quaternion of length 2 in the file gives the same rotation at the key.
    for (float& v : k.values) v *= 2;
    EXPECT_NEAR(degreesAboutZ(sampled(k, rotation, 1)), 120, floatTurn);
    std::fill(k.values.begin(), k.values.end(), 0.0f);
    EXPECT_EQ(sampled(k, rotation, 0.5), (std::vector<double>{0, 0, 0, 1})) << "no direction: no rotation";
}

// ---- nodes -------------------------------------------------------------------------------------------

// A triangle on node 1, a child of node 0.
struct MovedFile : GltfFile {
    MovedFile() : GltfFile(triangle()) {
        json["nodes"] = {{{"children", {1}}, {"translation", {0, 10, 0}}},
                         {{"mesh", 0}, {"translation", {1, 0, 0}}, {"scale", {2, 2, 2}}}};
    }
    // Linear interpolation, with keys at 0 s and 1 s.
    void channel(int node, const char* path, const std::vector<float>& values, const char* type,
                 std::size_t width, std::size_t animation = 0) {
        const int times = accessor<float>({0, 1}, FLOAT, "SCALAR", 1);
        const int output = accessor(values, FLOAT, type, width);
        Json& a = json["animations"][animation];
        a["samplers"].push_back({{"input", times}, {"output", output}});
        a["channels"].push_back(
            {{"sampler", a["samplers"].size() - 1}, {"target", {{"node", node}, {"path", path}}}});
    }
    using Json = nlohmann::json;
};

glm::dvec3 placeOf(const Scene& scene, double seconds, const glm::dvec3& p) {
    return glm::dvec3(poseAt(scene, seconds).instances.at(0).world_from_object * glm::dvec4(p, 1));
}
void expectNear(const glm::dvec3& got, const glm::dvec3& expected, double tolerance,
                const std::string& what) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(got[c], expected[c], tolerance) << what << " component " << c;
}

// Parts without a channel stay: the parent's translation, the child's scale of 2. Children move with
// parents.
TEST(Animation, NodesMoveWithTheirParents) {
    MovedFile f;
    f.channel(0, "rotation", appended(turn(0), turn(90)), "VEC4", 4);
    f.channel(1, "translation", {1, 0, 0, 3, 0, 0}, "VEC3", 3);
    const Scene scene = f.load();
    EXPECT_EQ(placeOf(scene, 0, {0, 1, 0}), glm::dvec3(1, 12, 0));
    expectNear(placeOf(scene, 1, {0, 0, 0}), {0, 13, 0}, 1e-6, "(3, 0, 0) turned to +Y, on (0, 10, 0)");
    expectNear(placeOf(scene, 1, {0, 1, 0}), {-2, 13, 0}, 1e-6, "+Y, twice as long, turned to -X");
    const double half = std::sqrt(0.5);
    expectNear(placeOf(scene, 0.5, {0, 0, 0}), {2 * half, 10 + 2 * half, 0}, 1e-6, "(2, 0, 0) at 45 degrees");
    EXPECT_EQ(placeOf(scene, 7, {0, 1, 0}), placeOf(scene, 1, {0, 1, 0})) << "the last key stays";
}

// The node's rest transform differs: an image at 0 s shows the first key.
TEST(Animation, ItBeginsWithTheFirstKey) {
    MovedFile f;
    f.channel(0, "translation", {0, 0, 5, 0, 0, 9}, "VEC3", 3);
    EXPECT_EQ(placeOf(f.load(), 0, {0, 0, 0}), glm::dvec3(1, 0, 5));
}

TEST(Animation, SeveralPlayAtOnceAndLaterOnesWin) {
    MovedFile f;
    f.channel(0, "translation", {0, 0, 0, 8, 0, 0}, "VEC3", 3, 0);
    f.channel(1, "scale", {3, 3, 3, 3, 3, 3}, "VEC3", 3, 0);
    f.channel(0, "translation", {0, 0, 0, 0, 0, 4}, "VEC3", 3, 1);
    const Scene scene = f.load();
    EXPECT_EQ(placeOf(scene, 1, {1, 0, 0}), glm::dvec3(4, 0, 4)) << "scale of the first, place of the second";
    EXPECT_TRUE(mentions(scene.notes, "2 animations: all play at once"));
}

TEST(Animation, OneIsChosenByIndexOrName) {
    MovedFile f;
    f.channel(0, "translation", {0, 0, 0, 8, 0, 0}, "VEC3", 3, 0);
    f.channel(7, "translation", {0, 0, 0, 8, 0, 0}, "VEC3", 3, 1);
    f.channel(0, "translation", {0, 0, 0, 0, 0, 4}, "VEC3", 3, 2);
    f.channel(1, "scale", {3, 3, 3, 3, 3, 3}, "VEC3", 3, 2);
    f.json["nodes"].push_back({{"name", "outside"}});
    f.json["animations"][1]["channels"][0]["target"]["node"] = 2;
    f.json["scenes"] = {{{"nodes", {0}}}};
    f.json["scene"] = 0;
    f.json["animations"][0]["name"] = "run";
    f.json["animations"][2]["name"] = "jump";
    const Scene scene = f.load();
    const auto at = [&](const std::string& choice) {
        return glm::dvec3(poseAt(scene, 1, choice).instances.at(0).world_from_object *
                          glm::dvec4(1, 0, 0, 1));
    };
    EXPECT_EQ(at(""), glm::dvec3(4, 0, 4));
    for (const char* choice : {"0", "run"}) EXPECT_EQ(at(choice), glm::dvec3(11, 0, 0)) << choice;
    EXPECT_EQ(at("1"), glm::dvec3(3, 10, 0)) << "it moves a node of another scene: this one is at rest";
    for (const char* choice : {"2", "jump"}) EXPECT_EQ(at(choice), glm::dvec3(4, 0, 4)) << choice;
    EXPECT_EQ(poseAt(scene, 1, "jump").animation, "jump");
    EXPECT_TRUE(mentions(scene.notes, "2 animations: all play at once, later ones override"));
    const auto error = [](const Scene& s, const std::string& choice) {
        return faultOf([&] { poseAt(s, 0, choice); });
    };
    EXPECT_EQ(error(scene, "walk"),
              "--animation \"walk\": the scene's animations are 0 \"run\", 1, 2 \"jump\"");
    EXPECT_EQ(error(scene, "3"), "--animation \"3\": the scene's animations are 0 \"run\", 1, 2 \"jump\"");
    EXPECT_EQ(error(GltfFile::triangle().load(), "0"), "--animation \"0\": the scene has no animation");
    Scene twins = scene;
    twins.animations[1].name = "run";
    EXPECT_EQ(error(twins, "run"), "--animation \"run\": is the name of 0 (run), 1 (run); give an index");
}

// The default camera is placed for the bounds of the playing animation at 0 s.
TEST(Animation, BoundsAtStartAreOfWhatPlays) {
    MovedFile f;
    f.channel(0, "translation", {0, 0, 0, 8, 0, 0}, "VEC3", 3, 0);
    f.channel(0, "translation", {0, 0, 5, 0, 0, 9}, "VEC3", 3, 1);
    const Scene scene = f.load();
    EXPECT_EQ(boundsAtStart(scene, poseAt(scene, 1, "0")).min.z, 0);
    EXPECT_EQ(boundsAtStart(scene, poseAt(scene, 1, "1")).min.z, 5);
}

TEST(Animation, LightsAndCamerasMove) {
    MovedFile f;
    f.json["extensionsUsed"] = {"KHR_lights_punctual"};
    f.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "spot"}, {"spot", nlohmann::json::object()}}};
    f.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1.0}, {"znear", 0.1}}}}};
    f.json["nodes"][1] = {{"translation", {0, 0, -3}},
                          {"camera", 0},
                          {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}};
    f.channel(0, "translation", {0, 10, 0, 0, 20, 0}, "VEC3", 3);
    // A rotation by 90 degrees around +X takes -Z to +Y.
    const float half = static_cast<float>(std::sqrt(0.5));
    f.channel(1, "rotation", {0, 0, 0, 1, half, 0, 0, half}, "VEC4", 4);
    const Scene scene = f.load();
    const Pose start = poseAt(scene, 0), end = poseAt(scene, 1);
    EXPECT_EQ(start.lights.at(0).position, glm::dvec3(0, 10, -3));
    EXPECT_EQ(start.lights[0].direction, glm::dvec3(0, 0, -1));
    EXPECT_EQ(end.lights.at(0).position, glm::dvec3(0, 20, -3));
    expectNear(end.lights[0].direction, {0, 1, 0}, 1e-7, "the spot");
    EXPECT_EQ(glm::dvec3(end.cameras.at(0).world_from_camera[3]), glm::dvec3(0, 20, -3));
    expectNear(-glm::dvec3(end.cameras[0].world_from_camera[2]), {0, 1, 0}, 1e-7, "the camera");
    EXPECT_EQ(end.cameras[0].node, -1) << "it is in world space";
}

// An object animated beyond maxCoordinate is not drawn at that time, but is again later.
TEST(Animation, WhatIsMovedBeyondReachIsNotInThePose) {
    MovedFile f;
    f.channel(0, "scale", {1, 1, 1, 1e18f, 1e18f, 1e18f}, "VEC3", 3);
    const Scene scene = f.load();
    EXPECT_EQ(poseAt(scene, 0).instances.size(), 1u);
    EXPECT_EQ(poseAt(scene, 1).instances.size(), 0u);
    EXPECT_EQ(poseAt(scene, 0).notes, std::vector<std::string>());
    EXPECT_EQ(poseAt(scene, 0.1).instances.size(), 1u) << "a tenth of it is in reach";
    const auto at = [](double seconds) {
        return ViewRequest{.time = seconds, .camera = "", .width = 8, .height = 8, .lights = ""};
    };
    EXPECT_EQ(makeSceneView(scene, at(0.1)).pose.instances.size(), 1u);
    EXPECT_EQ(faultOf([&] { makeSceneView(scene, at(1)); }),
              scene.name +
                  ": nothing is left to draw: 1 drawn instance is not finite or beyond 1e+18 m at 1 s: "
                  "left out");
}

}  // namespace
}  // namespace diptych
