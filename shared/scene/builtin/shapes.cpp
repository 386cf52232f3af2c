// SPDX-License-Identifier: MIT
#include "shared/scene/builtin/shapes.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace diptych {
namespace {

using glm::dvec2;
using glm::dvec3;

constexpr double TAU = 2.0 * std::numbers::pi;

struct Vertex {
    dvec3 position, normal, tangent;
    dvec2 texcoord;
};

std::uint32_t push(Primitive& shape, const Vertex& v) {
    const dvec3 normal = glm::normalize(v.normal);
    const dvec3 tangent = glm::normalize(v.tangent - normal * glm::dot(normal, v.tangent));
    shape.positions.emplace_back(v.position);
    shape.normals.emplace_back(normal);
    shape.tangents.emplace_back(glm::vec3(tangent), 1.0f);
    shape.texcoords[0].emplace_back(v.texcoord);
    return static_cast<std::uint32_t>(shape.positions.size() - 1);
}

void triangle(Primitive& shape, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    shape.indices.insert(shape.indices.end(), {a, b, c});
}

// Appends (columns + 1) x (rows + 1) vertices `at(i, j)`; seen from outside, i grows to the right and j
// downwards. Omits the degenerate triangles of a row that collapses to a point.
template <class At>
void grid(Primitive& shape, int columns, int rows, bool pointAbove, bool pointBelow, At&& at) {
    const auto first = static_cast<std::uint32_t>(shape.positions.size());
    for (int j = 0; j <= rows; ++j)
        for (int i = 0; i <= columns; ++i) push(shape, at(i, j));
    const auto index = [&](int i, int j) {
        return first + static_cast<std::uint32_t>(j * (columns + 1) + i);
    };
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i) {
            const std::uint32_t a = index(i + 1, j), b = index(i, j), c = index(i, j + 1),
                                d = index(i + 1, j + 1);
            if (j != 0 || !pointAbove) triangle(shape, a, b, d);
            if (j != rows - 1 || !pointBelow) triangle(shape, b, c, d);
        }
}

// Appends a flat polygon with one normal. Its corners are counter-clockwise seen from outside; texture
// coordinates are in metres.
void facet(Primitive& shape, const std::vector<dvec3>& corners) {
    const dvec3 right = glm::normalize(corners[1] - corners[0]);
    const dvec3 normal = glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
    const dvec3 up = glm::cross(normal, right);
    std::vector<std::uint32_t> at;
    for (const dvec3& p : corners)
        at.push_back(push(
            shape, {p, normal, right, {glm::dot(p - corners[0], right), -glm::dot(p - corners[0], up)}}));
    for (std::size_t i = 2; i < at.size(); ++i) triangle(shape, at[0], at[i - 1], at[i]);
}

}  // namespace

Primitive quad(const dvec3& corner, const dvec3& right, const dvec3& up, int columns, int rows) {
    Primitive shape;
    const dvec3 normal = glm::cross(right, up);
    grid(shape, columns, rows, false, false, [&](int i, int j) {
        const double u = static_cast<double>(i) / columns, v = static_cast<double>(j) / rows;
        return Vertex{corner + right * u + up * (1 - v), normal, right, {u, v}};
    });
    return shape;
}

Primitive sphere(double radius, int segments, int rings) {
    Primitive shape;
    grid(shape, segments, rings, true, true, [&](int i, int j) {
        const double u = static_cast<double>(i) / segments, v = static_cast<double>(j) / rings;
        const double theta = TAU * u, phi = TAU / 2 * v;
        const dvec3 n(-std::cos(theta) * std::sin(phi), std::cos(phi), std::sin(theta) * std::sin(phi));
        return Vertex{n * radius, n, {std::sin(theta), 0, std::cos(theta)}, {u, v}};
    });
    return shape;
}

Primitive box(const dvec3& size, double bevel) {
    Primitive shape;
    const dvec3 half = size / 2.0;
    const dvec3 flat = half - bevel;
    // Side `sign` of `axis`. Seen from outside, the other two axes, in cyclic order, point right and up.
    const auto axisVector = [](int axis, double length) {
        dvec3 v(0.0);
        v[axis] = length;
        return v;
    };
    for (int axis : {0, 1, 2})
        for (double sign : {-1.0, 1.0}) {
            // The image is upright on the x and z sides; on the top and bottom its top is towards -z.
            const int upAxis = axis == 1 ? 2 : 1;
            const dvec3 normal = axisVector(axis, sign), up = axisVector(upAxis, axis == 1 ? -1.0 : 1.0);
            const dvec3 right = glm::cross(up, normal);
            const int rightAxis = 3 - axis - upAxis;
            const dvec3 r = right * flat[rightAxis], t = up * flat[upAxis], n = normal * half[axis];
            Primitive side = quad(n - r - t, 2.0 * r, 2.0 * t);
            append(shape, scaleTexcoords(std::move(side), 2 * flat[rightAxis], 2 * flat[upAxis]));
        }
    if (bevel <= 0) return shape;

    for (int axis : {0, 1, 2})  // edges parallel to this axis
        for (double s : {-1.0, 1.0})
            for (double t : {-1.0, 1.0}) {
                const int other = (axis + 1) % 3, third = (axis + 2) % 3;
                dvec3 from = axisVector(other, s), to = axisVector(third, t);
                if (s * t < 0) std::swap(from, to);  // so that along = cross(from, to) points to +axis
                const dvec3 along = axisVector(axis, flat[axis]);
                const dvec3 middle = axisVector(other, s * flat[other]) + axisVector(third, t * flat[third]);
                grid(shape, 1, 1, false, false, [&](int i, int j) {
                    const dvec3& normal = j == 0 ? to : from;
                    const dvec3 right = -along;
                    return Vertex{middle + right * (i == 0 ? -1.0 : 1.0) + normal * bevel,
                                  normal,
                                  right,
                                  {2 * flat[axis] * i, bevel * std::numbers::sqrt2 * j}};
                });
            }
    for (double x : {-1.0, 1.0})
        for (double y : {-1.0, 1.0})
            for (double z : {-1.0, 1.0}) {
                const dvec3 sign(x, y, z), corner = sign * flat;
                std::array<dvec3, 3> normals{dvec3(x, 0, 0), dvec3(0, y, 0), dvec3(0, 0, z)};
                if (x * y * z < 0) std::swap(normals[0], normals[1]);
                const dvec3 right = normals[1] - normals[0], up = glm::cross(sign, right) / std::sqrt(3.0);
                std::array<std::uint32_t, 3> at{};
                for (std::size_t i = 0; i < 3; ++i) {
                    const dvec3 p = normals[i] * bevel;
                    at[i] =
                        push(shape, {corner + p,
                                     normals[i] + 0.01 * sign,
                                     right,
                                     {glm::dot(p, glm::normalize(right)), -glm::dot(p, glm::normalize(up))}});
                }
                triangle(shape, at[0], at[1], at[2]);
            }
    return shape;
}

Primitive lathe(const std::vector<dvec2>& profile, int segments) {
    Primitive shape;
    const double smooth = std::cos(TAU / 9);
    double length = 0;
    for (std::size_t k = 1; k < profile.size(); ++k) length += glm::distance(profile[k - 1], profile[k]);
    const auto normalOf = [&](std::size_t k) {  // outward normal of the segment that ends at point k
        const dvec2 d = glm::normalize(profile[k] - profile[k - 1]);
        return dvec2(d.y, -d.x);
    };
    double below = 0;
    for (std::size_t k = 1; k < profile.size(); ++k) {
        const double above = below + glm::distance(profile[k - 1], profile[k]);
        std::array<dvec2, 2> normals{normalOf(k), normalOf(k)};  // of the segments above and below
        if (k + 1 < profile.size() && glm::dot(normals[0], normalOf(k + 1)) > smooth)
            normals[0] += normalOf(k + 1);
        if (k > 1 && glm::dot(normals[1], normalOf(k - 1)) > smooth) normals[1] += normalOf(k - 1);
        grid(shape, segments, 1, profile[k].x <= 0, profile[k - 1].x <= 0, [&](int i, int j) {
            const double u = static_cast<double>(i) / segments, theta = TAU * u;
            const dvec2 p = profile[j == 0 ? k : k - 1], n = normals[static_cast<std::size_t>(j)];
            const dvec3 out(-std::cos(theta), 0, std::sin(theta));
            return Vertex{out * p.x + dvec3(0, p.y, 0),
                          out * n.x + dvec3(0, n.y, 0),
                          {std::sin(theta), 0, std::cos(theta)},
                          {u, 1 - (j == 0 ? above : below) / length}};
        });
        below = above;
    }
    return shape;
}

Primitive tube(const std::function<dvec3(double)>& curve, double radius, int segments, int sides) {
    const auto forward = [&](double s) { return glm::normalize(curve(s + 1e-4) - curve(s - 1e-4)); };
    // A frame moved along the curve by parallel transport. The rotation left after one loop is spread
    // evenly over the length, so that both ends match.
    std::vector<dvec3> across;
    dvec3 n = glm::cross(forward(0), std::abs(forward(0).y) < 0.9 ? dvec3(0, 1, 0) : dvec3(1, 0, 0));
    for (int i = 0; i <= segments; ++i) {
        const dvec3 f = forward(static_cast<double>(i) / segments);
        n = glm::normalize(n - f * glm::dot(f, n));
        across.push_back(n);
    }
    const double twist = std::atan2(glm::dot(glm::cross(across.back(), across.front()), forward(0)),
                                    glm::dot(across.back(), across.front()));
    Primitive shape;
    grid(shape, segments, sides, false, false, [&](int i, int j) {
        const double u = static_cast<double>(i) / segments, v = static_cast<double>(j) / sides;
        const dvec3 f = forward(u), side = across[static_cast<std::size_t>(i)];
        const double angle = TAU * v + twist * u;
        const dvec3 normal = side * std::cos(angle) + glm::cross(f, side) * std::sin(angle);
        return Vertex{curve(u) + normal * radius, normal, f, {u, v}};
    });
    return shape;
}

Primitive torus(double ring, double radius, int segments, int sides) {
    const auto circle = [ring](double s) { return dvec3(-std::cos(TAU * s), 0, std::sin(TAU * s)) * ring; };
    return tube(circle, radius, segments, sides);
}

Primitive torusKnot(int p, int q, double ring, double hole, double radius) {
    const auto knot = [=](double s) {
        const double around = TAU * p * s, through = TAU * q * s, r = ring + hole * std::cos(through);
        return dvec3(r * std::cos(around), hole * std::sin(through), r * std::sin(around));
    };
    return tube(knot, radius, 256, 20);
}

Primitive gem(double width, int sides) {
    Primitive shape;
    const auto at = [&](double radius, double height, double step) {
        const double angle = TAU * step / sides;
        return dvec3(radius * std::cos(angle), height, -radius * std::sin(angle)) * (width / 2);
    };
    std::vector<dvec3> table;
    for (int i = 0; i < sides; ++i) {
        const double s = i, m = s + 0.5, e = s + 1;
        facet(shape, {at(1, 0.95, s), at(1, 0.95, e), at(0.58, 1.3, m)});  // crown
        facet(shape, {at(0.58, 1.3, m), at(1, 0.95, e), at(0.58, 1.3, m + 1)});
        facet(shape, {at(1, 0.87, s), at(1, 0.87, e), at(1, 0.95, e), at(1, 0.95, s)});  // girdle
        facet(shape, {dvec3(0.0), at(1, 0.87, e), at(1, 0.87, s)});                      // pavilion
        table.push_back(at(0.58, 1.3, m));
    }
    facet(shape, table);
    return shape;
}

Primitive archway(double width, double height, double depth, double opening, double spring, int segments) {
    Primitive shape;
    const double radius = opening / 2;
    const auto inFront = [&](double x, double y) {
        return push(shape, {{x, y, 0}, {0, 0, 1}, {1, 0, 0}, {x + width / 2, height - y}});
    };
    const auto upFrom = [&](const dvec2& left, const dvec2& right) {  // to the top
        const std::uint32_t a = inFront(left.x, left.y), b = inFront(right.x, right.y),
                            c = inFront(right.x, height), d = inFront(left.x, height);
        triangle(shape, a, b, c);
        triangle(shape, a, c, d);
    };
    upFrom({-width / 2, 0}, {-radius, 0});
    upFrom({radius, 0}, {width / 2, 0});
    const auto arc = [&](int k) {  // point k of the arc, left to right
        const double angle = TAU / 2 * (1 - static_cast<double>(k) / segments);
        return dvec2(radius * std::cos(angle), spring + radius * std::sin(angle));
    };
    for (int k = 0; k < segments; ++k) upFrom(arc(k), arc(k + 1));
    // The inner surface of the opening. u runs into the wall, v along the edge from its right foot.
    const double length = 2 * spring + TAU / 2 * radius;
    const auto edge = [&](int k) -> Vertex {  // k: right foot, the arc from right to left, left foot
        const dvec2 p = k == 0             ? dvec2(radius, 0)
                        : k > segments + 1 ? dvec2(-radius, 0)
                                           : arc(segments + 1 - k);
        const double angle = TAU / 2 * std::clamp((k - 1.0) / segments, 0.0, 1.0);
        const double along = k == 0 ? 0 : k > segments + 1 ? length : spring + angle * radius;
        return {{p.x, p.y, 0}, {-std::cos(angle), -std::sin(angle), 0}, {0, 0, -1}, {0, along}};
    };
    grid(shape, 1, segments + 2, false, false, [&](int i, int j) {
        Vertex v = edge(j);
        v.position.z = -depth * i;
        v.texcoord.x = depth * i;
        return v;
    });
    return shape;
}

void append(Primitive& whole, const Primitive& part, const glm::dmat4& wholeFromPart) {
    const glm::dmat3 linear(wholeFromPart), normalMatrix = glm::transpose(glm::inverse(linear));
    const bool mirrors = glm::determinant(linear) < 0;
    const auto first = static_cast<std::uint32_t>(whole.positions.size());
    for (const glm::vec3& p : part.positions)
        whole.positions.emplace_back(wholeFromPart * glm::dvec4(p, 1.0));
    for (const glm::vec3& n : part.normals)
        whole.normals.emplace_back(glm::normalize(normalMatrix * dvec3(n)));
    for (const glm::vec4& t : part.tangents)
        whole.tangents.emplace_back(glm::vec3(glm::normalize(linear * dvec3(t))), mirrors ? -t.w : t.w);
    for (int set : {0, 1})
        whole.texcoords[set].insert(whole.texcoords[set].end(), part.texcoords[set].begin(),
                                    part.texcoords[set].end());
    whole.colors.insert(whole.colors.end(), part.colors.begin(), part.colors.end());
    for (std::size_t i = 0; i < part.indices.size(); i += 3) {
        const std::uint32_t* t = &part.indices[i];
        if (mirrors)
            triangle(whole, first + t[0], first + t[2], first + t[1]);
        else
            triangle(whole, first + t[0], first + t[1], first + t[2]);
    }
}

Primitive scaleTexcoords(Primitive shape, double u, double v) {
    for (glm::vec2& uv : shape.texcoords[0]) uv = glm::vec2(dvec2(uv) * dvec2(u, v));
    return shape;
}

Primitive withTurnedSet(Primitive shape) {
    for (const glm::vec2& uv : shape.texcoords[0]) shape.texcoords[1].push_back({uv.y, 1 - uv.x});
    return shape;
}

Primitive paint(Primitive shape, const std::function<glm::vec4(const glm::vec3& position)>& color) {
    shape.colors.clear();
    for (const glm::vec3& p : shape.positions) shape.colors.push_back(color(p));
    return shape;
}

}  // namespace diptych
