// SPDX-License-Identifier: MIT
// A fast, approximate ray caster for a posed scene; used to choose a view, not to render.
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
    // Above this count, a random but deterministic subset of triangles is kept, enlarged to the same total
    // area.
    static constexpr std::uint64_t maxTriangles = 1 << 19;

    // `bounds`: of the pose. Triangles with zero area or non-finite positions are omitted.
    VisibleSurface(const Scene& scene, const Pose& pose, const Bounds& bounds,
                   std::uint64_t limit = maxTriangles);
    ~VisibleSurface();
    VisibleSurface(const VisibleSurface&) = delete;
    VisibleSurface& operator=(const VisibleSurface&) = delete;

    struct Seen {
        double distance = 0;         // m, for a ray of unit direction
        glm::dvec3 normal{0};        // unit, towards the ray's origin
        std::uint32_t instance = 0;  // into Pose::instances
        bool front = true;           // false: the back of a double-sided surface
    };
    // The nearest drawn surface. Back faces of single-sided materials are skipped. Textures are not read:
    // masked and blended surfaces are opaque.
    std::optional<Seen> nearest(const glm::dvec3& origin, const glm::dvec3& direction) const;

private:
    struct Traced;
    std::unique_ptr<Traced> traced_;
};

}  // namespace diptych
