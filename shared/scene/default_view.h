// SPDX-License-Identifier: MIT
// The camera of a scene that has none.
#pragma once

#include "shared/scene/model/scene.h"
#include "shared/scene/motion/bounds.h"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include <string>
#include <vector>

namespace diptych {

// A camera around or inside a scene. The image size affects only the distance of an outside view.
struct DefaultView {
    enum class Viewpoint { standard, outside, inside };
    Viewpoint viewpoint = Viewpoint::standard;  // standard: from the direction (+1, +0.6, +1)
    glm::dvec3 backward{0, 0, 1};               // unit, from the target to the eye
    glm::dvec3 eye{0};                          // if inside
    double covered = 0;                         // fraction of a 16:9 image that shows a surface, 0 to 1
    double entropy = 0;                         // bits, see viewEntropy()
    std::string describe() const;               // "from inside; the scene covers 97 % of the image"
};

// Viewpoint entropy in bits (Vázquez, Feixas, Sbert and Heidrich 2001, "Viewpoint Selection using
// Viewpoint Entropy"): -sum p log2 p over parts that cover `pixels[i]` each; the background is one part.
// An empty view has 0; n equal parts have log2 n.
double viewEntropy(const std::vector<std::size_t>& pixels);

// The view that shows most of the scene at 0 s (see the README), so the camera does not follow the
// animation. Deterministic. `animation`: the one that plays, as for poseAt().
DefaultView chooseDefaultView(const Scene& scene, const std::string& animation = {});

// Distance from the eye to its target, m, and the camera's pose. Outside views fit all of the bounds with
// a margin of 5 % under freeCamera(). `aspect`: width over height.
double targetDistance(const DefaultView& view, const Bounds& bounds, double aspect);
glm::dmat4 worldFromCamera(const DefaultView& view, const Bounds& bounds, double aspect);

// A camera at the origin with a vertical field of view of 60 degrees, its near plane fitted to the bounds.
Camera freeCamera(const Bounds& bounds);
// The centre of the bounds, or the origin if they are empty.
glm::dvec3 usableCentre(const Bounds& bounds);

// A camera at `eye` with +Y up in its image. If it looks straight down, -Z points to the top of the image;
// straight up, to the bottom. Tilting from a view along -Z gives the same.
glm::dmat4 lookAt(const glm::dvec3& eye, const glm::dvec3& target);

}  // namespace diptych
