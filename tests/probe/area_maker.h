// SPDX-License-Identifier: MIT
// Area lights for the probe area.comp, and what they should give: by the reference, and by the table alone.
#pragma once

#include "compare/reference/lighting.h"
#include "shared/contract/features.h"
#include "shared/light/fit/lobe.h"
#include "shared/light/lights.h"
#include "shared/light/ltc.h"
#include "tests/probe/probe.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <stdexcept>
#include <vector>

namespace diptych::tests {

constexpr std::size_t areaWidth = 30;

// A surface in the origin with the normal +Z.
struct Receiver {
    double roughness = 0.5, metallic = 1, albedo = 1, f0 = 0.04, f90 = 1;
    glm::dvec3 to_viewer{0, 0, 1};
    double nDotV() const { return std::max(to_viewer.z, double{gpu::MIN_N_DOT_V}); }
};
inline glm::dvec3 viewAt(double degrees, double azimuth = 0) {
    const double angle = degrees * std::numbers::pi / 180;
    return {std::sin(angle) * std::cos(azimuth), std::sin(angle) * std::sin(azimuth), std::cos(angle)};
}

inline void pushArea(std::vector<float>& input, const Light& light, const Receiver& r) {
    const GpuLights lights = gpuLights(std::span(&light, 1), {0, 0, 0});
    const gpu::Light& l = lights.lights.at(0);
    const gpu::AreaLight& s = lights.area_lights.at(0);
    const auto push = [&](const auto&... values) { (input.push_back(static_cast<float>(values)), ...); };
    const auto push3 = [&](const auto& v) { push(v.x, v.y, v.z); };
    push(light.kind == LightKind::rect ? 0 : light.kind == LightKind::disc ? 1 : 2);
    push3(l.position), push3(s.x), push(s.radius), push3(s.y), push(s.extent), push3(s.direction);
    push(s.two_sided, l.inverse_range_squared);
    push3(r.to_viewer), push(r.roughness, r.metallic, r.albedo, r.f0, r.f90);
    const LtcCell cell = ltcTable().at(r.roughness, r.nDotV());
    push(cell.in_plane, cell.across, cell.unsheared, cell.magnitude, cell.fresnel);
}

// Each row's {diffuse, specular} radiance for a light of radiance 1.
inline std::vector<std::array<double, 2>> shadeArea(Probes& probes, const std::vector<float>& input,
                                                    std::uint32_t how = gpu::AREA_LIGHTS_LTC) {
    const std::vector<float> out = probes.run("area", input, areaWidth, 2, {gpu::FEATURE_area_lights, how});
    std::vector<std::array<double, 2>> rows;
    for (std::size_t i = 0; i + 1 < out.size(); i += 2) rows.push_back({double{out[i]}, double{out[i + 1]}});
    return rows;
}

inline std::array<double, 2> referenceArea(const Light& light, const Receiver& r) {
    reference::Surface s;
    s.to_viewer = r.to_viewer;
    s.albedo = glm::dvec3(r.albedo);
    s.metallic = r.metallic;
    s.roughness = r.roughness;
    s.dielectric_f0 = glm::dvec3(r.f0);
    s.dielectric_f90 = r.f90;
    Light white = light;
    white.color = glm::vec3(1);
    white.intensity = 1;
    const reference::Shading shading =
        reference::Lighting(std::span(&white, 1), nullptr, 1, {0, 0, 0})(s, {}, 1);
    return {shading.reflected.diffuse.g, shading.reflected.specular.g};
}

// The share of the sky that a light has under a transformed cosine, in double: the reference's patches, transformed,
// by adaptive quadrature. `l` of Transform is in the frame whose x points away from the viewer.
inline double shareOfSky(const Light& light, const ltc::Transform& t, const glm::dvec3& to_viewer) {
    const reference::Emitter emitter = reference::emitterOf(light, {0, 0, 0});
    const double sine = std::hypot(to_viewer.x, to_viewer.y);
    const double cx = sine > 1e-9 ? -to_viewer.x / sine : 1, cy = sine > 1e-9 ? -to_viewer.y / sine : 0;
    const auto toCosine = [&](const glm::dvec3& p) {
        const double x = cx * p.x + cy * p.y, y = cx * p.y - cy * p.x;
        return glm::dvec3((x - t.b * p.z) / t.a, y / t.c, p.z);
    };
    double sum = 0;
    for (const reference::Patch& patch : reference::visiblePatches(emitter, emitter.centre, {0, 0, 1})) {
        const auto place = [&](double u, double v) { return toCosine(patch.at(u, v).place); };
        // A patch's normal and area become those of the transformed patch by the cofactors of M^-1.
        const auto integrand = [&](double u, double v) {
            const reference::Patch::Point at = patch.at(u, v);
            const glm::dvec3 p = toCosine(at.place);
            const double p2 = glm::dot(p, p);
            if (!(p2 > 0) || !(p.z > 0)) return reference::Reflected{};
            // p'.(cof N) = det (M^-1) p.N, for p' = M^-1 p.
            const double facing = std::max(-glm::dot(at.place, at.normal), 0.0) / (t.a * t.c);
            return reference::Reflected{glm::dvec3(facing * p.z * at.area / (p2 * p2)), glm::dvec3(0)};
        };
        const auto mustSplit = [&](const reference::Cell& c) {
            const double u = (c.u0 + c.u1) / 2, v = (c.v0 + c.v1) / 2;
            const glm::dvec3 middle = glm::normalize(place(u, v));
            const auto from = [&](double a, double b) { return glm::length(glm::normalize(place(a, b)) - middle); };
            const double across_u = std::max(from(c.u0, v), from(c.u1, v));
            const double across_v = std::max(from(u, c.v0), from(u, c.v1));
            if (std::max(across_u, across_v) < 0.3) return reference::Split::none;
            return across_u > across_v ? reference::Split::u : reference::Split::v;
        };
        sum += reference::Quadrature(integrand, mustSplit, 1e-6, nullptr)().value.diffuse.g;
    }
    return sum / std::numbers::pi;
}

}  // namespace diptych::tests
