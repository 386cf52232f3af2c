// SPDX-License-Identifier: MIT
#include "shared/scene/motion/morphed_tangents.h"

#include "shared/scene/model/tangent_space.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cfloat>
#include <cmath>

namespace diptych {

namespace {

// Same threshold as in makeTangents(), so that both reject the same triangles.
glm::dvec3 directionOf(const glm::dvec3& v) {
    const double length = glm::length(v);
    return length > FLT_MIN ? v / length : glm::dvec3(0);
}
glm::dvec3 withinPlane(const glm::dvec3& normal, const glm::dvec3& v) {
    return directionOf(v - normal * glm::dot(normal, v));
}

// Unit dP/ds of a triangle; 0 if it has no derivatives. st: texture coordinates, t upwards.
glm::dvec3 derivative(const glm::dvec3 (&p)[3], const glm::dvec2 (&st)[3]) {
    if (p[0] == p[1] || p[1] == p[2] || p[2] == p[0]) return glm::dvec3(0);
    const glm::dvec2 b = st[1] - st[0], c = st[2] - st[0];
    const double area = b.x * c.y - b.y * c.x;
    if (!(std::abs(area) > FLT_MIN)) return glm::dvec3(0);
    const glm::dvec3 ds = (c.y * (p[1] - p[0]) - b.y * (p[2] - p[0])) / area;
    const glm::dvec3 dt = (b.x * (p[2] - p[0]) - c.x * (p[1] - p[0])) / area;
    return glm::length(dt) > FLT_MIN ? directionOf(ds) : glm::dvec3(0);
}

}  // namespace

std::vector<glm::dvec3> morphedTangents(const Primitive& primitive, const TextureSlot& map,
                                        const std::vector<glm::dvec3>& positions,
                                        const std::vector<glm::dvec3>& normals,
                                        const std::vector<glm::dvec2>& texcoords) {
    const TangentGroups& groups = primitive.tangent_groups;
    std::vector<glm::dvec3> sums(groups.count(), glm::dvec3(0));
    for (std::uint32_t g = 0; g < groups.count(); ++g)
        for (std::uint32_t i = groups.first[g]; i < groups.first[g + 1]; ++i) {
            const std::uint32_t corner = groups.corners[i];
            const std::uint32_t* triangle = &primitive.indices[corner / 3 * 3];
            glm::dvec3 p[3];
            glm::dvec2 st[3];
            for (int c = 0; c < 3; ++c) {
                p[c] = positions[triangle[c]];
                const glm::dvec3 uv(texcoords[triangle[c]], 1);
                st[c] = {glm::dot(map.u, uv), 1 - glm::dot(map.v, uv)};
            }
            const glm::dvec3 along = derivative(p, st);
            if (along == glm::dvec3(0)) continue;
            const std::uint32_t c = corner % 3;
            const glm::dvec3& normal = normals[triangle[c]];
            const glm::dvec3 before = withinPlane(normal, p[(c + 2) % 3] - p[c]);
            const glm::dvec3 after = withinPlane(normal, p[(c + 1) % 3] - p[c]);
            const double angle = std::acos(std::clamp(glm::dot(before, after), -1.0, 1.0));
            sums[g] += angle * withinPlane(normal, along);
        }
    std::vector<glm::dvec3> tangents(positions.size());
    for (std::size_t v = 0; v < tangents.size(); ++v) {
        const std::uint32_t g = groups.of_vertex[v];
        const glm::dvec3 made = g < groups.count() ? directionOf(sums[g]) : glm::dvec3(0);
        tangents[v] = made != glm::dvec3(0) ? made : glm::dvec3(anyTangent(glm::vec3(normals[v])));
    }
    return tangents;
}

}  // namespace diptych
