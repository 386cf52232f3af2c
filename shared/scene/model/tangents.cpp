// SPDX-License-Identifier: MIT
#include "shared/scene/model/tangents.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cfloat>
#include <cmath>
#include <tuple>
#include <type_traits>

namespace diptych {

namespace {

// Replaces the vertices of `primitive` by the vertices `source` of it, in that order.
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
    for (MorphTarget& target : primitive.targets)
        take(target.positions), take(target.normals), take(target.tangents);
}

}  // namespace

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

// ---- MikkTSpace --------------------------------------------------------------------------------------
//
// M. Mikkelsen, "Simulation of Wrinkled Surfaces Revisited", 2008, section 3, in the words used there:
// vertices are welded where position, normal and UV agree; each triangle has the first-order derivatives
// of position by s and t; triangles around a vertex that share edges and orientation form a group; a
// group's tangent is the angle-weighted mean of its triangles' tangents, each projected into the plane of
// the vertex normal. The algorithm's default angular threshold of 180 degrees never splits a group, so
// none is applied. t is 1 - v: the bitangent must point towards the top of the picture (glTF's +Y of a
// normal map), and v grows downwards. Double throughout; inputs are float.
//
// UV are the coordinates that the normal map is read with, after KHR_texture_transform: a map that is turned
// or mirrored has its own directions on the surface.

namespace {

constexpr int none = -1;

// The algorithm's own test for zero.
bool notZero(double x) {
    return std::abs(x) > FLT_MIN;
}
glm::dvec3 unitOrZero(const glm::dvec3& v) {
    const double length = glm::length(v);
    return notZero(length) ? v / length : glm::dvec3(0);
}
glm::dvec3 inPlaneOf(const glm::dvec3& normal, const glm::dvec3& v) {
    return unitOrZero(v - normal * glm::dot(normal, v));
}

glm::vec4 anyTangent(const glm::vec3& normal) {
    const glm::dvec3 n(normal);
    const glm::dvec3 axis = std::abs(n.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 t = glm::cross(axis, n);
    const double length = glm::length(t);
    return length > 0 ? glm::vec4(glm::vec3(t / length), 1) : glm::vec4(1, 0, 0, 1);
}

// The values that decide whether two vertices are welded; 0 and -0 compare equal.
struct VertexKey {
    std::array<std::uint32_t, 8> bits;
    std::uint32_t vertex;
    bool sameAs(const VertexKey& other) const { return bits == other.bits; }
    auto operator<=>(const VertexKey&) const = default;
};

struct Triangle {
    std::array<int, 3> vertex;                      // welded
    std::array<int, 3> neighbor{none, none, none};  // across the edge from corner i to corner i + 1
    std::array<int, 3> group{none, none, none};     // that corner i belongs to
    glm::dvec3 tangent{0};                          // unit dP/ds
    bool degenerate = false;
    bool orientation_preserving = false;
    bool joins_any = true;  // has no derivative of its own: it joins whichever group reaches it first
};

class TangentSpace {
public:
    TangentSpace(const Primitive& primitive, const TextureSlot& map)
        : primitive_(primitive), map_(map), texcoords_(primitive.texcoords[map.texcoord]) {
        weld();
        derive();
        findNeighbors();
        group();
        average();
    }

    // The tangent at corner `corner` of the index list.
    glm::vec4 at(std::size_t corner) const {
        const Triangle& triangle = triangles_[corner / 3];
        const int vertex = triangle.vertex[corner % 3];
        int group = triangle.group[corner % 3];
        // A triangle without area takes the group of a valid triangle at the same vertex.
        if (group == none && triangle.degenerate) group = group_of_vertex_[static_cast<std::size_t>(vertex)];
        if (group == none || tangents_[static_cast<std::size_t>(group)] == glm::dvec3(0))
            return anyTangent(glm::vec3(normal(vertex)));
        return glm::vec4(glm::vec3(tangents_[static_cast<std::size_t>(group)]),
                         preserving_[static_cast<std::size_t>(group)] ? 1.0f : -1.0f);
    }

private:
    const Primitive& primitive_;
    const TextureSlot& map_;
    const std::vector<glm::vec2>& texcoords_;
    std::vector<std::uint32_t>
        source_;  // welded vertex -> the first of the primitive's vertices that it stands for
    std::vector<Triangle> triangles_;
    std::vector<int> vertex_of_group_;
    std::vector<int> group_of_vertex_;  // the first group at each welded vertex
    std::vector<bool> preserving_;      // per group
    std::vector<glm::dvec3> tangents_;  // per group

    glm::dvec3 position(int v) const {
        return glm::dvec3(primitive_.positions[source_[static_cast<std::size_t>(v)]]);
    }
    glm::dvec3 normal(int v) const {
        return glm::dvec3(primitive_.normals[source_[static_cast<std::size_t>(v)]]);
    }
    glm::dvec2 st(int v) const {
        const glm::dvec2 uv(texcoords_[source_[static_cast<std::size_t>(v)]]);
        const glm::dvec3 at(uv, 1);
        return {glm::dot(map_.u, at), 1 - glm::dot(map_.v, at)};
    }

    // By sorting rather than hashing: a file could be made of vertices that all have the same hash.
    void weld() {
        std::vector<VertexKey> keys(primitive_.positions.size());
        for (std::uint32_t v = 0; v < keys.size(); ++v) {
            const glm::vec3 &p = primitive_.positions[v], &n = primitive_.normals[v];
            const glm::vec2& t = texcoords_[v];
            const std::array<float, 8> values{p.x, p.y, p.z, n.x, n.y, n.z, t.x, t.y};
            for (std::size_t i = 0; i < 8; ++i)
                keys[v].bits[i] = std::bit_cast<std::uint32_t>(values[i] + 0.0f);
            keys[v].vertex = v;
        }
        std::sort(keys.begin(), keys.end());
        std::vector<std::uint32_t> first(keys.size());  // for each vertex, the first of those welded with it
        for (std::size_t i = 0; i < keys.size(); ++i)
            first[keys[i].vertex] =
                i > 0 && keys[i].sameAs(keys[i - 1]) ? first[keys[i - 1].vertex] : keys[i].vertex;
        std::vector<int> welded(keys.size());
        for (std::uint32_t v = 0; v < welded.size(); ++v) {
            if (first[v] == v) source_.push_back(v);
            welded[v] = first[v] == v ? static_cast<int>(source_.size()) - 1 : welded[first[v]];
        }
        triangles_.resize(primitive_.indices.size() / 3);
        for (std::size_t t = 0; t < triangles_.size(); ++t)
            for (std::size_t i = 0; i < 3; ++i)
                triangles_[t].vertex[i] = welded[primitive_.indices[3 * t + i]];
    }

    // Equations 18 and 19 of the paper, normalised.
    void derive() {
        for (Triangle& triangle : triangles_) {
            const auto [a, b, c] = triangle.vertex;
            const glm::dvec3 pa = position(a), pb = position(b), pc = position(c);
            triangle.degenerate = pa == pb || pb == pc || pc == pa;
            if (triangle.degenerate) continue;
            const glm::dvec2 tb = st(b) - st(a), tc = st(c) - st(a);
            const glm::dvec3 d1 = pb - pa, d2 = pc - pa;
            const double area = tb.x * tc.y - tb.y * tc.x;  // signed, twice
            const glm::dvec3 os = tc.y * d1 - tb.y * d2;
            const glm::dvec3 ot = tb.x * d2 - tc.x * d1;
            triangle.orientation_preserving = area > 0;
            if (!notZero(area)) continue;
            triangle.tangent = (area > 0 ? 1.0 : -1.0) * unitOrZero(os);
            triangle.joins_any =
                !(notZero(glm::length(os) / std::abs(area)) && notZero(glm::length(ot) / std::abs(area)));
        }
    }

    // Two triangles are neighbours across an edge if they traverse it in opposite directions. Where more
    // than two triangles share an edge, they are paired in index order.
    void findNeighbors() {
        struct Edge {
            int low, high, triangle, corner;
            bool rising;
        };
        std::vector<Edge> edges;
        edges.reserve(3 * triangles_.size());
        for (std::size_t t = 0; t < triangles_.size(); ++t) {
            if (triangles_[t].degenerate) continue;
            for (std::size_t i = 0; i < 3; ++i) {
                const int from = triangles_[t].vertex[i], to = triangles_[t].vertex[(i + 1) % 3];
                edges.push_back({std::min(from, to), std::max(from, to), static_cast<int>(t),
                                 static_cast<int>(i), from < to});
            }
        }
        std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
            return std::tie(a.low, a.high, a.triangle, a.corner) <
                   std::tie(b.low, b.high, b.triangle, b.corner);
        });
        for (std::size_t begin = 0, end; begin < edges.size(); begin = end) {
            for (end = begin; end < edges.size() && edges[end].low == edges[begin].low &&
                              edges[end].high == edges[begin].high;)
                ++end;
            std::array<std::size_t, 2> next{begin, begin};  // unmatched edges, by direction
            const auto advance = [&](bool rising) {
                while (next[rising] < end && edges[next[rising]].rising != rising) ++next[rising];
                return next[rising] < end;
            };
            while (advance(false) && advance(true)) {
                const Edge &a = edges[next[0]++], &b = edges[next[1]++];
                neighborAt(a.triangle, a.corner) = b.triangle;
                neighborAt(b.triangle, b.corner) = a.triangle;
            }
        }
    }

    int& neighborAt(int triangle, int corner) {
        return triangles_[static_cast<std::size_t>(triangle)].neighbor[static_cast<std::size_t>(corner)];
    }

    void group() {
        group_of_vertex_.assign(source_.size(), none);
        std::vector<int> waiting;
        for (std::size_t t = 0; t < triangles_.size(); ++t) {
            for (std::size_t i = 0; i < 3; ++i) {
                const Triangle& first = triangles_[t];
                if (first.degenerate || first.joins_any || first.group[i] != none) continue;
                const int id = static_cast<int>(vertex_of_group_.size()), vertex = first.vertex[i];
                vertex_of_group_.push_back(vertex);
                preserving_.push_back(first.orientation_preserving);
                int& firstGroup = group_of_vertex_[static_cast<std::size_t>(vertex)];
                if (firstGroup == none) firstGroup = id;
                waiting.push_back(static_cast<int>(t));
                while (!waiting.empty()) {
                    Triangle& triangle = triangles_[static_cast<std::size_t>(waiting.back())];
                    waiting.pop_back();
                    const std::size_t corner = cornerAt(triangle, vertex);
                    if (triangle.group[corner] != none) continue;
                    if (triangle.joins_any && triangle.group == std::array{none, none, none})
                        triangle.orientation_preserving = preserving_.back();
                    if (triangle.orientation_preserving != preserving_.back()) continue;
                    triangle.group[corner] = id;
                    // The edges that leave and enter the corner; the one that leaves is followed first.
                    for (const std::size_t edge : {(corner + 2) % 3, corner})
                        if (triangle.neighbor[edge] != none) waiting.push_back(triangle.neighbor[edge]);
                }
            }
        }
    }

    static std::size_t cornerAt(const Triangle& triangle, int vertex) {
        return triangle.vertex[0] == vertex ? 0 : triangle.vertex[1] == vertex ? 1 : 2;
    }

    void average() {
        tangents_.assign(vertex_of_group_.size(), glm::dvec3(0));
        for (const Triangle& triangle : triangles_) {
            if (triangle.joins_any) continue;
            for (std::size_t i = 0; i < 3; ++i) {
                const int vertex = triangle.vertex[i];
                const glm::dvec3 n = normal(vertex), p = position(vertex);
                const glm::dvec3 before = inPlaneOf(n, position(triangle.vertex[(i + 2) % 3]) - p);
                const glm::dvec3 after = inPlaneOf(n, position(triangle.vertex[(i + 1) % 3]) - p);
                const double angle = std::acos(std::clamp(glm::dot(before, after), -1.0, 1.0));
                tangents_[static_cast<std::size_t>(triangle.group[i])] +=
                    angle * inPlaneOf(n, triangle.tangent);
            }
        }
        for (glm::dvec3& tangent : tangents_) tangent = unitOrZero(tangent);
    }
};

}  // namespace

void makeAnyTangents(Primitive& primitive) {
    primitive.tangents.clear();
    for (const glm::vec3& normal : primitive.normals) primitive.tangents.push_back(anyTangent(normal));
}

void makeTangents(Primitive& primitive, const TextureSlot& map) {
    if (map.texcoord < 0 || map.texcoord > 1 || primitive.texcoords[map.texcoord].empty())
        return makeAnyTangents(primitive);
    primitive.tangents.clear();
    const TangentSpace space(primitive, map);

    // A vertex keeps the first tangent found for it; for each further tangent the vertex is copied. Corners
    // with equal tangents share a copy as long as the search is short: a vertex of a million triangles may
    // have a million tangents.
    constexpr std::uint32_t last = ~0u;
    constexpr int mostShared = 16;
    std::vector<std::uint32_t> source(primitive.positions.size());
    for (std::uint32_t v = 0; v < source.size(); ++v) source[v] = v;
    std::vector<glm::vec4> tangents(source.size(), glm::vec4(0));  // 0: not set yet
    std::vector<std::uint32_t> nextCopy(source.size(), last);
    for (std::size_t corner = 0; corner < primitive.indices.size(); ++corner) {
        const glm::vec4 tangent = space.at(corner);
        std::uint32_t v = primitive.indices[corner];
        for (int copies = 0; tangents[v] != glm::vec4(0) && tangents[v] != tangent; ++copies) {
            if (nextCopy[v] == last || copies == mostShared) {
                const auto copy = static_cast<std::uint32_t>(source.size());
                if (copies < mostShared) nextCopy[v] = copy;
                source.push_back(source[v]);
                tangents.push_back(glm::vec4(0));
                nextCopy.push_back(last);
                v = copy;
            } else {
                v = nextCopy[v];
            }
        }
        tangents[v] = tangent;
        primitive.indices[corner] = v;
    }
    gather(primitive, source);
    for (std::size_t v = 0; v < tangents.size(); ++v)
        if (tangents[v] == glm::vec4(0)) tangents[v] = anyTangent(primitive.normals[v]);
    primitive.tangents = std::move(tangents);
}

}  // namespace diptych
