// SPDX-License-Identifier: MIT
// Which triangle a ray meets, which Embree says, and where, which is worked out in double.
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

// A place on a triangle. Positions are relative to the camera.
struct Hit {
    TriangleId id;
    double t = 0;               // along the ray, in lengths of its direction
    glm::dvec2 barycentric{0};  // of the second and third corner
    glm::dvec3 position{0};
    glm::dvec3 geometric_normal{0};  // unit, to the front
    bool front = true;               // the ray comes from there
};

struct Ray {
    glm::dvec3 origin{0}, direction{0};  // any length
    double from = 0, to = 0;             // t, both ends outside
    TriangleId without = {};             // which it leaves
};

class Geometry {
public:
    // `eye` becomes the origin. The pose and the scene outlive it. Not `deforming`, vertices stand where
    // world_from_object puts them, as the paths draw them yet.
    Geometry(const Scene& scene, const Pose& pose, const glm::dvec3& eye, bool deforming);
    ~Geometry();
    Geometry(const Geometry&) = delete;
    Geometry& operator=(const Geometry&) = delete;

    // Whether a hit counts; one that does not lets the ray pass.
    using Counts = std::function<bool(const Hit&)>;
    std::optional<Hit> nearest(const Ray& ray, const Counts& counts) const;
    bool meets(const Ray& ray, const Counts& counts) const;

    const Instance& instance(const TriangleId& id) const;
    const Primitive& primitive(const TriangleId& id) const;
    std::array<std::uint32_t, 3> vertices(const TriangleId& id) const;  // into its primitive
    std::array<glm::dvec3, 3> corners(const TriangleId& id) const;      // from the camera
    // Its instance's vertices, in the world; nullptr where world_from_object moves all of them alike.
    const PosedVertices* posed(const TriangleId& id) const;
    // Where the plane of the triangle is met; nothing where the ray runs along it.
    std::optional<Hit> onPlane(const TriangleId& id, const glm::dvec3& origin,
                               const glm::dvec3& direction) const;

private:
    struct Embree;
    const Scene& scene_;
    const Pose& pose_;
    glm::dvec3 eye_;
    std::vector<PosedVertices> posed_;  // by instance; empty where nothing deforms it
    std::unique_ptr<Embree> embree_;
};

}  // namespace diptych::reference
