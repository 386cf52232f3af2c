// SPDX-License-Identifier: MIT
// KHR_materials_sheen: Estevez and Kulla 2017, "Production Friendly Microfacet Sheen BRDF".
#pragma once

#include "compare/reference/scattering/surface.h"

#include <glm/vec3.hpp>

namespace diptych::reference {

inline bool hasSheen(const Surface& surface) {
    return surface.sheen_color != glm::dvec3(0);
}
// The sheen as a surface of its own, black below.
Surface sheenOf(const Surface& surface);
// The same surface without its sheen.
Surface underSheen(const Surface& surface);
// Fraction of its light that what lies under the sheen keeps; 1 without a sheen. It depends on the view
// alone, as the extension allows.
double sheenAlbedoScaling(const Surface& surface);

// The lobe with the colour 1, for one view direction.
class SheenLobe {
public:
    SheenLobe(double roughness, double n_dot_v);

    // D V n.l, 1/sr. All cosines are between 0 and 1.
    double operator()(double n_dot_l, double n_dot_h) const {
        return distribution(1 - n_dot_h * n_dot_h) * visibility(n_dot_l);
    }
    // D, 1/sr, by the squared sine between half vector and normal.
    double distribution(double sine2) const;
    // V n.l: it has a limit at the horizon, unlike V.
    double visibility(double n_dot_l) const { return 1 / ((1 + lambda_v_ + lambda(n_dot_l)) * 4 * n_dot_v_); }
    double viewCosine() const { return n_dot_v_; }

private:
    double lambda(double cosine) const;
    double logarithm(double cosine) const;

    double inverse_alpha_, n_dot_v_;
    double a_, b_, c_, d_, e_;  // of the fit to Lambda
    double lambda_v_;
};

// The integral of the lobe with the colour 1 over the hemisphere, accurate to 2e-5. It exceeds 1 at grazing
// views of roughness below 0.3.
double sheenAlbedo(double roughness, double n_dot_v);

}  // namespace diptych::reference
