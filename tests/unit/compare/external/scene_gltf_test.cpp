// SPDX-License-Identifier: MIT
// The glTF files given to external renderers, read back by our loader.
#include "compare/external/scene_gltf.h"

#include "shared/scene/load.h"
#include "shared/scene/model/material_slots.h"
#include "shared/scene/motion/pose.h"
#include "shared/scene/motion/posed.h"
#include "tests/support/files.h"
#include "tests/support/plain_builtin.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include <fstream>

namespace diptych::external {
namespace {

Scene readBack(const std::string& glb) {
    const std::filesystem::path file = testFolder() / "written.glb";
    std::ofstream(file, std::ios::binary) << glb;
    return loadScene(file.string());
}

SceneView viewAt(const Scene& scene, double time) {
    ViewRequest request;
    request.time = time;
    request.width = 64;
    request.height = 36;
    return makeSceneView(scene, request);
}

Material& firstMaterial(Scene& scene) {
    return scene.materials.at(static_cast<std::size_t>(scene.meshes.at(0).primitives.at(0).material));
}
// The first material in the scene's copy.
Material firstCopied(Scene scene) {
    const Scene back = readBack(sceneGltf(scene, viewAt(scene, 0), SkinNormals::joints).glb);
    const auto same = std::ranges::find(back.materials, firstMaterial(scene).name, &Material::name);
    EXPECT_NE(same, back.materials.end());
    return same == back.materials.end() ? Material() : *same;
}

// Centroids of an instance's triangles, world space.
std::vector<glm::dvec3> middlesOf(const Scene& scene, const Pose& pose, const Instance& instance) {
    const std::vector<glm::dvec3> positions = posedPositions(scene, pose, instance);
    const std::vector<std::uint32_t>& indices = primitiveOf(scene, instance).indices;
    std::vector<glm::dvec3> middles;
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3)
        middles.push_back((positions[indices[i]] + positions[indices[i + 1]] + positions[indices[i + 2]]) /
                          3.0);
    return middles;
}

// Lights that glTF supports, in pose order.
std::vector<Light> punctual(std::vector<Light> lights) {
    std::erase_if(lights, [](const Light& light) { return isArea(light.kind); });
    return lights;
}

// Lights and camera, of a rig alone and of a whole scene.
TEST(SceneGltf, ARigIsReadBackAsItIs) {
    for (const auto& [name, whole] : {std::pair{"builtin:suns", false},
                                      {"builtin:suns", true},
                                      {"builtin:points", false},
                                      {"builtin:points", true},
                                      {"builtin:spots", false},
                                      {"builtin:spots", true},
                                      {"builtin:calibration", false}}) {
        const Scene scene = loadScene(name);
        const SceneView view = viewAt(scene, 0);
        const WrittenScene rig = whole ? sceneGltf(scene, view, SkinNormals::joints) : rigGltf(view);
        const Scene back = readBack(rig.glb);
        const Pose pose = poseAt(back, 0);
        const std::vector<Light> passed = punctual(view.lights);
        ASSERT_EQ(pose.lights.size(), passed.size()) << name;
        for (std::size_t i = 0; i < passed.size(); ++i) {
            const Light &a = passed[i], &b = pose.lights[i];
            EXPECT_EQ(a.kind, b.kind);
            EXPECT_EQ(a.intensity, b.intensity);
            EXPECT_EQ(a.color, b.color);
            if (a.kind != LightKind::directional) {
                EXPECT_EQ(a.range, b.range);
                EXPECT_LT(glm::distance(a.position, b.position), 1e-6);
            }
            if (a.kind != LightKind::point) {
                EXPECT_LT(glm::distance(a.direction, b.direction), 1e-6);
            }
            if (a.kind == LightKind::spot) {
                EXPECT_EQ(a.outer_cone, b.outer_cone);
            }
        }
        EXPECT_EQ(rig.notes.empty(), passed.size() == view.lights.size()) << "area lights are counted";
        ASSERT_EQ(back.cameras.size(), 1u);
        EXPECT_NEAR(back.cameras[0].yfov, view.view.camera.yfov, 1e-9);
        const View seen = viewAt(back, 0).view;
        EXPECT_LT(glm::distance(seen.right(), view.view.right()), 1e-6);
        EXPECT_LT(glm::distance(seen.up(), view.view.up()), 1e-6);
        EXPECT_LT(glm::distance(seen.eye(), view.view.eye()), 1e-6);
    }
}

TEST(SceneGltf, ACopyHasThePosedSceneAtItsTime) {
    for (const std::string name : {"motion", "mirrored", "gallery", "tangents", "layers"}) {
        const Scene& scene = plainBuiltin(name);
        const SceneView view = viewAt(scene, 0.7);
        const Scene back = readBack(sceneGltf(scene, view, SkinNormals::joints).glb);
        const Pose pose = poseAt(back, 0);
        EXPECT_TRUE(back.animations.empty());
        std::size_t drawn = 0;
        for (const Instance& instance : view.pose.instances)
            drawn += !primitiveOf(scene, instance).indices.empty();
        ASSERT_EQ(pose.instances.size(), drawn) << name;
        for (std::size_t i = 0, k = 0; i < view.pose.instances.size(); ++i) {
            const Instance& passed = view.pose.instances[i];
            if (primitiveOf(scene, passed).indices.empty()) continue;
            const Instance& written = pose.instances[k++];
            // The loader drops vertices that no triangle uses and flips the triangles of a mirrored
            // skeleton.
            const std::vector<glm::dvec3> a = middlesOf(scene, view.pose, passed),
                                          b = middlesOf(back, pose, written);
            ASSERT_EQ(a.size(), b.size()) << name;
            double far = 0;
            for (std::size_t t = 0; t < a.size(); ++t) far = std::max(far, glm::distance(a[t], b[t]));
            EXPECT_LT(far, 1e-5) << name << " " << i;
            const Material& one =
                materialsOf(scene, view.pose)[static_cast<std::size_t>(primitiveOf(scene, passed).material)];
            const Material& other =
                back.materials[static_cast<std::size_t>(primitiveOf(back, written).material)];
            EXPECT_EQ(one.name, other.name);
            EXPECT_EQ(one.roughness, other.roughness);
            EXPECT_EQ(one.clearcoat, other.clearcoat) << one.name;
            EXPECT_EQ(one.anisotropy, other.anisotropy) << one.name;
            EXPECT_EQ(one.sheen_color, other.sheen_color) << one.name;
            EXPECT_EQ(one.iridescence, other.iridescence) << one.name;
            for (std::size_t s = 0; s < materialSlots.size(); ++s) {
                if (s == gpu::SLOT_lightmap) continue;
                EXPECT_EQ(readsSlot(one, s), readsSlot(other, s)) << one.name << ", slot " << s;
            }
            if (one.clearcoat > 0) {
                EXPECT_EQ(one.clearcoat_roughness, other.clearcoat_roughness) << one.name;
            }
            if (readsSlot(one, gpu::SLOT_clearcoat_normal)) {
                EXPECT_EQ(one.clearcoat_normal_scale, other.clearcoat_normal_scale) << one.name;
            }
            if (one.anisotropy > 0) {
                EXPECT_EQ(one.anisotropy_rotation, other.anisotropy_rotation) << one.name;
            }
            if (one.sheen_color != glm::vec3(0)) {
                EXPECT_EQ(one.sheen_roughness, other.sheen_roughness) << one.name;
            }
            if (one.iridescence > 0) {
                EXPECT_EQ(one.iridescence_ior, other.iridescence_ior) << one.name;
                EXPECT_EQ(one.iridescence_thickness_min, other.iridescence_thickness_min) << one.name;
                EXPECT_EQ(one.iridescence_thickness_max, other.iridescence_thickness_max) << one.name;
            }
            EXPECT_NEAR(one.normal_texture.u.x, other.normal_texture.u.x, 1e-6) << name;
            EXPECT_NEAR(one.normal_texture.v.x, other.normal_texture.v.x, 1e-6) << name;
        }
    }
}

// Their slots stay apart: colour and roughness of a sheen, weight and thickness of a film.
TEST(SceneGltf, TexturesOfSheensAndFilmsKeepTheirPlaces) {
    Scene scene = plainBuiltin("gallery");
    Material& m = firstMaterial(scene);
    m.sheen_color = {0.5f, 0.5f, 0.5f};
    m.iridescence = 0.5f;
    m.sheen_color_texture = {0, 0, {2, 0, 0}, {0, 1, 0}};
    m.sheen_roughness_texture = {0, 0, {3, 0, 0}, {0, 1, 0}};
    m.iridescence_texture = {0, 0, {4, 0, 0}, {0, 1, 0}};
    m.iridescence_thickness_texture = {0, 0, {5, 0, 0}, {0, 1, 0}};
    const Material same = firstCopied(scene);
    EXPECT_NEAR(same.sheen_color_texture.u.x, 2, 1e-6);
    EXPECT_NEAR(same.sheen_roughness_texture.u.x, 3, 1e-6);
    EXPECT_NEAR(same.iridescence_texture.u.x, 4, 1e-6);
    EXPECT_NEAR(same.iridescence_thickness_texture.u.x, 5, 1e-6);
}

// Every factor and texture of light that passes; a distance of 0, infinity, is not written.
TEST(SceneGltf, TransmissionIsReadBackAsItIs) {
    Scene scene = plainBuiltin("gallery");
    Material& m = firstMaterial(scene);
    m.transmission = 0.25f;
    m.ior = 1.75f;
    m.thickness = 2;
    m.attenuation_color = {0.5f, 0.25f, 0.125f};
    m.dispersion = 0.75f;
    m.diffuse_transmission = 0.375f;
    m.diffuse_transmission_color = {0.75f, 0.5f, 0.25f};
    m.transmission_texture = {0, 0, {2, 0, 0}, {0, 1, 0}};
    m.thickness_texture = {0, 1, {3, 0, 0}, {0, 1, 0}};
    m.diffuse_transmission_texture = {0, 0, {4, 0, 0}, {0, 1, 0}};
    m.diffuse_transmission_color_texture = {0, 0, {5, 0, 0}, {0, 1, 0}};
    for (const float distance : {0.0f, 3.0f}) {
        m.attenuation_distance = distance;
        const Material same = firstCopied(scene);
        for (float Material::*factor :
             {&Material::transmission, &Material::ior, &Material::thickness, &Material::attenuation_distance,
              &Material::dispersion, &Material::diffuse_transmission})
            EXPECT_EQ(same.*factor, m.*factor);
        EXPECT_EQ(same.attenuation_color, m.attenuation_color);
        EXPECT_EQ(same.diffuse_transmission_color, m.diffuse_transmission_color);
        EXPECT_NEAR(same.transmission_texture.u.x, 2, 1e-6);
        EXPECT_NEAR(same.thickness_texture.u.x, 3, 1e-6);
        EXPECT_EQ(same.thickness_texture.texcoord, 1);
        EXPECT_NEAR(same.diffuse_transmission_texture.u.x, 4, 1e-6);
        EXPECT_NEAR(same.diffuse_transmission_color_texture.u.x, 5, 1e-6);
    }
}

// Thickness is in units of the mesh, which nodes scale; the copy of a posed mesh is in world space.
TEST(SceneGltf, VolumesOfPosedMeshesKeepTheirThickness) {
    Scene scene = loadScene("builtin:motion");
    for (Material& m : scene.materials) m.transmission = m.thickness = 0.5f;
    SceneView view = viewAt(scene, 0.7);
    std::vector<Instance> passed;
    for (Instance& instance : view.pose.instances) {
        if (primitiveOf(scene, instance).indices.empty()) continue;
        if (instance.skin < 0) instance.world_from_object *= glm::dmat4(glm::dmat3(3.0));
        passed.push_back(instance);
    }
    const Scene back = readBack(sceneGltf(scene, view, SkinNormals::joints).glb);
    const Pose pose = poseAt(back, 0);
    ASSERT_EQ(pose.instances.size(), passed.size());
    int scaled = 0;
    for (std::size_t i = 0; i < passed.size(); ++i) {
        EXPECT_NEAR(lengthScale(pose.instances[i]), lengthScale(passed[i]), 1e-9) << i;
        scaled += passed[i].deformed() && passed[i].skin < 0;
        const std::vector<glm::dvec3> a = middlesOf(scene, view.pose, passed[i]),
                                      b = middlesOf(back, pose, pose.instances[i]);
        ASSERT_EQ(a.size(), b.size());
        for (std::size_t t = 0; t < a.size(); ++t) EXPECT_LT(glm::distance(a[t], b[t]), 1e-5) << i;
    }
    EXPECT_GT(scaled, 0);
}

// In its own extension: no other states F0, glossiness and diffuse in the same textures.
TEST(SceneGltf, SpecularGlossinessIsReadBackAsItIs) {
    const Scene& plain = plainBuiltin("gallery");
    Scene scene = plain;
    Material& m = firstMaterial(scene);
    const std::string name = m.name;
    m = {};
    m.name = name;
    m.specular_glossiness = true;
    m.base_color = {0.8f, 0.4f, 0.2f, 1};
    m.specular_color = {0.1f, 0.3f, 0.7f};
    m.metallic = m.ior = 0;
    m.roughness = 0.3f;
    m.base_color_texture.texture = 0;
    m.specular_color_texture = {1, 0, {2, 0, 0}, {0, 3, 0.5}};
    const WrittenScene written = sceneGltf(scene, viewAt(scene, 0), SkinNormals::joints);
    EXPECT_NE(written.glb.find("\"extensionsRequired\":[\"KHR_materials_pbrSpecularGlossiness\"]"),
              std::string::npos);
    const Material same = firstCopied(scene);
    EXPECT_TRUE(same.specular_glossiness);
    EXPECT_EQ(same.base_color, m.base_color);
    EXPECT_EQ(same.specular_color, m.specular_color);
    EXPECT_EQ(same.roughness, m.roughness);
    EXPECT_EQ(same.metallic, 0);
    EXPECT_EQ(same.ior, 0);
    EXPECT_GE(same.base_color_texture.texture, 0);
    EXPECT_GE(same.specular_color_texture.texture, 0);
    EXPECT_NE(same.specular_color_texture.texture, same.base_color_texture.texture);
    EXPECT_NEAR(same.specular_color_texture.u.x, 2, 1e-6);
    EXPECT_NEAR(same.specular_color_texture.v.z, 0.5, 1e-6);
    EXPECT_EQ(sceneGltf(plain, viewAt(plain, 0), SkinNormals::joints).glb.find("extensionsRequired"),
              std::string::npos);
}

}  // namespace
}  // namespace diptych::external
