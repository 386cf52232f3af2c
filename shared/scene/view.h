// SPDX-License-Identifier: MIT
// Converts a camera and image size to the shaders' matrices and vectors, in double.
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
    double target_distance = 1;  // m, from the eye to its target
    // Width over height of the camera's frame if the image is narrower; else 0.
    double wider_frame = 0;

    glm::dvec3 eye() const;
    glm::dvec3 target() const;
    glm::dvec3 right() const;     // unit
    glm::dvec3 up() const;        // unit
    glm::dvec3 backward() const;  // unit, from the target to the camera

    // Reversed depth, Vulkan's clip space (y down), relative to the camera: world axes with the camera as
    // origin.
    glm::dmat4 clipFromWorld() const;

    gpu::View gpuView() const;  // light counts are 0
};

// The image contains all of the camera's frame (glTF 2.0, 3.10.3). An image narrower than the frame shows
// more above and below, a wider one more at the sides.
//
// `choice` is Settings::camera: a camera of the scene, a free camera, or empty. Empty means the first
// camera, or the default view if there is none. Throws std::runtime_error that names --camera and the
// accepted values. `kept` is called only if the default view is needed; the caller keeps its result.
using DefaultViewOf = std::function<const DefaultView&()>;
View makeView(const Scene& scene, const Pose& pose, const std::string& choice, int width, int height,
              const DefaultViewOf& kept = {});

}  // namespace diptych
