// SPDX-License-Identifier: MIT
#include "compare/reference/image_key.h"

#include "compare/reference/key.h"
#include "compare/reference/pixel_renderer.h"
#include "compare/reference/request.h"
#include "compare/reference/scene/material.h"
#include "shared/scene/model/material_slots.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <span>
#include <vector>

namespace diptych::reference {
namespace {

void addPrimitive(Key& key, const Primitive& p) {
    key.addAll(p.positions);
    key.addAll(p.normals);
    key.addAll(p.tangents);
    key.addAll(p.texcoords[0]);
    key.addAll(p.texcoords[1]);
    key.addAll(p.colors);
    key.addAll(p.indices);
    key.add(glm::ivec2(p.material, p.flat));
    key.addAll(p.tangent_groups.corners);
    for (const JointSet& set : p.joint_sets) {
        key.addAll(set.joints);
        key.addAll(set.weights);
    }
    for (const MorphTarget& target : p.targets) {
        key.addAll(target.positions);
        key.addAll(target.normals);
        key.addAll(target.tangents);
        key.addAll(target.texcoords[0]);
        key.addAll(target.texcoords[1]);
        key.addAll(target.colors);
    }
}

void addMaterial(Key& key, const Material& m) {
#define DIPTYCH_ADD(type, name, ...) key.add(m.name);
    MATERIAL_FACTORS(DIPTYCH_ADD)
#undef DIPTYCH_ADD
    key.add(m.emissive);
    key.add(m.specular_color);
    key.add(m.anisotropy_rotation);
    key.add(glm::ivec4(static_cast<int>(m.alpha_mode), m.double_sided, m.unlit, m.specular_glossiness));
    for (const MaterialSlot& slot : materialSlots) {
        const TextureSlot& s = m.*slot.texture;
        key.add(s.texture);
        key.add(s.texcoord);
        key.add(s.u);
        key.add(s.v);
    }
}

void addScene(Key& key, const Request& request) {
    const Scene& scene = request.scene;
    for (const Mesh& mesh : scene.meshes)
        for (const Primitive& p : mesh.primitives) addPrimitive(key, p);
    for (const Material& m : materialsOf(scene, request.pose)) addMaterial(key, m);
    for (const Texture& texture : scene.textures) {
        key.add(texture.image);
        key.add(glm::ivec4(static_cast<int>(texture.sampler.wrap_s), static_cast<int>(texture.sampler.wrap_t),
                           texture.sampler.magnify_linear, texture.sampler.minify_linear));
    }
    for (const TextureImage& image : scene.images) {
        key.add(glm::ivec2(image.width, image.height));
        key.addAll(image.rgba);
        key.addAll(image.rgba16);
        key.addAll(image.rgba32);
    }
    for (const Instance& instance : request.pose.instances) {
        key.add(glm::ivec4(instance.mesh, instance.primitive, instance.skin, instance.weights));
        key.add(instance.world_from_object);
    }
    for (const std::vector<glm::dmat4>& joints : request.pose.skins) key.addAll(joints);
    for (const std::vector<double>& weights : request.pose.weights) key.addAll(weights);
}

void addLight(Key& key, const Light& l) {
    key.add(glm::vec4(l.color, l.intensity));
    key.add(glm::vec4(l.range, l.inner_cone, l.outer_cone, l.angle));
    key.add(glm::vec4(l.width, l.height, l.radius, l.length));
    key.add(glm::ivec2(static_cast<int>(l.kind), l.two_sided));
    key.add(l.position);
    key.add(l.direction);
    key.add(l.axis);
}

void addAir(Key& key, const Air& air) {
    for (const AirKind& kind : {air.molecules, air.aerosols}) {
        key.add(kind.scattering);
        key.add(kind.extinction);
        key.add(kind.scale);
    }
    key.add(glm::dvec2(air.g, air.ground));
    key.add(air.uniform);
    key.add(air.ambient);
    key.add(air.sun != nullptr);
    if (!air.sun) return;
    key.add(glm::vec4(air.sun->color, air.sun->intensity));
    key.add(air.sun->direction);
}

}  // namespace

// Increase the version number whenever the reference itself renders differently.
std::uint64_t keyOf(const Request& request) {
    constexpr int version = 19;
    Key key;
    key.add(version);
    key.add(std::as_bytes(std::span(request.program)));
    const View& view = request.view;
    key.add(glm::ivec4(view.width, view.height, request.samples, static_cast<int>(request.mode)));
    key.add(request.resolve);
    key.add(view.camera.world_from_camera);
    key.add(glm::dvec4(view.camera.yfov, view.camera.ymag, view.camera.near, view.camera.far));
    key.add(glm::ivec4(view.camera.orthographic, request.shadowed_environment, request.environment_costs,
                       request.surroundings | 2 * request.blended | 4 * request.shadow_edges));
    key.addAll(request.casters);
    for (const Light& l : request.lights) addLight(key, l);
    key.add(request.environment_factor);
    key.add(request.environment_rotation);
    key.add(request.ambient);
    key.add(request.multiscatter);
    key.add(request.base_layer);
    key.add(request.skin_normals);
    key.add(request.falloff.window);
    key.add(request.falloff.cone);
    key.add(request.air.has_value());
    if (request.air) addAir(key, *request.air);
    if (request.residual) key.addAll(request.residual->radiance.data);
    if (request.scene.environment) {
        const Image& sky = request.scene.environment->radiance;
        key.add(glm::ivec2(sky.width, sky.height));
        key.addAll(sky.data);
        for (const Material& m : materialsOf(request.scene, request.pose)) key.add(hasLightmap(m));
    }
    for (const auto* channels : {request.surfaces, request.decoded})
        if (channels)
            for (const auto& [mode, image] : *channels) key.addAll(image.data);
    // Rays hit it: the camera's, those to lights, or those through what is not opaque.
    if (request.mode == ReferenceMode::scene || request.shadows() ||
        (request.blended && blendsSomewhere(request)))
        addScene(key, request);
    return key.value();
}

}  // namespace diptych::reference
