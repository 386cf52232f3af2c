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
constexpr double turnedBy = 37;  // degrees
// Even, so that the 2x2 pixels whose differences choose a mip level stay together; not a multiple of a
// tile's size.
constexpr int border = 6;

// Transforms scene, lights and camera: world' = place * world, whose 3x3 part is orthogonal. If it
// mirrors, so does the image.
void placeAll(Case& placed, const glm::dmat4& place) {
    const glm::dmat3 turn(place);
    const bool mirrors = glm::determinant(turn) < 0;
    Scene& scene = placed.scene;
    const int root = static_cast<int>(scene.nodes.size());
    for (Node& node : scene.nodes)
        if (node.parent < 0) node.parent = root;
    scene.nodes.push_back({.name = "placed", .parent_from_node = place});
    for (Light& light : scene.lights) {
        light.position = glm::dvec3(place * glm::dvec4(light.position, 1));
        light.direction = turn * light.direction;
        light.axis = turn * light.axis;
    }
    glm::dmat4& camera = placed.camera().world_from_camera;
    camera = place * camera;
    if (mirrors) camera[0] = -camera[0];
}

void moveTogether(Related& related, const Subject& subject) {
    placeAll(related.changed, glm::translate(glm::dmat4(1), subject.bounds.radius() * movedBy));
}

void turnTogether(Related& related, const Subject&) {
    const glm::dmat4 turn = glm::rotate(glm::dmat4(1), glm::radians(turnedBy), glm::dvec3(0, 1, 0));
    placeAll(related.changed, turn);
    related.map.turn = glm::dmat3(turn);
}

// A matrix of only 0 and 1.
void turnByAQuarter(Related& related, const Subject&) {
    const glm::dmat3 quarter({0, 0, -1}, {0, 1, 0}, {1, 0, 0});
    placeAll(related.changed, glm::dmat4(quarter));
    related.map.turn = quarter;
}

// Without textures: the pixel of 2x2 that decides a texture's mip level is not mirrored.
void mirror(Related& related, const Subject&) {
    related.own_base = true;
    for (Case* of : {&related.base, &related.changed})
        for (Material& material : of->scene.materials)
            for (const MaterialSlot& slot : materialSlots) material.*slot.texture = {};
    const glm::dmat3 mirrored({-1, 0, 0}, {0, 1, 0}, {0, 0, 1});
    placeAll(related.changed, glm::dmat4(mirrored));
    related.map.turn = mirrored;
    related.map.mirrored = true;
}

void scaleByTwo(Related& related, const Subject&) {
    scaleLengths(related.changed, 2);
    related.map.length = 2;
}

std::string lacksTurnable(const Subject& subject) {
    if (subject.given.settings.env != Settings().env || subject.given.scene.environment)
        return "the maps of an environment have their own pixel grid";
    if (const std::string lacks = lacksPerObject(subject); !lacks.empty()) return lacks;
    return lacksWithShadows(subject);
}
std::string lacksMirrorable(const Subject& subject) {
    if (subject.view.width % 2 != 0)
        return "the picture's width is odd: mirrored, derivatives would use other 2x2 quads";
    return lacksTurnable(subject);
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
    if (std::ranges::any_of(subject.given.scene.materials, transmits))
        return "surfaces with transmission read the picture up to its border, which moves";
    return lacksWithShadows(subject);
}

std::string lacksWithoutFar(const Subject& subject) {
    if (subject.view.camera.orthographic) return "the camera is orthographic";
    return lacksWithShadows(subject);
}

// Stored depth is the near plane's distance over view depth if there is no far plane.
void halveNear(Related& related, const Subject&) {
    related.own_base = true;
    for (Case* of : {&related.base, &related.changed})
        of->camera().far = std::numeric_limits<double>::infinity();
    related.changed.camera().near /= 2;
}

}  // namespace

std::vector<Relation> placeRelations() {
    return {
        {.name = "moved",
         .changes = "scene, lights and camera are moved by 100,000 times the scene's radius",
         .equality = Equality::rounding,
         .because = "positions relative to the camera are computed in double; one that rounds to another "
                    "float32 moves by 2^-24 of its distance",
         .lacks = lacksWithShadows,
         .change = moveTogether},
        {.name = "turned",
         .changes = "scene, lights and camera are rotated by 37 degrees about +Y",
         .equality = Equality::rounding,
         .because = "vectors in world space have other components, which round differently",
         .lacks = lacksTurnable,
         .change = turnTogether},
        {.name = "quarter_turn",
         .changes = "scene, lights and camera are rotated by 90 degrees about +Y",
         .equality = Equality::rounding,
         .because = "x and z are exchanged, so sums of products have another order",
         .lacks = lacksTurnable,
         .change = turnByAQuarter},
        {.name = "mirrored",
         .changes = "scene, lights and camera are mirrored at x = 0, and so is the picture; without textures",
         .equality = Equality::rounding,
         .because = "signs change, and mirrored columns of the picture round differently",
         .lacks = lacksMirrorable,
         .change = mirror},
        {.name = "scaled",
         .changes = "all lengths are doubled, and candela are multiplied by 4",
         .because = "powers of two are exact in float32",
         .lacks = lacksWithShadows,
         .change = scaleByTwo,
         .same_pipelines = true},
        {.name = "tiles_shifted",
         .changes = "the picture has 6 more pixels on each side, so tiles begin at other pixels",
         .equality = Equality::rounding,
         .because = "another division computes the ray through a pixel",
         .lacks = lacksFixedBorder,
         .change = shiftTiles},
        {.name = "near_halved",
         .changes = "the near plane is half as far away, without a far plane",
         .because = "stored depth is near / depth, and half of a float32 is exact",
         .lacks = lacksWithoutFar,
         .change = halveNear,
         .same_pipelines = true}};
}

}  // namespace diptych::audit
