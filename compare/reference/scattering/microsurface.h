// SPDX-License-Identifier: MIT
// Ground truth for multiple-scattering compensation: a random walk between mirror microfacets. Heitz,
// Hanika, d'Eon and Dachsbacher 2016, "Multiple-Scattering Microfacet BSDFs with the Smith Model".
#pragma once

#include "compare/reference/scattering/sampling.h"
#include "compare/reference/scattering/surface.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <functional>

namespace diptych::reference {

// Mirror facets with a GGX distribution and Smith's independent heights. Directions are unit and point
// away from the surface, in a frame with the normal +Z.
class Microsurface {
public:
    explicit Microsurface(double alpha) : alpha_(alpha) {}  // GGX width, roughness^2, in (0, 1]

    // A facet on a path, and its reflection of a light.
    class Facet {
    public:
        Facet(const Microsurface& surface, const glm::dvec3& back, double height)
            : surface_(surface), back_(back), height_(height) {}

        struct Reflection {
            double cosine;    // between the light and the normal of the facet that mirrors it
            double fraction;  // fraction of the path's radiance from that light with F = 1, 1/sr
        };
        Reflection evaluate(const glm::dvec3& to_light) const;

    private:
        const Microsurface& surface_;
        glm::dvec3 back_;
        double height_;
    };

    // Traces one path that arrives from `from`; returns the direction in which it leaves. Calls
    // visit(facet, cosine) at every facet, with the cosine of the reflection there.
    template <class Visit>
    glm::dvec3 trace(const glm::dvec3& from, Random& random, const Visit& visit) const;

    // The normal of a random facet that is visible from a direction.
    glm::dvec3 visibleNormal(const glm::dvec3& direction, Random& random) const;

private:
    double lambda(const glm::dvec3& w) const;
    // The height of the next facet: the logarithm of the fraction of the surface below it. Above 0: the
    // path leaves.
    double next(const glm::dvec3& on, double height, Random& random) const;

    double alpha_;
};

template <class Visit>
glm::dvec3 Microsurface::trace(const glm::dvec3& from, Random& random, const Visit& visit) const {
    glm::dvec3 on = -from;
    for (double height = 0;;) {
        height = next(on, height, random);
        if (height > 0) return on;
        const glm::dvec3 back = -on, normal = visibleNormal(back, random);
        const double cosine = std::max(glm::dot(back, normal), 0.0);
        visit(Facet(*this, back, height), cosine);
        on = glm::normalize(2 * cosine * normal - back);
    }
}

// Reflections beyond the first, with Schlick's Fresnel at every facet, as without a thin film. Each path sees
// one of a Surface's two materials throughout; their results are mixed as in the BRDF.
class Between {
public:
    explicit Between(const Surface& surface);

    // The fraction of all paths from the viewer that meet at least two facets.
    double fraction() const { return fraction_; }
    // No paths are traced below this fraction of uniform light.
    static constexpr double minFraction = 0.002;

    // A path that meets at least two facets, found by rejection.
    struct Path {
        glm::dvec3 direct{0};     // from `lights`, W/(sr m^2)
        glm::dvec3 direction{0};  // in which the path leaves
        glm::dvec3 weight{0};     // fraction of radiance from `direction` that reaches the viewer
        glm::dvec3 layer{0};      // the same by the dielectric's layer alone
    };
    // `lights` calls its argument with each light's direction and irradiance, W/m^2 perpendicular to it.
    // It is called at every facet from the second on, and may choose another point on a light each time.
    using Add = std::function<void(const glm::dvec3& to_light, const glm::dvec3& irradiance)>;
    Path path(Random& random, const std::function<void(const Add&)>& lights) const;

private:
    Surface surface_;
    Microsurface facets_;
    glm::dvec3 x_, y_, from_;
    double fraction_;
};

}  // namespace diptych::reference
