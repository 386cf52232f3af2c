// SPDX-License-Identifier: MIT
// KHR_materials_transmission, _volume, _dispersion and _ior: refraction, absorption and the lobe of light
// that passes a surface.
#pragma once

#include "compare/reference/scattering/brdf.h"
#include "compare/reference/scattering/lobe_sampler.h"
#include "compare/reference/scattering/surface.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <optional>

namespace diptych::reference {

// Index of refraction of a component, at least 1; infinite for an `ior` of 0. KHR_materials_dispersion
// spreads it about that of green.
double indexOf(const Surface& surface, int component);

// The unit direction into which `along` refracts where it enters a medium of this index, by Snell's law.
// `along`, `normal`: unit; the normal is on the side of the incident light.
glm::dvec3 refractedInto(const glm::dvec3& along, const glm::dvec3& normal, double index);
// The same where it leaves the medium; empty where all light is reflected inside.
std::optional<glm::dvec3> refractedOut(const glm::dvec3& along, const glm::dvec3& normal, double index);

// Fraction of unpolarized light that the boundary of a medium of this index reflects inside it (Fresnel's
// equations); 1 beyond the critical angle. `cosine`: of the angle inside.
double reflectedInside(double cosine, double index);

// Fraction of light that remains after `distance` metres, for each component (Beer and Lambert).
glm::dvec3 attenuationOf(const Surface& surface, double distance);

// Offset by which a slab moves the ray that leaves it towards the viewer, m; the ray stays parallel and
// loses light over the thickness. 0 for a thin wall.
glm::dvec3 slabShift(const Surface& surface, int component);

// The lobe of a rough surface about the direction straight on: GGX's reflection lobe with F = 1, mirrored
// to the far side.
class TransmittedLobe {
public:
    explicit TransmittedLobe(const Surface& surface);

    // Whether all light comes from straight on: the lobe is not wider than the narrowest of the model.
    bool isOneRay() const { return !brdf_; }

    // `weight`: light from there as a fraction of the lobe's, over the density; its mean is 1.
    struct Sample {
        glm::dvec3 direction;  // unit, away from the viewer
        double weight;
    };
    Sample operator()(const glm::dvec2& u) const;  // u in [0, 1)^2

private:
    std::optional<Brdf> brdf_;
    std::optional<LobeSampler> sampler_;
    double whole_ = 1;  // the lobe's integral
    glm::dvec3 normal_, straight_;
};

// Whether light from behind arrives from elsewhere than straight on.
bool isBent(const Surface& surface);

}  // namespace diptych::reference
