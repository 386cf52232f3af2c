// SPDX-License-Identifier: MIT
#include "compare/reference/pixel_renderer.h"

#include "compare/reference/channels.h"
#include "compare/reference/light/area.h"
#include "compare/reference/light/punctual.h"
#include "compare/reference/light/shadow_edge.h"
#include "compare/reference/resolve.h"
#include "compare/reference/scattering/sampling.h"
#include "shared/scene/model/axes.h"
#include "shared/scene/model/luminance.h"
#include "shared/scene/motion/bounds.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <tuple>
#include <utility>

namespace diptych::reference {
namespace {

constexpr double nowhere = std::numeric_limits<double>::infinity();

LightingInputs lightingInputs(const Request& request, const glm::dvec3& eye) {
    return {.lights = request.lights,
            .environment = request.environment(),
            .environment_factor = request.environment_factor,
            .environment_rotation = request.environment_rotation,
            .eye = eye,
            .ambient = request.ambient,
            .casters = request.casters,
            .shadowed_environment = request.shadowed_environment,
            .multiscatter = request.multiscatter,
            .falloff = request.falloff};
}

}  // namespace

bool isLocal(const Light& light) {
    return light.kind == LightKind::point || light.kind == LightKind::spot;
}

bool blendsSomewhere(const Request& request) {
    return std::ranges::any_of(materialsOf(request.scene, request.pose), isSeenThrough);
}

PixelRenderer::PixelRenderer(const Request& request)
    : request_(request),
      eye_(request.view.eye()),
      rays_(request.view),
      geometry_(request.scene, request.pose, eye_, request.skin_normals == SkinNormals::blended),
      materials_(request.scene, request.pose, geometry_),
      mesh_paths_(geometry_, materials_),
      lighting_(lightingInputs(request, eye_)),
      blends_(request.blended && blendsSomewhere(request)),
      scene_radius_(worldBounds(request.scene, request.pose).radius()) {
    if (request.air) haze_.emplace(*request.air, eye_);
    if (request.environment_costs) lighting_.takeCosts();
    if (request.surroundings) lighting_.takeSurroundings();
    for (const std::size_t caster : request.casters)
        if (!sun_ && request.lights[caster].kind == LightKind::directional) sun_ = &request.lights[caster];
    for (const std::size_t caster : request.casters)
        if (isLocal(request.lights[caster])) locals_.push_back(&request.lights[caster]);
    if (request.residual && request.scene.environment)
        background_.emplace(*request.scene.environment, request.environment_factor,
                            request.environment_rotation);
}

Pixel PixelRenderer::withDecoded(int x, int y, Pixel pixel) const {
    const std::uint64_t seed = seedOf(x, y);
    const std::optional<Standing> standing = capturedAt(x, y);
    if (!standing) return pixel;
    Surface s = Captured(*request_.decoded, materialsOf(request_.scene, request_.pose))
                    .surface(seed, rays_, standing->surface.material);
    s.position = standing->surface.position;
    s.to_viewer = standing->surface.to_viewer;
    s.base_layer = request_.base_layer;
    const glm::dvec3 own = pixel.shading.all() + emitted(standing->surface);
    Visibility visible;
    if (request_.shadows() || request_.surroundings) visible = visibilityFrom(standing->foot);
    pixel.shading = lighting_(s, visible, seed);
    if (!pixel.pane) pixel.transmitted = pixel.shading.from_behind;
    pixel.lit += (pixel.shading.all() + emitted(s) - own) * pixel.haze.transmittance * (1 - pixel.hidden);
    return pixel;
}

Pixel PixelRenderer::render(int x, int y) const {
    const std::uint64_t seed = seedOf(x, y);
    return request_.mode == ReferenceMode::surface ? renderCaptured(x, y, seed) : renderScene(x, y, seed);
}

void PixelRenderer::takeTerms(int x, int y, PixelLight& pixel) const {
    const std::optional<Standing> standing = request_.mode == ReferenceMode::surface
                                                 ? capturedAt(x, y)
                                                 : tracedAt(rays_.through(x + 0.5, y + 0.5));
    if (!standing) return;
    const Visibility visible = visibilityFrom(standing->foot);
    const auto shade = [&](const LightingInputs& inputs) {
        return Lighting(inputs)(standing->surface, visible, seedOf(x, y));
    };
    LightingInputs one = lightingInputs(request_, eye_);
    one.environment = nullptr;
    one.ambient = glm::dvec3(0);
    constexpr std::size_t first = 0;
    for (std::size_t i = 0; i < request_.lights.size(); ++i) {
        const bool casts = std::ranges::find(request_.casters, i) != request_.casters.end();
        one.lights = request_.lights.subspan(i, 1);
        one.casters = std::span(&first, casts ? 1 : 0);
        Shading shading = shade(one);
        shading.ambient = glm::dvec3(0);  // a lightmap's, which would be added to every light
        pixel.lights.push_back(shading);
    }
    LightingInputs others = lightingInputs(request_, eye_);
    others.lights = {};
    others.casters = {};
    pixel.without_lights = shade(others);
}

std::uint64_t PixelRenderer::seedOf(int x, int y) const {
    return static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(request_.view.width) +
           static_cast<std::uint64_t>(x);
}

Visibility PixelRenderer::visibilityFrom(const Foot& foot) const {
    if (!request_.shadows() && !request_.surroundings) return {};
    const double from = foot.offset * glm::length(foot.position);
    return [this, foot, from](const glm::dvec3& to_light, double distance) {
        if (!foot.normalTowards(to_light)) return false;
        const Ray ray{foot.position, to_light, from, distance * (1 - lightOffset), foot.without};
        return !geometry_.meets(ray, [this](const Hit& hit) { return materials_.throwsShadow(hit); });
    };
}

double PixelRenderer::seenOfDisc(const Foot& foot, std::uint64_t seed) const {
    const int samples = std::max(request_.samples, minDiscSamples);
    const double radius = emitterOf(*sun_, {}).radius;
    const glm::dvec3 centre = -sun_->direction, x = perpendicularTo(centre), y = glm::cross(centre, x);
    const Visibility visible = visibilityFrom(foot);
    Random random(streamOf(seed, discStream));
    const double u = random();
    const glm::dvec2 shift(u, random());
    int seen = 0;
    for (int i = 0; i < samples; ++i) {
        const glm::dvec2 at = evenly(static_cast<std::uint64_t>(i), shift);
        const double out = radius * std::sqrt(at.x), around = 2 * std::numbers::pi * at.y;
        seen += visible(glm::normalize(centre + out * (x * std::cos(around) + y * std::sin(around))),
                        std::numeric_limits<double>::infinity());
    }
    return static_cast<double>(seen) / samples;
}

void PixelRenderer::takeShadow(Pixel& pixel, const Surface& s, const Foot& foot, std::uint64_t seed) const {
    pixel.sun_visibility = 1;
    if (!sun_) return;
    const glm::dvec3 to_light = -sun_->direction;
    const auto sees = [&](const glm::dvec3& location) {
        Foot there = foot;
        there.position = location;
        return visibilityFrom(there)(to_light, std::numeric_limits<double>::infinity());
    };
    pixel.sun_visibility = sun_->angle > 0 ? seenOfDisc(foot, seed) : sees(foot.position) ? 1 : 0;
    const std::optional<glm::dvec3> normal = foot.normalTowards(to_light);
    if (!normal) return;
    const bool partly = pixel.sun_visibility > 0 && pixel.sun_visibility < 1;
    pixel.edge_distance =
        partly ? 0 : edgeDistance(sees, foot.position, *normal, to_light, 2 * scene_radius_);
    const glm::dvec3 irradiance = incident(*sun_, {}, {}).irradiance;
    pixel.sun_radiance = (lighting_.reflectance(s, to_light) * irradiance).size();
    const double n_dot_l = glm::dot(s.normal, to_light);
    pixel.sun_irradiance =
        std::max(foot.both_sides ? std::abs(n_dot_l) : n_dot_l, 0.0) * luminance(irradiance);
}

void PixelRenderer::takeLocalShadows(Pixel& pixel, const Surface& s, const Foot& foot) const {
    pixel.local_visibility = 1;
    double all = 0, seen = 0;
    for (const Light* const light : locals_) {
        const glm::dvec3 position = light->position - eye_;
        const Incident here = incident(*light, position, foot.position, request_.falloff);
        const double weight = luminance(here.irradiance);
        if (!(weight > 0)) continue;
        const auto sees = [&](const glm::dvec3& location) {
            Foot there = foot;
            there.position = location;
            const glm::dvec3 path = position - location;
            const double distance = glm::length(path);
            return visibilityFrom(there)(path / distance, distance);
        };
        all += weight;
        if (sees(foot.position)) seen += weight;
        const std::optional<glm::dvec3> normal = foot.normalTowards(here.to_light);
        if (!normal) continue;
        const double edge = edgeDistance(sees, foot.position, *normal, here.to_light, here.distance);
        pixel.local_edge = std::min(pixel.local_edge, edge / here.distance);
        pixel.local_radiance += (lighting_.reflectance(s, here.to_light) * here.irradiance).size();
    }
    if (all > 0) pixel.local_visibility = seen / all;
}

void PixelRenderer::takeShadows(Pixel& pixel, const Surface& s, const Foot& foot, std::uint64_t seed) const {
    if (!request_.shadow_edges) return;
    takeShadow(pixel, s, foot, seed);
    takeLocalShadows(pixel, s, foot);
}

glm::dvec3 PixelRenderer::background(const PixelRay& ray) const {
    const glm::dvec3 d = glm::normalize(ray.direction);
    const glm::dvec3 radiance = background_ ? background_->radiance(d) : lighting_.background(d);
    if (!haze_) return radiance;
    const Hazed haze = haze_->along(ray.origin, d, std::numeric_limits<double>::infinity());
    return radiance * haze.transmittance + haze.scattered;
}

void PixelRenderer::takeHaze(Pixel& pixel, const Surface& s) const {
    if (!haze_) return;
    const glm::dvec3 away = -s.to_viewer;
    const double reach = glm::dot(s.position, away);
    pixel.haze = haze_->along(s.position - away * reach, away, reach);
    pixel.lit = pixel.lit * pixel.haze.transmittance + pixel.haze.scattered;
}

Ray PixelRenderer::cameraRay(const PixelRay& pixel, double from) const {
    return {pixel.origin, pixel.direction, std::max(from, request_.view.camera.near),
            request_.view.camera.far};
}

std::optional<Hit> PixelRenderer::nearest(const PixelRay& ray) const {
    return geometry_.nearest(cameraRay(ray, 0), [&](const Hit& hit) {
        return !materials_.blends(hit) && materials_.isThere(hit, &ray);
    });
}

std::optional<PixelRenderer::Standing> PixelRenderer::capturedAt(int x, int y) const {
    const Captured captured(*request_.surfaces, materialsOf(request_.scene, request_.pose));
    const std::uint64_t pixel = seedOf(x, y);
    if (!captured.isSurface(pixel)) return {};
    Surface s = captured.surface(pixel, rays_, captured.material(pixel));
    s.base_layer = request_.base_layer;
    const double depth = captured.depth(pixel);
    const bool both_sides = s.diffuse_transmission > 0;
    Foot foot{s.position, s.geometric_normal, {}, capturedOffset, both_sides};
    if (request_.shadows() || request_.surroundings) {
        // Recovers the exact position if the camera ray hits a surface at the captured depth.
        const std::optional<Hit> hit = nearest(rays_.through(x + 0.5, y + 0.5));
        if (hit && std::abs(hit->t - depth) <= 1e-4 * depth)
            foot = {hit->position, s.geometric_normal, hit->id, exactOffset, both_sides};
    }
    return Standing{s, foot, depth};
}

std::optional<PixelRenderer::Standing> PixelRenderer::tracedAt(const PixelRay& ray) const {
    const std::optional<Hit> hit = nearest(ray);
    return hit ? std::optional(standingAt(*hit, ray)) : std::nullopt;
}

PixelRenderer::Standing PixelRenderer::standingAt(const Hit& hit, const PixelRay& ray) const {
    Surface s = materials_.surface(hit, ray);
    s.base_layer = request_.base_layer;
    s.to_viewer = rays_.toViewer(s.position);
    return {s, Foot{s.position, s.geometric_normal, hit.id, exactOffset, s.diffuse_transmission > 0}, hit.t};
}

Pixel PixelRenderer::renderCaptured(int x, int y, std::uint64_t seed) const {
    Pixel pixel;
    const PixelRay ray = rays_.through(x + 0.5, y + 0.5);
    const std::optional<Standing> standing = capturedAt(x, y);
    if (!standing) {
        pixel.lit = background(ray);
        return withBlended(std::move(pixel), nowhere, ray, seed);
    }
    const auto& [s, foot, depth] = *standing;
    pixel.depth = depth;
    Visibility visible;
    pixel.sun_visibility = pixel.local_visibility = 1;
    if (request_.shadows() || request_.surroundings) {
        visible = visibilityFrom(foot);
        takeShadows(pixel, s, foot, seed);
    }
    pixel.shading = lighting_(s, visible, seed);
    pixel.transmitted = pixel.shading.from_behind;
    pixel.lit = pixel.shading.all() + emitted(s);
    takeHaze(pixel, s);
    pixel.surface = s;
    const double end = pixel.depth;
    return withBlended(std::move(pixel), end, ray, seed);
}

Pixel PixelRenderer::shaded(const Hit& hit, const PixelRay& ray, std::uint64_t seed) const {
    Pixel pixel;
    const auto [s, foot, depth] = standingAt(hit, ray);
    pixel.depth = depth;
    pixel.shading = lighting_(s, visibilityFrom(foot), seed);
    pixel.transmitted = pixel.shading.from_behind;
    takeShadows(pixel, s, foot, seed);
    pixel.lit = pixel.shading.all() + emitted(s);
    takeHaze(pixel, s);
    pixel.surface = s;
    return pixel;
}

bool PixelRenderer::isOnEdge(const Hit& hit) {
    const glm::dvec2& b = hit.barycentric;
    return std::min({b.x, b.y, 1 - b.x - b.y}) < 1e-9;
}

std::vector<Hit> PixelRenderer::blendedHits(double end, const PixelRay& ray) const {
    std::vector<Hit> hits;
    Ray search = cameraRay(ray, 0);
    search.to = std::min(search.to, end);
    geometry_.meets(search, [&](const Hit& hit) {
        if (materials_.blends(hit) && !materials_.transmits(hit) && materials_.isThere(hit, &ray))
            hits.push_back(hit);
        return false;  // continue the ray
    });
    const auto location = [](const Hit& hit) {
        return std::tuple(hit.t, ~hit.id.instance, ~hit.id.triangle);
    };
    std::ranges::sort(hits, {}, location);
    // A ray through an edge hits both of its triangles at one point.
    const auto same = std::ranges::unique(hits, [](const Hit& a, const Hit& b) {
        return a.id == b.id ||
               (a.id.instance == b.id.instance && isOnEdge(a) && isOnEdge(b) && b.t - a.t <= 1e-9 * a.t);
    });
    hits.erase(same.begin(), same.end());
    return hits;
}

double PixelRenderer::blendedBefore(double end, const PixelRay& ray, std::uint64_t seed, Pixel& pixel) const {
    double through = 1;
    std::uint64_t layer = 0;
    for (const Hit& hit : blendedHits(end, ray)) {
        const double covered = through * materials_.coverage(hit, ray);
        if (covered > 0) {
            const Pixel here = shaded(hit, ray, streamOf(seed, layer));
            pixel.lit += here.lit * covered;
            pixel.blended += here.shading * covered;
            through -= covered;
        }
        ++layer;
    }
    return through;
}

Pixel PixelRenderer::alongRay(const PixelRay& ray, std::uint64_t seed) const {
    const std::optional<Hit> solid = nearest(ray);
    Pixel pixel;
    if (solid)
        pixel = shaded(*solid, ray, seed);
    else
        pixel.lit = background(ray);
    return withBlended(std::move(pixel), solid ? solid->t : nowhere, ray, seed);
}

Pixel PixelRenderer::withBlended(Pixel pixel, double end, const PixelRay& ray, std::uint64_t seed) const {
    if (!blends_) return pixel;
    pixel.unblended = pixel.lit;
    end *= 1 + 1e-6;
    const double through_pane = withPane(pixel, end, ray, streamOf(seed, paneStream));
    const glm::dvec3 behind = std::exchange(pixel.lit, glm::dvec3(0));
    const Shading pane = std::exchange(pixel.blended, Shading{});
    const double through = blendedBefore(end, ray, ~seed, pixel);
    pixel.lit += behind * through;
    pixel.blended += pane * through;
    pixel.hidden = 1 - through * through_pane;
    return pixel;
}

Pixel PixelRenderer::renderScene(int x, int y, std::uint64_t seed) const {
    Pixel centre = alongRay(rays_.through(x + 0.5, y + 0.5), seed);
    if (request_.samples == 1) return centre;
    ResolvedLight light(request_.resolve, request_.samples);
    const double side = std::sqrt(1.0 / request_.samples);
    for (int i = 0; i < request_.samples; ++i) {
        const glm::dvec2 at = evenly(static_cast<std::uint64_t>(i), {0.5, 0.5});
        const PixelRay ray = rays_.through(x + at.x, y + at.y, side);
        light.add(alongRay(ray, streamOf(~seed, static_cast<std::uint64_t>(i))));
    }
    light.put(centre);
    return centre;
}

}  // namespace diptych::reference
