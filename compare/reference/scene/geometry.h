// SPDX-License-Identifier: MIT
// Ray casting: Embree finds the triangle that a ray hits; the hit position is computed in double.
#pragma once

#include "shared/scene/model/scene.h"
#include "shared/scene/motion/pose.h"
#include "shared/scene/motion/posed.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace diptych::reference {

struct TriangleId {
    std::uint32_t instance = ~0u, triangle = ~0u;
    bool operator==(const TriangleId&) const = default;
};

// A point on a triangle. Positions are relative to the camera.
struct Hit {
    TriangleId id;
    double t = 0;               // ray parameter, in lengths of the ray's direction
    glm::dvec2 barycentric{0};  // weights of the second and third corners
    glm::dvec3 position{0};
    glm::dvec3 geometric_normal{0};  // unit, on the front side
    bool front = true;               // whether the ray hits the front side
};

struct Ray {
    glm::dvec3 origin{0}, direction{0};  // of any length
    double from = 0, to = 0;             // range of t, exclusive at both ends
    TriangleId without = {};             // the triangle that the ray starts on, which it cannot hit
};

class Geometry {
public:
    // Positions become relative to `eye`; `blended_normals`: see posedVertices(). The pose and the scene
    // must outlive this.
    Geometry(const Scene& scene, const Pose& pose, const glm::dvec3& eye, bool blended_normals = false);
    ~Geometry();
    Geometry(const Geometry&) = delete;
    Geometry& operator=(const Geometry&) = delete;

    // Whether a hit is accepted; the ray passes through a rejected one.
    using Counts = std::function<bool(const Hit&)>;
    std::optional<Hit> nearest(const Ray& ray, const Counts& counts) const;
    bool meets(const Ray& ray, const Counts& counts) const;

    const Instance& instance(const TriangleId& id) const;
    const Primitive& primitive(const TriangleId& id) const;
    std::array<std::uint32_t, 3> vertices(const TriangleId& id) const;  // indices into its primitive
    std::array<glm::dvec3, 3> corners(const TriangleId& id) const;      // relative to the camera
    // The deformed vertices of its instance, in world space; nullptr if world_from_object applies to all
    // vertices.
    const PosedVertices* posed(const TriangleId& id) const;
    // Values of the three corners after morphing; empty if the primitive has none.
    std::optional<std::array<glm::dvec2, 3>> texcoords(const TriangleId& id, int set) const;
    std::optional<std::array<glm::dvec4, 3>> colors(const TriangleId& id) const;
    // Intersection with the plane of the triangle; empty if the ray is parallel to it.
    std::optional<Hit> onPlane(const TriangleId& id, const glm::dvec3& origin,
                               const glm::dvec3& direction) const;

private:
    struct Embree;
    const Scene& scene_;
    const Pose& pose_;
    glm::dvec3 eye_;
    std::vector<PosedVertices> posed_;  // by instance; empty for instances without deformation
    std::unique_ptr<Embree> embree_;
};

}  // namespace diptych::reference
