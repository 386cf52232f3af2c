// SPDX-License-Identifier: MIT
#include "shared/scene/motion/bounds.h"

#include "shared/scene/motion/posed.h"

#include <glm/glm.hpp>

#include <cmath>
#include <cstddef>

namespace diptych {

double Bounds::radius() const {
    return empty() ? 0.0 : glm::length(max - min) * 0.5;
}

Bounds worldBounds(const Scene& scene, const Pose& pose) {
    Bounds bounds;
    const auto add = [&](const glm::dvec3& p) {
        bounds.min = glm::min(bounds.min, p);
        bounds.max = glm::max(bounds.max, p);
    };
    for (const Instance& instance : pose.instances) {
        if (instance.deformed()) {
            for (const glm::dvec3& p : posedPositions(scene, pose, instance))
                if (!std::isnan(p.x)) add(p);
            continue;
        }
        for (const glm::vec3& p : primitiveOf(scene, instance).positions)
            add(glm::dvec3(instance.world_from_object * glm::dvec4(p, 1.0)));
    }
    return bounds;
}

Bounds boundsAtStart(const Scene& scene, const Pose& pose) {
    return pose.seconds == 0 ? worldBounds(scene, pose)
                             : worldBounds(scene, poseAt(scene, 0, pose.animation));
}

}  // namespace diptych
