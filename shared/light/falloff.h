// SPDX-License-Identifier: MIT
// Falloff of lights on the host, as shaders/lib/lights/punctual_lights.glsl computes it.
#pragma once

#include <algorithm>

namespace diptych {

// Both factors are in [0, 1] and never grow with the distance or the angle from the axis.
struct LightFalloff {
    bool squared_window = false;  // --range-window squared
    bool smooth_cones = false;    // --spot-cone smoothstep

    // Factor of the range at `x`, the squared distance by the squared range; exactly 0 from 1 on.
    double window(double x) const {
        const double factor = x < 1 ? 1 - x * x : 0;
        return squared_window ? factor * factor : factor;
    }

    // Factor of a spot at `c`, linear in the cosine: 0 at the outer angle, 1 at the inner; clamped here.
    double cone(double c) const {
        c = std::clamp(c, 0.0, 1.0);
        return smooth_cones ? c * c * (3 - 2 * c) : c * c;
    }
};

}  // namespace diptych
