// SPDX-License-Identifier: MIT
#include "compare/reference/light/punctual.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace diptych::reference {
namespace {

constexpr double unit = 0x1p-24;  // half a float32's unit in the last place, relative
// Roundings of a unit vector to a light: difference, squared length, root, product.
constexpr double ofDirection = 6 * unit;

}  // namespace

double rangeWindow(double distance, double range, RangeWindow window) {
    if (std::isinf(range)) return 1;
    if (distance >= range) return 0;
    return std::pow(1 - std::pow(distance / range, 4), window == RangeWindow::squared ? 2 : 1);
}

Incident incident(const Light& light, const glm::dvec3& light_position, const glm::dvec3& position,
                  const Falloff& falloff) {
    const glm::dvec3 power = glm::dvec3(light.color) * double{light.intensity};
    if (light.kind == LightKind::directional)
        return {-light.direction, power, std::numeric_limits<double>::infinity(), ofDirection};
    const glm::dvec3 path = light_position - position;
    const double distance = glm::length(path);
    if (!(distance > 0)) return {};
    Incident result{path / distance,
                    power / (distance * distance) * rangeWindow(distance, light.range, falloff.window),
                    distance, unit * glm::length(light_position) / distance + ofDirection};
    result.rounding = 2 * result.angle_error;
    if (const double x = std::pow(distance / light.range, 4); x < 1)
        result.rounding +=
            (falloff.window == RangeWindow::squared ? 8 : 4) * x / (1 - x) * result.angle_error;
    if (light.kind == LightKind::spot) {
        const double outer = std::cos(double{light.outer_cone}), inner = std::cos(double{light.inner_cone});
        // 0.001 is KHR_lights_punctual's constant: it keeps the slope finite for a cone with a hard edge.
        const double inside =
            (-glm::dot(result.to_light, light.direction) - outer) / std::max(0.001, inner - outer);
        const double t = std::clamp(inside, 0.0, 1.0);
        if (t > 0 && t < 1) result.rounding += 2 * result.angle_error / (std::max(0.001, inner - outer) * t);
        // The cubic Hermite curve with zero slope at both ends, or the square.
        result.irradiance *= falloff.cone == SpotFalloff::smoothstep ? 3 * t * t - 2 * t * t * t : t * t;
    }
    return result;
}

}  // namespace diptych::reference
