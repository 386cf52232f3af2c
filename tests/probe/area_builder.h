// SPDX-License-Identifier: MIT
// Area lights for the probe area.comp, with expected results from the reference and from the table alone.
#pragma once

#include "compare/reference/light/lighting.h"
#include "shared/contract/features.h"
#include "shared/light/fit/lobe.h"
#include "shared/light/lights.h"
#include "shared/light/ltc.h"
#include "tests/probe/probe.h"
#include "tests/support/light_kinds.h"
#include "tests/support/reference_builder.h"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <stdexcept>
#include <vector>

namespace diptych::tests {

constexpr std::size_t areaWidth = 35;

// Surface at the origin with normal +Z.
struct Receiver {
    double roughness = 0.5, metallic = 1, albedo = 1, f0 = 0.04, f90 = 1;
    glm::dvec3 to_viewer{0, 0, 1};
    double nDotV() const { return std::max(to_viewer.z, double{gpu::MIN_N_DOT_V}); }
};
inline glm::dvec3 viewAt(double degrees, double azimuth = 0) {
    return reference::polar(degrees * std::numbers::pi / 180, azimuth);
}

inline void pushArea(std::vector<float>& input, const Light& light, const Receiver& r) {
    const GpuLights lights = gpuLights(std::span(&light, 1), {0, 0, 0});
    const gpu::Light& l = lights.lights.at(0);
    const gpu::AreaLight& s = lights.area_lights.at(0);
    const auto push = [&](const auto&... values) { (input.push_back(static_cast<float>(values)), ...); };
    const auto push3 = [&](const auto& v) { push(v.x, v.y, v.z); };
    push(indexOf(light.kind) - indexOf(areaKinds.front()));
    push3(l.position), push3(s.x), push(s.radius), push3(s.y), push(s.extent), push3(s.direction);
    push(s.two_sided, l.inverse_range_squared);
    push3(r.to_viewer), push(r.roughness, r.metallic, r.albedo, r.f0, r.f90);
    const LtcCell cell = ltcTable().at(r.roughness, r.nDotV());
    for (const LtcLobe& lobe : {cell.even, cell.layer})
        push(lobe.in_plane, lobe.across, lobe.unsheared, lobe.tilt);
    push(cell.magnitude, cell.fresnel);
}

// {diffuse, specular} radiance of each row for a light of radiance 1.
inline std::vector<std::array<double, 2>> shadeArea(Probes& probes, const std::vector<float>& input,
                                                    bool points = false, gpu::uint multiscatter = 0) {
    const std::vector<float> out = probes.run("area", input, areaWidth, 2,
                                              {{gpu::FEATURE_area_lights, points ? gpu::AREA_POINTS : 0},
                                               {gpu::FEATURE_multiscatter, multiscatter}});
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
    const reference::Shading shading = reference::Lighting({.lights = std::span(&white, 1)})(s, {}, 1);
    return {shading.reflected.diffuse.g, shading.reflected.specular.g};
}

// Integral of p / pi over the light's directions p under the transformed cosine, in its frame. Lambert's
// formula in double: the outline is transformed vertex by vertex and clipped at the horizon.
inline glm::dvec3 factorOf(const Light& light, const ltc::Transform& t, const glm::dvec3& to_viewer) {
    const bool flat = !isClosed(light.kind);
    if (flat && !light.two_sided && glm::dot(light.position, light.direction) >= 0) return {};
    const double sine = std::hypot(to_viewer.x, to_viewer.y);
    const double cx = sine > 1e-9 ? -to_viewer.x / sine : 1, cy = sine > 1e-9 ? -to_viewer.y / sine : 0;
    std::vector<glm::dvec3> outline = outlineOf(light), above;
    for (glm::dvec3& p : outline)
        p = glm::normalize(t.toCosine({cx * p.x + cy * p.y, cx * p.y - cy * p.x, p.z}));
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const glm::dvec3 p = outline[i], q = outline[(i + 1) % outline.size()];
        if (p.z >= 0) above.push_back(p);
        if ((p.z < 0) != (q.z < 0)) above.push_back((p * q.z - q * p.z) / (q.z - p.z));
    }
    glm::dvec3 sum{};
    for (std::size_t i = 0; i < above.size(); ++i) {
        const glm::dvec3 p = above[i], q = above[(i + 1) % above.size()], across = glm::cross(p, q);
        const double size = glm::length(across);
        if (size > 0) sum += across * (std::atan2(size, glm::dot(p, q)) / size);
    }
    return sum * ((sum.z < 0 ? -1 : 1) / (2 * reference::pi));
}
// Fraction of the transformed cosine that the light covers.
inline double fractionOfSky(const Light& light, const ltc::Transform& t, const glm::dvec3& to_viewer) {
    const glm::dvec3 factor = factorOf(light, t, to_viewer);
    return std::clamp(factor.z + t.tilt * factor.x, 0.0, 1.0);
}

// F0 and F90, interpolated by `metallic`.
inline glm::dvec2 fresnelOf(const Receiver& r) {
    return {std::lerp(r.f0, r.albedo, r.metallic), std::lerp(r.f90, 1.0, r.metallic)};
}
inline ltc::Transform transformOf(const LtcCell& cell, const Receiver& r) {
    const glm::dvec2 f = fresnelOf(r);
    return ltc::transformOf(cell.lobe(f.x, f.y), r.roughness * r.roughness, r.nDotV());
}
// Specular result of the shader for a covered fraction, with mean direction l under the transformed cosine
// (in the lobe's frame): the lobe's own value for a small light, the sky's reflection for a large one.
inline double specularOf(double fraction, const glm::dvec3& l, const LtcCell& cell, const Receiver& r) {
    const glm::dvec2 f = fresnelOf(r);
    const ltc::Lobe::Value value = ltc::Lobe(r.roughness * r.roughness, r.nDotV())(l);
    const double sky = cell.reflected(f.x, f.y), density = std::max(transformOf(cell, r).density(l), 1e-20);
    const double there = std::min(value.lobe * std::lerp(f.x, f.y, value.schlick) / density, 4 * sky);
    return std::min(std::lerp(there, sky, std::pow(fraction, 0.25)) * fraction, sky);
}
inline double specularOf(const Light& light, const LtcCell& cell, const Receiver& r) {
    const ltc::Transform t = transformOf(cell, r);
    const glm::dvec3 factor = factorOf(light, t, r.to_viewer);
    if (!(factor.z > 0)) return 0;
    const double fraction = std::clamp(factor.z + t.tilt * factor.x, 0.0, 1.0);
    return specularOf(fraction, glm::normalize(t.fromCosine(factor)), cell, r);
}

}  // namespace diptych::tests
