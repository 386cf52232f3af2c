// SPDX-License-Identifier: MIT
// From a camera and a picture's size to the matrices and vectors that the shaders need, in double.
#pragma once

#include "shared/contract/view.h"
#include "shared/scene/default_view.h"
#include "shared/scene/model/scene.h"
#include "shared/scene/motion/pose.h"

#include <functional>
#include <string>

namespace diptych {

struct View {
    Camera camera;  // in world space
    int width = 0, height = 0;
    double target_distance = 1;  // m, from the eye to the point that it looks at
    double wider_frame = 0;      // width over height of the camera's frame where the picture is narrower; 0

    glm::dvec3 eye() const;
    glm::dvec3 target() const;
    glm::dvec3 right() const;     // unit
    glm::dvec3 up() const;        // unit
    glm::dvec3 backward() const;  // unit, from the target to the camera

    // Reversed depth, Vulkan's clip space (y down), relative to the camera: world axes with the camera as
    // origin.
    glm::dmat4 clipFromWorld() const;

    gpu::View gpuView() const;  // the light counts in it are left 0
};

// All of the camera's frame is in the picture (glTF 2.0, 3.10.3): a picture that is narrower than the frame
// shows more above and below it, and a wider one more at its sides.
//
// `choice` is Settings::camera: one of the scene's own cameras, a free camera, or empty for the first of its
// cameras or, where it has none, the default view. Throws std::runtime_error naming --camera and what is
// accepted.
View makeView(const Scene& scene, const Pose& pose, const std::string& choice, int width, int height);
// The same with a default view that the caller keeps; it is asked for where the camera needs it.
using DefaultViewOf = std::function<const DefaultView&()>;
View makeView(const Scene& scene, const Pose& pose, const std::string& choice, int width, int height,
              const DefaultViewOf& defaultView);

}  // namespace diptych
