// SPDX-License-Identifier: MIT
// Animated properties of lights, cameras and materials at one time (KHR_animation_pointer).
#pragma once

#include "shared/scene/model/scene.h"

#include <string>
#include <vector>

namespace diptych {

struct PropertyMotion {
    std::vector<Light> lights;        // as Scene::lights
    std::vector<Camera> cameras;      // as Scene::cameras
    std::vector<Material> materials;  // as Scene::materials; empty if no playing animation moves any
};

// Under animationsOf(scene, choice). All play at once; if several target one property, the last one wins.
// Values that a spline takes out of range (propertiesOf()) are clamped. A light's inner cone is at most its
// outer one. If the far plane is not beyond the near plane, a perspective camera gets none, an
// orthographic one a far plane right behind the near plane.
PropertyMotion propertiesAt(const Scene& scene, double seconds, const std::string& choice = {});

}  // namespace diptych
