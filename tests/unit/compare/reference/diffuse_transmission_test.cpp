// SPDX-License-Identifier: MIT
// KHR_materials_diffuse_transmission in the reference: light from behind, by closed forms and by mirrored
// surfaces.
#include "compare/reference/scattering/ambient.h"
#include "compare/reference/scattering/brdf.h"
#include "compare/reference/scattering/sheen.h"

#include "tests/support/layer_formulas.h"
#include "tests/support/light_kinds.h"
#include "tests/support/reference_scene.h"

namespace diptych::reference {
namespace {

// A surface facing +Z that lets diffuse light pass, without a dielectric layer, seen at `angle`.
Surface leaf(double weight, const glm::dvec3& color = glm::dvec3(1), double angle = 0) {
    Surface s = lambertian();
    s.to_viewer = {std::sin(angle), 0, std::cos(angle)};
    s.diffuse_transmission = weight;
    s.diffuse_transmission_color = color;
    return s;
}
// The same under a glossy layer.
Surface waxyLeaf(double weight, double angle) {
    Surface s = leaf(weight, {0.5, 0.25, 1}, angle);
    s.roughness = 0.5;
    s.dielectric_f0 = glm::dvec3(0.04);
    s.dielectric_f90 = 1;
    return s;
}
glm::dvec3 fromBelow(double angle, double azimuth = 0) {
    return {std::sin(angle) * std::cos(azimuth), std::sin(angle) * std::sin(azimuth), -std::cos(angle)};
}
// ---- the lobe ----------------------------------------------------------------------------------------

TEST(ReferenceDiffuseTransmission, TheLobeIsTheExtensions) {
    const Reflected f = Brdf(leaf(0.25, {1, 0.5, 0}))(fromBelow(0.8, 1));
    EXPECT_NEAR(f.transmitted.r, 0.25 / pi * std::cos(0.8), 1e-15);
    EXPECT_NEAR(f.transmitted.g, 0.125 / pi * std::cos(0.8), 1e-15);
    EXPECT_EQ(f.transmitted.b, 0);
    EXPECT_EQ(f.diffuse, glm::dvec3(0));
    EXPECT_EQ(f.specular, glm::dvec3(0));
    EXPECT_EQ(Brdf(leaf(0))(fromBelow(0.8)).size(), 0) << "an opaque surface";
}

TEST(ReferenceDiffuseTransmission, TheDiffuseLobeKeepsTheRest) {
    const glm::dvec3 l(std::sin(0.5), 0, std::cos(0.5));
    for (const double weight : {0.0, 0.25, 1.0}) {
        const Reflected f = Brdf(leaf(weight, {1, 0, 0}))(l);
        EXPECT_NEAR(f.diffuse.g, (1 - weight) * std::cos(0.5) / pi, 1e-15) << weight;
        EXPECT_EQ(f.transmitted, glm::dvec3(0));
    }
}

// The layer takes as much as of light mirrored to the front: Schlick's term at the half vector.
TEST(ReferenceDiffuseTransmission, TheLayerTakesItsFractionOfTheLight) {
    for (const double view : {0.1, 1.2})
        for (const double angle : {0.3, 1.4}) {
            const Surface s = waxyLeaf(0.5, view);
            const glm::dvec3 l = fromBelow(angle, 2), mirrored(l.x, l.y, -l.z);
            const double cosine = glm::dot(s.to_viewer, glm::normalize(mirrored + s.to_viewer));
            const glm::dvec3 f = Brdf(s)(l).transmitted;
            EXPECT_NEAR(f.g, 0.5 * 0.25 / pi * std::cos(angle) * (1 - schlick(cosine)), 1e-14);
            EXPECT_NEAR(f.b, 4 * f.g, 1e-14);
        }
}

TEST(ReferenceDiffuseTransmission, MetalAndTransmissionTakeTheirFractions) {
    Surface s = leaf(0.5);
    s.metallic = 0.25;
    s.transmission = 0.5;
    EXPECT_NEAR(Brdf(s)({0, 0, -1}).transmitted.g, 0.75 * 0.5 * 0.5 / pi, 1e-15);
    EXPECT_NEAR(Brdf(s)({0, 0, 1}).diffuse.g, 0.75 * 0.5 * 0.5 / pi, 1e-15);
}

// ---- energy ------------------------------------------------------------------------------------------

// A white leaf of weight 1 sends all light behind; of any weight, light 1 from both sides leaves as 1.
TEST(ReferenceDiffuseTransmission, AWhiteFurnaceStaysWhite) {
    for (const double weight : {0.0, 0.3, 1.0}) {
        const Surface s = leaf(weight);
        const Shading ambient = underAmbient(s), sky = Lighting({.environment = &whiteSky()})(s, {}, 1);
        EXPECT_NEAR(ambient.from_behind.g, weight, 1e-5);
        EXPECT_NEAR(ambient.all().g, 1, 1e-5);
        EXPECT_NEAR(sky.all().g, 1, sky.uncertainty + 2e-3);
        EXPECT_EQ(sky.environment.transmitted, sky.reflected.transmitted);
        EXPECT_EQ(sky.from_behind, sky.reflected.transmitted);
    }
    EXPECT_LE(underAmbient(waxyLeaf(1, 0.4)).all().b, 1);
}

// The diffuse lobe of the mirrored surface is the transmitted one.
TEST(ReferenceDiffuseTransmission, TheSurfaceBehindIsItsMirror) {
    const Surface s = waxyLeaf(0.25, 0.9), back = behind(s);
    for (const glm::dvec3& l : {fromBelow(0.2, 1), fromBelow(1.3, 4)}) {
        const glm::dvec3 seen = Brdf(back)(l).diffuse, f = Brdf(s)(l).transmitted;
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], f[c], 1e-15);
    }
    EXPECT_NEAR(diffuseAlbedo(back).b, 0.25 / 0.75 * diffuseAlbedo(s).b, 1e-5);
}

// ---- lights ------------------------------------------------------------------------------------------

// Every kind of light behind a leaf lights it as it lights an opaque surface from the front.
TEST(ReferenceDiffuseTransmission, EveryLightPassesFromBehind) {
    for (const LightKind kind : everyLightKind()) {
        const Light above = lightOf(kind, {0.2, 0, 2}), below = lightOf(kind, {0.2, 0, -2}, {0, 0, 1});
        const Shading lit = shadedBy(std::span(&above, 1), leaf(0)),
                      passed = shadedBy(std::span(&below, 1), leaf(0.5, {1, 0.5, 0.25}));
        const double expected = lit.reflected.diffuse.g;
        EXPECT_GT(expected, 0);
        EXPECT_NEAR(passed.reflected.transmitted.r, 0.5 * expected, 1e-5 * expected) << nameOf(kind);
        EXPECT_NEAR(passed.reflected.transmitted.b, 0.125 * expected, 1e-5 * expected) << nameOf(kind);
        EXPECT_EQ(passed.reflected.diffuse, glm::dvec3(0));
        EXPECT_EQ(shadedBy(std::span(&below, 1), leaf(0)).all(), glm::dvec3(0));
    }
}

// An upright light of which half is on each side: both halves count, each once.
TEST(ReferenceDiffuseTransmission, ALightAcrossTheHorizonCountsOnBothSides) {
    Light rect = lightOf(LightKind::rect, {2, 0, 0}, {-1, 0, 0});
    rect.width = rect.height = 1;
    const Shading whole = shadedBy(std::span(&rect, 1), leaf(0)),
                  passed = shadedBy(std::span(&rect, 1), leaf(0.5));
    EXPECT_GT(whole.reflected.diffuse.g, 0);
    EXPECT_NEAR(passed.reflected.diffuse.g, 0.5 * whole.reflected.diffuse.g, 1e-5);
    EXPECT_NEAR(passed.reflected.transmitted.g, 0.5 * whole.reflected.diffuse.g, 1e-5);
}

// Half a sky: only the part behind passes.
TEST(ReferenceDiffuseTransmission, TheSkyBehindPasses) {
    Environment below{"below", Image(64, 32, 3, 0.0f)};
    for (int y = 16; y < 32; ++y)
        for (int x = 0; x < 64; ++x)
            for (int c = 0; c < 3; ++c) below.radiance.at(x, y, c) = 1;
    Surface s = leaf(0.5);
    s.normal = s.geometric_normal = s.to_viewer = {0, 1, 0};
    const Shading up = Lighting({.environment = &below})(s, {}, 1);
    EXPECT_NEAR(up.reflected.transmitted.g, 0.5, 0.02);
    EXPECT_LT(up.reflected.diffuse.g, 0.02) << "a row of pixels crosses the horizon";
}

TEST(ReferenceDiffuseTransmission, SheensAndCoatsDimIt) {
    const Light sun = lightOf(LightKind::directional, {0, 0, 0}, {0, 0, 1});
    Surface s = leaf(0.5);
    const double bare = shadedBy(std::span(&sun, 1), s).reflected.transmitted.g;
    s.sheen_color = glm::dvec3(0.5);
    s.sheen_roughness = 0.5;
    const double kept = sheenAlbedoScaling(s);
    EXPECT_LT(kept, 0.99);
    EXPECT_NEAR(shadedBy(std::span(&sun, 1), s).reflected.transmitted.g, kept * bare, 1e-12);
    s.clearcoat = 1;
    s.clearcoat_normal = s.normal;
    EXPECT_NEAR(shadedBy(std::span(&sun, 1), s).reflected.transmitted.g, 0.96 * kept * bare, 1e-12);
}

// ---- images ----------------------------------------------------------------------------------------

// A floor that lets light pass, seen from above, lit from below.
Scene litFromBelow(float weight) {
    Scene scene = floorScene();
    Material& m = scene.materials[0];
    m.diffuse_transmission = weight;
    m.diffuse_transmission_color = {1, 0.5f, 0.25f};
    scene.lights = {lightOf(LightKind::point, {0, 0, -2}, {0, 0, 1})};
    return scene;
}
glm::dvec3 aboveLeaf(const Scene& scene, Channel channel, bool shadows) {
    return pixelOf(drawn(scene, viewFrom({0, 0, 3}, {0, 0, 0}, 1, 1, 0.01), shadows)[channel]);
}

TEST(ReferenceDiffuseTransmission, ShadowRaysStartOnTheLightsSide) {
    for (const bool shadows : {false, true}) {
        const glm::dvec3 lit = aboveLeaf(litFromBelow(0.5f), Channel::lit, shadows);
        EXPECT_NEAR(lit.r, 0.5 / 4 / pi, 1e-6) << shadows;
        EXPECT_NEAR(lit.b, 0.25 * lit.r, 1e-7) << shadows;
        EXPECT_EQ(aboveLeaf(litFromBelow(0.5f), Channel::lit_transmission, shadows), lit);
        EXPECT_EQ(aboveLeaf(litFromBelow(0), Channel::lit, shadows), glm::dvec3(0));
    }
    Scene between = litFromBelow(0.5f);
    between.materials.push_back(matte());
    add(between, quad({-1, -1, -1}, {2, 0, 0}, {0, 2, 0}, 1));
    EXPECT_EQ(aboveLeaf(between, Channel::lit, true), glm::dvec3(0)) << "a board below";
    Scene above = litFromBelow(0.5f);
    above.materials.push_back(matte());
    add(above, quad({-1, 1, 4}, {2, 0, 0}, {0, -2, 0}, 1));
    EXPECT_GT(aboveLeaf(above, Channel::lit, true).r, 0) << "a board above shades nothing below";
    EXPECT_EQ(aboveLeaf(above, Channel::local_visibility, true).r, 1);
    EXPECT_EQ(aboveLeaf(between, Channel::local_visibility, true).r, 0);
}

TEST(ReferenceDiffuseTransmission, TheVolumeAbsorbs) {
    Scene scene = litFromBelow(0.5f);
    Material& m = scene.materials[0];
    m.thickness = 2;
    m.attenuation_distance = 1;
    m.attenuation_color = {0.5f, 1, 0};
    EXPECT_EQ(aboveLeaf(scene, Channel::diffuse_transmission_color, false), glm::dvec3(0.25, 0.5, 0));
}

TEST(ReferenceDiffuseTransmission, CapturedLeavesAreShadedAgain) {
    const Scene scene = litFromBelow(0.5f);
    const View view = viewFrom({0, 0, 3}, {0, 0, 0}, 1, 1, 0.01);
    for (const bool shadows : {false, true}) {
        const Drawn traced = drawn(scene, view, shadows);
        const ReferenceImage again = shadedAgain(scene, view, traced, traced.image.channels, shadows);
        for (const Channel channel : {Channel::lit, Channel::lit_transmission}) {
            const double expected = double{traced[channel].at(0, 0, 0)};
            EXPECT_GT(expected, 0);
            EXPECT_NEAR(double{again.channels.at(channel).at(0, 0, 0)}, expected, 1e-5 * expected);
        }
    }
}

}  // namespace
}  // namespace diptych::reference
