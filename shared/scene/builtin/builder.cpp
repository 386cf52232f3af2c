// SPDX-License-Identifier: MIT
#include "shared/scene/builtin/builder.h"

#include "shared/scene/model/axes.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <cmath>
#include <utility>

namespace diptych {

int Builder::material(const std::string& name, const Surface& surface) {
    Material& made = scene.materials.emplace_back();
    made.name = name;
    made.base_color = glm::vec4(surface.base_color, 1);
    made.metallic = surface.metallic;
    made.roughness = surface.roughness;
    made.emissive = surface.emissive;
    return static_cast<int>(scene.materials.size() - 1);
}

TextureSlot Builder::texture(TextureImage image, double tiles, const Sampler& sampler) {
    scene.images.push_back(std::move(image));
    scene.textures.push_back({static_cast<int>(scene.images.size() - 1), sampler});
    TextureSlot slot;
    slot.texture = static_cast<int>(scene.textures.size() - 1);
    slot.u.x = slot.v.y = tiles;
    return slot;
}

int Builder::addMesh(Primitive shape, int material, const std::string& name) {
    shape.material = material;
    scene.meshes.push_back({name, {}});
    scene.meshes.back().primitives.push_back(std::move(shape));
    return static_cast<int>(scene.meshes.size() - 1);
}

int Builder::addNode(const std::string& name, int mesh, const glm::dmat4& parentFromNode, int parent) {
    scene.nodes.push_back({name, parent, parentFromNode, mesh});
    return static_cast<int>(scene.nodes.size() - 1);
}

int Builder::add(const std::string& name, Primitive shape, int material, const glm::dmat4& worldFromShape) {
    return addNode(name, addMesh(std::move(shape), material, name), worldFromShape);
}

int Builder::add(const std::string& name, Primitive shape, int material, const glm::dvec3& position) {
    return add(name, std::move(shape), material, at(position.x, position.y, position.z));
}

Light& Builder::light(const char* name, LightKind kind, const glm::vec3& color, float intensity, float range,
                      const glm::dvec3& position, const glm::dvec3& direction) {
    Light& made = scene.lights.emplace_back();
    made.name = fmt::format("{} {}", name, scene.lights.size() - 1);
    made.kind = kind;
    made.color = color;
    made.intensity = intensity;
    made.range = range;
    made.position = position;
    made.direction = glm::normalize(direction);
    return made;
}

void Builder::point(const glm::dvec3& position, const glm::vec3& color, float candela, float range) {
    light("point", LightKind::point, color, candela, range, position, {0, 0, -1});
}

void Builder::spot(const glm::dvec3& position, const glm::dvec3& target, const glm::vec3& color,
                   float candela, float range, const Cone& cone) {
    Light& made = light("spot", LightKind::spot, color, candela, range, position, target - position);
    made.inner_cone = static_cast<float>(glm::radians(cone.inner));
    made.outer_cone = static_cast<float>(glm::radians(cone.outer));
}

Light& Builder::rect(const glm::dvec3& position, const glm::dvec3& target, const glm::vec3& color, float nits,
                     float range) {
    Light& made = light("area", LightKind::rect, color, nits, range, position, target - position);
    made.axis = perpendicularTo(made.direction);
    return made;
}

void Builder::sun(const glm::dvec3& direction, const glm::vec3& color, float lux) {
    light("sun", LightKind::directional, color, lux, noEnd, {0, 0, 0}, direction);
}

Camera& Builder::camera(const std::string& name, const glm::dvec3& eye, const glm::dvec3& target,
                        double yfovDegrees, double near, double far) {
    const glm::dvec3 forward = glm::normalize(target - eye);
    const glm::dvec3 up = std::abs(forward.y) < 0.999 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, -1);
    // Built from its axes, because inverting a view matrix would lose digits far from the origin.
    const glm::dvec3 right = glm::normalize(glm::cross(forward, up));
    Camera& made = scene.cameras.emplace_back();
    made.name = name;
    made.yfov = glm::radians(yfovDegrees);
    made.near = near;
    made.far = far;
    made.world_from_camera = glm::dmat4(glm::dvec4(right, 0), glm::dvec4(glm::cross(right, forward), 0),
                                        glm::dvec4(-forward, 0), glm::dvec4(eye, 1));
    return made;
}

glm::dmat4 at(double x, double y, double z) {
    return glm::translate(glm::dmat4(1.0), glm::dvec3(x, y, z));
}
glm::dmat4 rotated(double degrees, const glm::dvec3& axis) {
    return glm::rotate(glm::dmat4(1.0), glm::radians(degrees), axis);
}
glm::dmat4 scaled(double x, double y, double z) {
    return glm::scale(glm::dmat4(1.0), glm::dvec3(x, y, z));
}

}  // namespace diptych
