// SPDX-License-Identifier: MIT
#include "shared/scene/model/tangent_space.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <bit>
#include <cfloat>
#include <cmath>
#include <tuple>

namespace diptych {

namespace {

constexpr int none = -1;

// MikkTSpace's own test for zero.
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

// Attributes that must agree for two vertices to be welded; 0 and -0 compare equal.
struct VertexKey {
    std::array<std::uint32_t, 8> bits;
    std::uint32_t vertex;
};

// Orders vertices by their morph target offsets and, in a flat primitive, by their triangle; 0: both
// vertices always move alike.
class MorphOrder {
public:
    MorphOrder(const Primitive& primitive, bool morphed, int texcoord) {
        if (!morphed) return;
        for (const MorphTarget& target : primitive.targets) {
            add(target.positions);
            add(target.normals);
            add(target.texcoords[texcoord]);
        }
        if (!primitive.flat) return;
        triangle_.resize(primitive.positions.size());
        for (std::size_t i = 0; i < primitive.indices.size(); ++i)
            triangle_[primitive.indices[i]] = static_cast<std::uint32_t>(i / 3);
    }

    int operator()(std::uint32_t a, std::uint32_t b) const {
        if (!triangle_.empty() && triangle_[a] != triangle_[b]) return triangle_[a] < triangle_[b] ? -1 : 1;
        for (const Deltas& deltas : deltas_)
            for (std::size_t c = 0; c < deltas.width; ++c) {
                const float x = deltas.first[a * deltas.width + c], y = deltas.first[b * deltas.width + c];
                if (x != y) return x < y ? -1 : 1;
            }
        return 0;
    }

private:
    struct Deltas {
        const float* first;
        std::size_t width;
    };
    std::vector<Deltas> deltas_;
    std::vector<std::uint32_t> triangle_;  // of each vertex; empty if the primitive is not flat

    template <class Vec>
    void add(const std::vector<Vec>& deltas) {
        if (!deltas.empty()) deltas_.push_back({&deltas[0][0], static_cast<std::size_t>(Vec::length())});
    }
};

std::size_t cornerAt(const std::array<int, 3>& vertices, int vertex) {
    return vertices[0] == vertex ? 0 : vertices[1] == vertex ? 1 : 2;
}

}  // namespace

glm::vec4 anyTangent(const glm::vec3& normal) {
    const glm::dvec3 n(normal);
    const glm::dvec3 axis = std::abs(n.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 t = glm::cross(axis, n);
    const double length = glm::length(t);
    return length > 0 ? glm::vec4(glm::vec3(t / length), 1) : glm::vec4(1, 0, 0, 1);
}

bool movesTangents(const MorphTarget& target, int texcoord) {
    return !target.positions.empty() || !target.normals.empty() || !target.texcoords[texcoord].empty();
}

TangentSpace::TangentSpace(const Primitive& primitive, const TextureSlot& map)
    : primitive_(primitive),
      map_(map),
      texcoords_(primitive.texcoords[map.texcoord]),
      morphed_(std::ranges::any_of(primitive.targets, [&](const MorphTarget& target) {
          return movesTangents(target, map.texcoord);
      })) {
    weld();
    derive();
    findNeighbors();
    group();
    average();
    if (morphed_) findMoves();
}

glm::vec4 TangentSpace::at(std::size_t corner) const {
    const Triangle& triangle = triangles_[corner / 3];
    const int vertex = triangle.vertex[corner % 3];
    int group = triangle.group[corner % 3];
    // A degenerate triangle takes the group of a valid triangle at the same vertex.
    if (group == none && triangle.degenerate) group = group_of_vertex_[static_cast<std::size_t>(vertex)];
    if (group == none || tangents_[static_cast<std::size_t>(group)] == glm::dvec3(0))
        return anyTangent(glm::vec3(normal(vertex)));
    return glm::vec4(glm::vec3(tangents_[static_cast<std::size_t>(group)]),
                     preserving_[static_cast<std::size_t>(group)] ? 1.0f : -1.0f);
}

std::uint32_t TangentSpace::groupAt(std::size_t corner) const {
    const Triangle& triangle = triangles_[corner / 3];
    const auto vertex = static_cast<std::size_t>(triangle.vertex[corner % 3]);
    int group = triangle.group[corner % 3];
    if (group == none && triangle.degenerate) group = group_of_vertex_[vertex];
    return static_cast<std::uint32_t>(group == none ? vertex_of_group_.size() + vertex
                                                    : static_cast<std::size_t>(group));
}

// After the groups, each welded vertex has an index for its corners without a group.
std::uint32_t TangentSpace::groupCount() const {
    return static_cast<std::uint32_t>(vertex_of_group_.size() + source_.size());
}

bool TangentSpace::counts(std::size_t triangle) const {
    const auto [a, b, c] = triangles_[triangle].vertex;
    const auto coincide = [&](int i, int j) {  // in every pose
        return position(i) == position(j) &&
               (moved_.empty() || moved_[static_cast<std::size_t>(i)] == moved_[static_cast<std::size_t>(j)]);
    };
    if (coincide(a, b) || coincide(b, c) || coincide(c, a)) return false;
    const glm::dvec2 tb = st(b) - st(a), tc = st(c) - st(a);
    return slides_ || notZero(tb.x * tc.y - tb.y * tc.x);
}

// Hashes each welded vertex's deltas by FNV-1a. Comparing the deltas for every triangle would cost
// triangles * targets, and a small file can have many of both.
void TangentSpace::findMoves() {
    for (const MorphTarget& target : primitive_.targets) {
        slides_ |= !target.texcoords[map_.texcoord].empty();
        if (target.positions.empty()) continue;
        moved_.resize(source_.size(), 0xcbf29ce484222325u);
        for (std::size_t v = 0; v < moved_.size(); ++v)
            for (int c = 0; c < 3; ++c)
                moved_[v] =
                    (moved_[v] ^ std::bit_cast<std::uint32_t>(target.positions[source_[v]][c] + 0.0f)) *
                    0x100000001b3u;
    }
}

glm::dvec3 TangentSpace::position(int v) const {
    return glm::dvec3(primitive_.positions[source_[static_cast<std::size_t>(v)]]);
}
glm::dvec3 TangentSpace::normal(int v) const {
    return glm::dvec3(primitive_.normals[source_[static_cast<std::size_t>(v)]]);
}
glm::dvec2 TangentSpace::st(int v) const {
    const glm::dvec2 uv(texcoords_[source_[static_cast<std::size_t>(v)]]);
    const glm::dvec3 at(uv, 1);
    return {glm::dot(map_.u, at), 1 - glm::dot(map_.v, at)};
}

// Sorts instead of hashing: a malicious file could give all vertices the same hash.
void TangentSpace::weld() {
    std::vector<VertexKey> keys(primitive_.positions.size());
    for (std::uint32_t v = 0; v < keys.size(); ++v) {
        const glm::vec3 &p = primitive_.positions[v], &n = primitive_.normals[v];
        const glm::vec2& t = texcoords_[v];
        const std::array<float, 8> values{p.x, p.y, p.z, n.x, n.y, n.z, t.x, t.y};
        for (std::size_t i = 0; i < 8; ++i) keys[v].bits[i] = std::bit_cast<std::uint32_t>(values[i] + 0.0f);
        keys[v].vertex = v;
    }
    const MorphOrder order(primitive_, morphed_, map_.texcoord);
    std::sort(keys.begin(), keys.end(), [&](const VertexKey& a, const VertexKey& b) {
        if (a.bits != b.bits) return a.bits < b.bits;
        const int moved = order(a.vertex, b.vertex);
        return moved != 0 ? moved < 0 : a.vertex < b.vertex;
    });
    std::vector<std::uint32_t> first(keys.size());  // first vertex that each is welded with
    for (std::size_t i = 0; i < keys.size(); ++i) {
        const bool same =
            i > 0 && keys[i].bits == keys[i - 1].bits && order(keys[i].vertex, keys[i - 1].vertex) == 0;
        first[keys[i].vertex] = same ? first[keys[i - 1].vertex] : keys[i].vertex;
    }
    std::vector<int> welded(keys.size());
    for (std::uint32_t v = 0; v < welded.size(); ++v) {
        if (first[v] == v) source_.push_back(v);
        welded[v] = first[v] == v ? static_cast<int>(source_.size()) - 1 : welded[first[v]];
    }
    triangles_.resize(primitive_.indices.size() / 3);
    for (std::size_t t = 0; t < triangles_.size(); ++t)
        for (std::size_t i = 0; i < 3; ++i) triangles_[t].vertex[i] = welded[primitive_.indices[3 * t + i]];
}

// Equations 18 and 19 of Mikkelsen 2008, normalized.
void TangentSpace::derive() {
    for (Triangle& triangle : triangles_) {
        const auto [a, b, c] = triangle.vertex;
        const glm::dvec3 pa = position(a), pb = position(b), pc = position(c);
        triangle.degenerate = pa == pb || pb == pc || pc == pa;
        if (triangle.degenerate) continue;
        const glm::dvec2 tb = st(b) - st(a), tc = st(c) - st(a);
        const glm::dvec3 d1 = pb - pa, d2 = pc - pa;
        const double area = tb.x * tc.y - tb.y * tc.x;  // twice the signed area
        const glm::dvec3 os = tc.y * d1 - tb.y * d2;
        const glm::dvec3 ot = tb.x * d2 - tc.x * d1;
        triangle.orientation_preserving = area > 0;
        if (!notZero(area)) continue;
        triangle.tangent = (area > 0 ? 1.0 : -1.0) * unitOrZero(os);
        triangle.joins_any =
            !(notZero(glm::length(os) / std::abs(area)) && notZero(glm::length(ot) / std::abs(area)));
    }
}

// Two triangles are neighbours across an edge if they traverse it in opposite directions. If more than two
// share an edge, they are paired in index order.
void TangentSpace::findNeighbors() {
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
            edges.push_back({std::min(from, to), std::max(from, to), static_cast<int>(t), static_cast<int>(i),
                             from < to});
        }
    }
    std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
        return std::tie(a.low, a.high, a.triangle, a.corner) < std::tie(b.low, b.high, b.triangle, b.corner);
    });
    for (std::size_t begin = 0, end; begin < edges.size(); begin = end) {
        for (end = begin; end < edges.size() && edges[end].low == edges[begin].low &&
                          edges[end].high == edges[begin].high;)
            ++end;
        std::array<std::size_t, 2> next{begin, begin};  // next unmatched edge, by direction
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

int& TangentSpace::neighborAt(int triangle, int corner) {
    return triangles_[static_cast<std::size_t>(triangle)].neighbor[static_cast<std::size_t>(corner)];
}

void TangentSpace::group() {
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
                const std::size_t corner = cornerAt(triangle.vertex, vertex);
                if (triangle.group[corner] != none) continue;
                if (triangle.joins_any && triangle.group == std::array{none, none, none})
                    triangle.orientation_preserving = preserving_.back();
                if (triangle.orientation_preserving != preserving_.back()) continue;
                triangle.group[corner] = id;
                // The edges that enter and leave the corner; the leaving one is followed first.
                for (const std::size_t edge : {(corner + 2) % 3, corner})
                    if (triangle.neighbor[edge] != none) waiting.push_back(triangle.neighbor[edge]);
            }
        }
    }
}

void TangentSpace::average() {
    tangents_.assign(vertex_of_group_.size(), glm::dvec3(0));
    for (const Triangle& triangle : triangles_) {
        if (triangle.joins_any) continue;
        for (std::size_t i = 0; i < 3; ++i) {
            const int vertex = triangle.vertex[i];
            const glm::dvec3 n = normal(vertex), p = position(vertex);
            const glm::dvec3 before = inPlaneOf(n, position(triangle.vertex[(i + 2) % 3]) - p);
            const glm::dvec3 after = inPlaneOf(n, position(triangle.vertex[(i + 1) % 3]) - p);
            const double angle = std::acos(std::clamp(glm::dot(before, after), -1.0, 1.0));
            tangents_[static_cast<std::size_t>(triangle.group[i])] += angle * inPlaneOf(n, triangle.tangent);
        }
    }
    for (glm::dvec3& tangent : tangents_) tangent = unitOrZero(tangent);
}

}  // namespace diptych
