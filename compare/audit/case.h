// SPDX-License-Identifier: MIT
// What an audit pushes: a scene with all that is chosen for its picture fixed, so that nothing is chosen anew
// when a part of it is changed.
#pragma once

#include "shared/frame/frame.h"
#include "shared/frame/settings.h"
#include "shared/scene/model/scene.h"
#include "shared/scene/motion/bounds.h"
#include "shared/scene/scene_view.h"

#include <glm/vec3.hpp>

#include <string>
#include <vector>

namespace diptych::audit {

struct Case {
    Scene scene;        // the only camera that is used is its last one, without a node, and so are all lights
    Settings settings;  // camera: that one; no rig of lights
    // Above 0: pictures are compared, of 8 bits, exposed by this factor beyond the automatic one.
    double exposure = 0;

    Camera& camera() { return scene.cameras.back(); }
    const Camera& camera() const { return scene.cameras.back(); }
};

// What there is to push, of the case as it is given.
struct Subject {
    Case given;
    View view;
    std::string view_name;  // the camera's, or how it was chosen
    // The surface in the middle of the picture, or the nearest to the middle that is seen: world, m.
    bool seen = false;
    glm::dvec3 point{0}, normal{0, 1, 0};  // the normal: unit, the triangle's own, towards the eye
    double nearest = 0;                    // m, from the eye to the nearest surface that was found
    Bounds bounds;                         // of the posed scene
    bool moves = false;                    // an animation plays in it
};

// What was audited, as its report says.
struct Audited {
    std::string scene, camera;
    Settings settings;
    ReportDevice device;
    std::vector<std::string> notes;
};

// The lights are those of the Settings' rig, the scene's own or the default sun.
Subject makeSubject(const Scene& scene, const Settings& settings);

// Puts the whole scene, its lights and its camera elsewhere: world' = move * world. A uniform scale and a
// translation. Lights and planes of the camera keep their own units: see scaleLengths().
void moveAll(Case& pushed, const glm::dmat4& move);

// Multiplies all lengths by a factor so that the picture stays the same: scene, lights, haze, shadows,
// camera.
void scaleLengths(Case& pushed, double factor);

}  // namespace diptych::audit
