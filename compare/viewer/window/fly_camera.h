// SPDX-License-Identifier: MIT
// An interactive camera, expressed as --camera text so that any view can be reproduced.
#pragma once

#include "compare/viewer/drawing/request.h"
#include "shared/frame/frame.h"
#include "shared/image/image.h"
#include "shared/scene/view.h"

#include <glm/vec3.hpp>

#include <optional>
#include <string>

namespace diptych::viewer {

class FlyCamera {
public:
    // Takes over an image's camera. Roll about the view direction is lost at the first movement, because
    // --camera has no roll.
    void take(const FrameCamera& camera);
    // Whether --camera can describe the camera: false for an orthographic one.
    bool canMove() const { return known_ && fov_ > 0; }

    // Rotates about the world's up and the camera's right, rad; stops just short of straight up and down.
    void look(double right, double up);
    // Moves along the camera's right, the world's up and the view direction, m.
    void move(const glm::dvec3& right_up_forward);
    // Rotates about a world-space point, which stays at its image position, rad.
    void orbit(const glm::dvec3& pivot, double right, double up);

    // "eye=x,y,z target=x,y,z fov=deg near=m far=m"; 9 digits resolve a millimetre in a megametre.
    std::string describe() const;

    const glm::dvec3& eye() const { return eye_; }
    glm::dvec3 forward() const;  // unit, world
    glm::dvec3 right() const;    // unit, world
    // Distance to the camera's target when it was taken over, m: a scale for speeds.
    double targetDistance() const { return target_distance_; }

private:
    bool known_ = false;
    glm::dvec3 eye_{0};
    double heading_ = 0, pitch_ = 0;  // rad: about +Y from -Z, counter-clockwise seen from above; upwards
    double fov_ = 0, near_ = 0.1, far_ = 1000, target_distance_ = 1;
};

// The world position at a pixel, from its depth (m along the view direction, 0: background); empty in the
// background. Perspective cameras only.
std::optional<glm::dvec3> seenAt(const View& view, const Image& depth, const PixelPosition& pixel);

}  // namespace diptych::viewer
