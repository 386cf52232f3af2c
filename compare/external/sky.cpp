// SPDX-License-Identifier: MIT
#include "compare/external/sky.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace diptych::external {
namespace {

constexpr double pi = glm::pi<double>();

// Direction in the original environment that appears at `direction` after mirroring and rotation.
glm::dvec3 before(const glm::dvec3& direction, const SkyInterpretation& interpretation) {
    const double angle = glm::radians(-interpretation.rotation), c = std::cos(angle), s = std::sin(angle);
    const glm::dvec3 unrotated(c * direction.x + s * direction.z, direction.y,
                               -s * direction.x + c * direction.z);
    return {interpretation.mirrored ? -unrotated.x : unrotated.x, unrotated.y, unrotated.z};
}

// Environment pixels as directional lights: direction, and irradiance / pi at normal incidence.
class Texels {
public:
    explicit Texels(const Image& sky) {
        for (int y = 0; y < sky.height; ++y) {
            const double polar = pi * (y + 0.5) / sky.height;
            const double solid_angle = 2 * pi / sky.width * pi / sky.height * std::sin(polar);
            for (int x = 0; x < sky.width; ++x) {
                const double azimuth = 2 * pi * (x + 0.5) / sky.width - pi;
                const glm::dvec3 direction(std::sin(polar) * std::sin(azimuth), std::cos(polar),
                                           -std::sin(polar) * std::cos(azimuth));
                const glm::dvec3 radiance(sky.at(x, y, 0), sky.at(x, y, 1), sky.at(x, y, 2));
                texels_.push_back({direction, radiance * solid_angle / pi,
                                   glm::min(radiance, glm::dvec3(1)) * solid_angle / pi});
            }
        }
    }
    glm::dvec3 lightOn(const glm::dvec3& normal, bool cut_off) const {
        glm::dvec3 sum(0);
        for (const Texel& texel : texels_)
            if (const double cosine = glm::dot(texel.direction, normal); cosine > 0)
                sum += (cut_off ? texel.cut_off : texel.light) * cosine;
        return sum;
    }

private:
    struct Texel {
        glm::dvec3 direction, light, cut_off;
    };
    std::vector<Texel> texels_;
};

}  // namespace

glm::dvec3 lightFrom(const Image& sky, const glm::dvec3& normal, bool cut_off) {
    return Texels(sky).lightOn(normal, cut_off);
}

SkyInterpretation skyInterpretation(const Image& sky, std::span<const TiltedFace> faces) {
    const Texels texels(sky);
    double all = 0;
    for (const TiltedFace& face : faces) all += glm::dot(face.radiance, face.radiance);
    const auto tried = [&](SkyInterpretation interpretation) {
        double products = 0, squares = 0;
        std::vector<glm::dvec3> light;
        for (const TiltedFace& face : faces) {
            light.push_back(texels.lightOn(before(face.normal, interpretation), interpretation.cut_off));
            products += glm::dot(face.radiance, light.back());
            squares += glm::dot(light.back(), light.back());
        }
        interpretation.factor = squares > 0 ? products / squares : 1;
        double rest = 0;
        for (std::size_t i = 0; i < faces.size(); ++i) {
            const glm::dvec3 off = faces[i].radiance - interpretation.factor * light[i];
            rest += glm::dot(off, off);
        }
        interpretation.residual = all > 0 ? std::sqrt(rest / all) : 0;
        return interpretation;
    };
    const SkyInterpretation as_expected = tried({});
    SkyInterpretation best = as_expected;
    for (const bool cut_off : {false, true})
        for (const bool mirrored : {false, true})
            for (int rotation = -175; rotation <= 180; rotation += 5)
                if (const SkyInterpretation one = tried({mirrored, double(rotation), cut_off, 1, 0});
                    one.residual < best.residual)
                    best = one;
    if (!(best.residual < 0.5 * as_expected.residual)) return as_expected;
    // Prefer a simpler explanation if its residual is hardly larger: no clipping, or a multiple of 90
    // degrees.
    constexpr double hardly = 1.25, noise = 0.01;
    const auto isAsGood = [&](const SkyInterpretation& one) {
        return one.residual < hardly * best.residual + noise;
    };
    for (const double rotation : {0.0, 90.0, 180.0, -90.0})
        for (const bool mirrored : {false, true})
            for (const bool cut_off : {false, true})
                if (const SkyInterpretation one = tried({mirrored, rotation, cut_off, 1, 0}); isAsGood(one))
                    return one;
    return best;
}

}  // namespace diptych::external
