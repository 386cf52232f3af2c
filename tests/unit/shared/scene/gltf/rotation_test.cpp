// SPDX-License-Identifier: MIT
// Quaternions of any length rotate by their direction: of nodes, of animated nodes, and of keys of every
// interpolation and component type. Exporters write normalized integers, and float32 that is not exactly
// unit length.
#include "shared/scene/motion/animation.h"
#include "shared/scene/motion/pose.h"
#include "tests/support/gltf_builder.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include <array>
#include <cmath>
#include <numbers>

namespace diptych {
namespace {

constexpr double degrees = std::numbers::pi / 180;
constexpr std::array lengths{1e-3, 0.5, 0.999, 1.0, 1.001, 2.0, 300.0};
const glm::dvec3 axis = glm::normalize(glm::dvec3(1, -2, 0.5));

// Rodrigues' formula: v rotated around `axis`.
glm::dvec3 turned(const glm::dvec3& v, double angle) {
    return v * std::cos(angle) + glm::cross(axis, v) * std::sin(angle) +
           axis * (glm::dot(axis, v) * (1 - std::cos(angle)));
}

std::array<double, 4> xyzw(double angle, double length) {
    const double s = std::sin(angle / 2) * length;
    return {axis.x * s, axis.y * s, axis.z * s, std::cos(angle / 2) * length};
}

// The columns of the instance's matrix are the rotated axes, without scale.
void expectTurned(const Scene& scene, double seconds, double angle, double bound, const std::string& what) {
    const glm::dmat4 m = poseAt(scene, seconds).instances.at(0).world_from_object;
    for (int column = 0; column < 3; ++column) {
        glm::dvec3 unit(0);
        unit[column] = 1;
        EXPECT_LE(glm::length(glm::dvec3(m[column]) - turned(unit, angle)), bound)
            << what << ", column " << column;
    }
}

TEST(GltfRotation, OfANodeIsMadeUnit) {
    for (const double length : lengths)
        for (const double angle : {30 * degrees, 90 * degrees, 179 * degrees}) {
            GltfFile f = GltfFile::triangle();
            f.json["nodes"][0]["rotation"] = xyzw(angle, length);
            expectTurned(f.load(), 0, angle, 1e-14, fmt::format("length {}", length));
        }
}

// A node with an animated translation keeps its rotation as a separate part.
TEST(GltfRotation, OfANodeThatMovesIsMadeUnit) {
    for (const double length : lengths) {
        GltfFile f = GltfFile::triangle();
        f.json["nodes"][0]["rotation"] = xyzw(50 * degrees, length);
        const int times = f.accessor<float>({0, 1}, FLOAT, "SCALAR", 1),
                  places = f.accessor<float>({0, 0, 0, 4, 0, 0}, FLOAT, "VEC3", 3);
        f.json["animations"] = {
            {{"samplers", {{{"input", times}, {"output", places}}}},
             {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}}};
        const Scene scene = f.load();
        expectTurned(scene, 0.5, 50 * degrees, 1e-14, fmt::format("length {}", length));
        EXPECT_NEAR(poseAt(scene, 0.5).instances.at(0).world_from_object[3].x, 2, 1e-12);
    }
}

// Keys of 20 and 80 degrees, one shorter and one longer than unit length. Halfway it is 50 degrees at any
// length. A spline depends on the lengths, so its keys have the same length.
TEST(GltfRotation, OfKeysIsMadeUnit) {
    for (const double length : lengths)
        for (const std::string interpolation : {"STEP", "LINEAR", "CUBICSPLINE"}) {
            const bool cubic = interpolation == "CUBICSPLINE";
            std::vector<float> values;
            for (const auto& [angle, size] : {std::pair{20.0, length}, {80.0, cubic ? length : 1 / length}}) {
                if (cubic) values.insert(values.end(), 4, 0.0f);
                for (const double q : xyzw(angle * degrees, size)) values.push_back(static_cast<float>(q));
                if (cubic) values.insert(values.end(), 4, 0.0f);
            }
            GltfFile f = GltfFile::triangle();
            const int times = f.accessor<float>({0, 1}, FLOAT, "SCALAR", 1),
                      turns = f.accessor<float>(values, FLOAT, "VEC4", 4);
            f.json["animations"] = {
                {{"samplers", {{{"input", times}, {"output", turns}, {"interpolation", interpolation}}}},
                 {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "rotation"}}}}}}}};
            const Scene scene = f.load();
            const std::string what = fmt::format("{}, length {}", interpolation, length);
            // The loader normalizes keys, except those of splines.
            const std::vector<float>& stored = scene.animations.at(0).keyframes.at(0).values;
            for (std::size_t i = 0; i + 3 < stored.size() && !cubic; i += 4)
                EXPECT_NEAR(std::hypot(std::hypot(stored[i], stored[i + 1]),
                                       std::hypot(stored[i + 2], stored[i + 3])),
                            1, 2e-7)
                    << what;
            // The keys are float32: the angle's rounding is twice a quaternion's.
            constexpr double rounding = 5e-7;
            expectTurned(scene, 0, 20 * degrees, rounding, what);
            expectTurned(scene, 0.5, (interpolation == "STEP" ? 20 : 50) * degrees, rounding, what);
            if (interpolation == "LINEAR") expectTurned(scene, 0.25, 35 * degrees, rounding, what);
            expectTurned(scene, 2, 80 * degrees, rounding, what);
        }
}

// Sampling does not rely on the loader: two keys of different lengths also rotate evenly.
TEST(GltfRotation, SamplingMakesKeysUnit) {
    for (const double length : lengths) {
        Keyframes keys{Interpolation::linear, {0, 1}, {}, 4};
        for (const auto& [angle, size] : {std::pair{20.0, length}, {80.0, 1 / length}})
            for (const double q : xyzw(angle * degrees, size)) keys.values.push_back(static_cast<float>(q));
        for (const double u : {0.25, 0.5}) {
            const std::vector<double> q = sampled(keys, AnimatedPart::rotation, u);
            const std::array<double, 4> expected = xyzw((20 + 60 * u) * degrees, 1);
            for (std::size_t c = 0; c < 4; ++c) EXPECT_NEAR(q[c], expected[c], 2e-7) << length << " at " << u;
        }
    }
}

// Components in signed bytes are off by up to 1/254, so hardly any such quaternion has unit length.
TEST(GltfRotation, OfNormalisedIntegersIsMadeUnit) {
    std::vector<std::int8_t> bytes;
    for (const double q : xyzw(70 * degrees, 1))
        bytes.push_back(static_cast<std::int8_t>(std::lround(q * 127)));
    GltfFile f = GltfFile::triangle();
    const int times = f.accessor<float>({0}, FLOAT, "SCALAR", 1),
              turns = f.accessor(bytes, BYTE, "VEC4", 4, true);
    f.json["animations"] = {
        {{"samplers", {{{"input", times}, {"output", turns}}}},
         {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "rotation"}}}}}}}};
    const Scene scene = f.load();
    expectTurned(scene, 0, 70 * degrees, 0.02, "bytes");
    const glm::dmat3 m(poseAt(scene, 0).instances.at(0).world_from_object);
    double length = 0;
    for (const std::int8_t b : bytes) length += b / 127.0 * (b / 127.0);
    EXPECT_GT(std::abs(length - 1), 1e-4) << "or nothing is tested";
    for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b) EXPECT_NEAR(glm::dot(m[a], m[b]), a == b, 1e-14) << "orthonormal";
}

// Lights and cameras may be in rotated nodes, too.
TEST(GltfRotation, LightsAndCamerasAreTurnedAlike) {
    for (const double length : lengths) {
        GltfFile f = GltfFile::triangle();
        f.json["extensionsUsed"] = {"KHR_lights_punctual"};
        f.json["extensions"]["KHR_lights_punctual"]["lights"] = {
            {{"type", "spot"}, {"spot", nlohmann::json::object()}}};
        f.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.5}}}}};
        f.json["nodes"] = {{{"mesh", 0}, {"children", {1}}, {"rotation", xyzw(40 * degrees, length)}},
                           {{"camera", 0},
                            {"translation", {0, 0, 3}},
                            {"rotation", xyzw(15 * degrees, 1 / length)},
                            {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}}};
        const Scene scene = f.load();
        const Pose pose = poseAt(scene, 0);
        const glm::dvec3 away = turned({0, 0, -1}, 55 * degrees), place = turned({0, 0, 3}, 40 * degrees);
        EXPECT_LE(glm::length(pose.lights.at(0).direction - away), 1e-14) << length;
        EXPECT_LE(glm::length(pose.lights.at(0).position - place), 1e-14) << length;
        const glm::dmat4& camera = pose.cameras.at(0).world_from_camera;
        EXPECT_LE(glm::length(glm::dvec3(camera[2]) + away), 1e-14) << length;
        EXPECT_LE(glm::length(glm::dvec3(camera[3]) - place), 1e-14) << length;
    }
}

}  // namespace
}  // namespace diptych
