// SPDX-License-Identifier: MIT
// Input of an audit: a scene in which everything chosen automatically for its image is fixed, so that
// changing a part changes no other choice.
#pragma once

#include "shared/frame/frame.h"
#include "shared/frame/settings.h"
#include "shared/scene/model/scene.h"
#include "shared/scene/motion/bounds.h"
#include "shared/scene/scene_view.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace diptych::audit {

struct Case {
    // Uses only its last camera, which has no node; lights have no nodes either.
    Scene scene;
    Settings settings;  // camera: that one; no light rig
    // If above 0, 8-bit images are compared, exposed by this factor times the automatic exposure.
    double exposure = 0;

    Camera& camera() { return scene.cameras.back(); }
    const Camera& camera() const { return scene.cameras.back(); }
};

// Properties of the original case that quantities and relations use.
struct Subject {
    Case original;
    View view;
    std::string view_name;  // the camera's name, or how it was chosen
    // The visible surface in or nearest to the image's centre: world, m.
    bool has_surface = false;
    glm::dvec3 point{0}, normal{0, 1, 0};  // the normal: unit, of the triangle, towards the eye
    double nearest = 0;                    // m, from the eye to the nearest surface found
    Bounds bounds;                         // of the scene at its pose
    bool moves = false;                    // whether an animation moves it

    double distance() const { return glm::distance(point, view.eye()); }  // of the visible surface, m
    // From the eye to beyond the whole scene, m.
    double farthest() const { return glm::distance(bounds.centre(), view.eye()) + bounds.radius(); }
    // The scene's radius, above 0, m.
    double radius() const { return std::max(bounds.radius(), 1e-6); }
};

// Subject of an audit, as its report states it.
struct Audited {
    std::string scene, camera;
    Settings settings;
    ReportDevice device;
    std::vector<std::string> notes;
};

bool isLocal(const Light& light);     // has a position
bool isPunctual(const Light& light);  // a point or spot light

// Lights come from the Settings' rig, the scene, or the default directional light.
Subject makeSubject(const Scene& scene, const Settings& settings);

// Adds a node after all others that draws mesh `mesh` at the place of node `index`.
Node& carry(Scene& scene, std::size_t index, int mesh);

// Moves the whole scene, its lights and its camera: world' = move * world, a uniform scale and a
// translation. Does not scale lights and camera planes; see scaleLengths().
void moveAll(Case& changed, const glm::dmat4& move);

// Scales all lengths of scene, lights, haze, shadows and camera, so that the image stays the same.
void scaleLengths(Case& changed, double factor);

}  // namespace diptych::audit
