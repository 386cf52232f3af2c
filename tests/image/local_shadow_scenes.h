// SPDX-License-Identifier: MIT
// Small scenes with shadow-casting point and spot lights.
#pragma once

#include "tests/image/shadow_scenes.h"

#include <glm/trigonometric.hpp>

#include <utility>
#include <vector>

namespace diptych::tests {

// The six sides of a box, facing outwards or `inwards`.
inline void addBox(std::vector<Primitive>& all, const glm::vec3& low, const glm::vec3& high, int material = 0,
                   bool inwards = false) {
    const glm::vec3 d = high - low, x(d.x, 0, 0), y(0, d.y, 0), z(0, 0, d.z);
    const auto side = [&](const glm::vec3& corner, const glm::vec3& a, const glm::vec3& b) {
        all.push_back(inwards ? rectangle(corner, b, a, material) : rectangle(corner, a, b, material));
    };
    side(low, y, x);
    side(low + z, x, y);
    side(low, z, y);
    side(low + x, y, z);
    side(low, x, z);
    side(low + y, z, x);
}

inline Light castingPoint(const glm::dvec3& position) {
    Light light;
    light.kind = LightKind::point;
    light.position = position;
    light.intensity = 20;
    return light;
}

// `degrees`: half angle of the cone.
inline Light castingSpot(const glm::dvec3& position, const glm::dvec3& target, double degrees) {
    Light light = castingPoint(position);
    light.kind = LightKind::spot;
    light.direction = glm::normalize(target - position);
    light.outer_cone = static_cast<float>(glm::radians(degrees));
    light.inner_cone = light.outer_cone * 0.8f;
    return light;
}

inline Scene sceneOf(std::vector<Primitive> all, const std::vector<Light>& lights, const glm::dvec3& eye,
                     const glm::dvec3& target, double scale = 1) {
    Scene scene;
    scene.name = "local shadows";
    for (Primitive& p : all)
        for (glm::vec3& position : p.positions) position *= static_cast<float>(scale);
    scene.meshes.push_back({"all", std::move(all)});
    scene.nodes.push_back({"all", -1, glm::dmat4(1.0), 0});
    scene.materials.resize(2);
    for (Material& material : scene.materials) {
        material.double_sided = true;
        material.metallic = 0;
    }
    scene.lights = lights;
    for (Light& light : scene.lights) {
        light.position *= scale;
        light.intensity *= static_cast<float>(scale * scale);
    }
    Camera camera;
    camera.near = 0.1 * scale;
    camera.world_from_camera = glm::inverse(glm::lookAt(eye * scale, target * scale, {0, 1, 0}));
    scene.cameras.push_back(camera);
    return scene;
}

// The ground, 8 m x 8 m around the origin, with objects on it, seen from above.
inline Scene ground(const std::vector<Light>& lights, std::vector<Primitive> standing = {},
                    double scale = 1) {
    std::vector<Primitive> all{rectangle({-4, 0, 4}, {8, 0, 0}, {0, 0, -8})};
    for (Primitive& p : standing) all.push_back(std::move(p));
    return sceneOf(std::move(all), lights, {0.4, 6, 2.5}, {0, 0, 0}, scale);
}

// A room of 6 m x 3 m x 6 m with pillars on all sides of its centre and small objects along the edges of a
// lamp's cube map there. The camera is in a corner.
inline std::vector<Primitive> room() {
    std::vector<Primitive> all;
    addBox(all, {-3, 0, -3}, {3, 3, 3}, 0, true);
    for (const float x : {-1.0f, 1.0f})
        for (const float z : {-1.0f, 1.0f}) {
            addBox(all, {x - 0.15f, 0, z - 0.15f}, {x + 0.15f, 2.2f, z + 0.15f}, 1);
            addBox(all, {1.9f * x - 0.2f, 0, 0.6f * z - 0.2f}, {1.9f * x + 0.2f, 0.5f, 0.6f * z + 0.2f}, 1);
            addBox(all, {0.7f * x - 0.05f, 2.3f, 0.1f * z - 0.05f},
                   {0.7f * x + 0.05f, 2.4f, 0.1f * z + 0.05f}, 1);
        }
    return all;
}
inline Scene lampInARoom() {
    return sceneOf(room(), {castingPoint({0.1, 1.6, -0.05})}, {-2.7, 2.7, 2.6}, {0.6, 0.9, -0.8});
}
// The spot's cone includes the camera, too.
inline Scene bothLightsInARoom() {
    return sceneOf(room(), {castingPoint({0.1, 1.6, -0.05}), castingSpot({2.5, 2.8, -2.5}, {-1, 0.5, 1}, 35)},
                   {-2.7, 2.7, 2.6}, {0.6, 0.9, -0.8});
}

inline std::vector<Primitive> standing() {
    std::vector<Primitive> all;
    addBox(all, {-1.2f, 0, -0.4f}, {-0.8f, 0.7f, 0.5f}, 1);
    addBox(all, {0.4f, 0.6f, -0.9f}, {0.9f, 0.8f, 0.9f}, 1);
    addBox(all, {1.6f, 0, 0.8f}, {2.2f, 1.1f, 1.3f}, 1);
    return all;
}
inline Scene spotOverTheGround() {
    return ground({castingSpot({-2.2, 3, 1.5}, {0.2, 0, 0}, 38)}, standing());
}
inline Scene wideSpotOverTheGround() {
    return ground({castingSpot({0.1, 1.9, 0.2}, {0.3, 0, 0.1}, 85)}, standing());
}

}  // namespace diptych::tests
