// SPDX-License-Identifier: MIT
#include "shared/scene/motion/posed.h"

#include "shared/contract/posing.h"
#include "shared/scene/model/material_slots.h"
#include "shared/scene/model/tangent_space.h"
#include "shared/scene/motion/morphed_tangents.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace diptych {

namespace {

// Inverse transpose times the determinant; also defined for singular matrices.
glm::dmat3 cofactors(const glm::dmat3& m) {
    return {glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1])};
}

// Inverse transpose times the sign of the determinant, within the limits of posing.h.
glm::dmat3 inverseTranspose(const glm::dmat3& m) {
    double largest = 0;
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r) largest = std::max(largest, std::abs(m[c][r]));
    if (!(largest > 0)) return glm::dmat3(0);
    const glm::dmat3 axes = m / largest;
    const double min = double{gpu::MIN_DETERMINANT}, max = double{gpu::MAX_INVERSE};
    return cofactors(axes) * std::min(1 / largest / std::max(std::abs(glm::determinant(axes)), min), max);
}

// Computes the posed vertices of one instance.
class Posing {
public:
    Posing(const Scene& scene, const Pose& pose, const Instance& instance)
        : primitive_(primitiveOf(scene, instance)),
          world_from_object_(instance.world_from_object),
          world_from_mesh_(instance.skin < 0 ? nullptr
                                             : &pose.skins[static_cast<std::size_t>(instance.skin)]),
          weights_(instance.weights < 0 ? nullptr
                                        : &pose.weights[static_cast<std::size_t>(instance.weights)]) {}

    const Primitive& primitive() const { return primitive_; }

    // A vertex attribute plus its weighted morph deltas, in object space. `deltas` of a target may be empty.
    template <class Sum, class T, class Deltas>
    Sum morphed(const std::vector<T>& base, const Deltas& deltas, std::size_t vertex) const {
        Sum sum(base[vertex]);
        if (!weights_) return sum;
        for (std::size_t t = 0; t < primitive_.targets.size(); ++t) {
            const auto& delta = std::invoke(deltas, primitive_.targets[t]);
            if (!delta.empty()) sum += (*weights_)[t] * Sum(delta[vertex]);
        }
        return sum;
    }
    glm::dvec3 position(std::size_t v) const {
        return morphed<glm::dvec3>(primitive_.positions, &MorphTarget::positions, v);
    }
    glm::dvec3 normal(std::size_t v) const {
        return morphed<glm::dvec3>(primitive_.normals, &MorphTarget::normals, v);
    }
    glm::dvec3 tangent(std::size_t v) const {
        return morphed<glm::dvec3>(primitive_.tangents, &MorphTarget::tangents, v);
    }
    glm::dvec2 texcoord(int set, std::size_t v) const {
        return morphed<glm::dvec2>(
            primitive_.texcoords[set], [set](const MorphTarget& t) -> auto& { return t.texcoords[set]; }, v);
    }
    glm::dvec4 color(std::size_t v) const {
        return glm::clamp(morphed<glm::dvec4>(primitive_.colors, &MorphTarget::colors, v), 0.0, 1.0);
    }

    // Whether a target of non-zero weight satisfies `moves`.
    template <class Moves>
    bool isMoved(const Moves& moves) const {
        if (!weights_) return false;
        for (std::size_t t = 0; t < primitive_.targets.size(); ++t)
            if ((*weights_)[t] != 0 && moves(primitive_.targets[t])) return true;
        return false;
    }

    // Weighted mean of the joint matrices, normalized, because float32 weights add up to 1 only within
    // rounding.
    glm::dmat4 worldFrom(std::size_t vertex) const {
        if (!world_from_mesh_) return world_from_object_;
        glm::dmat4 sum(0);
        double whole = 0;
        addJoints(vertex, [&](const glm::dmat4& joint, double weight) {
            sum += weight * joint;
            whole += weight;
        });
        return sum / whole;
    }

    // A normal in world axes, not normalized, not yet oriented to the front side.
    glm::dvec3 turned(std::size_t vertex, const glm::dvec3& normal, bool blended) const {
        if (blended || !world_from_mesh_) return cofactors(glm::dmat3(worldFrom(vertex))) * normal;
        glm::dvec3 sum(0);
        addJoints(vertex, [&](const glm::dmat4& joint, double weight) {
            sum += weight * (inverseTranspose(glm::dmat3(joint)) * normal);
        });
        return sum;
    }

private:
    template <class Add>
    void addJoints(std::size_t vertex, const Add& add) const {
        for (const JointSet& set : primitive_.joint_sets)
            for (int i = 0; i < 4; ++i)
                if (const double weight = set.weights[vertex][i]; weight > 0)
                    add((*world_from_mesh_)[set.joints[vertex][i]], weight);
    }

    const Primitive& primitive_;
    const glm::dmat4 world_from_object_;
    const std::vector<glm::dmat4>* world_from_mesh_;  // by joint; nullptr: not skinned
    const std::vector<double>* weights_;              // by target; nullptr: no morph target applies
};

glm::dvec3 withinLimits(const glm::dvec4& p) {
    for (int c = 0; c < 3; ++c)
        if (!(std::abs(p[c]) <= maxCoordinate)) return glm::dvec3(std::numeric_limits<double>::quiet_NaN());
    return glm::dvec3(p);
}

// Scales before normalizing, because the square of a very long or short vector may exceed double's range.
glm::dvec3 safeUnit(const glm::dvec3& v) {
    const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    return largest > 0 && std::isfinite(largest) ? glm::normalize(v / largest) : glm::dvec3(0);
}

void makeFlat(const std::vector<glm::dvec3>& positions, const std::vector<std::uint32_t>& indices,
              double handedness, std::vector<glm::dvec3>& normals) {
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        const glm::dvec3 &a = positions[indices[i]], &b = positions[indices[i + 1]],
                         &c = positions[indices[i + 2]];
        const glm::dvec3 normal = handedness * safeUnit(glm::cross(b - a, c - a));
        for (std::size_t corner = 0; corner < 3; ++corner) normals[indices[i + corner]] = normal;
    }
}

// In object space, before skinning.
std::vector<glm::dvec3> tangentsOf(const Posing& posing, const TextureSlot& map, bool map_rotated) {
    const Primitive& primitive = posing.primitive();
    const std::size_t count = primitive.positions.size();
    std::vector<glm::dvec3> tangents(count);
    const auto moves = [&](const MorphTarget& target) { return movesTangents(target, map.texcoord); };
    if (primitive.tangent_groups.empty() || (!map_rotated && !posing.isMoved(moves))) {
        for (std::size_t v = 0; v < count; ++v) tangents[v] = posing.tangent(v);
        return tangents;
    }
    std::vector<glm::dvec3> positions(count), normals(count);
    std::vector<glm::dvec2> texcoords(count);
    for (std::size_t v = 0; v < count; ++v) {
        positions[v] = posing.position(v);
        normals[v] = safeUnit(posing.normal(v));
        texcoords[v] = posing.texcoord(map.texcoord, v);
    }
    if (primitive.flat) makeFlat(positions, primitive.indices, 1, normals);
    return morphedTangents(primitive, map, positions, normals, texcoords);
}

}  // namespace

std::vector<glm::dvec3> posedPositions(const Scene& scene, const Pose& pose, const Instance& instance) {
    const Posing posing(scene, pose, instance);
    std::vector<glm::dvec3> result(posing.primitive().positions.size());
    for (std::size_t v = 0; v < result.size(); ++v)
        result[v] = withinLimits(posing.worldFrom(v) * glm::dvec4(posing.position(v), 1));
    return result;
}

PosedVertices posedVertices(const Scene& scene, const Pose& pose, const Instance& instance,
                            bool blended_normals) {
    const Posing posing(scene, pose, instance);
    const Primitive& primitive = posing.primitive();
    const double handedness = glm::determinant(glm::dmat3(instance.world_from_object)) < 0 ? -1 : 1;
    PosedVertices result;
    const std::size_t count = primitive.positions.size();
    result.positions.resize(count);
    result.normals.resize(count);
    const auto material = static_cast<std::size_t>(primitive.material);
    const TextureSlot map = tangentMap(materialsOf(scene, pose)[material]);
    result.tangents = tangentsOf(posing, map, instance.map_rotated);
    if (instance.map_rotated) result.bitangents = mirroredSign(tangentMap(scene.materials[material]), map);
    for (std::size_t v = 0; v < count; ++v) {
        const glm::dmat4 world = posing.worldFrom(v);
        result.positions[v] = withinLimits(world * glm::dvec4(posing.position(v), 1));
        result.normals[v] = handedness * safeUnit(posing.turned(v, posing.normal(v), blended_normals));
        result.tangents[v] = safeUnit(glm::dmat3(world) * result.tangents[v]);
    }
    if (primitive.flat) makeFlat(result.positions, primitive.indices, handedness, result.normals);
    for (int set = 0; set < 2; ++set)
        if (posing.isMoved([set](const MorphTarget& target) { return !target.texcoords[set].empty(); }))
            for (std::size_t v = 0; v < count; ++v) result.texcoords[set].push_back(posing.texcoord(set, v));
    if (posing.isMoved([](const MorphTarget& target) { return !target.colors.empty(); }))
        for (std::size_t v = 0; v < count; ++v) result.colors.push_back(posing.color(v));
    return result;
}

}  // namespace diptych
