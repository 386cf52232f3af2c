// SPDX-License-Identifier: MIT
// What compensations approximate: light on a rough surface of mirrors that are lit by each other, by random
// walk. Heitz, Hanika, d'Eon and Dachsbacher 2016, "Multiple-Scattering Microfacet BSDFs with the Smith
// Model".
#pragma once

#include "compare/reference/sampling.h"
#include "compare/reference/surface.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <functional>

namespace diptych::reference {

// Facets distributed as GGX with Smith's independent heights, each a mirror. Directions are unit, in a frame
// with the normal +Z, away from the surface.
class Microsurface {
public:
    explicit Microsurface(double alpha) : alpha_(alpha) {}  // GGX width, roughness^2, in (0, 1]

    // A facet that a path meets, and what it shows of a light.
    class Facet {
    public:
        Facet(const Microsurface& surface, const glm::dvec3& back, double height)
            : surface_(surface), back_(back), height_(height) {}

        struct Seen {
            double cosine;  // of the light's angle to the facet that mirrors it
            double share;   // of a path that arrives here, by facets with F = 1, 1/sr
        };
        Seen of(const glm::dvec3& to_light) const;

    private:
        const Microsurface& surface_;
        glm::dvec3 back_;
        double height_;
    };

    // One path that arrives from `from`, which ends in the direction that is returned. Calls visit(facet,
    // cosine) at every facet: the cosine is that of its reflection there.
    template <class Visit>
    glm::dvec3 trace(const glm::dvec3& from, Random& random, const Visit& visit) const;

private:
    glm::dvec3 facet(const glm::dvec3& seen_from, Random& random) const;
    double lambda(const glm::dvec3& w) const;
    // The height of the next facet: the logarithm of the share of the surface that lies below. Above 0: there
    // is none.
    double next(const glm::dvec3& on, double height, Random& random) const;

    double alpha_;
};

template <class Visit>
glm::dvec3 Microsurface::trace(const glm::dvec3& from, Random& random, const Visit& visit) const {
    glm::dvec3 on = -from;
    for (double height = 0;;) {
        height = next(on, height, random);
        if (height > 0) return on;
        const glm::dvec3 back = -on, normal = facet(back, random);
        const double cosine = std::max(glm::dot(back, normal), 0.0);
        visit(Facet(*this, back, height), cosine);
        on = glm::normalize(2 * cosine * normal - back);
    }
}

// The lobes of a Surface's two materials with Schlick's Fresnel at every facet, mixed as its BRDF is: paths
// of the one material and of the other, never of a mix. What is beyond the first reflection.
class Between {
public:
    explicit Between(const Surface& surface);

    // The share of all paths from the viewer that meet two facets or more.
    double share() const { return share_; }
    // Below this one nothing is followed: less than that share of light from everywhere.
    static constexpr double leastShare = 0.002;

    // One of them: as many are begun as that takes.
    struct Path {
        glm::dvec3 direct{0};     // of `lights`, W/(sr m^2)
        glm::dvec3 direction{0};  // in which it leaves,
        glm::dvec3 weight{0};     // and the share of radiance from there that reaches the viewer,
        glm::dvec3 layer{0};      // by the dielectric's layer alone
    };
    // `lights` calls its argument with the direction and the irradiance of each, W/m^2 across it, once for
    // every facet from the second on; it may choose another point of a light each time.
    using Add = std::function<void(const glm::dvec3& to_light, const glm::dvec3& irradiance)>;
    Path path(Random& random, const std::function<void(const Add&)>& lights) const;

private:
    Surface surface_;
    Microsurface facets_;
    glm::dvec3 x_, y_, from_;
    double share_;
};

}  // namespace diptych::reference
