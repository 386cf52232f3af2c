// SPDX-License-Identifier: MIT
// What a ray through a posed scene meets, roughly and quickly: for choosing a view, not for a picture.
#pragma once

#include "shared/scene/model/scene.h"
#include "shared/scene/motion/bounds.h"
#include "shared/scene/motion/pose.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <memory>
#include <optional>

namespace diptych {

class VisibleSurface {
public:
    // Above this many triangles a random, but always the same, part of them is kept, each enlarged so that
    // their area stays what it was.
    static constexpr std::uint64_t mostTriangles = 1 << 19;

    // `bounds`: of the pose. Triangles without a finite place or an area are left out.
    VisibleSurface(const Scene& scene, const Pose& pose, const Bounds& bounds,
                   std::uint64_t limit = mostTriangles);
    ~VisibleSurface();
    VisibleSurface(const VisibleSurface&) = delete;
    VisibleSurface& operator=(const VisibleSurface&) = delete;

    struct Seen {
        double distance = 0;         // m, for a ray of unit direction
        glm::dvec3 normal{0};        // unit, towards the ray's origin
        std::uint32_t instance = 0;  // into Pose::instances
        bool front = true;           // false: the other side of a double-sided surface
    };
    // The nearest surface that is drawn: a back face of a single-sided material is passed through. Textures
    // are not read: a masked or blended surface is a whole one.
    std::optional<Seen> nearest(const glm::dvec3& origin, const glm::dvec3& direction) const;

private:
    struct Traced;
    std::unique_ptr<Traced> traced_;
};

}  // namespace diptych
