// SPDX-License-Identifier: MIT
#include "shared/scene/model/tangents.h"

#include "shared/scene/model/tangent_space.h"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <numeric>
#include <optional>
#include <type_traits>

namespace diptych {

namespace {

// Replaces the vertices of `primitive` by its vertices `source`, in that order.
void gather(Primitive& primitive, const std::vector<std::uint32_t>& source) {
    const auto take = [&](auto& attribute) {
        if (attribute.empty()) return;
        std::remove_reference_t<decltype(attribute)> taken;
        taken.reserve(source.size());
        for (const std::uint32_t v : source) taken.push_back(attribute[v]);
        attribute = std::move(taken);
    };
    take(primitive.positions);
    take(primitive.normals);
    take(primitive.tangents);
    take(primitive.texcoords[0]);
    take(primitive.texcoords[1]);
    take(primitive.colors);
    for (JointSet& set : primitive.joint_sets) take(set.joints), take(set.weights);
    for (MorphTarget& target : primitive.targets) {
        take(target.positions), take(target.normals), take(target.tangents);
        take(target.texcoords[0]), take(target.texcoords[1]), take(target.colors);
    }
}

// The groups of `space` that the vertices use, renumbered in order. `group` is per vertex; ~0: none.
TangentGroups groupsOf(const TangentSpace& space, const std::vector<std::uint32_t>& indices,
                       const std::vector<std::uint32_t>& group) {
    constexpr std::uint32_t unset = ~0u;
    std::vector<std::uint32_t> new_index(space.groupCount(), unset);
    std::uint32_t count = 0;
    for (const std::uint32_t g : group)
        if (g != unset && new_index[g] == unset) new_index[g] = count++;
    TangentGroups groups;
    groups.of_vertex.reserve(group.size());
    for (const std::uint32_t g : group) groups.of_vertex.push_back(g == unset ? count : new_index[g]);
    // Counting sort, by group, of the corners that have derivatives.
    std::vector<std::uint32_t> next(std::size_t{count} + 1, 0);
    const auto visit = [&](const auto& use) {
        for (std::size_t corner = 0; corner + 2 < indices.size(); corner += 3)
            if (space.counts(corner / 3))
                for (std::size_t i = 0; i < 3; ++i) use(corner + i, groups.of_vertex[indices[corner + i]]);
    };
    visit([&](std::size_t, std::uint32_t g) { ++next[g + 1]; });
    std::partial_sum(next.begin(), next.end(), next.begin());
    groups.first = next;
    groups.corners.resize(next.back());
    visit([&](std::size_t corner, std::uint32_t g) {
        groups.corners[next[g]++] = static_cast<std::uint32_t>(corner);
    });
    return groups;
}

TangentRotation between(const glm::vec3& normal, const glm::vec4& from, const glm::vec4& to) {
    const glm::dvec3 tangent(from), other(to),
        bitangent = double{from.w} * glm::cross(glm::dvec3(normal), tangent);
    const glm::dvec2 rotation(glm::dot(tangent, other), glm::dot(bitangent, other));
    const double length = glm::length(rotation);
    if (!(length > 0)) return {};
    return {rotation.x / length, rotation.y / length, (from.w < 0) != (to.w < 0)};
}

constexpr std::uint32_t ungrouped = ~0u;

struct SplitVertices {
    std::vector<std::uint32_t> source;  // the vertex of the primitive that each copies
    std::vector<glm::vec4> tangents;    // 0: no triangle uses the vertex
    std::vector<std::uint32_t> groups;  // `ungrouped` if tangents do not move
};

// A vertex keeps its first tangent, and is copied for each other tangent (or group).
// Corners with equal tangents share a copy if the search is short: a vertex of a million triangles may
// have a million tangents.
template <class TangentAt, class GroupAt>
SplitVertices splitByTangent(Primitive& primitive, const TangentAt& tangentAt, const GroupAt& groupAt) {
    constexpr std::uint32_t last = ungrouped;
    constexpr int maxShared = 16;
    std::vector<std::uint32_t> source(primitive.positions.size());
    for (std::uint32_t v = 0; v < source.size(); ++v) source[v] = v;
    std::vector<glm::vec4> tangents(source.size(), glm::vec4(0));  // 0: not set
    std::vector<std::uint32_t> groups(source.size(), last);        // `last` if tangents do not move
    std::vector<std::uint32_t> nextCopy(source.size(), last);
    for (std::size_t corner = 0; corner < primitive.indices.size(); ++corner) {
        const glm::vec4 tangent = tangentAt(corner);
        const std::uint32_t group = groupAt(corner);
        std::uint32_t v = primitive.indices[corner];
        for (int copies = 0; tangents[v] != glm::vec4(0) && (tangents[v] != tangent || groups[v] != group);
             ++copies) {
            if (nextCopy[v] == last || copies == maxShared) {
                const auto copy = static_cast<std::uint32_t>(source.size());
                if (copies < maxShared) nextCopy[v] = copy;
                source.push_back(source[v]);
                tangents.push_back(glm::vec4(0));
                groups.push_back(last);
                nextCopy.push_back(last);
                v = copy;
            } else {
                v = nextCopy[v];
            }
        }
        tangents[v] = tangent;
        groups[v] = group;
        primitive.indices[corner] = v;
    }
    return {std::move(source), std::move(tangents), std::move(groups)};
}

}  // namespace

TangentRotation TangentRotation::of(float w) {
    const double coded = std::abs(double{w}) - 1, rotation = coded - std::floor(coded);
    const auto side = [](double t) { return 4 * std::abs(t - std::floor(t) - 0.5) - 1; };
    const glm::dvec2 on_square(side(rotation), side(rotation + 0.75));
    const glm::dvec2 unit = glm::normalize(on_square);
    return {unit.x, unit.y, coded >= 1};
}

float TangentRotation::times(float sign) const {
    const double x = cosine / (std::abs(cosine) + std::abs(sine)), rotation = (sine < 0 ? 3 + x : 1 - x) / 4;
    const float min = mirrored ? 2 : 1, coded = static_cast<float>(double{min} + rotation);
    return sign * (coded < min + 1 ? coded : min);
}

glm::vec4 rotatedTangent(const glm::vec3& normal, const glm::vec4& tangent) {
    const TangentRotation rotation = TangentRotation::of(tangent.w);
    const float sign = signOf(tangent.w);
    const glm::vec3 along(tangent);
    return {along * static_cast<float>(rotation.cosine) +
                glm::cross(normal, along) * (sign * static_cast<float>(rotation.sine)),
            rotation.mirrored ? -sign : sign};
}

void makeFlatNormals(Primitive& primitive) {
    primitive.normals.clear();
    gather(primitive, primitive.indices);
    primitive.normals.resize(primitive.positions.size());
    for (std::uint32_t i = 0; i < primitive.indices.size(); ++i) primitive.indices[i] = i;
    for (std::size_t i = 0; i + 2 < primitive.positions.size(); i += 3) {
        const glm::dvec3 a(primitive.positions[i]), b(primitive.positions[i + 1]),
            c(primitive.positions[i + 2]);
        const glm::dvec3 n = glm::cross(b - a, c - a);
        const double length = glm::length(n);
        const glm::vec3 normal = length > 0 ? glm::vec3(n / length) : glm::vec3(0, 0, 1);
        std::fill_n(primitive.normals.begin() + static_cast<std::ptrdiff_t>(i), 3, normal);
    }
}

void makeAnyTangents(Primitive& primitive) {
    primitive.tangents.clear();
    primitive.tangent_groups = {};
    for (const glm::vec3& normal : primitive.normals) primitive.tangents.push_back(anyTangent(normal));
}

void makeTangents(Primitive& primitive, const TextureSlot& map, bool map_turns, const TextureSlot* turned) {
    const auto isThere = [&](int set) { return set >= 0 && set <= 1 && !primitive.texcoords[set].empty(); };
    std::optional<TangentSpace> other;
    if (turned && isThere(turned->texcoord)) other.emplace(primitive, *turned);
    if (!isThere(map.texcoord) && !other) return makeAnyTangents(primitive);
    primitive.tangents.clear();
    // A map with zero extent at rest gets one later. Its bitangent signs are those of the unmapped
    // coordinates.
    const bool flattened = map_turns && map.u.x * map.v.y - map.u.y * map.v.x == 0;
    const TextureSlot read = flattened ? TextureSlot{.texture = map.texture, .texcoord = map.texcoord} : map;
    std::optional<TangentSpace> space;
    if (isThere(map.texcoord)) space.emplace(primitive, read);
    const auto tangentAt = [&](std::size_t corner) {
        const glm::vec3& normal = primitive.normals[primitive.indices[corner]];
        glm::vec4 tangent = space ? space->at(corner) : anyTangent(normal);
        if (other) tangent.w = between(normal, tangent, other->at(corner)).times(tangent.w);
        return tangent;
    };

    const bool moves =
        space && (map_turns || std::ranges::any_of(primitive.targets, [&](const MorphTarget& target) {
                      return movesTangents(target, map.texcoord);
                  }));

    SplitVertices split = splitByTangent(
        primitive, tangentAt, [&](std::size_t corner) { return moves ? space->groupAt(corner) : ungrouped; });
    TangentGroups made;  // before gather(), which replaces the vertices that `space` refers to
    if (moves) made = groupsOf(*space, primitive.indices, split.groups);
    gather(primitive, split.source);
    for (std::size_t v = 0; v < split.tangents.size(); ++v)
        if (split.tangents[v] == glm::vec4(0)) split.tangents[v] = anyTangent(primitive.normals[v]);
    primitive.tangents = std::move(split.tangents);
    primitive.tangent_groups = std::move(made);
}

}  // namespace diptych
