// SPDX-License-Identifier: MIT
// Light of sheens and thin films in one pixel of a tilted square, compared with the definitions of
// KHR_materials_sheen and KHR_materials_iridescence.
#include "tests/image/square.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <array>
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
    Light sun;
    sun.kind = LightKind::directional;
    sun.intensity = static_cast<float>(sunlight);
    sun.direction = -l;
    scene.lights = {sun};
    return scene;
}
glm::dvec3 tiltedNormal(double degrees) {
    return {std::sin(glm::radians(degrees)), 0, std::cos(glm::radians(degrees))};
}

Settings onePixel(float ambient = 0) {
    Settings settings = smallPicture(GBufferEncoding::full);
    settings.size = {1, 1};
    settings.ambient = {ambient, ambient, ambient};
    return settings;
}

void expectLight(const Frame& frame, Channel mode, const glm::dvec3& expected, double tolerance,
                 const std::string& where) {
    const glm::vec3 got = colorAt(frame, mode, 0, 0);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(double{got[c]}, expected[c], tolerance)
            << frame.name << " " << debugMode(mode).name << ", " << where;
}

// ---- sheen -------------------------------------------------------------------------------------------

// Estevez and Kulla 2017, "Production Friendly Microfacet Sheen BRDF".
class Fibres {
public:
    explicit Fibres(double roughness) : alpha_(roughness * roughness) {
        constexpr std::array rough{21.5473, 3.82987, 0.19823, -1.97760, -4.32054};
        constexpr std::array smooth{25.3245, 3.32435, 0.16801, -1.27393, -4.85967};
        const double t = (1 - alpha_) * (1 - alpha_);
        for (std::size_t i = 0; i < fit_.size(); ++i) fit_[i] = (1 - t) * rough[i] + t * smooth[i];
    }

    // D V.
    double lobe(const glm::dvec3& n, const glm::dvec3& v, const glm::dvec3& l) const {
        const double n_dot_h = glm::dot(n, glm::normalize(l + v)), n_dot_v = glm::dot(n, v),
                     n_dot_l = glm::dot(n, l), sine = std::sqrt(1 - n_dot_h * n_dot_h);
        const double d = (2 + 1 / alpha_) * std::pow(sine, 1 / alpha_) / (2 * std::numbers::pi);
        return d / ((1 + lambda(n_dot_v) + lambda(n_dot_l)) * 4 * n_dot_v * n_dot_l);
    }

    // The lobe's integral over the hemisphere with the cosine, by midpoints that are dense at the horizon.
    double albedo(double n_dot_v) const {
        constexpr int count = 300;
        const glm::dvec3 v(std::sqrt(1 - n_dot_v * n_dot_v), 0, n_dot_v);
        double sum = 0;
        for (int i = 0; i < count; ++i) {
            const double root = (i + 0.5) / count, cosine = root * root,
                         across = std::sqrt(1 - cosine * cosine);
            for (int j = 0; j < count; ++j) {
                const double azimuth = std::numbers::pi * (j + 0.5) / count;
                const glm::dvec3 l(across * std::cos(azimuth), across * std::sin(azimuth), cosine);
                sum += lobe({0, 0, 1}, v, l) * cosine * 2 * root;
            }
        }
        return sum * 2 * std::numbers::pi / (count * count);
    }

private:
    double curve(double x) const {
        return fit_[0] / (1 + fit_[1] * std::pow(x, fit_[2])) + fit_[3] * x + fit_[4];
    }
    double lambda(double cosine) const {
        return std::exp(cosine < 0.5 ? curve(cosine) : 2 * curve(0.5) - curve(1 - cosine));
    }

    double alpha_;
    std::array<double, 5> fit_{};
};

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
            const Fibres fibres(double{roughness});
            const double direct = sunlight * fibres.lobe(n, toViewer, slanted) * glm::dot(n, slanted),
                         all = fibres.albedo(n.z), left = 1 - 0.9 * all;
            const std::vector<Frame> dark = bothPaths(tiltedSquare(cloth, degrees, slanted), onePixel()),
                                     bright = bothPaths(tiltedSquare(cloth, degrees, slanted), onePixel(3)),
                                     base = bothPaths(tiltedSquare(bare, degrees, slanted), onePixel(3));
            const std::string where = fmt::format("roughness {}, {} degrees", roughness, degrees);
            for (std::size_t path = 0; path < 2; ++path) {
                const auto below = [&](Channel mode) {
                    return left * glm::dvec3(colorAt(base[path], mode, 0, 0));
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
    const double left = 1 - (0.04 + 0.96 * std::pow(1 - n.z, 5));
    const std::vector<Frame> bare = bothPaths(tiltedSquare(cloth, 50, slanted), onePixel(1)),
                             under = bothPaths(tiltedSquare(coated, 50, slanted), onePixel(1));
    for (std::size_t path = 0; path < 2; ++path)
        expectLight(under[path], Channel::lit_sheen,
                    left * glm::dvec3(colorAt(bare[path], Channel::lit_sheen, 0, 0)), 1e-5, "coated");
}

// ---- iridescence -------------------------------------------------------------------------------------

double schlicks(double f0, double f90, double cosine) {
    return f0 + (f90 - f0) * std::pow(1 - cosine, 5);
}

// Belcour and Barla 2017, "A Practical Extension to Microfacet Theory for the Modeling of Varying
// Iridescence": X, Y and Z of a path difference in m, each with its phase, by Gaussians; then linear Rec.709.
glm::dvec3 interferenceColor(double difference, const glm::dvec3& phase) {
    struct Gaussian {
        int component;
        double value, position, variance;
    };
    const double k = 2 * std::numbers::pi * difference;
    glm::dvec3 xyz(0);
    for (const Gaussian& g :
         {Gaussian{0, 5.4856e-13, 1.6810e6, 4.3278e9}, Gaussian{0, 9.7470e-14, 2.2399e6, 4.5282e9},
          Gaussian{1, 4.4201e-13, 1.7953e6, 9.3046e9}, Gaussian{2, 5.2481e-13, 2.2084e6, 6.6121e9}})
        xyz[g.component] += g.value * std::sqrt(2 * std::numbers::pi * g.variance) *
                            std::cos(g.position * k + phase[g.component]) * std::exp(-g.variance * k * k) /
                            1.0685e-7;
    const glm::dmat3 rows(3.2404542, -1.5371385, -0.4985314, -0.9692660, 1.8760108, 0.0415560, 0.0556434,
                          -0.2040259, 1.0572252);
    return xyz * rows;
}

// Fraction that a film of `ior` and `nm` reflects over a material of `f0`: both faces, and two orders of
// interference.
glm::dvec3 filmReflectance(double cosine, const glm::dvec3& f0, double ior, double nm) {
    const double inner = std::sqrt(1 - (1 - cosine * cosine) / (ior * ior)),
                 front = schlicks(std::pow((ior - 1) / (ior + 1), 2), 1, cosine),
                 difference = 2 * ior * nm * 1e-9 * inner;
    glm::dvec3 back, through, phase;
    for (int c = 0; c < 3; ++c) {
        const double index = (1 + std::sqrt(f0[c])) / (1 - std::sqrt(f0[c]));
        back[c] = schlicks(std::pow((index - ior) / (index + ior), 2), 1, inner);
        through[c] = (1 - front) * (1 - front) * back[c] / (1 - front * back[c]);
        phase[c] = index < ior ? 2 * std::numbers::pi : std::numbers::pi;
    }
    glm::dvec3 reflected = front + through;
    for (const double order : {1.0, 2.0})
        reflected += 2.0 * (through - (1 - front)) * glm::pow(front * back, glm::dvec3(order / 2)) *
                     interferenceColor(order * difference, order * phase);
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
            m.iridescence_thickness_most = film.nm;
            const glm::dvec3 n = tiltedNormal(degrees), albedo(m.base_color);
            // At 0 degrees along the normal.
            const glm::dvec3 l = degrees > 0 ? slanted : n;
            const double cosine = glm::dot(toViewer, glm::normalize(l + toViewer)), n_dot_l = glm::dot(n, l);
            const auto filmed = [&](const glm::dvec3& f0) {
                return glm::mix(glm::dvec3(schlicks(f0.r, 1, cosine), schlicks(f0.g, 1, cosine),
                                           schlicks(f0.b, 1, cosine)),
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
    thin.iridescence_thickness_most = 0;
    const glm::dvec3 light = glm::normalize(glm::dvec3(-0.7, 0.2, 0.6));
    const std::vector<Frame> with = bothPaths(tiltedSquare(thin, 40, light), onePixel(1)),
                             without = bothPaths(tiltedSquare(bare, 40, light), onePixel(1));
    for (std::size_t path = 0; path < 2; ++path)
        for (const Channel mode : {Channel::lit, Channel::lit_specular, Channel::lit_ambient})
            expectLight(with[path], mode, glm::dvec3(colorAt(without[path], mode, 0, 0)), 1e-4,
                        "no thickness");
}

}  // namespace
}  // namespace diptych::tests
