// SPDX-License-Identifier: MIT
// Surfaces with transmission: the light that passes them.
#include "compare/reference/pixel_renderer.h"
#include "compare/reference/scattering/adaptive_sampling.h"
#include "compare/reference/scattering/sampling.h"
#include "compare/reference/scattering/transmission.h"
#include "shared/scene/model/luminance.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace diptych::reference {
namespace {

constexpr double forever = std::numeric_limits<double>::infinity();

// A ray from a point, for single samples: their textures are not filtered.
PixelRay rayFrom(const glm::dvec3& origin, const glm::dvec3& direction) {
    return {.origin = origin, .direction = direction};
}

}  // namespace

std::optional<Hit> PixelRenderer::paneBefore(double end, const PixelRay& ray) const {
    Ray search = cameraRay(ray, 0);
    search.to = std::min(search.to, end);
    return geometry_.nearest(
        search, [&](const Hit& hit) { return materials_.transmits(hit) && materials_.isThere(hit, &ray); });
}

PixelRenderer::Sent PixelRenderer::sentAlong(const PixelRay& ray, const Ray& search,
                                             std::uint64_t seed) const {
    const std::optional<Hit> hit = geometry_.nearest(
        search, [&](const Hit& met) { return !materials_.blends(met) && materials_.isThere(met, &ray); });
    const glm::dvec3 along = glm::normalize(ray.direction),
                     start = search.origin + search.direction * search.from;
    if (!hit) {
        PixelRay behind = ray;
        behind.origin = start;
        return {background(behind)};
    }
    Standing standing = standingAt(*hit, ray);
    standing.surface.to_viewer = -along;
    const Shading shading = lighting_(standing.surface, visibilityFrom(standing.foot), seed);
    Sent sent{shading.all() + emitted(standing.surface), shading.uncertainty};
    if (haze_) {
        const Hazed haze = haze_->along(start, along, glm::dot(hit->position - start, along));
        sent.radiance = sent.radiance * haze.transmittance + haze.scattered;
    }
    return sent;
}

// Straight on, the pixel's own ray goes on, moved by the slab: its textures are filtered as without the pane.
// An opaque surface at the same depth as the pane is behind it.
PixelRenderer::Passed PixelRenderer::passedAs(const Pane& pane, int component,
                                              const TransmittedLobe::Sample& lobe, std::uint64_t seed) const {
    const Surface& s = *pane.pixel.surface;
    const glm::dvec3 fraction = pane.tint * attenuationOf(s, s.thickness) * lobe.weight,
                     shift = slabShift(s, component);
    if (fraction == glm::dvec3(0)) return {};
    Sent sent;
    if (lobe.direction == -s.to_viewer) {
        PixelRay ray = pane.ray;
        ray.origin += s.position + shift - (ray.origin + ray.direction * pane.hit.t);
        const double from = pane.hit.t * (1 - 2e-6);
        sent = sentAlong(ray, {ray.origin, ray.direction, from, request_.view.camera.far}, seed);
    } else {
        const PixelRay ray = rayFrom(s.position + shift, lobe.direction);
        sent = sentAlong(ray, {ray.origin, ray.direction, 0, forever, pane.hit.id}, seed);
    }
    return {sent.radiance * fraction, fraction,
            sent.uncertainty * std::max({fraction.r, fraction.g, fraction.b})};
}

PixelRenderer::Passed PixelRenderer::passedMesh(const Pane& pane, int component, std::uint64_t seed) const {
    const Surface& s = *pane.pixel.surface;
    Random random(seed);
    const std::optional<MeshPaths::End> end = mesh_paths_(pane.hit, s, indexOf(s, component), random);
    if (!end) return {};
    const glm::dvec3 fraction = pane.tint * attenuationOf(s, end->length);
    const PixelRay ray = rayFrom(end->origin, end->direction);
    const Sent sent =
        sentAlong(ray, {end->origin, end->direction, end->from, forever, end->without}, streamOf(seed, 1));
    return {sent.radiance * fraction, fraction,
            sent.uncertainty * std::max({fraction.r, fraction.g, fraction.b})};
}

bool PixelRenderer::goesThroughMesh(const Hit& hit) const {
    return request_.mode == ReferenceMode::scene && materials_.isThick(hit) && hit.front;
}

PixelRenderer::Passed PixelRenderer::passedThrough(const Pane& pane, std::uint64_t seed) const {
    const Surface& s = *pane.pixel.surface;
    if (pane.tint == glm::dvec3(0)) return {};
    const bool mesh = goesThroughMesh(pane.hit);
    const TransmittedLobe lobe(s);
    // Components that refract apart have ways of their own.
    const auto passed = [&](const auto& of) {
        if (!(s.dispersion > 0) || !(mesh || s.thickness > 0)) return of(1);
        Passed all;
        for (int c = 0; c < 3; ++c) {
            const Passed one = of(c);
            all.radiance[c] = one.radiance[c];
            all.fraction[c] = one.fraction[c];
            all.uncertainty = std::max(all.uncertainty, one.uncertainty);
        }
        return all;
    };
    if (!mesh && lobe.isOneRay())
        return passed([&](int c) { return passedAs(pane, c, {-s.to_viewer, 1}, seed); });
    std::array<glm::dvec2, 8> shifts;
    Random random(streamOf(seed, 0));
    for (glm::dvec2& shift : shifts) {
        const double u = random();
        shift = {u, random()};
    }
    glm::dvec3 fraction(0);
    std::size_t count = 0;
    // Each sample shades a surface with all lights, so it counts as many. A branch in a mesh that one path in
    // 25 takes, as in glass, is among the first 256 paths but for one pixel in 30,000.
    constexpr std::size_t worth = 16;
    const std::uint64_t first = mesh ? 32 : 8;
    const Estimated found = sampleUntilConfident(
        [&](std::size_t round, std::uint64_t index) {
            const std::uint64_t stream = streamOf(streamOf(seed, round + 1), index);
            const Passed one = passed([&](int c) {
                return mesh ? passedMesh(pane, c, stream)
                            : passedAs(pane, c, lobe(evenly(index, shifts[round])), stream);
            });
            fraction += one.fraction;
            ++count;
            return Reflected{.transmitted = one.radiance};
        },
        worth, first, 0, 0);
    return {found.value.transmitted, fraction / static_cast<double>(count), found.uncertainty};
}

// The light behind has the haze of its whole way: that in front of the pane, and that behind it. The pane's
// own haze counts for the fraction that it hides.
double PixelRenderer::withPane(Pixel& pixel, double& end, const PixelRay& ray, std::uint64_t seed) const {
    const std::optional<Hit> hit = paneBefore(end, ray);
    if (!hit) return 1;
    Pixel here = shaded(*hit, ray, streamOf(seed, 0));
    const glm::dvec3 tint = transmitted(*here.surface);
    const Passed passed = passedThrough({*hit, here, ray, tint}, streamOf(seed, 1));
    const Hazed& haze = here.haze;
    const glm::dvec3 light = passed.radiance * haze.transmittance + haze.scattered * passed.fraction,
                     own = here.lit - haze.scattered * passed.fraction;
    const double coverage = materials_.coverage(*hit, ray);
    pixel.lit = pixel.lit * (1 - coverage) + (own + light) * coverage;
    here.shading.uncertainty +=
        passed.uncertainty * std::max({haze.transmittance.r, haze.transmittance.g, haze.transmittance.b});
    pixel.blended += here.shading * coverage;
    pixel.transmitted = light * coverage;
    pixel.pane = here.surface;
    if (goesThroughMesh(*hit) || isBent(*here.surface))
        pixel.bent = coverage * std::max({tint.r, tint.g, tint.b});
    end = hit->t * (1 + 1e-6);
    return 1 - coverage * (1 - std::clamp(luminance(passed.fraction), 0.0, 1.0));
}

}  // namespace diptych::reference
