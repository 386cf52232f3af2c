// SPDX-License-Identifier: MIT
#include "compare/audit/relations.h"

#include "shared/scene/model/material_slots.h"

#include <glm/ext/matrix_transform.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace diptych::audit {

namespace {

// Horizontal and along no axis, in radii of the scene. float32 would place the scene to a hundredth of its
// size; double has bits to spare.
const glm::dvec3 movedBy{86421.3, 0, -50321.7};
constexpr double rotationDegrees = 37;
// Even, so that the 2x2 pixels whose differences choose a mip level stay together; not a multiple of a
// tile's size.
constexpr int border = 6;

// Transforms scene, lights and camera: world' = transform * world, whose 3x3 part is orthogonal. If it
// mirrors, so does the image.
void transformAll(Case& changed, const glm::dmat4& transform) {
    moveAll(changed, transform);
    const glm::dmat3 rotation(transform);
    for (Light& light : changed.scene.lights) {
        light.direction = rotation * light.direction;
        light.axis = rotation * light.axis;
    }
    glm::dmat4& camera = changed.camera().world_from_camera;
    for (int c = 0; c < 3; ++c) camera[c] = transform * camera[c];
    if (glm::determinant(rotation) < 0) camera[0] = -camera[0];
}

void rotateAll(Related& related, const glm::dmat3& rotation) {
    transformAll(related.changed, glm::dmat4(rotation));
    related.map.rotation = rotation;
}

void rotateTogether(Related& related, const Subject&) {
    rotateAll(related,
              glm::dmat3(glm::rotate(glm::dmat4(1), glm::radians(rotationDegrees), glm::dvec3(0, 1, 0))));
}

// Without textures: the pixel of 2x2 that decides a texture's mip level is not mirrored.
void mirror(Related& related, const Subject&) {
    related.own_base = true;
    for (Case* of : {&related.base, &related.changed})
        for (Material& material : of->scene.materials)
            for (const MaterialSlot& slot : materialSlots) material.*slot.texture = {};
    rotateAll(related, glm::dmat3({-1, 0, 0}, {0, 1, 0}, {0, 0, 1}));
    related.map.mirrored = true;
}

std::string lacksRotatable(const Subject& subject) {
    const bool lit = subject.original.settings.env != Settings().env || subject.original.scene.environment;
    return lit ? "the maps of an environment have their own pixel grid" : "";
}
std::string lacksMirrorable(const Subject& subject) {
    const bool odd = subject.view.width % 2 != 0;
    return odd ? "the picture's width is odd: mirrored, derivatives would use other 2x2 quads" : "";
}

// A wider view whose central pixels stay the same.
void shiftTiles(Related& related, const Subject&) {
    Size& size = related.changed.settings.size;
    const double taller = static_cast<double>(size.height + 2 * border) / size.height;
    size.width += 2 * border;
    size.height += 2 * border;
    Camera& camera = related.changed.camera();
    camera.ymag *= taller;
    camera.yfov = 2 * std::atan(std::tan(camera.yfov / 2) * taller);
    related.map.border = border;
}

std::string lacksFixedBorder(const Subject& subject) {
    const bool any = std::ranges::any_of(subject.original.scene.materials, transmits);
    return any ? "surfaces with transmission read the picture up to its border, which moves" : "";
}

// Stored depth is the near plane's distance over view depth if there is no far plane.
void halveNear(Related& related, const Subject&) {
    related.own_base = true;
    for (Case* of : {&related.base, &related.changed})
        of->camera().far = std::numeric_limits<double>::infinity();
    related.changed.camera().near /= 2;
}

}  // namespace

std::vector<Relation> transformRelations() {
    return {
        {.name = "moved",
         .changes = "scene, lights and camera are moved by 100,000 times the scene's radius",
         .equality = Equality::rounding,
         .because = "positions relative to the camera are computed in double; one that rounds to another "
                    "float32 moves by 2^-24 of its distance",
         .lacks = {lacksWithShadows},
         .change =
             [](Related& related, const Subject& subject) {
                 transformAll(related.changed,
                              glm::translate(glm::dmat4(1), subject.bounds.radius() * movedBy));
             }},
        {.name = "turned",
         .changes = "scene, lights and camera are rotated by 37 degrees about +Y",
         .equality = Equality::rounding,
         .because = "vectors in world space have other components, which round differently",
         .lacks = {lacksRotatable, lacksPerObject, lacksWithShadows},
         .change = rotateTogether},
        {.name = "quarter_turn",
         .changes = "scene, lights and camera are rotated by 90 degrees about +Y",
         .equality = Equality::rounding,
         .because = "x and z are exchanged, so sums of products have another order",
         .lacks = {lacksRotatable, lacksPerObject, lacksWithShadows},
         // A matrix of only 0 and 1.
         .change =
             [](Related& related, const Subject&) {
                 rotateAll(related, glm::dmat3({0, 0, -1}, {0, 1, 0}, {1, 0, 0}));
             }},
        {.name = "mirrored",
         .changes = "scene, lights and camera are mirrored at x = 0, and so is the picture; without textures",
         .equality = Equality::rounding,
         .because = "signs change, and mirrored columns of the picture round differently",
         .lacks = {lacksMirrorable, lacksRotatable, lacksPerObject, lacksWithShadows},
         .change = mirror},
        {.name = "scaled",
         .changes = "all lengths are doubled, and candela are multiplied by 4",
         .because = "powers of two are exact in float32",
         .lacks = {lacksWithShadows},
         .change =
             [](Related& related, const Subject&) {
                 scaleLengths(related.changed, 2);
                 related.map.length = 2;
             },
         .same_pipelines = true},
        {.name = "tiles_shifted",
         .changes = "the picture has 6 more pixels on each side, so tiles begin at other pixels",
         .equality = Equality::rounding,
         .because = "another division computes the ray through a pixel",
         .lacks = {lacksFixedBorder, lacksWithShadows},
         .change = shiftTiles},
        {.name = "near_halved",
         .changes = "the near plane is half as far away, without a far plane",
         .because = "stored depth is near / depth, and half of a float32 is exact",
         .lacks = {lacksPerspective, lacksWithShadows},
         .change = halveNear,
         .same_pipelines = true},
    };
}

}  // namespace diptych::audit
