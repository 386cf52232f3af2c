// SPDX-License-Identifier: MIT
#include "shared/scene/motion/posed.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace diptych {

namespace {

// Computes the posed vertices of one instance.
class Posing {
public:
    Posing(const Scene& scene, const Pose& pose, const Instance& instance)
        : primitive_(scene.meshes[static_cast<std::size_t>(instance.mesh)]
                         .primitives[static_cast<std::size_t>(instance.primitive)]),
          world_from_object_(instance.world_from_object),
          world_from_mesh_(instance.skin < 0 ? nullptr
                                             : &pose.skins[static_cast<std::size_t>(instance.skin)]),
          weights_(instance.weights < 0 ? nullptr
                                        : &pose.weights[static_cast<std::size_t>(instance.weights)]) {}

    const Primitive& primitive() const { return primitive_; }

    // A vertex's attribute plus the weighted sum of its morph targets, in object space.
    template <class T>
    glm::dvec3 morphed(const std::vector<T>& base, std::vector<glm::vec3> MorphTarget::*deltas,
                       std::size_t vertex) const {
        glm::dvec3 sum(base[vertex]);
        if (!weights_) return sum;
        for (std::size_t t = 0; t < primitive_.targets.size(); ++t) {
            const std::vector<glm::vec3>& delta = primitive_.targets[t].*deltas;
            if (!delta.empty()) sum += (*weights_)[t] * glm::dvec3(delta[vertex]);
        }
        return sum;
    }

    // The weighted mean of the joints' matrices. float32 weights add up to 1 but for rounding, so the sum is
    // divided by their sum.
    glm::dmat4 worldFrom(std::size_t vertex) const {
        if (!world_from_mesh_) return world_from_object_;
        glm::dmat4 sum(0);
        double whole = 0;
        for (const JointSet& set : primitive_.joint_sets)
            for (int i = 0; i < 4; ++i) {
                const double weight = set.weights[vertex][i];
                if (!(weight > 0)) continue;
                sum += weight * (*world_from_mesh_)[set.joints[vertex][i]];
                whole += weight;
            }
        return sum / whole;
    }

private:
    const Primitive& primitive_;
    const glm::dmat4 world_from_object_;
    const std::vector<glm::dmat4>* world_from_mesh_;  // by joint; nullptr: not skinned
    const std::vector<double>* weights_;              // nullptr: no morph target applies
};

glm::dvec3 placed(const glm::dvec4& p) {
    for (int c = 0; c < 3; ++c)
        if (!(std::abs(p[c]) <= maxCoordinate)) return glm::dvec3(std::numeric_limits<double>::quiet_NaN());
    return glm::dvec3(p);
}

// Normalised without squaring the components directly: the square of a very long or short vector may leave
// double's range.
glm::dvec3 unitOrZero(const glm::dvec3& v) {
    const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    return largest > 0 && std::isfinite(largest) ? glm::normalize(v / largest) : glm::dvec3(0);
}

// The inverse transpose times the determinant; it exists also for singular matrices.
glm::dmat3 cofactors(const glm::dmat3& m) {
    return {glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1])};
}

void makeFlat(PosedVertices& posed, const std::vector<std::uint32_t>& indices, double handedness) {
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        const glm::dvec3 &a = posed.positions[indices[i]], &b = posed.positions[indices[i + 1]],
                         &c = posed.positions[indices[i + 2]];
        const glm::dvec3 normal = handedness * unitOrZero(glm::cross(b - a, c - a));
        for (std::size_t corner = 0; corner < 3; ++corner) posed.normals[indices[i + corner]] = normal;
    }
}

}  // namespace

std::vector<glm::dvec3> posedPositions(const Scene& scene, const Pose& pose, const Instance& instance) {
    const Posing posing(scene, pose, instance);
    const std::vector<glm::vec3>& positions = posing.primitive().positions;
    std::vector<glm::dvec3> result(positions.size());
    for (std::size_t v = 0; v < result.size(); ++v)
        result[v] = placed(posing.worldFrom(v) *
                           glm::dvec4(posing.morphed(positions, &MorphTarget::positions, v), 1));
    return result;
}

PosedVertices posedVertices(const Scene& scene, const Pose& pose, const Instance& instance) {
    const Posing posing(scene, pose, instance);
    const Primitive& primitive = posing.primitive();
    const double handedness = glm::determinant(glm::dmat3(instance.world_from_object)) < 0 ? -1 : 1;
    PosedVertices result;
    const std::size_t count = primitive.positions.size();
    result.positions.resize(count);
    result.normals.resize(count);
    result.tangents.resize(count);
    for (std::size_t v = 0; v < count; ++v) {
        const glm::dmat4 world = posing.worldFrom(v);
        const glm::dmat3 axes(world);
        result.positions[v] =
            placed(world * glm::dvec4(posing.morphed(primitive.positions, &MorphTarget::positions, v), 1));
        result.normals[v] =
            handedness *
            unitOrZero(cofactors(axes) * posing.morphed(primitive.normals, &MorphTarget::normals, v));
        result.tangents[v] = unitOrZero(axes * posing.morphed(primitive.tangents, &MorphTarget::tangents, v));
    }
    if (primitive.flat) makeFlat(result, primitive.indices, handedness);
    return result;
}

}  // namespace diptych
