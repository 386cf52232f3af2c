// SPDX-License-Identifier: MIT
#include "compare/audit/case.h"

#include "compare/frames/frame_properties.h"
#include "shared/scene/visible_surface.h"

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace diptych::audit {

namespace {

constexpr int probedAcross = 32;  // rays across and down that search for the surface nearest to the centre

// World direction (unit) through an image point from (-1, -1), bottom left, to (1, 1).
glm::dvec3 directionAt(const View& view, double x, double y) {
    const double t = std::tan(view.camera.yfov / 2), aspect = static_cast<double>(view.width) / view.height;
    return glm::normalize(view.right() * (x * t * aspect) + view.up() * (y * t) - view.backward());
}

void findSurface(Subject& subject, const Scene& scene, const Pose& pose) {
    if (subject.view.camera.orthographic || subject.bounds.empty()) return;
    const VisibleSurface surface(scene, pose, subject.bounds);
    double nearest = 0;
    for (int row = 0; row <= probedAcross; ++row)
        for (int column = 0; column <= probedAcross; ++column) {
            const double x = 2.0 * column / probedAcross - 1, y = 2.0 * row / probedAcross - 1;
            const double away = x * x + y * y;
            const glm::dvec3 along = directionAt(subject.view, x, y);
            const auto hit = surface.nearest(subject.view.eye(), along);
            if (!hit) continue;
            subject.nearest = subject.has_surface ? std::min(subject.nearest, hit->distance) : hit->distance;
            if (subject.has_surface && away >= nearest) continue;
            subject.has_surface = true;
            nearest = away;
            subject.point = subject.view.eye() + along * hit->distance;
            subject.normal = hit->normal;
        }
}

}  // namespace

bool isLocal(const Light& light) {
    return light.kind != LightKind::directional;
}
bool isPunctual(const Light& light) {
    return light.kind == LightKind::point || light.kind == LightKind::spot;
}

Subject makeSubject(const Scene& scene, const Settings& settings) {
    SceneViews views(scene);
    const SceneView& view = views.at(viewRequest(settings));
    Subject subject;
    subject.original = {scene, settings};
    subject.view = view.view;
    subject.view_name = view.default_view.empty() ? view.view.camera.name : view.default_view;
    Case& original = subject.original;
    original.scene.lights = view.lights;
    if (view.sun && !original.scene.lights.empty())
        original.scene.lights.pop_back();  // --env-sun extracts it again
    for (Light& light : original.scene.lights) light.node = light.source = -1;
    original.settings.lights = Settings().lights;
    Camera camera = view.view.camera;
    camera.node = camera.source = -1;
    camera.name = "audited";
    original.scene.cameras.push_back(std::move(camera));
    original.settings.camera = std::to_string(original.scene.cameras.size() - 1);
    subject.bounds = worldBounds(scene, view.pose);
    subject.moves = std::ranges::any_of(scene.animations, movesAnything);
    findSurface(subject, scene, view.pose);
    return subject;
}

Node& carry(Scene& scene, std::size_t index, int mesh) {
    Node carrier = scene.nodes[index];
    carrier.parent = static_cast<int>(index);
    carrier.parent_from_node = glm::dmat4(1);
    carrier.transform = -1;
    carrier.mesh = mesh;
    return scene.nodes.emplace_back(std::move(carrier));
}

void moveAll(Case& changed, const glm::dmat4& move) {
    Scene& scene = changed.scene;
    const int root = static_cast<int>(scene.nodes.size());
    for (Node& node : scene.nodes)
        if (node.parent < 0) node.parent = root;
    scene.nodes.push_back({.name = "moved", .parent_from_node = move});
    const auto moved = [&](const glm::dvec3& location) { return glm::dvec3(move * glm::dvec4(location, 1)); };
    for (Light& light : scene.lights) light.position = moved(light.position);
    glm::dmat4& camera = changed.camera().world_from_camera;
    camera[3] = glm::dvec4(moved(glm::dvec3(camera[3])), 1);
}

void scaleLengths(Case& changed, double factor) {
    moveAll(changed, glm::scale(glm::dmat4(1), glm::dvec3(factor)));
    const auto f = static_cast<float>(factor);
    for (Light& light : changed.scene.lights) {
        for (float* length : {&light.range, &light.width, &light.height, &light.radius, &light.length})
            *length *= f;
        // Candela equal lux at one metre.
        if (isPunctual(light))
            light.intensity = static_cast<float>(double{light.intensity} * factor * factor);
    }
    // Nodes scale a volume's thickness, but not the distance over which it absorbs.
    for (Material& material : changed.scene.materials) material.attenuation_distance *= f;
    Camera& camera = changed.camera();
    camera.near *= factor;
    camera.far *= factor;
    camera.ymag *= factor;
    Settings& settings = changed.settings;
    if (settings.haze) {
        settings.haze_density /= f;
        settings.haze_rayleigh_height *= f;
        settings.haze_mie_height *= f;
        settings.haze_ground *= f;
    }
    settings.shadow_distance *= f;
}

}  // namespace diptych::audit
