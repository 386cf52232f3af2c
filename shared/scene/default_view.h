// SPDX-License-Identifier: MIT
// Where the camera of a scene that has none stands.
#pragma once

#include "shared/scene/model/scene.h"
#include "shared/scene/motion/bounds.h"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include <string>
#include <vector>

namespace diptych {

// A camera around a scene or within it. Its place does not depend on the picture's size, but for how far away
// the whole scene fits into it.
struct DefaultView {
    enum class Place { usual, outside, inside };
    Place place = Place::usual;    // usual: from the direction (+1, +0.6, +1) around the bounds
    glm::dvec3 backward{0, 0, 1};  // unit, from what is looked at to the eye
    glm::dvec3 eye{0};             // inside: where it stands
    double covered = 0;            // share of a picture of 16:9 that shows a surface, 0 to 1
    double entropy = 0;            // bits, see viewEntropy()
    std::string inWords() const;   // "from inside; the scene covers 97 % of the image"
};

// Viewpoint entropy (Vázquez, Feixas, Sbert and Heidrich 2001, "Viewpoint Selection using Viewpoint
// Entropy"), in bits: of parts that fill `pixels[i]` of a picture, the background being one of them,
// sum -p log2 p. 2^bits parts of equal size have it: nothing has 0, one bit more is twice as many parts.
double viewEntropy(const std::vector<std::size_t>& pixels);

// The view of the scene at 0 s that shows most, see the README; so the camera does not move with the scene.
// The same on every run. `animation`: the one that plays, as for poseAt().
DefaultView chooseDefaultView(const Scene& scene, const std::string& animation = {});

// The eye's distance from what it looks at, m, and its place: outside where all of the bounds is seen with a
// margin of 5 %, under the camera of freeCamera(). `aspect`: width over height.
double targetDistance(const DefaultView& view, const Bounds& bounds, double aspect);
glm::dmat4 worldFromCamera(const DefaultView& view, const Bounds& bounds, double aspect);

// A camera of 60 degrees at the origin for a scene of those bounds.
Camera freeCamera(const Bounds& bounds);
// The bounds' centre, or the origin where they are empty.
glm::dvec3 usableCentre(const Bounds& bounds);

// A camera at `eye` with +Y up in its picture. Looking straight up or down, -Z is: at the top looking down,
// at the bottom looking up, as for a camera that tilts there from looking along -Z.
glm::dmat4 lookAt(const glm::dvec3& eye, const glm::dvec3& target);

}  // namespace diptych
