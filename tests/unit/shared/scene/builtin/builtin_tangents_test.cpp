// SPDX-License-Identifier: MIT
// builtin:tangents, compared with the derivatives of its planes and columns in closed form.
#include "shared/scene/builtin/builtin.h"
#include "shared/scene/motion/pose.h"
#include "shared/scene/motion/posed.h"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <cmath>
#include <numbers>
#include <string>

namespace diptych {
namespace {

class BuiltinTangents : public testing::TestWithParam<double> {};

// At rest, rotated, and rotated and mirrored by its animation.
TEST_P(BuiltinTangents, AreThoseOfTheTransformedCoordinatesInClosedForm) {
    const Scene scene = makeBuiltin("tangents");
    const Pose pose = poseAt(scene, GetParam());
    int planes = 0, columns = 0;
    for (const Instance& instance : pose.instances) {
        const Mesh& mesh = scene.meshes.at(static_cast<std::size_t>(instance.mesh));
        const Primitive& p = mesh.primitives.at(0);
        const TextureSlot& map =
            materialsOf(scene, pose).at(static_cast<std::size_t>(p.material)).normal_texture;
        ASSERT_EQ(instance.deformed(), GetParam() > 0) << "none is posed that is as at rest";
        const PosedVertices posed = posedVertices(scene, pose, instance);
        const bool column = mesh.name.starts_with("column");
        ++(column ? columns : planes);
        // Derivatives of the map's coordinates along u and v of the first set. The second set is (v, 1 -
        // u).
        const bool second = map.texcoord == 1;
        const glm::dvec2 u = second ? glm::dvec2(-map.u.y, map.u.x) : glm::dvec2(map.u);
        const glm::dvec2 v = second ? glm::dvec2(-map.v.y, map.v.x) : glm::dvec2(map.v);
        const double determinant = u.x * v.y - u.y * v.x;
        // A column's 64 chords are shorter than the arcs by 1 - sinc(2 pi / 64) = 1.6e-3. The angle
        // weights of triangles left and right of a vertex differ by as little.
        const double tolerance = column ? 3e-3 : 1e-6;
        for (std::size_t i = 0; i < p.positions.size(); ++i) {
            const glm::dvec3 n(p.normals[i]), t(posed.tangents[i]);
            const glm::dvec3 along_u = column
                                           ? 2 * std::numbers::pi * 0.4 * glm::cross(glm::dvec3(0, 1, 0), n)
                                           : glm::dvec3(1, 0, 0);
            const glm::dvec3 along_v(0, -1.6, 0);
            // Inverse of the matrix with rows u and v.
            const glm::dvec3 expected = (v.y * along_u - v.x * along_v) / determinant;
            const glm::dvec3 downwards = (-u.y * along_u + u.x * along_v) / determinant;
            EXPECT_LT(glm::length(t - glm::normalize(expected)), tolerance) << mesh.name << " vertex " << i;
            const double sign = glm::dot(glm::cross(n, t), downwards) < 0 ? 1 : -1;
            EXPECT_EQ(p.tangents[i].w * posed.bitangents, sign) << mesh.name << " vertex " << i;
        }
    }
    EXPECT_EQ(planes, 7);
    EXPECT_EQ(columns, 7);
}

INSTANTIATE_TEST_SUITE_P(Seconds, BuiltinTangents, testing::Values(0.0, 1.5, 3.5));

}  // namespace
}  // namespace diptych
