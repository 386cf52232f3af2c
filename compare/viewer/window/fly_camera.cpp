// SPDX-License-Identifier: MIT
#include "compare/viewer/window/fly_camera.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace diptych::viewer {
namespace {

// Pitch limit, rad: straight up and down have no right and left.
constexpr double steepest = 89.5 * std::numbers::pi / 180;

double pitchOf(const glm::dvec3& unit) {
    return std::asin(std::clamp(unit.y, -1.0, 1.0));
}
double headingOf(const glm::dvec3& unit) {
    return std::atan2(-unit.x, -unit.z);
}
glm::dvec3 directionOf(double heading, double pitch) {
    return {-std::sin(heading) * std::cos(pitch), std::sin(pitch), -std::cos(heading) * std::cos(pitch)};
}

}  // namespace

void FlyCamera::take(const FrameCamera& camera) {
    eye_ = {camera.eye[0], camera.eye[1], camera.eye[2]};
    const glm::dvec3 target(camera.target[0], camera.target[1], camera.target[2]);
    const glm::dvec3 to = target - eye_;
    target_distance_ = glm::length(to);
    if (!(target_distance_ > 0) || !std::isfinite(target_distance_)) return;
    known_ = true;
    heading_ = headingOf(to / target_distance_);
    pitch_ = std::clamp(pitchOf(to / target_distance_), -steepest, steepest);
    fov_ = camera.fov_degrees;
    near_ = camera.near;
    far_ = camera.far;
}

glm::dvec3 FlyCamera::forward() const {
    return directionOf(heading_, pitch_);
}

glm::dvec3 FlyCamera::right() const {
    return {std::cos(heading_), 0, -std::sin(heading_)};
}

void FlyCamera::look(double right, double up) {
    heading_ = std::remainder(heading_ - right, 2 * std::numbers::pi);
    pitch_ = std::clamp(pitch_ + up, -steepest, steepest);
}

void FlyCamera::move(const glm::dvec3& by) {
    eye_ += right() * by.x + glm::dvec3(0, by.y, 0) + forward() * by.z;
}

// The eye's position relative to the pivot, in the camera's axes, stays the same.
void FlyCamera::orbit(const glm::dvec3& pivot, double right, double up) {
    const auto upOf = [this] { return glm::cross(this->right(), forward()); };
    const glm::dvec3 from = eye_ - pivot;
    const glm::dvec3 own(glm::dot(from, this->right()), glm::dot(from, upOf()), glm::dot(from, forward()));
    look(right, up);
    eye_ = pivot + this->right() * own.x + upOf() * own.y + forward() * own.z;
}

std::string FlyCamera::describe() const {
    const glm::dvec3 target = eye_ + forward() * target_distance_;
    return fmt::format(
        "eye={:.9g},{:.9g},{:.9g} target={:.9g},{:.9g},{:.9g} fov={:.9g} near={:.9g} far={:.9g}", eye_.x,
        eye_.y, eye_.z, target.x, target.y, target.z, fov_, near_, far_);
}

std::optional<glm::dvec3> seenAt(const View& view, const Image& depth, const PixelPosition& pixel) {
    const auto along = double{depth.at(pixel.x, pixel.y)};
    if (!(along > 0)) return std::nullopt;
    // Any point on the pixel's ray, from the eye.
    const glm::dvec4 clip(2 * (pixel.x + 0.5) / depth.width - 1, 2 * (pixel.y + 0.5) / depth.height - 1, 0.5,
                          1);
    const glm::dvec4 at = glm::inverse(view.clipFromWorld()) * clip;
    const glm::dvec3 ray = glm::dvec3(at) / at.w;
    return view.eye() + ray * (along / glm::dot(ray, -view.backward()));
}

}  // namespace diptych::viewer
