// SPDX-License-Identifier: MIT
// The key of a reference image: a checkpoint of one image is never used for another.
#include "compare/reference/image_key.h"

#include "tests/support/reference_scene.h"

#include <set>
#include <string>
#include <utility>

namespace diptych::reference {
namespace {

// Everything that a Request points to, with all parts present.
struct Asked {
    Scene scene = floorScene();
    Pose pose;
    View view = viewFrom({0, 0, 3}, {0, 0, 0}, 8, 4);
    std::vector<Light> lights{lightOf(LightKind::point, {0, 0, 2})};
    double environment_factor = 1;
    glm::dvec3 ambient{0};
    Multiscatter multiscatter = Multiscatter::off;
    BaseLayer base_layer = BaseLayer::max;
    SkinNormals skin_normals = SkinNormals::joints;
    Falloff falloff;
    Air air;
    std::vector<std::size_t> casters;
    bool shadowed_environment = false, environment_costs = false, surroundings = false;
    ReferenceMode mode = ReferenceMode::scene;
    int samples = 4;
    Resolve resolve = Resolve::linear;
    std::map<Channel, Image> surfaces{{Channel::lit, Image(2, 1, 1)}};
    std::string program = "1.0";

    Asked() {
        Primitive& p = scene.meshes[0].primitives[0];
        p.colors.assign(4, glm::vec4(1));
        p.texcoords[1] = p.texcoords[0];
        p.joint_sets.resize(1);
        p.joint_sets[0].joints.resize(4);
        p.joint_sets[0].weights.resize(4);
        p.targets.resize(1);
        p.targets[0].positions.resize(4);
        p.targets[0].normals.resize(4);
        p.targets[0].tangents.resize(4);
        scene.images = {{"8 bits", 1, 1, {1, 2, 3, 4}},
                        {"16 bits", 1, 1, {}, {1, 2, 3, 4}},
                        {"floats", 1, 1, {}, {}, {1, 2, 3, 4}}};
        scene.textures = {{0, {}}};
        scene.environment = Environment{"sky", Image(2, 1, 3, 1.0f)};
        pose.instances = {Instance{}};
        pose.skins = {{glm::dmat4(1)}};
        pose.weights = {{0.5}};
    }

    std::uint64_t key() const {
        return keyOf({.scene = scene,
                      .pose = pose,
                      .view = view,
                      .lights = lights,
                      .environment_factor = environment_factor,
                      .ambient = ambient,
                      .multiscatter = multiscatter,
                      .base_layer = base_layer,
                      .skin_normals = skin_normals,
                      .falloff = falloff,
                      .air = air,
                      .casters = casters,
                      .shadowed_environment = shadowed_environment,
                      .environment_costs = environment_costs,
                      .surroundings = surroundings,
                      .mode = mode,
                      .samples = samples,
                      .resolve = resolve,
                      .surfaces = &surfaces,
                      .program = program});
    }
    Material& material() { return scene.materials[0]; }
    Primitive& primitive() { return scene.meshes[0].primitives[0]; }
    Light& light() { return lights[0]; }
};

void alter(float& factor) {
    factor += 0.125f;
}
template <int N>
void alter(glm::vec<N, float>& factor) {
    factor[N - 1] += 0.125f;
}

using Change = std::pair<const char*, void (*)(Asked&)>;

void expectKeysOfTheirOwn(std::span<const Change> changes) {
    std::set<std::uint64_t> keys{Asked().key()};
    for (const auto& [name, change] : changes) {
        Asked changed;
        change(changed);
        EXPECT_TRUE(keys.insert(changed.key()).second) << name;
    }
}

TEST(ReferenceKey, TheSameRequestHasTheSameKey) {
    EXPECT_EQ(Asked().key(), Asked().key());
}

TEST(ReferenceKey, IsOfTheImageAndItsLight) {
    const Change changes[] = {
        {"width", [](Asked& a) { a.view.width = 4; }},
        {"height", [](Asked& a) { a.view.height = 8; }},
        {"samples", [](Asked& a) { a.samples = 8; }},
        {"resolve", [](Asked& a) { a.resolve = Resolve::tonemapped; }},
        {"mode", [](Asked& a) { a.mode = ReferenceMode::surface; }},
        {"casters", [](Asked& a) { a.casters = {0}; }},
        {"shadowed environment", [](Asked& a) { a.shadowed_environment = true; }},
        {"what an environment costs", [](Asked& a) { a.environment_costs = true; }},
        {"what is hidden", [](Asked& a) { a.surroundings = true; }},
        {"program", [](Asked& a) { a.program = "1.1"; }},
        {"camera", [](Asked& a) { a.view.camera.world_from_camera[3].x += 1e-9; }},
        {"yfov", [](Asked& a) { a.view.camera.yfov += 1e-9; }},
        {"ymag", [](Asked& a) { a.view.camera.ymag = 2; }},
        {"near", [](Asked& a) { a.view.camera.near = 0.02; }},
        {"far", [](Asked& a) { a.view.camera.far = 100; }},
        {"orthographic", [](Asked& a) { a.view.camera.orthographic = true; }},
        {"ambient", [](Asked& a) { a.ambient.b = 0.1; }},
        {"multiscatter", [](Asked& a) { a.multiscatter = Multiscatter::fdez; }},
        {"base layer", [](Asked& a) { a.base_layer = BaseLayer::component; }},
        {"normals of skins", [](Asked& a) { a.skin_normals = SkinNormals::blended; }},
        {"range window", [](Asked& a) { a.falloff.window = RangeWindow::squared; }},
        {"spot cone", [](Asked& a) { a.falloff.cone = SpotFalloff::smoothstep; }},
        {"molecules", [](Asked& a) { a.air.molecules.scattering.b = 1e-5; }},
        {"what they take away", [](Asked& a) { a.air.molecules.extinction.r = 1e-5; }},
        {"their height", [](Asked& a) { a.air.molecules.scale = 2; }},
        {"aerosols", [](Asked& a) { a.air.aerosols.scattering.r = 1e-5; }},
        {"what these take away", [](Asked& a) { a.air.aerosols.extinction.g = 1e-5; }},
        {"these's height", [](Asked& a) { a.air.aerosols.scale = 3; }},
        {"g", [](Asked& a) { a.air.g = 0.5; }},
        {"ground", [](Asked& a) { a.air.ground = 1; }},
        {"two heights", [](Asked& a) { a.air.uniform = false; }},
        {"light that air scatters", [](Asked& a) { a.air.ambient.g = 1; }},
        {"sun that air scatters", [](Asked& a) { a.air.sun = &a.lights[0]; }},
        {"factor of the environment", [](Asked& a) { a.environment_factor = 2; }},
        {"environment", [](Asked& a) { a.scene.environment->radiance.data[5] = 2; }},
        {"size of the environment",
         [](Asked& a) {
             std::swap(a.scene.environment->radiance.width, a.scene.environment->radiance.height);
         }},
        {"no environment", [](Asked& a) { a.scene.environment.reset(); }},
        {"a lightmap under the environment",
         [](Asked& a) {
             a.mode = ReferenceMode::surface;
             a.material().lightmap_texture.texture = 0;
         }},
        {"surfaces", [](Asked& a) { a.surfaces.at(Channel::lit).data[1] = 1; }},
        {"one light more", [](Asked& a) { a.lights.push_back(a.lights[0]); }},
        {"colour", [](Asked& a) { a.light().color.g = 0.5f; }},
        {"intensity", [](Asked& a) { a.light().intensity = 2; }},
        {"range", [](Asked& a) { a.light().range = 9; }},
        {"inner cone", [](Asked& a) { a.light().inner_cone = 0.1f; }},
        {"outer cone", [](Asked& a) { a.light().outer_cone = 0.9f; }},
        {"angle", [](Asked& a) { a.light().angle = 0.01f; }},
        {"width of a light", [](Asked& a) { a.light().width = 3; }},
        {"height of a light", [](Asked& a) { a.light().height = 3; }},
        {"radius", [](Asked& a) { a.light().radius = 0.25f; }},
        {"length", [](Asked& a) { a.light().length = 2; }},
        {"kind", [](Asked& a) { a.light().kind = LightKind::spot; }},
        {"two-sided", [](Asked& a) { a.light().two_sided = true; }},
        {"position", [](Asked& a) { a.light().position.y += 1e-9; }},
        {"direction", [](Asked& a) { a.light().direction = glm::dvec3(0, 1, 0); }},
        {"axis", [](Asked& a) { a.light().axis = glm::dvec3(0, 1, 0); }},
    };
    expectKeysOfTheirOwn(changes);
}

TEST(ReferenceKey, IsOfEveryMaterialAndTexture) {
    const Change changes[] = {
        {"emission", [](Asked& a) { alter(a.material().emissive); }},
        {"specular colour", [](Asked& a) { alter(a.material().specular_color); }},
        {"direction of anisotropy", [](Asked& a) { alter(a.material().anisotropy_rotation); }},
        {"alpha mode", [](Asked& a) { a.material().alpha_mode = AlphaMode::mask; }},
        {"double-sided", [](Asked& a) { a.material().double_sided = true; }},
        {"unlit", [](Asked& a) { a.material().unlit = true; }},
        {"specular-glossiness", [](Asked& a) { a.material().specular_glossiness = true; }},
        {"set of coordinates", [](Asked& a) { a.material().normal_texture.texcoord = 1; }},
        {"transform of u", [](Asked& a) { a.material().normal_texture.u.z = 0.5; }},
        {"transform of v", [](Asked& a) { a.material().normal_texture.v.z = 0.5; }},
        {"image", [](Asked& a) { a.scene.textures[0].image = 1; }},
        {"wrap s", [](Asked& a) { a.scene.textures[0].sampler.wrap_s = Wrap::clamp_to_edge; }},
        {"wrap t", [](Asked& a) { a.scene.textures[0].sampler.wrap_t = Wrap::clamp_to_edge; }},
        {"magnified", [](Asked& a) { a.scene.textures[0].sampler.magnify_linear = false; }},
        {"minified", [](Asked& a) { a.scene.textures[0].sampler.minify_linear = false; }},
        {"8 bits", [](Asked& a) { a.scene.images[0].rgba[3] = 9; }},
        {"16 bits", [](Asked& a) { a.scene.images[1].rgba16[3] = 9; }},
        {"floats", [](Asked& a) { a.scene.images[2].rgba32[3] = 9; }},
#define FACTOR(type, name, ...) {#name, [](Asked& a) { alter(a.material().name); }},
        MATERIAL_FACTORS(FACTOR)
#undef FACTOR
#define SLOT(number, name, ...) \
    {#name "'s texture", [](Asked& a) { a.material().name##_texture.texture = 0; }},
            MATERIAL_SLOTS(SLOT)
#undef SLOT
    };
    expectKeysOfTheirOwn(changes);
}

TEST(ReferenceKey, IsOfTheGeometryAndItsPose) {
    const Change changes[] = {
        {"positions", [](Asked& a) { a.primitive().positions[3].z = 0.1f; }},
        {"normals", [](Asked& a) { a.primitive().normals[3] = glm::vec3(0, 1, 0); }},
        {"tangents", [](Asked& a) { a.primitive().tangents[3].w = -1; }},
        {"first coordinates", [](Asked& a) { a.primitive().texcoords[0][3].x = 0.5f; }},
        {"second coordinates", [](Asked& a) { a.primitive().texcoords[1][3].x = 0.5f; }},
        {"colours", [](Asked& a) { a.primitive().colors[3].a = 0.5f; }},
        {"indices", [](Asked& a) { std::swap(a.primitive().indices[4], a.primitive().indices[5]); }},
        {"material", [](Asked& a) { a.primitive().material = 1; }},
        {"flat", [](Asked& a) { a.primitive().flat = true; }},
        {"joints", [](Asked& a) { a.primitive().joint_sets[0].joints[3].x = 1; }},
        {"joints' weights", [](Asked& a) { a.primitive().joint_sets[0].weights[3].x = 1; }},
        {"targets' positions", [](Asked& a) { a.primitive().targets[0].positions[3].x = 1; }},
        {"targets' normals", [](Asked& a) { a.primitive().targets[0].normals[3].x = 1; }},
        {"targets' tangents", [](Asked& a) { a.primitive().targets[0].tangents[3].x = 1; }},
        {"targets' first coordinates",
         [](Asked& a) { a.primitive().targets[0].texcoords[0].emplace_back(1.0f, 0.0f); }},
        {"targets' second coordinates",
         [](Asked& a) { a.primitive().targets[0].texcoords[1].emplace_back(1.0f, 0.0f); }},
        {"targets' colours",
         [](Asked& a) { a.primitive().targets[0].colors.emplace_back(1.0f, 0.0f, 0.0f, 0.0f); }},
        {"tangents made anew", [](Asked& a) { a.primitive().tangent_groups.corners = {1}; }},
        {"place", [](Asked& a) { a.pose.instances[0].world_from_object[3].x = 1e-9; }},
        {"skin", [](Asked& a) { a.pose.instances[0].skin = 0; }},
        {"weights", [](Asked& a) { a.pose.instances[0].weights = 0; }},
        {"skins", [](Asked& a) { a.pose.skins[0][0][3].x = 1e-9; }},
        {"targets' weights", [](Asked& a) { a.pose.weights[0][0] = 0.25; }},
        {"one instance more", [](Asked& a) { a.pose.instances.push_back({}); }},
    };
    expectKeysOfTheirOwn(changes);
}

// Captured surfaces contain everything that mode surface shades, except shadow casters and what is not
// opaque.
TEST(ReferenceKey, OfSurfacesTheSceneCountsWhereRaysHitIt) {
    for (const bool shadows : {false, true})
        for (const bool pane : {false, true}) {
            Asked one, other;
            for (Asked* const asked : {&one, &other}) {
                asked->mode = ReferenceMode::surface;
                if (shadows) asked->casters = {0};
                if (pane) asked->material().transmission = 1;
            }
            other.primitive().positions[3].z = 0.1f;
            EXPECT_EQ(one.key() == other.key(), !shadows && !pane);
        }
}

}  // namespace
}  // namespace diptych::reference
