// SPDX-License-Identifier: MIT
#include "shared/scene/builtin/shapes.h"
#include "shared/scene/model/material_slots.h"
#include "shared/scene/motion/pose.h"
#include "shared/scene/view.h"
#include "tests/support/errors.h"
#include "tests/unit/shared/scene/builtin/builtin_scenes.h"

#include <gtest/gtest.h>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace diptych {
namespace {

std::string builtinFault(const std::string& name) {
    return faultOf([&] { makeBuiltin(name); });
}

std::size_t triangles(const Scene& scene) {
    std::size_t count = 0;
    for (const Node& node : scene.nodes)
        if (node.mesh >= 0)
            for (const Primitive& primitive : scene.meshes[static_cast<std::size_t>(node.mesh)].primitives)
                count += primitive.indices.size() / 3;
    return count;
}

// Checks scene.h's guarantees for primitives, and that normals, winding, texture coordinates and tangents
// (for the normal map) are consistent.
void expectWhole(const Primitive& p, const TextureSlot& map, const std::string& what) {
    ASSERT_EQ(p.normals.size(), p.positions.size()) << what;
    ASSERT_EQ(p.tangents.size(), p.positions.size()) << what;
    ASSERT_TRUE(p.colors.empty() || p.colors.size() == p.positions.size()) << what;
    ASSERT_EQ(p.indices.size() % 3, 0u) << what;
    for (std::size_t v = 0; v < p.positions.size(); ++v) {
        const glm::dvec3 n(p.normals[v]), t(p.tangents[v]);
        ASSERT_NEAR(glm::length(n), 1, 1e-6) << what;  // float32: three roundings of 6e-8
        ASSERT_NEAR(glm::length(t), 1, 1e-6) << what;
        ASSERT_NEAR(glm::dot(n, t), 0, 1e-6) << what;
        ASSERT_EQ(std::abs(p.tangents[v].w), 1) << what;
    }
    for (std::size_t k = 0; k < p.indices.size(); k += 3) {
        const std::uint32_t* i = &p.indices[k];
        for (int c = 0; c < 3; ++c) ASSERT_LT(i[c], p.positions.size()) << what;
        const auto at = [&](int c) { return glm::dvec3(p.positions[i[c]]); };
        const glm::dvec3 edge1 = at(1) - at(0), edge2 = at(2) - at(0), normal = glm::cross(edge1, edge2);
        ASSERT_GT(glm::length(normal), 0) << what << ": triangle " << k / 3 << " has no area";
        const std::vector<glm::vec2>& set = p.texcoords[map.texcoord];
        if (set.empty()) continue;
        const auto uv = [&](int c) {
            const glm::dvec3 read(set[i[c]], 1);
            return glm::dvec2(glm::dot(map.u, read), glm::dot(map.v, read));
        };
        const glm::dvec2 d1 = uv(1) - uv(0), d2 = uv(2) - uv(0);
        const double area = d1.x * d2.y - d2.x * d1.y;
        ASSERT_NE(area, 0) << what << ": triangle " << k / 3 << " has no texture area";
        const glm::dvec3 alongU = (edge1 * d2.y - edge2 * d1.y) / area,
                         alongV = (edge2 * d1.x - edge1 * d2.x) / area;
        for (int c = 0; c < 3; ++c) {
            const glm::dvec3 n(p.normals[i[c]]), t(p.tangents[i[c]]);
            ASSERT_GT(glm::dot(normal, n), 0)
                << what << ": triangle " << k / 3 << " faces against its normals";
            ASSERT_GT(glm::dot(t, alongU), 0) << what << ": triangle " << k / 3;
            ASSERT_LT(static_cast<double>(p.tangents[i[c]].w) * glm::dot(glm::cross(n, t), alongV), 0)
                << what << ": triangle " << k / 3;
        }
    }
}

void expectSlot(const Scene& scene, const TextureSlot& slot, const std::string& what) {
    ASSERT_LT(slot.texture, static_cast<int>(scene.textures.size())) << what;
    if (slot.texture < 0) return;
    const int image = scene.textures[static_cast<std::size_t>(slot.texture)].image;
    ASSERT_GE(image, 0) << what;
    ASSERT_LT(image, static_cast<int>(scene.images.size())) << what;
}

TEST(Builtin, EveryPartOfEverySceneIsWhole) {
    for (const BuiltinName& builtin : builtinNames()) {
        const Scene& scene = builtinScene(builtin.name);
        const std::string& what = builtin.name;
        EXPECT_EQ(scene.name, "builtin:" + what);
        EXPECT_FALSE(builtin.shows.empty());
        for (const Mesh& mesh : scene.meshes)
            for (const Primitive& primitive : mesh.primitives) {
                ASSERT_GE(primitive.material, 0) << what;
                ASSERT_LT(primitive.material, static_cast<int>(scene.materials.size())) << what;
                const Material& m = scene.materials[static_cast<std::size_t>(primitive.material)];
                expectWhole(primitive, tangentMap(m), what + ": " + mesh.name);
            }
        for (const Node& node : scene.nodes) {
            ASSERT_LT(node.mesh, static_cast<int>(scene.meshes.size())) << what;
            ASSERT_LT(node.parent, static_cast<int>(scene.nodes.size())) << what;
            ASSERT_NE(glm::determinant(glm::dmat3(node.parent_from_node)), 0) << what << ": " << node.name;
        }
        for (const Material& m : scene.materials)
            for (const MaterialSlot& slot : materialSlots)
                expectSlot(scene, m.*slot.texture, what + ": " + m.name);
        for (const TextureImage& image : scene.images)
            ASSERT_EQ(image.components(), static_cast<std::size_t>(image.width * image.height * 4))
                << what << ": " << image.name;
        for (const Light& light : scene.lights) {
            if (light.kind != LightKind::point) {
                ASSERT_NEAR(glm::length(light.direction), 1, 1e-12) << what;
            }
            ASSERT_GT(light.range, 0) << what;
            ASSERT_LT(light.inner_cone, light.outer_cone) << what;
            ASSERT_LE(light.outer_cone, std::numbers::pi_v<float> / 2) << what;
        }
        EXPECT_EQ(scene.cameras.empty(), what == "empty") << what;
        for (const Camera& camera : scene.cameras) {
            const glm::dmat3 axes(camera.world_from_camera);
            EXPECT_NEAR(glm::determinant(axes), 1, 1e-12) << what;
            EXPECT_LT(camera.near, camera.far) << what;
        }
    }
}

TEST(Builtin, NamesAreUniqueAndMistakesListWhatThereIs) {
    std::set<std::string> names;
    for (const BuiltinName& builtin : builtinNames())
        EXPECT_TRUE(names.insert(builtin.name).second) << builtin.name;
    ASSERT_FALSE(names.empty());
    EXPECT_EQ(builtinNames().front().name, "gallery");
    for (const std::string& name : names)
        EXPECT_NE(builtinFault("nonesuch").find(name), std::string::npos) << name;
    for (const char* wrong :
         {"", "Gallery", "gallery?lights=3", "spheres?", "spheres?lights",
          "spheres?lights=", "spheres?lights=-1", "spheres?lights=4x", "spheres?lights=4294967296",
          "spheres?lights=2147483648", "spheres?light=4", "spheres?lights=1&lights=2"}) {
        const std::string error = builtinFault(wrong);
        EXPECT_EQ(error.find("builtin:"), 0u) << wrong << ": " << error;
        EXPECT_EQ(error.find('\n'), std::string::npos);
    }
    EXPECT_NE(builtinFault("spheres?light=4").find("lights=N"), std::string::npos);
    EXPECT_NE(builtinFault("array?object=4").find("objects=N, triangles=N"), std::string::npos);
    EXPECT_NE(builtinFault("array?objects=1&materials=x").find("'x' is not a number of materials"),
              std::string::npos);
}

TEST(Builtin, AnArrayHasAsManyAsItIsTold) {
    const auto trianglesOf = [](const Scene& scene) {
        std::size_t triangles = 0;
        for (const Node& node : scene.nodes)
            triangles += scene.meshes[static_cast<std::size_t>(node.mesh)].primitives[0].indices.size() / 3;
        return triangles;
    };
    const Scene many = makeBuiltin("array?objects=30&triangles=30000&meshes=7&materials=3");
    EXPECT_EQ(many.nodes.size(), 30u);
    EXPECT_EQ(many.meshes.size(), 7u);
    EXPECT_EQ(many.materials.size(), 3u);
    EXPECT_TRUE(many.images.empty());
    // A sphere of k rings has 4 k (k - 1) triangles; 16 rings are closest to 1000.
    EXPECT_EQ(trianglesOf(many), 30u * 960);
    const Scene squares = makeBuiltin("array?objects=5&triangles=10&materials=50");
    EXPECT_EQ(trianglesOf(squares), 10u);
    EXPECT_EQ(squares.meshes.size(), 5u) << "no more than objects";
    const Scene textured = makeBuiltin("array?objects=2&texture_mib=8");
    ASSERT_EQ(textured.images.size(), 2u);
    EXPECT_EQ(textured.images[0].rgba.size() + textured.images[1].rgba.size(), 8u << 20);
    EXPECT_NE(textured.images[0].rgba, textured.images[1].rgba);
    for (const Material& material : textured.materials) EXPECT_GE(material.base_color_texture.texture, -1);
    EXPECT_EQ(makeBuiltin("array?objects=0").nodes.size(), 1u);
}

// Check values of the scene's definition, to six decimals: half a step is 5e-7.
TEST(Builtin, SpheresHasItsPublishedNumbers) {
    const Scene scene = makeBuiltin("spheres?lights=64");
    const auto near = [](const glm::dvec3& a, const glm::dvec3& b) {
        for (int c : {0, 1, 2}) EXPECT_NEAR(a[c], b[c], 6e-7);
    };
    ASSERT_EQ(scene.materials.size(), 401u);  // the ground first
    near(scene.materials[1].base_color, {.221140, .661414, .534948});
    near(scene.materials[400].base_color, {.305775, .311372, .507452});
    EXPECT_EQ(scene.materials[400].metallic, 1);
    EXPECT_EQ(scene.materials[400].roughness, 1);
    EXPECT_EQ(scene.materials[1].roughness, 0.1f);
    ASSERT_EQ(scene.nodes.size(), 401u);
    near(scene.nodes[1].parent_from_node[3], {-19, 0.5, -19});
    near(scene.nodes[400].parent_from_node[3], {19, 0.5, 19});

    const Primitive& ground = scene.meshes[0].primitives[0];
    EXPECT_EQ(ground.indices.size(), 6u);
    for (const glm::vec3& n : ground.normals) EXPECT_EQ(n, glm::vec3(0, 1, 0));
    const Primitive& ball = scene.meshes[1].primitives[0];
    EXPECT_EQ(ball.positions.size(), 561u);
    EXPECT_EQ(ball.indices.size(), 3u * 960u);
    // The first triangle is (b, c, d) of cell (0, 0), followed by the next cell's; (a, b, d) exists from
    // row 1 on.
    EXPECT_EQ((std::vector<std::uint32_t>(ball.indices.begin(), ball.indices.begin() + 6)),
              (std::vector<std::uint32_t>{0, 33, 34, 1, 34, 35}));
    EXPECT_EQ((std::vector<std::uint32_t>(ball.indices.begin() + 96, ball.indices.begin() + 102)),
              (std::vector<std::uint32_t>{34, 33, 67, 33, 66, 67}));

    ASSERT_EQ(scene.lights.size(), 65u);  // the sun first
    near(scene.lights[0].direction, glm::normalize(glm::dvec3(-.5, -1, -.3)));
    near(scene.lights[2].position, {-2.257722, 1.420735, 2.068258});
    near(scene.lights[64].position, {18.339517, 1.083678, 7.780559});
    EXPECT_EQ(scene.lights[64].intensity, 4);
    EXPECT_EQ(scene.lights[64].range, 3);
    EXPECT_EQ(makeBuiltin("spheres").lights.size(), 257u);
    EXPECT_EQ(makeBuiltin("spheres?lights=0").lights.size(), 1u);
    const Camera& camera = scene.cameras.at(0);
    near(camera.world_from_camera[3], {0, 6, 14});
    near(camera.world_from_camera[2], glm::normalize(glm::dvec3(0, 6, 14)));
}

TEST(Builtin, TheGalleryHoldsWhatANewcomerShouldSee) {
    const Scene& scene = builtinScene("gallery");
    EXPECT_LT(triangles(scene), 150000u);
    EXPECT_GT(triangles(scene), 60000u);
    bool mask = false, emissive = false, dielectric = false, colors = false, normals = false,
         occlusion = false;
    for (const Material& m : scene.materials) {
        mask |= m.alpha_mode == AlphaMode::mask;
        EXPECT_TRUE(m.double_sided || m.alpha_mode != AlphaMode::mask)
            << m.name << ": seen through its holes";
        emissive |= m.emissive_texture.texture >= 0;
        dielectric |= m.ior != 1.5f && m.specular_color != glm::vec3(1);
        normals |= m.normal_texture.texture >= 0;
        occlusion |= m.occlusion_texture.texture >= 0;
    }
    for (const Mesh& mesh : scene.meshes) colors |= !mesh.primitives[0].colors.empty();
    EXPECT_TRUE(mask && emissive && dielectric && colors && normals && occlusion);
    for (const TextureImage& image : scene.images) EXPECT_LE(image.width, 512) << image.name;
    for (const Light& light : scene.lights)
        if (light.kind != LightKind::directional) {
            EXPECT_TRUE(std::isfinite(light.range)) << light.name;
        }
}

// Each layer beside none, all at once, and every one of their textures.
TEST(Builtin, LayersHoldEveryLayerAndTexture) {
    const Scene& scene = builtinScene("layers");
    EXPECT_LT(triangles(scene), 60000u);
    std::set<std::uint32_t> layers;
    std::set<std::size_t> slots;
    for (const Material& m : scene.materials) {
        layers.insert(layersOf(m));
        for (std::size_t s = 0; s < materialSlots.size(); ++s)
            if (readsSlot(m, s)) slots.insert(s);
    }
    constexpr std::uint32_t all =
        gpu::LAYER_CLEARCOAT | gpu::LAYER_ANISOTROPY | gpu::LAYER_SHEEN | gpu::LAYER_IRIDESCENCE;
    for (const std::uint32_t some :
         {0u, gpu::LAYER_CLEARCOAT, gpu::LAYER_ANISOTROPY, gpu::LAYER_SHEEN, gpu::LAYER_IRIDESCENCE,
          gpu::LAYER_CLEARCOAT | gpu::LAYER_ANISOTROPY, gpu::LAYER_SHEEN | gpu::LAYER_IRIDESCENCE, all})
        EXPECT_TRUE(layers.contains(some)) << some;
    for (const gpu::uint slot :
         {gpu::SLOT_normal, gpu::SLOT_clearcoat, gpu::SLOT_clearcoat_roughness, gpu::SLOT_clearcoat_normal,
          gpu::SLOT_anisotropy, gpu::SLOT_sheen_color, gpu::SLOT_sheen_roughness, gpu::SLOT_iridescence,
          gpu::SLOT_iridescence_thickness})
        EXPECT_TRUE(slots.contains(slot)) << slot;
}

// Whatever the image's shape, no ball is cut off.
TEST(Builtin, LayersAreWhollyInTheImage) {
    const Scene& scene = builtinScene("layers");
    const Pose pose = poseAt(scene, 0);
    for (const auto& [width, height] : {std::pair{1600, 900}, {900, 900}, {2100, 900}, {450, 900}}) {
        const View view = makeView(scene, pose, "", width, height);
        const glm::dmat4 clip = view.clipFromWorld();
        for (const Instance& instance : pose.instances)
            for (const glm::vec3& p : primitiveOf(scene, instance).positions) {
                const glm::dvec3 world(instance.world_from_object * glm::dvec4(p, 1));
                const glm::dvec4 at = clip * glm::dvec4(world - view.eye(), 1);
                EXPECT_LT(std::max(std::abs(at.x), std::abs(at.y)), 0.99 * at.w) << width << " " << height;
            }
    }
}

// Under constant radiance 1, a white Lambertian plane has irradiance pi in any orientation. 64 suns sample
// the cosine at 64 points; the error falls as N^-3/4 and is below 3 % here.
TEST(Builtin, TheFurnaceIsEvenlyLit) {
    const Scene& scene = builtinScene("furnace");
    const Primitive directions = sphere(1, 24, 12);
    for (const glm::vec3& n : directions.normals) {
        double irradiance = 0;
        for (const Light& light : scene.lights)
            irradiance += static_cast<double>(light.intensity) *
                          std::max(0.0, -glm::dot(light.direction, glm::dvec3(n)));
        EXPECT_NEAR(irradiance / std::numbers::pi, 1, 0.03);
    }
}

TEST(Builtin, NamedTestScenesAreWhatTheirNameSays) {
    EXPECT_EQ(triangles(makeBuiltin("empty")), 0u);
    EXPECT_EQ(triangles(makeBuiltin("triangle")), 1u);
    EXPECT_TRUE(makeBuiltin("unlit").lights.empty());
    EXPECT_EQ(makeBuiltin("many_materials").materials.size(), 5000u);
    EXPECT_TRUE(makeBuiltin("ortho").cameras.at(0).orthographic);
    EXPECT_EQ(makeBuiltin("deep").cameras.at(0).far, 1e5);
    const auto all = [](const char* name, LightKind kind) {
        const Scene scene = makeBuiltin(name);
        EXPECT_FALSE(scene.lights.empty()) << name;
        for (const Light& light : scene.lights) EXPECT_EQ(light.kind, kind) << name;
    };
    all("suns", LightKind::directional);
    all("points", LightKind::point);
    all("spots", LightKind::spot);
    std::set<LightKind> shapes;
    for (const Light& light : makeBuiltin("areas").lights) shapes.insert(light.kind);
    EXPECT_EQ(shapes, (std::set{LightKind::rect, LightKind::disc, LightKind::tube}));
    float brightest = 0, dimmest = 1;
    for (const Material& m : makeBuiltin("emission").materials) {
        brightest = std::max(brightest, m.emissive.r);
        dimmest = std::min(dimmest, m.emissive.r);
    }
    EXPECT_FLOAT_EQ(brightest, 1e6f);
    EXPECT_FLOAT_EQ(dimmest, 1e-6f);
    int mirrors = 0;
    for (const Node& node : makeBuiltin("mirrored").nodes)
        mirrors += glm::determinant(glm::dmat3(node.parent_from_node)) < 0;
    EXPECT_GE(mirrors, 4);
}

TEST(Shapes, AreWholeAndAsLargeAsTheySay) {
    const auto extent = [](const Primitive& p) {
        glm::vec3 low(1e9f), high(-1e9f);
        for (const glm::vec3& v : p.positions) low = glm::min(low, v), high = glm::max(high, v);
        return high - low;
    };
    const auto near = [](const glm::vec3& a, const glm::vec3& b) {
        for (int c : {0, 1, 2}) EXPECT_NEAR(a[c], b[c], 1e-6f);  // float32 positions of about 1 m
    };
    near(extent(box({1, 2, 3}, 0.1)), {1, 2, 3});
    near(extent(box({1, 2, 3})), {1, 2, 3});
    near(extent(sphere(0.5)), {1, 1, 1});
    near(extent(torus(1, 0.25)), {2.5f, 0.5f, 2.5f});
    near(extent(gem(2)), {2, 1.3f, 2});
    near(extent(archway(3, 2.5, 0.5, 2, 1)), {3, 2.5f, 0.5f});
    for (const auto& shape : {box({1, 2, 3}, 0.1), box({1, 1, 1}), sphere(1, 7, 5), torus(1, 0.2),
                              torusKnot(2, 3, 1, 0.4, 0.2), lathe({{0, 0}, {1, 0}, {0.8, 1}, {0, 1.2}}),
                              gem(1), archway(3, 3, 1, 2, 1.5), quad({0, 0, 0}, {1, 0, 1}, {0, 2, 0}, 3, 2)})
        expectWhole(shape, {}, "shape");
}

TEST(Shapes, AppendedMirrorImagesStayWhole) {
    Primitive whole;
    append(whole, sphere(1, 8, 6), glm::scale(glm::dmat4(1.0), glm::dvec3(-1, 2, 0.5)));
    expectWhole(whole, {}, "mirrored sphere");
    EXPECT_EQ(whole.tangents[0].w, -1);
}

}  // namespace
}  // namespace diptych
