// SPDX-License-Identifier: MIT
// A camera that a person steers, in the words of --camera: what is drawn is what those words ask for.
#pragma once

#include "compare/viewer/order.h"
#include "shared/frame/frame.h"
#include "shared/image/image.h"
#include "shared/scene/view.h"

#include <glm/vec3.hpp>

#include <optional>
#include <string>

namespace diptych::viewer {

class FlyCamera {
public:
    // Takes over the camera of a picture. Upright from then on: a camera that is rolled about its view, which
    // --camera has no words for, stands up when it is moved.
    void take(const FrameCamera& camera);
    // Whether it has a camera that --camera can describe: not an orthographic one.
    bool canMove() const { return known_ && fov_ > 0; }

    // Turns about the world's up and the camera's right, radians; up and down end short of straight.
    void look(double right, double up);
    // Along the camera's right, the world's up and where it looks, m.
    void move(const glm::dvec3& right_up_forward);
    // Turns about a point in world space, which stays where it is in the picture, radians.
    void orbit(const glm::dvec3& pivot, double right, double up);

    // "eye=x,y,z target=x,y,z fov=deg near=m far=m", with 9 digits, which tell a millimetre in a megametre.
    std::string words() const;

    const glm::dvec3& eye() const { return eye_; }
    glm::dvec3 forward() const;  // unit, world
    glm::dvec3 right() const;    // unit, world
    // How far the camera's target was when it was taken over, m: a scale for speeds.
    double reach() const { return reach_; }

private:
    bool known_ = false;
    glm::dvec3 eye_{0};
    double heading_ = 0, pitch_ = 0;  // rad: about +Y from -Z, counter-clockwise seen from above; upwards
    double fov_ = 0, near_ = 0.1, far_ = 1000, reach_ = 1;
};

// The place in the world that a pixel shows, by its depth (m along the view's direction, 0: background);
// nothing where there is none. Of a perspective camera: others do not orbit.
std::optional<glm::dvec3> seenAt(const View& view, const Image& depth, const PixelPlace& pixel);

}  // namespace diptych::viewer
