// SPDX-License-Identifier: MIT
// The reference applies a file's quaternion of any length: a tilted plane at its exact positions.
#include "tests/support/gltf_builder.h"
#include "tests/support/reference_scene.h"

namespace diptych::reference {
namespace {

// The plane z = 0, rotated by 30 degrees around +X, seen along -Z from 5 m. The ray through (x, y) of the
// image plane at distance 1 has y = v t and z = 5 - t; it hits the plane where z = y tan 30.
TEST(ReferenceRotation, OfAnyLengthDrawsTheSamePlane) {
    const double angle = glm::radians(30.0), slope = std::tan(angle);
    const View view = viewFrom({0, 0, 5}, {0, 0, 0}, 8, 8, glm::radians(20.0));
    for (const bool animated : {false, true})
        for (const double length : {0.5, 1.0, 2.0}) {
            GltfFile f;
            const int positions = f.accessor<float>(
                {-9, -9, 0, 9, -9, 0, 9, 9, 0, -9, -9, 0, 9, 9, 0, -9, 9, 0}, FLOAT, "VEC3", 3);
            f.json["meshes"] = {{{"primitives", {{{"attributes", {{"POSITION", positions}}}}}}}};
            const std::array<double, 4> q{std::sin(angle / 2) * length, 0, 0, std::cos(angle / 2) * length};
            f.json["nodes"] = {{{"mesh", 0}}};
            if (animated) {
                const int times = f.accessor<float>({0}, FLOAT, "SCALAR", 1);
                const int turns = f.accessor<float>(
                    {static_cast<float>(q[0]), 0, 0, static_cast<float>(q[3])}, FLOAT, "VEC4", 4);
                f.json["animations"] = {
                    {{"samplers", {{{"input", times}, {"output", turns}}}},
                     {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "rotation"}}}}}}}};
            } else {
                f.json["nodes"][0]["rotation"] = q;
            }
            const Drawn image = drawn(f.load(), view);
            for (const auto& [x, y] : {std::pair{0, 0}, {5, 2}, {7, 7}}) {
                const double unit = std::tan(glm::radians(10.0)), v = (1 - (y + 0.5) / 4) * unit;
                const double t = 5 / (1 + v * slope);
                EXPECT_NEAR(double{image[Channel::depth].at(x, y)}, t, 1e-5) << length << animated;
                const Image& normals = image[Channel::normals];
                EXPECT_NEAR(double{normals.at(x, y, 0)}, 0, 1e-6) << length << animated;
                EXPECT_NEAR(double{normals.at(x, y, 1)}, -std::sin(angle), 1e-6) << length << animated;
                EXPECT_NEAR(double{normals.at(x, y, 2)}, std::cos(angle), 1e-6) << length << animated;
            }
        }
}

}  // namespace
}  // namespace diptych::reference
