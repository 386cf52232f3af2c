// SPDX-License-Identifier: MIT
// Audits of a path with an injected fault: it breaks at the magnitude that theory predicts, within a
// factor of 2.
#include "compare/audit/audit.h"
#include "compare/audit/quantities.h"
#include "tests/image/square.h"

#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <numbers>

namespace diptych::tests {
namespace {

using audit::Case;
using audit::Measurer;
using audit::Quantity;
using audit::Series;
using audit::Step;
using audit::Subject;

constexpr double percent = 1e-2;  // the criterion; its breaking point is searched for

Subject subjectOf(const Scene& scene, const std::function<void(Settings&)>& change = {}) {
    Settings settings;
    settings.size = {48, 27};
    settings.shadows = Shadows::off;
    settings.gbuffer = GBufferEncoding::full;
    if (change) change(settings);
    return audit::makeSubject(scene, settings);
}

// The magnitude between `sound` and `broken` at which the error of forward+ reaches 1e-2, to a factor of
// 1.1 (bisection in log scale). Fails if `sound` breaks or `broken` passes.
double limitOf(Measurer& measurer, const Quantity& quantity, double sound, double broken) {
    const std::array<Series, 1> series{Series{Path::forward_plus, {}}};
    const auto passes = [&](double magnitude) {
        const Step step = measurer.measure(quantity, series, magnitude);
        return step.outcomes[0].error() <= percent;
    };
    EXPECT_TRUE(passes(sound)) << quantity.name;
    EXPECT_FALSE(passes(broken)) << quantity.name;
    while (std::abs(std::log(broken / sound)) > std::log(1.1)) {
        const double middle = std::sqrt(sound * broken);
        (passes(middle) ? sound : broken) = middle;
    }
    return std::sqrt(sound * broken);
}

void expectWithinTwo(double measured, double predicted, const char* what) {
    EXPECT_GT(measured, predicted / 2) << what;
    EXPECT_LT(measured, predicted * 2) << what;
}

const Quantity& quantityNamed(std::string_view name) {
    return *audit::quantitiesOf(std::array{std::string(name)}).front();
}

// Many vertices at many depths. The default sun's light does not depend on position.
Scene inclined() {
    Scene scene = fineMesh(24);
    scene.nodes[0].parent_from_node =
        glm::rotate(glm::dmat4(1), 0.5, glm::normalize(glm::dvec3(1, 0.4, 0.1)));
    return scene;
}

// A vertex and the eye are each rounded to float32 in world space, by up to half a ULP of their
// coordinate; depth depends on the difference. The scene moves along (0.8, 0, 0.6), and depth is along z.
// At offset X each rounding is at most 2^-24 0.6 X. The 99th percentile is slightly more than one of the
// two.
TEST(AuditFaults, AFloat32WorldTransformBreaksWhereTheorySays) {
    const Subject subject = subjectOf(inclined());
    Measurer measurer(device(), subject, {});
    measurer.plant({.scene = [](Case& drawn) {
        const auto rounded = [](glm::dvec3 p) { return glm::dvec3(glm::vec3(p)); };
        for (Node& node : drawn.scene.nodes) {
            if (node.mesh < 0) continue;
            // The whole world transform; a parent node has the offset.
            glm::dmat4 world = node.parent_from_node;
            for (int at = node.parent; at >= 0; at = drawn.scene.nodes[static_cast<std::size_t>(at)].parent)
                world = drawn.scene.nodes[static_cast<std::size_t>(at)].parent_from_node * world;
            const glm::dmat3 turned(world);
            const glm::dmat4 origin = glm::translate(glm::dmat4(1), glm::dvec3(world[3]));
            for (Primitive& p : drawn.scene.meshes[static_cast<std::size_t>(node.mesh)].primitives) {
                for (glm::vec3& normal : p.normals) normal = glm::vec3(turned * glm::dvec3(normal));
                for (glm::vec3& position : p.positions) {
                    const glm::dvec3 location = rounded(glm::dvec3(world * glm::dvec4(position, 1)));
                    position = glm::vec3(location - glm::dvec3(origin[3]));
                }
            }
            node.parent = -1;
            node.parent_from_node = origin;
        }
        glm::dvec4& eye = drawn.camera().world_from_camera[3];
        eye = glm::dvec4(rounded(glm::dvec3(eye)), 1);
    }});
    // An error of 1.5 half ULPs of 2^-24 0.6 X, at the distance of the centre.
    const double distance = glm::distance(subject.point, subject.view.eye());
    const double predicted = percent * distance / (1.5 * 0.6 * 0x1p-24);
    expectWithinTwo(limitOf(measurer, quantityNamed("offset"), 1, 1e7), predicted, "float32 world transform");
}

// z = 1 - n / d (for f much larger than d) has a ULP of 2^-24 below 1: an error of at least 2^-25, which
// is d^2 / n times that in d. The rasteriser's plane equation for z adds up to two roundings.
TEST(AuditFaults, StandardDepthBreaksWhereTheorySays) {
    const Subject subject =
        subjectOf(inclined(), [](Settings& s) { s.depth_format = DepthFormat::d32f_standard; });
    Measurer measurer(device(), subject, {});
    const Quantity& near = quantityNamed("near");
    // At the image's centre, where most pixels are; the magnitude is far / near.
    const double distance = glm::distance(subject.point, subject.view.eye());
    Case changed = subject.original;
    near.apply(changed, subject, 1e3);
    const double far = changed.camera().far;
    const double predicted = percent * far / (distance * 2 * 0x1p-25);
    expectWithinTwo(limitOf(measurer, near, 1e2, 1e9), predicted, "standard depth");
}

// A square lit by a sun from the viewer's side, entirely within a small angle of the highlight. It is a
// metal, so lit is D times a nearly constant factor.
Scene highlight() {
    Scene scene = square();
    scene.materials[0].metallic = 1;
    scene.cameras[0].yfov = 0.02 * std::numbers::pi / 180;
    scene.lights = {sunAlong({0, 0, -1}, 1)};
    return scene;
}

void applySharpness(Case& changed, const Subject&, double roughness) {
    for (Material& material : changed.scene.materials) material.roughness = static_cast<float>(roughness);
}

// The denominator (n.h)^2 (alpha^2 - 1) + 1 equals alpha^2 plus the squared angle, computed from numbers
// near 1. Float32 rounds n.h by 2^-24 and the rest by half of that: 1.5 2^-24 in all. D errs by twice the
// relative error. It reaches 1e-2 at alpha^2 = 1.8e-5, roughness 0.065.
TEST(AuditFaults, AnUnguardedDBreaksWhereTheorySays) {
    const Subject subject = subjectOf(highlight());
    Measurer measurer(device(), subject, {});
    measurer.plant({.image =
                        [](const Case& drawn, Frame& frame) {
                            const float alpha =
                                drawn.scene.materials[0].roughness * drawn.scene.materials[0].roughness;
                            const float alpha2 = alpha * alpha;
                            const Image& places = frame.channels.at(Channel::position);
                            Image& image = frame.channels.at(Channel::lit);
                            for (std::size_t i = 0; i < image.pixels(); ++i) {
                                const float* const p = places.pixel(i);
                                const glm::vec3 v = glm::normalize(-glm::vec3(p[0], p[1], p[2]));
                                const glm::vec3 h = glm::normalize(glm::vec3(0, 0, 1) + v);
                                const glm::dvec3 hd = glm::normalize(glm::dvec3(0, 0, 1) + glm::dvec3(v));
                                const double sine2 = hd.x * hd.x + hd.y * hd.y,
                                             clamped = std::max(double{alpha}, 0.045 * 0.045);
                                const double exact = sine2 + hd.z * hd.z * clamped * clamped;
                                const float naive = h.z * h.z * (alpha2 - 1) + 1;
                                const double wrong =
                                    double{alpha2} / (clamped * clamped) * (exact / naive) * (exact / naive);
                                for (int c = 0; c < 3; ++c)
                                    image.pixel(i)[c] = static_cast<float>(image.pixel(i)[c] * wrong);
                            }
                        },
                    .channels = {Channel::position}});
    static const Quantity sharpness{.name = "roughness",
                                    .unit = "",
                                    .what = "the roughness of all",
                                    .magnitudes = {0.01, 1},
                                    .original = [](const Subject&) { return 1.0; },
                                    .apply = applySharpness};
    const double predicted = std::pow(2 * 1.5 * 0x1p-24 / percent, 0.25);
    expectWithinTwo(limitOf(measurer, sharpness, 0.5, 0.01), predicted, "D");
}

// `degrees`: full cone angle; the falloff starts at the axis.
void applySoftCone(Case& changed, const Subject&, double degrees) {
    for (Light& light : changed.scene.lights) {
        light.inner_cone = 0;
        light.outer_cone = static_cast<float>(degrees / 2 * std::numbers::pi / 180);
    }
}

// The cone's falloff is 1 - cos(outer) wide, clamped to at least 0.001. Without the clamp, light changes
// below that width: by 1e-2 at 0.995 of it.
TEST(AuditFaults, AnUnguardedConeBreaksWhereTheorySays) {
    Scene scene = square();
    scene.cameras[0].yfov = 0.5 * std::numbers::pi / 180;
    Light spot;
    spot.kind = LightKind::spot;
    spot.position = {0, 0, 1};
    spot.direction = {0, 0, -1};
    spot.intensity = 1;
    scene.lights = {spot};
    const Subject subject = subjectOf(scene);
    Measurer measurer(device(), subject, {});
    measurer.plant({.image =
                        [](const Case& drawn, Frame& frame) {
                            const float outer = std::cos(drawn.scene.lights[0].outer_cone), inner = 1;
                            const Image& places = frame.channels.at(Channel::position);
                            Image& image = frame.channels.at(Channel::lit);
                            for (std::size_t i = 0; i < image.pixels(); ++i) {
                                const float* const p = places.pixel(i);
                                const float cosine = -glm::normalize(glm::vec3(p[0], p[1], p[2])).z;
                                const auto fraction = [&](float width) {
                                    return std::clamp((cosine - outer) / width, 0.0f, 1.0f);
                                };
                                const float guarded = fraction(std::max(inner - outer, 0.001f)),
                                            naive = fraction(inner - outer);
                                const float wrong = guarded > 0 ? naive / guarded : 1.0f;
                                for (int c = 0; c < 3; ++c) image.pixel(i)[c] *= wrong * wrong;
                            }
                        },
                    .channels = {Channel::position}});
    static const Quantity cone{.name = "cone",
                               .unit = "degrees",
                               .what = "the whole angle of the spot",
                               .magnitudes = {1, 90},
                               .original = [](const Subject&) { return 90.0; },
                               .apply = applySoftCone};
    const double predicted = 2 * std::acos(1 - 0.001 * 0.995) * 180 / std::numbers::pi;
    expectWithinTwo(limitOf(measurer, cone, 90, 1), predicted, "cone");
}

}  // namespace
}  // namespace diptych::tests
