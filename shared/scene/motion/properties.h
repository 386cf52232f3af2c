// SPDX-License-Identifier: MIT
// What animations move beside nodes (KHR_animation_pointer): lights, cameras and materials at a time.
#pragma once

#include "shared/scene/model/scene.h"

#include <string>
#include <vector>

namespace diptych {

struct PropertyMotion {
    std::vector<Light> lights;        // as Scene::lights
    std::vector<Camera> cameras;      // as Scene::cameras
    std::vector<Material> materials;  // as Scene::materials; empty if nothing that plays moves any
};

// Under animationsOf(scene, choice), which play at once: where two move one property, the later one applies.
// What a spline carries out of its range (factsOf()) counts as the nearest valid value: a light's inner cone
// is at most its outer one, and where a far plane comes to lie before the near one, a perspective has none
// and an orthographic camera one directly behind it.
PropertyMotion propertiesAt(const Scene& scene, double seconds, const std::string& choice = {});

}  // namespace diptych
