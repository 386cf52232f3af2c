// SPDX-License-Identifier: MIT
// Light of sheens and thin films in one pixel of a tilted square, compared with the definitions of
// KHR_materials_sheen and KHR_materials_iridescence.
#include "tests/image/square.h"
#include "tests/support/layer_formulas.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace diptych::tests {
namespace {

constexpr double sunlight = 2;  // irradiance perpendicular to the light, W/m^2
const glm::dvec3 slanted = glm::normalize(glm::dvec3(0.3, 0.5, 0.8)), toViewer(0, 0, 1);

// The square turned by `degrees` about the image's vertical, lit by a sun in the direction `l`.
Scene tiltedSquare(const Material& material, double degrees, const glm::dvec3& l) {
    Scene scene = square();
    scene.materials[0] = material;
    scene.nodes[0].parent_from_node =
        glm::rotate(glm::dmat4(1.0), glm::radians(degrees), glm::dvec3(0, 1, 0));
    scene.lights = {sunAlong(-l, static_cast<float>(sunlight))};
    return scene;
}
glm::dvec3 tiltedNormal(double degrees) {
    return {std::sin(glm::radians(degrees)), 0, std::cos(glm::radians(degrees))};
}

Settings onePixel(float ambient = 0) {
    Settings settings = smallImage(GBufferEncoding::full);
    settings.size = {1, 1};
    settings.ambient = {ambient, ambient, ambient};
    return settings;
}

void expectLight(const Frame& frame, Channel channel, const glm::dvec3& expected, double tolerance,
                 const std::string& where) {
    const glm::vec3 got = colorAt(frame, channel, 0, 0);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(double{got[c]}, expected[c], tolerance)
            << frame.name << " " << debugMode(channel).name << ", " << where;
}

// ---- sheen -------------------------------------------------------------------------------------------

Material wovenCloth(float roughness) {
    Material m;
    m.base_color = {0.6f, 0.4f, 0.2f, 1};
    m.metallic = 0;
    m.sheen_color = {0.9f, 0.5f, 0.1f};
    m.sheen_roughness = roughness;
    return m;
}

// Sunlight by D V, ambient light by its integral E; all below is scaled by 1 - E times the largest component
// of the colour. The paths' table of E is up to 1.1e-4 off.
TEST(LayerValues, ASheenIsItsFormula) {
    for (const float roughness : {0.2f, 0.5f, 1.0f})
        for (const double degrees : {-35.0, 70.0}) {
            const Material cloth = wovenCloth(roughness);
            Material bare = cloth;
            bare.sheen_color = {};
            const glm::dvec3 n = tiltedNormal(degrees), color(cloth.sheen_color);
            const double n_dot_h = glm::dot(n, glm::normalize(slanted + toViewer)),
                         direct =
                             sunlight * estevezKulla(double{roughness}, glm::dot(n, slanted), n.z, n_dot_h),
                         all = denseSheenAlbedo(double{roughness}, n.z), left = 1 - 0.9 * all;
            const std::vector<Frame> dark = bothPaths(tiltedSquare(cloth, degrees, slanted), onePixel()),
                                     bright = bothPaths(tiltedSquare(cloth, degrees, slanted), onePixel(3)),
                                     base = bothPaths(tiltedSquare(bare, degrees, slanted), onePixel(3));
            const std::string where = fmt::format("roughness {}, {} degrees", roughness, degrees);
            for (std::size_t path = 0; path < 2; ++path) {
                const auto below = [&](Channel channel) {
                    return left * glm::dvec3(colorAt(base[path], channel, 0, 0));
                };
                expectLight(dark[path], Channel::lit_sheen, color * direct, 1e-4 * direct + 1e-9, where);
                expectLight(bright[path], Channel::lit_sheen, color * (direct + 3 * all), 4e-4, where);
                expectLight(bright[path], Channel::lit_diffuse, below(Channel::lit_diffuse), 1e-4, where);
                expectLight(bright[path], Channel::lit_specular,
                            below(Channel::lit_specular) + color * direct, 1e-4 * (1 + direct), where);
                expectLight(bright[path], Channel::lit_ambient,
                            below(Channel::lit_ambient) + color * (3 * all), 6e-4, where);
            }
        }
}

// A coat dims the sheen by its own Fresnel term.
TEST(LayerValues, ACoatLiesAboveASheen) {
    const Material cloth = wovenCloth(0.6f);
    Material coated = cloth;
    coated.clearcoat = 1;
    const glm::dvec3 n = tiltedNormal(50);
    const double left = 1 - schlick(n.z);
    const std::vector<Frame> bare = bothPaths(tiltedSquare(cloth, 50, slanted), onePixel(1)),
                             under = bothPaths(tiltedSquare(coated, 50, slanted), onePixel(1));
    for (std::size_t path = 0; path < 2; ++path)
        expectLight(under[path], Channel::lit_sheen,
                    left * glm::dvec3(colorAt(bare[path], Channel::lit_sheen, 0, 0)), 1e-5, "coated");
}

// ---- iridescence -------------------------------------------------------------------------------------

// Fraction that a film of `ior` and `nm` reflects over a material of `f0`: both faces, and two orders of
// interference.
glm::dvec3 filmReflectance(double cosine, const glm::dvec3& f0, double ior, double nm) {
    const double inner = std::sqrt(1 - (1 - cosine * cosine) / (ior * ior)),
                 front = schlick(cosine, std::pow((ior - 1) / (ior + 1), 2)),
                 difference = 2 * ior * nm * 1e-9 * inner;
    glm::dvec3 back, through, phase;
    for (int c = 0; c < 3; ++c) {
        const double index = (1 + std::sqrt(f0[c])) / (1 - std::sqrt(f0[c]));
        back[c] = schlick(inner, std::pow((index - ior) / (index + ior), 2));
        through[c] = (1 - front) * (1 - front) * back[c] / (1 - front * back[c]);
        phase[c] = index < ior ? 2 * std::numbers::pi : std::numbers::pi;
    }
    glm::dvec3 reflected = front + through;
    for (const double order : {1.0, 2.0})
        reflected += 2.0 * (through - (1 - front)) * glm::pow(front * back, glm::dvec3(order / 2)) *
                     spectralSum(order * difference, order * phase);
    return glm::max(reflected, glm::dvec3(0));
}

double largestOf(const glm::dvec3& v) {
    return std::max({v.r, v.g, v.b});
}

// With alpha = 1, D = 1 / pi and V = 1 / (2 (n.v + n.l)).
TEST(LayerValues, AFilmIsItsFormula) {
    struct Film {
        float weight, ior, nm;
    };
    for (const Film& film : {Film{1, 1.3f, 300}, Film{1, 1.8f, 550}, Film{0.5f, 1.4f, 120}})
        for (const double degrees : {0.0, 40.0}) {
            Material m;
            m.base_color = {0.8f, 0.5f, 0.3f, 1};
            m.metallic = 0.25f;
            m.iridescence = film.weight;
            m.iridescence_ior = film.ior;
            m.iridescence_thickness_max = film.nm;
            const glm::dvec3 n = tiltedNormal(degrees), albedo(m.base_color);
            // At 0 degrees along the normal.
            const glm::dvec3 l = degrees > 0 ? slanted : n;
            const double cosine = glm::dot(toViewer, glm::normalize(l + toViewer)), n_dot_l = glm::dot(n, l);
            const auto filmed = [&](const glm::dvec3& f0) {
                return glm::mix(glm::mix(f0, glm::dvec3(1), schlick(cosine, 0)),
                                filmReflectance(cosine, f0, double{film.ior}, double{film.nm}),
                                double{film.weight});
            };
            const glm::dvec3 dielectric = filmed(glm::dvec3(0.04)),
                             fresnel = glm::mix(dielectric, filmed(albedo), 0.25),
                             specular =
                                 fresnel * (sunlight * n_dot_l / (2 * std::numbers::pi * (n.z + n_dot_l))),
                             diffuse = albedo * (0.75 * (1 - largestOf(dielectric)) * sunlight * n_dot_l /
                                                 std::numbers::pi);
            const std::string where =
                fmt::format("weight {}, {} nm, {} degrees", film.weight, film.nm, degrees);
            for (const Frame& frame : bothPaths(tiltedSquare(m, degrees, l), onePixel())) {
                expectLight(frame, Channel::lit_specular, specular, 1e-4 * largestOf(specular), where);
                expectLight(frame, Channel::lit_diffuse, diffuse, 1e-4 * largestOf(diffuse), where);
            }
        }
}

TEST(LayerValues, AFilmWithoutThicknessIsTheBase) {
    Material bare;
    bare.base_color = {0.8f, 0.5f, 0.3f, 1};
    bare.metallic = 0.5f;
    bare.roughness = 0.4f;
    Material thin = bare;
    thin.iridescence = 1;
    thin.iridescence_ior = 1.8f;
    thin.iridescence_thickness_max = 0;
    const glm::dvec3 light = glm::normalize(glm::dvec3(-0.7, 0.2, 0.6));
    const std::vector<Frame> with = bothPaths(tiltedSquare(thin, 40, light), onePixel(1)),
                             without = bothPaths(tiltedSquare(bare, 40, light), onePixel(1));
    for (std::size_t path = 0; path < 2; ++path)
        for (const Channel channel : {Channel::lit, Channel::lit_specular, Channel::lit_ambient})
            expectLight(with[path], channel, glm::dvec3(colorAt(without[path], channel, 0, 0)), 1e-4,
                        "no thickness");
}

}  // namespace
}  // namespace diptych::tests
