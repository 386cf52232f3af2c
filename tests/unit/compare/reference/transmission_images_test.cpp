// SPDX-License-Identifier: MIT
// Images of panes and slabs: what is seen through them, in which order, through haze, and in furnaces.
#include "tests/support/layer_table.h"
#include "tests/support/reference_scene.h"

namespace diptych::reference {
namespace {

// ---- what is behind ----------------------------------------------------------------------------------

// Transmits all light and reflects none.
Material clearPane() {
    Material m = matte();
    m.transmission = 1;
    m.roughness = 0;
    return m;
}

// A white floor at z = -2, lit by a point, and in front of it a pane at z = 0.
Scene windowScene(const Material& pane, double height = 0) {
    Scene scene = floorScene();
    for (glm::vec3& p : scene.meshes[0].primitives[0].positions) p.z = -2;
    scene.materials.push_back(pane);
    add(scene, quad({-5, -5, static_cast<float>(height)}, {10, 0, 0}, {0, 10, 0}, 1));
    scene.lights = {lightOf(LightKind::point, {0.3, 0, -1})};
    return scene;
}
Scene withoutPane(Scene scene) {
    scene.meshes[0].primitives.resize(1);
    return scene;
}
// Radiance of the floor at a point, under the light.
double floorAt(const glm::dvec3& point) {
    const glm::dvec3 path = glm::dvec3(0.3, 0, -1) - point;
    return path.z / std::pow(glm::length(path), 3) / pi;
}

const glm::dvec3 obliqueEye(-2, 0, 3);
View oblique() {
    return viewFrom(obliqueEye, {0, 0, 0}, 1, 1, 0.01);
}
glm::dvec3 obliqueRay() {
    return glm::normalize(-obliqueEye);
}
// Where a ray from a point of the pane meets the floor.
glm::dvec3 onFloor(const glm::dvec3& from) {
    return from + obliqueRay() * ((-2 - from.z) / obliqueRay().z);
}

void expectCentre(const Image& image, const glm::dvec3& expected, double relative, const char* what) {
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(pixelOf(image)[c], expected[c], relative * std::abs(expected[c]) + 1e-9) << what << c;
}

// Mode surface, with the opaque surfaces as captured.
ReferenceImage captured(const Scene& scene, const View& view, const std::optional<Air>& air = {}) {
    const Drawn traced = drawn(scene, view);
    return shadedAgain(scene, view, traced, traced.image.channels, false, air);
}
const Image& litOf(const ReferenceImage& image) {
    return image.channels.at(Channel::lit);
}

TEST(ReferenceTransmission, AThinWallTintsWhatIsStraightBehind) {
    Material m = clearPane();
    m.base_color = {0.5f, 0.25f, 1, 1};
    const Scene scene = windowScene(m);
    const double behind = floorAt(onFloor({0, 0, 0}));
    const glm::dvec3 expected = glm::dvec3(0.5, 0.25, 1) * behind;
    expectCentre(drawn(scene, oblique())[Channel::lit], expected, 1e-6, "scene");
    expectCentre(litOf(captured(scene, oblique())), expected, 1e-5, "surface");
    expectCentre(drawn(scene, oblique())[Channel::lit_transmission], expected, 1e-6, "its channel");
    expectCentre(drawn(scene, oblique())[Channel::lit_diffuse], glm::dvec3(behind), 1e-6, "the floor's");
}

TEST(ReferenceTransmission, ASlabShowsWhatIsBeside) {
    Material m = clearPane();
    m.thickness = 0.5f;
    m.attenuation_color = {0.5f, 1, 0.25f};
    m.attenuation_distance = 2;
    const double sine = 2 / std::sqrt(13.0), inside = sine / 1.5;
    const glm::dvec3 refracted(inside, 0, -std::sqrt(1 - inside * inside));
    const glm::dvec3 unabsorbed(std::pow(0.5, 0.25), 1, std::pow(0.25, 0.25));
    const double beside = floorAt(onFloor(refracted * 0.5));
    EXPECT_GT(std::abs(beside / floorAt(onFloor({0, 0, 0})) - 1), 0.02) << "the test can tell them apart";
    expectCentre(litOf(captured(windowScene(m), oblique())), unabsorbed * beside, 1e-5, "slab");
}

// The node scales the thickness: a factor of 2 along each axis, or one of 8 along one.
TEST(ReferenceTransmission, TheNodeScalesTheThickness) {
    Material m = clearPane();
    m.thickness = 0.25f;
    Scene scene = windowScene(m);
    scene.meshes.resize(2);
    scene.meshes[1].primitives = {scene.meshes[0].primitives.back()};
    scene.meshes[0].primitives.pop_back();
    scene.nodes.resize(2);
    scene.nodes[1].mesh = 1;
    for (const glm::dvec3& scale : {glm::dvec3(2), glm::dvec3(-8, 1, 1)}) {
        scene.nodes[1].parent_from_node = glm::scale(glm::dmat4(1), scale);
        scene.materials[1].double_sided = true;
        EXPECT_NEAR(pixelOf(drawn(scene, oblique())[Channel::transmission_thickness]).x, 0.5, 1e-6);
    }
}

TEST(ReferenceTransmission, ComponentsRefractApart) {
    Material m = clearPane();
    m.thickness = 0.5f;
    m.dispersion = 4;
    const Image lit = litOf(captured(windowScene(m), oblique()));
    for (int c = 0; c < 3; ++c) {
        const double index = 1.5 + (c - 1) * 0.5 * 0.025 * 4, inside = 2 / std::sqrt(13.0) / index;
        const glm::dvec3 refracted(inside, 0, -std::sqrt(1 - inside * inside));
        const double expected = floorAt(onFloor(refracted * 0.5));
        EXPECT_NEAR(pixelOf(lit)[c], expected, 1e-5 * expected) << c;
    }
    EXPECT_GT(std::abs(pixelOf(lit).r / pixelOf(lit).b - 1), 1e-3);
    m.dispersion = 0;
    const Image without = litOf(captured(windowScene(m), oblique()));
    EXPECT_EQ(without.data[0], without.data[1]);
    EXPECT_EQ(without.data[0], without.data[2]);
    EXPECT_NEAR(double{without.data[1]}, pixelOf(lit).g, 1e-7) << "green has the index itself";
}

// A texture of 0 leaves the base, bit for bit.
TEST(ReferenceTransmission, WithoutTransmissionItIsTheBase) {
    Material m = matte();
    m.specular = 1;
    m.base_color = {0.5f, 0.25f, 0.75f, 1};
    m.emissive = {0.1f, 0.2f, 0.3f};
    Scene opaque = windowScene(m);
    opaque.lights.push_back(lightOf(LightKind::point, {0, 0.5, 2}));
    Scene pane = opaque;
    pane.images = {{"black", 1, 1, {0, 0, 0, 255}}};
    pane.textures = {{0, {}}};
    pane.materials[1].transmission = 1;
    pane.materials[1].thickness = 1;
    pane.materials[1].transmission_texture.texture = 0;
    EXPECT_EQ(drawn(pane, oblique())[Channel::lit].data, drawn(opaque, oblique())[Channel::lit].data);
    EXPECT_EQ(pixelOf(drawn(pane, oblique())[Channel::lit_transmission]), glm::dvec3(0));
}

// The share of transmission scales the diffuse lobe down: here the sun lights the pane and, because neither
// casts a shadow, the floor.
TEST(ReferenceTransmission, WhatIsNotTransmittedIsScattered) {
    Material m = clearPane();
    m.transmission = 0.25f;
    Scene scene = windowScene(m);
    scene.lights = {lightOf(LightKind::directional, {0, 0, 0})};
    scene.lights[0].intensity = 2;
    scene.materials[0].base_color = {0.5f, 0.5f, 0.5f, 1};
    expectCentre(drawn(scene, oblique())[Channel::lit], glm::dvec3((0.75 + 0.25 * 0.5) * 2 / pi), 1e-6,
                 "both");
}

TEST(ReferenceTransmission, OnlyTheNearestIsSeen) {
    Material m = clearPane();
    m.base_color = {1, 0.5f, 0.5f, 1};
    Scene scene = windowScene(m);
    Material other = clearPane(), veil = matte();
    other.base_color = {0.25f, 1, 1, 1};
    veil.alpha_mode = AlphaMode::blend;
    veil.base_color = {0, 0, 0, 0.5f};
    veil.emissive = {1, 1, 1};
    scene.materials.push_back(other);
    scene.materials.push_back(veil);
    const glm::dvec3 behind = glm::dvec3(1, 0.5, 0.5) * floorAt(onFloor({0, 0, 0}));
    add(scene, quad({-5, -5, -0.5f}, {10, 0, 0}, {0, 10, 0}, 2));
    expectCentre(drawn(scene, oblique())[Channel::lit], behind, 1e-6, "another pane behind is hidden");
    add(scene, quad({-5, -5, -0.25f}, {10, 0, 0}, {0, 10, 0}, 3));
    expectCentre(drawn(scene, oblique())[Channel::lit], behind, 1e-6, "so is what blends behind it");
    add(scene, quad({-5, -5, 0.25f}, {10, 0, 0}, {0, 10, 0}, 3));
    expectCentre(drawn(scene, oblique())[Channel::lit], behind * 0.5 + 0.5, 1e-6, "but not before it");
    expectCentre(drawn(scene, oblique())[Channel::lit_transmission], behind, 1e-6, "the pane's own");
}

TEST(ReferenceTransmission, AlphaCoversAndMasksCut) {
    Material m = clearPane();
    m.base_color = {0, 1, 0, 0.25f};
    const double behind = floorAt(onFloor({0, 0, 0}));
    expectCentre(drawn(windowScene(m), oblique())[Channel::lit], glm::dvec3(0, behind, 0), 1e-6, "OPAQUE");
    m.alpha_mode = AlphaMode::blend;
    expectCentre(drawn(windowScene(m), oblique())[Channel::lit],
                 glm::dvec3(0.75 * behind, behind, 0.75 * behind), 1e-6, "BLEND");
    expectCentre(drawn(windowScene(m), oblique())[Channel::lit_transmission], glm::dvec3(0, 0.25 * behind, 0),
                 1e-6, "of what it covers");
    m.alpha_mode = AlphaMode::mask;
    expectCentre(drawn(windowScene(m), oblique())[Channel::lit], glm::dvec3(behind), 1e-6, "MASK");
    EXPECT_EQ(pixelOf(drawn(windowScene(m), oblique())[Channel::transmission]).x, 0);
}

TEST(ReferenceTransmission, ItsChannelsAreOfTheNearestPane) {
    const Scene scene = windowScene(testedLayers(gpu::LAYER_TRANSMISSION)[0].typical(clearPane()));
    EXPECT_EQ(pixelOf(drawn(scene, oblique())[Channel::material_id]).x, 0)
        << "other channels are of the floor";
    Scene behind = scene;
    for (glm::vec3& p : behind.meshes[0].primitives[1].positions) p.z = -3;
    for (const Scene& none : {withoutPane(scene), behind})
        for (const DebugMode& mode : debugModes())
            if (layerOf(mode.channel) == gpu::LAYER_TRANSMISSION) {
                EXPECT_EQ(pixelOf(drawn(none, oblique())[mode.channel]), glm::dvec3(0)) << mode.name;
            }
}

// Textures with a transform and the second set of coordinates.
TEST(ReferenceTransmission, TexturesFollowTheirCoordinates) {
    Scene scene = windowScene(clearPane());
    // Red and green halves by u: 0.2 and 1 for u < 1/2.
    scene.images = {{"halves", 2, 1, {51, 255, 0, 255, 255, 0, 0, 255}}};
    scene.textures = {{0, {}}};
    scene.textures[0].sampler.magnify_linear = scene.textures[0].sampler.minify_linear = false;
    Material& m = scene.materials[1];
    m.thickness = 1;
    m.transmission_texture = {0, 0, {0, 0, 0.25}, {0, 0, 0.5}};
    m.thickness_texture = {0, 1, {1, 0, 0}, {0, 1, 0}};
    scene.meshes[0].primitives[1].texcoords[1].assign(4, {0.25f, 0.5f});
    const auto shown = [&](Channel mode) { return pixelOf(drawn(scene, oblique())[mode]).x; };
    EXPECT_NEAR(shown(Channel::transmission), 0.2, 1e-7);
    EXPECT_EQ(shown(Channel::transmission_thickness), 1);
    m.transmission_texture.u.z = 0.75;
    scene.meshes[0].primitives[1].texcoords[1].assign(4, {0.75f, 0.5f});
    EXPECT_EQ(shown(Channel::transmission), 1);
    EXPECT_EQ(shown(Channel::transmission_thickness), 0);
}

// ---- furnaces ----------------------------------------------------------------------------------------

Scene paneInFurnace(Material pane) {
    Scene scene = windowScene(pane);
    scene.meshes[0].primitives.erase(scene.meshes[0].primitives.begin());
    scene.lights.clear();
    scene.environment = Environment{"furnace", Image(8, 4, 3, 1.0f)};
    return scene;
}

// Under light 1 from everywhere a lossless smooth pane is invisible but for what Fresnel's term loses between
// the lobe and the view; nothing gains light.
TEST(ReferenceTransmission, AWhiteFurnaceGainsNothing) {
    for (const float roughness : {0.0f, 0.4f, 1.0f})
        for (const float thickness : {0.0f, 0.5f}) {
            Material m = clearPane();
            m.specular = 1;
            m.roughness = roughness;
            m.thickness = thickness;
            const Scene scene = paneInFurnace(m);
            const Drawn traced = drawn(scene, oblique());
            const ReferenceImage slab = captured(scene, oblique());
            for (const ReferenceImage* image : {&traced.image, &slab}) {
                const double lit = pixelOf(litOf(*image)).g, open = 0.02 + pixelOf(image->uncertainty).x;
                EXPECT_LT(lit, 1 + open) << roughness << " " << thickness;
                if (roughness == 0) {
                    EXPECT_GT(lit, 1 - open) << thickness;
                }
            }
        }
}

// The lobe's weights are a mean: an even background is not dimmed by roughness.
TEST(ReferenceTransmission, RoughnessKeepsAnEvenBackground) {
    Material m = clearPane();
    m.base_color = {0.5f, 1, 0.25f, 1};
    for (const float roughness : {0.3f, 0.9f}) {
        m.roughness = roughness;
        const Drawn d = drawn(paneInFurnace(m), oblique());
        expectCentre(d[Channel::lit_transmission], {0.5, 1, 0.25}, 0.02, "even");
        EXPECT_NEAR(pixelOf(d.image.blended).y, 1, 1e-6) << "the share that passes, of its component";
        EXPECT_NEAR(pixelOf(d.image.blended).z, 1, 0.02) << "and its light";
    }
}

// Straight on, half of a rough pane's lobe is over each half of the floor.
TEST(ReferenceTransmission, RoughnessBlursAnEdgeEvenly) {
    Material m = clearPane();
    m.roughness = 0.4f;
    Scene scene = windowScene(m);
    scene.lights.clear();
    Material bright = matte();
    bright.emissive = {1, 1, 1};
    scene.materials.push_back(bright);
    add(scene, quad({0, -10, -1.9f}, {10, 0, 0}, {0, 20, 0}, 2));
    const Drawn d = drawn(scene, viewFrom({0, 0, 3}, {0, 0, 0}, 1, 1, 0.001));
    EXPECT_NEAR(pixelOf(d[Channel::lit]).g, 0.5, 0.02);
    EXPECT_GT(pixelOf(d.image.uncertainty).x, 0);
}

// ---- haze --------------------------------------------------------------------------------------------

// Air whose density halves every 2 m, seen downwards. Transmittance over a length is exp(-the mean extinction
// times it), and air of one albedo under even light scatters that light's fraction that it does not
// transmit. The light behind has the haze in front of the pane and that from where it leaves the pane.
TEST(ReferenceTransmission, HazeLiesOnTheWholeWay) {
    Material m = clearPane();
    m.base_color = {0.25f, 1, 0.5f, 1};
    const glm::dvec3 eye(-2, 3, 3), along = -glm::normalize(eye), tint(0.25, 1, 0.5),
                                    extinction(0.1, 0.2, 0.4);
    Air air;
    air.ground = 1;
    air.aerosols = {extinction * 0.5, extinction, 2 / std::log(2.0)};
    air.ambient = glm::dvec3(0.5);
    const auto passes = [&](const glm::dvec3& from, const glm::dvec3& to) {
        const auto density = [&](double y) { return std::exp(-(y - air.ground) / air.aerosols.scale); };
        const double mean = (density(to.y) - density(from.y)) * air.aerosols.scale / (from.y - to.y);
        return glm::exp(-extinction * mean * glm::distance(from, to));
    };
    const auto through = [&](const glm::dvec3& light, const glm::dvec3& transmittance) {
        return light * transmittance + 0.5 * air.ambient * (1.0 - transmittance);
    };
    for (const float thickness : {0.0f, 0.5f}) {
        m.thickness = thickness;
        const glm::dvec3 inside = glm::dvec3(along.x, along.y, 0) / 1.5,
                         leaves = glm::dvec3(inside.x, inside.y, -std::sqrt(1 - glm::dot(inside, inside))) *
                                  double{thickness},
                         floor = leaves + along * ((-2 - leaves.z) / along.z);
        const glm::dvec3 path = glm::dvec3(0.3, 0, -1) - floor,
                         lit(path.z / std::pow(glm::length(path), 3) / pi);
        const glm::dvec3 expected =
            through(tint * through(lit, passes(leaves, floor)), passes(eye, glm::dvec3(0)));
        expectCentre(litOf(captured(windowScene(m), viewFrom(eye, {0, 0, 0}, 1, 1, 0.001), air)), expected,
                     1e-5, thickness > 0 ? "slab" : "thin wall");
    }
}

}  // namespace
}  // namespace diptych::reference
