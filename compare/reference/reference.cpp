// SPDX-License-Identifier: MIT
#include "compare/reference/reference.h"

#include "compare/reference/area.h"
#include "compare/reference/checkpoint.h"
#include "compare/reference/geometry.h"
#include "compare/reference/haze.h"
#include "compare/reference/lighting.h"
#include "compare/reference/material.h"
#include "compare/reference/picture_key.h"
#include "compare/reference/pixel.h"
#include "compare/reference/pixel_rays.h"
#include "compare/reference/punctual.h"
#include "compare/reference/resolve.h"
#include "compare/reference/sampling.h"
#include "compare/reference/shadow_edge.h"
#include "compare/reference/time_estimate.h"
#include "shared/contract/debug_mode.h"
#include "shared/frame/debug_modes.h"
#include "shared/frame/made_channels.h"
#include "shared/scene/model/axes.h"
#include "shared/scene/model/luminance.h"
#include "shared/scene/motion/bounds.h"

#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

namespace diptych::reference {
namespace {

glm::dvec3 specularColor(const Surface& s) {
    return s.dielectric_f0 * (1 - s.metallic) + s.albedo * s.metallic;
}

bool isLocal(const Light& light) {
    return light.kind == LightKind::point || light.kind == LightKind::spot;
}

// ---- channels ----------------------------------------------------------------------------------------

// The components of a channel (shared/contract/debug_mode.h).
glm::dvec3 channelValue(int mode, const Pixel& pixel) {
    // Light is the mean over the pixel's area, even if the centre shows background.
    switch (static_cast<gpu::uint>(mode)) {
        case gpu::DEBUG_lit:
            return pixel.lit;
        case gpu::DEBUG_lit_diffuse:
            return pixel.shading.reflected.diffuse;
        case gpu::DEBUG_lit_specular:
            return pixel.shading.reflected.specular;
        case gpu::DEBUG_lit_ambient:
            return pixel.shading.ambient;
        case gpu::DEBUG_lit_environment:
            return pixel.shading.environment.diffuse + pixel.shading.environment.specular;
        case gpu::DEBUG_lit_haze:
            return pixel.haze.scattered;
        case gpu::DEBUG_shadow_visibility:
            return glm::dvec3(pixel.sun_visibility);
        case gpu::DEBUG_local_visibility:
            return glm::dvec3(pixel.local_visibility);
        default:
            break;
    }
    if (!pixel.surface) return glm::dvec3(mode == static_cast<int>(gpu::DEBUG_material_id) ? -1 : 0);
    const Surface& s = *pixel.surface;
    switch (static_cast<gpu::uint>(mode)) {
        case gpu::DEBUG_albedo:
            return s.albedo;
        case gpu::DEBUG_normals:
            return s.normal;
        case gpu::DEBUG_metallic:
            return glm::dvec3(s.metallic);
        case gpu::DEBUG_roughness:
            return glm::dvec3(s.roughness);
        case gpu::DEBUG_emission:
            return s.emission;
        case gpu::DEBUG_occlusion:
            return glm::dvec3(s.occlusion);
        case gpu::DEBUG_specular:
            return specularColor(s);
        case gpu::DEBUG_material_id:
            return glm::dvec3(s.material);
        case gpu::DEBUG_texcoords:
            return glm::dvec3(s.texcoord, 0);
        case gpu::DEBUG_depth:
            return glm::dvec3(pixel.depth);
        case gpu::DEBUG_transmittance:
            return pixel.haze.transmittance;
        case gpu::DEBUG_position:
            return s.position;
        case gpu::DEBUG_geometric_normal:
            return s.geometric_normal;
        case gpu::DEBUG_dielectric_f90:
            return glm::dvec3(s.dielectric_f90);
        case gpu::DEBUG_lightmap:
            return s.lightmap;
        case gpu::DEBUG_tangent:
            return s.tangent;
        case gpu::DEBUG_handedness:
            return glm::dvec3(s.handedness);
        case gpu::DEBUG_tangent_normal:
            return s.tangent_normal;
        case gpu::DEBUG_dielectric_f0:
            return s.dielectric_f0;
        case gpu::DEBUG_lightmapped:
            return glm::dvec3(s.lightmapped);
    }
    throw std::logic_error("the reference lacks a channel: " + std::string(debugMode(mode).name));
}

// Decodes surfaces from a path's captured channels.
class Captured {
public:
    Captured(const std::map<int, Image>& channels, const std::vector<Material>& materials)
        : channels_(channels), materials_(materials) {}

    bool isSurface(std::size_t pixel) const { return value(gpu::DEBUG_material_id, pixel).x >= 0; }
    double depth(std::size_t pixel) const { return value(gpu::DEBUG_depth, pixel).x; }

    int material(std::size_t pixel) const { return static_cast<int>(value(gpu::DEBUG_material_id, pixel).x); }

    Surface surface(std::size_t pixel, const PixelRays& rays, int material) const {
        Surface s;
        s.position = value(gpu::DEBUG_position, pixel);
        s.to_viewer = rays.toViewer(s.position);
        // A float32 unit vector is off by up to 1e-7, which would affect 1 - (n.h)^2 at a highlight.
        s.normal = unitOr(value(gpu::DEBUG_normals, pixel), s.to_viewer);
        s.geometric_normal = unitOr(value(gpu::DEBUG_geometric_normal, pixel), s.to_viewer);
        s.albedo = value(gpu::DEBUG_albedo, pixel);
        s.metallic = value(gpu::DEBUG_metallic, pixel).x;
        s.roughness = value(gpu::DEBUG_roughness, pixel).x;
        s.occlusion = value(gpu::DEBUG_occlusion, pixel).x;
        s.emission = value(gpu::DEBUG_emission, pixel);
        s.lightmap = value(gpu::DEBUG_lightmap, pixel);
        s.dielectric_f90 = value(gpu::DEBUG_dielectric_f90, pixel).x;
        s.material = material;
        s.lightmapped = hasLightmap(materials_.at(static_cast<std::size_t>(s.material)));
        s.dielectric_f0 = value(gpu::DEBUG_dielectric_f0, pixel);
        return s;
    }

private:
    glm::dvec3 value(gpu::uint mode, std::size_t pixel) const {
        const Image& image = channels_.at(static_cast<int>(mode));
        const float* p = image.pixel(pixel);
        glm::dvec3 result(0);
        for (int c = 0; c < std::min(image.components, 3); ++c) result[c] = double{p[c]};
        return result;
    }

    const std::map<int, Image>& channels_;
    const std::vector<Material>& materials_;
};

// ---- one pixel ---------------------------------------------------------------------------------------

bool blendsSomewhere(const Request& request) {
    return std::ranges::any_of(materialsOf(request.scene, request.pose), isSeenThrough);
}

constexpr double nowhere = std::numeric_limits<double>::infinity();

class PixelRenderer {
public:
    explicit PixelRenderer(const Request& request)
        : request_(request),
          eye_(request.view.eye()),
          rays_(request.view),
          geometry_(request.scene, request.pose, eye_, request.skin_normals == SkinNormals::blended),
          materials_(request.scene, request.pose, geometry_),
          lighting_(request.lights, request.environment(), request.environment_factor, eye_, request.ambient,
                    request.casters, request.shadowed_environment, request.multiscatter,
                    request.environment_rotation, request.falloff),
          blends_(request.blended && blendsSomewhere(request)),
          scene_radius_(worldBounds(request.scene, request.pose).radius()) {
        if (request.air) haze_.emplace(*request.air, eye_);
        if (request.environment_costs) lighting_.takeCosts();
        if (request.surroundings) lighting_.takeSurroundings();
        for (const std::size_t caster : request.casters)
            if (!sun_ && request.lights[caster].kind == LightKind::directional)
                sun_ = &request.lights[caster];
        for (const std::size_t caster : request.casters)
            if (isLocal(request.lights[caster])) locals_.push_back(&request.lights[caster]);
        if (request.residual && request.scene.environment)
            background_.emplace(*request.scene.environment, request.environment_factor,
                                request.environment_rotation);
    }

    // The pixel of render() with light from the surface of Request::decoded in place of the captured one.
    Pixel withDecoded(int x, int y, Pixel pixel) const {
        const std::uint64_t seed = seedOf(x, y);
        const std::optional<Standing> standing = capturedAt(x, y);
        if (!standing) return pixel;
        Surface s = Captured(*request_.decoded, materialsOf(request_.scene, request_.pose))
                        .surface(seed, rays_, standing->surface.material);
        s.position = standing->surface.position;
        s.to_viewer = standing->surface.to_viewer;
        s.base_layer = request_.base_layer;
        const glm::dvec3 own = pixel.shading.all() + standing->surface.emission;
        Visibility visible;
        if (request_.shadows() || request_.surroundings) visible = visibilityFrom(standing->foot);
        pixel.shading = lighting_(s, visible, seed);
        pixel.lit += (pixel.shading.all() + s.emission - own) * pixel.haze.transmittance * (1 - pixel.hidden);
        return pixel;
    }

    Pixel render(int x, int y) const {
        const std::uint64_t seed = seedOf(x, y);
        return request_.mode == ReferenceMode::surface ? renderCaptured(x, y, seed) : renderScene(x, y, seed);
    }

    // The contribution of each light and of everything else at the pixel's centre; empty in the
    // background.
    void takeTerms(int x, int y, PixelLight& pixel) const {
        const std::optional<Standing> standing = request_.mode == ReferenceMode::surface
                                                     ? capturedAt(x, y)
                                                     : tracedAt(rays_.through(x + 0.5, y + 0.5));
        if (!standing) return;
        const Visibility visible = visibilityFrom(standing->foot);
        const auto shade = [&](std::span<const Light> lights, const Environment* environment,
                               const glm::dvec3& ambient, std::span<const std::size_t> casters) {
            return Lighting(lights, environment, request_.environment_factor, eye_, ambient, casters,
                            request_.shadowed_environment, request_.multiscatter,
                            request_.environment_rotation,
                            request_.falloff)(standing->surface, visible, seedOf(x, y));
        };
        constexpr std::size_t first = 0;
        for (std::size_t i = 0; i < request_.lights.size(); ++i) {
            const bool casts = std::ranges::find(request_.casters, i) != request_.casters.end();
            Shading shading = shade(request_.lights.subspan(i, 1), nullptr, glm::dvec3(0),
                                    std::span(&first, casts ? 1 : 0));
            shading.ambient = glm::dvec3(0);  // a lightmap's, which would be added to every light
            pixel.lights.push_back(shading);
        }
        pixel.without_lights = shade({}, request_.environment(), request_.ambient, {});
    }

private:
    std::uint64_t seedOf(int x, int y) const {
        return static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(request_.view.width) +
               static_cast<std::uint64_t>(x);
    }

    // Start of a shadow ray, relative to the point's distance from the camera: far above rounding errors
    // in double, far below modelled detail. A captured position is only as exact as a float32 depth.
    static constexpr double exactOffset = 1e-9, capturedOffset = 1e-5;
    // Gap between the end of a shadow ray and the light, relative to the ray's length. It keeps a ceiling,
    // whose float32 vertices may round to below the lamp, from occluding a lamp on it.
    static constexpr double lightOffset = 1e-5;
    // Minimum number of directions to a sun's disc, and their random stream, which no light has.
    static constexpr int leastDiscSamples = 64;
    static constexpr std::uint64_t discStream = ~std::uint64_t{0};

    // Light from behind the triangle does not reach it, whatever the shading normal.
    struct Foot {
        glm::dvec3 place, geometric_normal;
        TriangleId without;
        double offset;
    };
    Visibility visibilityFrom(const Foot& foot) const {
        if (!request_.shadows() && !request_.surroundings) return {};
        const double from = foot.offset * glm::length(foot.place);
        return [this, foot, from](const glm::dvec3& to_light, double distance) {
            if (!(glm::dot(foot.geometric_normal, to_light) > 0)) return false;
            const Ray ray{foot.place, to_light, from, distance * (1 - lightOffset), foot.without};
            return !geometry_.meets(ray, [this](const Hit& hit) { return materials_.throwsShadow(hit); });
        };
    }

    // The visible fraction of the sun's disc, by directions that cover it evenly.
    double seenOfDisc(const Foot& foot, std::uint64_t seed) const {
        const int samples = std::max(request_.samples, leastDiscSamples);
        const double radius = emitterOf(*sun_, {}).radius;
        const glm::dvec3 centre = -sun_->direction, x = perpendicularTo(centre), y = glm::cross(centre, x);
        const Visibility visible = visibilityFrom(foot);
        Random turn(streamOf(seed, discStream));
        const double u = turn();
        const glm::dvec2 shift(u, turn());
        int seen = 0;
        for (int i = 0; i < samples; ++i) {
            const glm::dvec2 at = evenly(static_cast<std::uint64_t>(i), shift);
            const double out = radius * std::sqrt(at.x), around = 2 * std::numbers::pi * at.y;
            seen += visible(glm::normalize(centre + out * (x * std::cos(around) + y * std::sin(around))),
                            std::numeric_limits<double>::infinity());
        }
        return static_cast<double>(seen) / samples;
    }

    // Visibility of the shadow-casting sun, its centre or its disc; 1 without one. A partly visible disc
    // is at the shadow's boundary; otherwise the distance is measured for its centre.
    void takeShadow(Pixel& pixel, const Surface& s, const Foot& foot, std::uint64_t seed) const {
        pixel.sun_visibility = 1;
        if (!sun_) return;
        const glm::dvec3 to_light = -sun_->direction;
        const auto sees = [&](const glm::dvec3& place) {
            Foot there = foot;
            there.place = place;
            return visibilityFrom(there)(to_light, std::numeric_limits<double>::infinity());
        };
        pixel.sun_visibility = sun_->angle > 0 ? seenOfDisc(foot, seed) : sees(foot.place) ? 1 : 0;
        if (!(glm::dot(foot.geometric_normal, to_light) > 0)) return;
        const bool partly = pixel.sun_visibility > 0 && pixel.sun_visibility < 1;
        pixel.edge_distance =
            partly ? 0 : edgeDistance(sees, foot.place, foot.geometric_normal, to_light, 2 * scene_radius_);
        const glm::dvec3 irradiance = incident(*sun_, {}, {}).irradiance;
        pixel.sun_radiance = (lighting_.brdf(s)(to_light) * irradiance).size();
        pixel.sun_irradiance = std::max(glm::dot(s.normal, to_light), 0.0) * luminance(irradiance);
    }

    // The same for shadow-casting points and spots, weighted by the luminance of their irradiance.
    void takeLocalShadows(Pixel& pixel, const Surface& s, const Foot& foot) const {
        pixel.local_visibility = 1;
        double all = 0, seen = 0;
        for (const Light* const light : locals_) {
            const glm::dvec3 position = light->position - eye_;
            const Incident here = incident(*light, position, foot.place, request_.falloff);
            const double weight = luminance(here.irradiance);
            if (!(weight > 0)) continue;
            const auto sees = [&](const glm::dvec3& place) {
                Foot there = foot;
                there.place = place;
                const glm::dvec3 path = position - place;
                const double distance = glm::length(path);
                return visibilityFrom(there)(path / distance, distance);
            };
            all += weight;
            if (sees(foot.place)) seen += weight;
            if (!(glm::dot(foot.geometric_normal, here.to_light) > 0)) continue;
            const double edge =
                edgeDistance(sees, foot.place, foot.geometric_normal, here.to_light, here.distance);
            pixel.local_edge = std::min(pixel.local_edge, edge / here.distance);
            pixel.local_radiance += (lighting_.brdf(s)(here.to_light) * here.irradiance).size();
        }
        if (all > 0) pixel.local_visibility = seen / all;
    }

    void takeShadows(Pixel& pixel, const Surface& s, const Foot& foot, std::uint64_t seed) const {
        if (!request_.shadow_edges) return;
        takeShadow(pixel, s, foot, seed);
        takeLocalShadows(pixel, s, foot);
    }

    // The background behind all haze, as the camera sees it.
    glm::dvec3 background(const PixelRay& ray) const {
        const glm::dvec3 d = glm::normalize(ray.direction);
        const glm::dvec3 radiance = background_ ? background_->radiance(d) : lighting_.background(d);
        if (!haze_) return radiance;
        const Hazed haze = haze_->along(ray.origin, d, std::numeric_limits<double>::infinity());
        return radiance * haze.transmittance + haze.scattered;
    }

    // Applies the haze in front of the surface to its light.
    void takeHaze(Pixel& pixel, const Surface& s) const {
        if (!haze_) return;
        const glm::dvec3 away = -s.to_viewer;
        const double reach = glm::dot(s.position, away);
        pixel.haze = haze_->along(s.position - away * reach, away, reach);
        pixel.lit = pixel.lit * pixel.haze.transmittance + pixel.haze.scattered;
    }

    Ray cameraRay(const PixelRay& pixel, double from) const {
        return {pixel.origin, pixel.direction, std::max(from, request_.view.camera.near),
                request_.view.camera.far};
    }

    // The nearest opaque surface.
    std::optional<Hit> nearest(const PixelRay& ray) const {
        return geometry_.nearest(cameraRay(ray, 0), [&](const Hit& hit) {
            return !materials_.blends(hit) && materials_.isThere(hit, &ray);
        });
    }

    // A surface, and the start of rays from it.
    struct Standing {
        Surface surface;
        Foot foot;
        double depth = 0;
    };

    // From a path's captured channels; empty in the background.
    std::optional<Standing> capturedAt(int x, int y) const {
        const Captured captured(*request_.surfaces, materialsOf(request_.scene, request_.pose));
        const std::uint64_t pixel = seedOf(x, y);
        if (!captured.isSurface(pixel)) return {};
        Surface s = captured.surface(pixel, rays_, captured.material(pixel));
        s.base_layer = request_.base_layer;
        const double depth = captured.depth(pixel);
        Foot foot{s.position, s.geometric_normal, {}, capturedOffset};
        if (request_.shadows() || request_.surroundings) {
            // Recovers the exact position if the camera ray hits a surface at the captured depth.
            const std::optional<Hit> hit = nearest(rays_.through(x + 0.5, y + 0.5));
            if (hit && std::abs(hit->t - depth) <= 1e-4 * depth)
                foot = {hit->position, s.geometric_normal, hit->id, exactOffset};
        }
        return Standing{s, foot, depth};
    }

    // From the nearest hit; empty in the background.
    std::optional<Standing> tracedAt(const PixelRay& ray) const {
        const std::optional<Hit> hit = nearest(ray);
        return hit ? std::optional(standingAt(*hit, ray)) : std::nullopt;
    }

    Standing standingAt(const Hit& hit, const PixelRay& ray) const {
        Surface s = materials_.surface(hit, ray);
        s.base_layer = request_.base_layer;
        s.to_viewer = rays_.toViewer(s.position);
        return {s, Foot{s.position, s.geometric_normal, hit.id, exactOffset}, hit.t};
    }

    Pixel renderCaptured(int x, int y, std::uint64_t seed) const {
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
        pixel.lit = pixel.shading.all() + s.emission;
        takeHaze(pixel, s);
        pixel.surface = s;
        const double end = pixel.depth;
        return withBlended(std::move(pixel), end, ray, seed);
    }

    Pixel shaded(const Hit& hit, const PixelRay& ray, std::uint64_t seed) const {
        Pixel pixel;
        const auto [s, foot, depth] = standingAt(hit, ray);
        pixel.depth = depth;
        pixel.shading = lighting_(s, visibilityFrom(foot), seed);
        takeShadows(pixel, s, foot, seed);
        pixel.lit = pixel.shading.all() + s.emission;
        takeHaze(pixel, s);
        pixel.surface = s;
        return pixel;
    }

    static bool isOnEdge(const Hit& hit) {
        const glm::dvec2& b = hit.barycentric;
        return std::min({b.x, b.y, 1 - b.x - b.y}) < 1e-9;
    }

    // Blended surfaces in front of `end`, front to back. At equal depth, the one later in the scene is in
    // front.
    std::vector<Hit> blendedHits(double end, const PixelRay& ray) const {
        std::vector<Hit> hits;
        Ray search = cameraRay(ray, 0);
        search.to = std::min(search.to, end);
        geometry_.meets(search, [&](const Hit& hit) {
            if (materials_.blends(hit) && materials_.isThere(hit, &ray)) hits.push_back(hit);
            return false;  // continue the ray
        });
        const auto place = [](const Hit& hit) {
            return std::tuple(hit.t, ~hit.id.instance, ~hit.id.triangle);
        };
        std::ranges::sort(hits, {}, place);
        // A ray through an edge hits both of its triangles at one point.
        const auto same = std::ranges::unique(hits, [](const Hit& a, const Hit& b) {
            return a.id == b.id ||
                   (a.id.instance == b.id.instance && isOnEdge(a) && isOnEdge(b) && b.t - a.t <= 1e-9 * a.t);
        });
        hits.erase(same.begin(), same.end());
        return hits;
    }

    // Blends them over lit (Porter and Duff 1984, "Compositing Digital Images"). Returns the visible
    // fraction of the background. Transmittance has no colour because the paths blend by one number
    // (shared/transparent/README.md). A surface's haze counts only for the fraction it hides, because the
    // background has its own.
    double blendedBefore(double end, const PixelRay& ray, std::uint64_t seed, Pixel& pixel) const {
        double through = 1;
        std::uint64_t layer = 0;
        for (const Hit& hit : blendedHits(end, ray)) {
            const double covered = through * materials_.coverage(hit, ray);
            if (covered > 0) {
                const Pixel here = shaded(hit, ray, streamOf(seed, layer));
                const double share =
                    covered * (1 - std::clamp(luminance(transmitted(*here.surface)), 0.0, 1.0));
                pixel.lit += (here.lit - here.haze.scattered) * covered + here.haze.scattered * share;
                pixel.blended += here.shading * covered;
                through -= share;
            }
            ++layer;
        }
        return through;
    }

    // Channels other than lit show the nearest opaque surface.
    Pixel alongRay(const PixelRay& ray, std::uint64_t seed) const {
        const std::optional<Hit> solid = nearest(ray);
        Pixel pixel;
        if (solid)
            pixel = shaded(*solid, ray, seed);
        else
            pixel.lit = background(ray);
        return withBlended(std::move(pixel), solid ? solid->t : nowhere, ray, seed);
    }

    // Blends surfaces over the pixel, including those that lie on it: `end` has float32 precision.
    Pixel withBlended(Pixel pixel, double end, const PixelRay& ray, std::uint64_t seed) const {
        if (!blends_) return pixel;
        const glm::dvec3 behind = std::exchange(pixel.lit, glm::dvec3(0));
        const double through = blendedBefore(end * (1 + 1e-6), ray, ~seed, pixel);
        pixel.lit += behind * through;
        pixel.unblended = behind;
        pixel.hidden = 1 - through;
        return pixel;
    }

    // With several samples, light is their mean over the pixel; other channels show the centre.
    Pixel renderScene(int x, int y, std::uint64_t seed) const {
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

    const Request& request_;
    const glm::dvec3 eye_;
    const PixelRays rays_;
    const Geometry geometry_;
    const Materials materials_;
    Lighting lighting_;
    std::optional<EnvironmentLight> background_;  // set if another environment lights the scene
    std::optional<Haze> haze_;
    const Light* sun_ = nullptr;        // the shadow-casting one
    std::vector<const Light*> locals_;  // shadow-casting points and spots
    const bool blends_;                 // whether any material blends
    const double scene_radius_;         // m, of a sphere around all geometry
};

// ---- the image ---------------------------------------------------------------------------------------

// Side of the square tiles that are rendered and saved as units, in pixels.
constexpr int tileSide = 16;

// The other images of a picture, in the order in which tiles store them.
std::array<Image*, 6> besides(Picture& picture) {
    return {&picture.shadow_edge,  &picture.local_shadow_edge, &picture.environment_costs,
            &picture.surroundings, &picture.blended,           &picture.unblended};
}

bool isOfShadows(int mode) {
    return mode == static_cast<int>(gpu::DEBUG_shadow_visibility) ||
           mode == static_cast<int>(gpu::DEBUG_local_visibility);
}

class Drawing {
public:
    explicit Drawing(const Request& request)
        : request_(request),
          across_((request.view.width + tileSide - 1) / tileSide),
          down_((request.view.height + tileSide - 1) / tileSide) {
        for (const DebugMode& mode : debugModes()) {
            if (!isMadeByReference(mode)) continue;
            if (!request.shadow_edges && isOfShadows(mode.number)) continue;
            const bool copied = request.mode == ReferenceMode::surface && !isShaded(mode.number);
            Image& image = picture_.channels[mode.number];
            if (copied) {
                image = request.surfaces->at(mode.number);
                continue;
            }
            image = Image(request.view.width, request.view.height, mode.width);
            drawn_.push_back(&mode);
            floats_ += mode.width;
        }
        if (request.decoded)
            for (const int mode : litModes) {
                picture_.decoded[mode] = Image(request.view.width, request.view.height, 3);
                floats_ += 3;
            }
        picture_.uncertainty = Image(request.view.width, request.view.height, 1);
        ++floats_;
        const auto cast = [&](const auto& which) {
            return request.shadow_edges && std::ranges::any_of(request.casters, [&](std::size_t i) {
                       return which(request.lights[i]);
                   });
        };
        if (cast([](const Light& light) { return light.kind == LightKind::directional; }))
            picture_.shadow_edge = Image(request.view.width, request.view.height, 3);
        if (cast(isLocal)) picture_.local_shadow_edge = Image(request.view.width, request.view.height, 2);
        if (request.environment_costs && request.scene.environment)
            picture_.environment_costs = Image(request.view.width, request.view.height, 9);
        if (request.surroundings) picture_.surroundings = Image(request.view.width, request.view.height, 2);
        if (request.blended && blendsSomewhere(request)) {
            picture_.blended = Image(request.view.width, request.view.height, 1);
            picture_.unblended = Image(request.view.width, request.view.height, 3);
        }
        for (const Image* image : besides(picture_)) floats_ += image->components;
    }

    Picture operator()() {
        const std::size_t pixels = std::size_t{tileSide} * tileSide;
        Checkpoint* const checkpoint =
            request_.keep ? &request_.keep(keyOf(request_), 1 + pixels * static_cast<std::size_t>(floats_))
                          : nullptr;
        const auto tiles = static_cast<std::uint64_t>(across_) * static_cast<std::uint64_t>(down_);
        std::vector<bool> there(tiles, false);
        if (checkpoint)
            for (const Checkpoint::Record& record : checkpoint->takeEarlier())
                if (record.number < tiles) {
                    put(record.number, record.values);
                    there[record.number] = true;
                    picture_.kept_share += 1.0 / static_cast<double>(tiles);
                    picture_.kept_seconds += double{record.values.front()} / tbb::info::default_concurrency();
                }
        // The order of tiles is scattered over the image, so that the finished part predicts the remaining
        // time.
        std::vector<std::uint64_t> order;
        std::uint64_t step =
            std::max<std::uint64_t>(1, static_cast<std::uint64_t>(0.618 * static_cast<double>(tiles)));
        while (std::gcd(step, tiles) != 1) ++step;
        for (std::uint64_t i = 0, tile = 0; i < tiles; ++i, tile = (tile + step) % tiles)
            if (!there[tile]) order.push_back(tile);

        if (!order.empty()) {
            const PixelRenderer renderer(request_);
            if (request_.expected)
                if (const auto seconds = expectedSeconds(request_.view.width, request_.view.height,
                                                         [&](int x, int y) { renderer.render(x, y); }))
                    request_.expected(*seconds * (1 - picture_.kept_share));
            std::atomic<std::size_t> done{0};
            tbb::parallel_for(std::size_t{0}, order.size(), [&](std::size_t i) {
                const std::vector<float> values = renderTile(renderer, order[i]);
                put(order[i], values);
                if (checkpoint) checkpoint->keep(order[i], values);
                if (request_.tile) tell(order[i]);
                if (request_.progress)
                    request_.progress(static_cast<double>(++done) / static_cast<double>(order.size()));
            });
        }
        if (std::ranges::all_of(picture_.uncertainty.data, [](float u) { return u == 0; }))
            picture_.uncertainty = {};
        return std::move(picture_);
    }

private:
    template <class Visit>
    void eachPixel(std::uint64_t tile, Visit&& visit) const {
        const int x0 = static_cast<int>(tile % static_cast<std::uint64_t>(across_)) * tileSide;
        const int y0 = static_cast<int>(tile / static_cast<std::uint64_t>(across_)) * tileSide;
        for (int y = y0; y < std::min(y0 + tileSide, request_.view.height); ++y)
            for (int x = x0; x < std::min(x0 + tileSide, request_.view.width); ++x) visit(x, y);
    }

    void tell(std::uint64_t tile) const {
        const int x = static_cast<int>(tile % static_cast<std::uint64_t>(across_)) * tileSide;
        const int y = static_cast<int>(tile / static_cast<std::uint64_t>(across_)) * tileSide;
        request_.tile(picture_, x, y, std::min(tileSide, request_.view.width - x),
                      std::min(tileSide, request_.view.height - y));
    }

    // The seconds that the tile took, then its pixels' values.
    std::vector<float> renderTile(const PixelRenderer& renderer, std::uint64_t tile) const {
        const auto start = std::chrono::steady_clock::now();
        std::vector<float> values{0};
        eachPixel(tile, [&](int x, int y) {
            const Pixel pixel = renderer.render(x, y);
            const auto takeChannel = [&](int mode, const Pixel& of) {
                const glm::dvec3 value = channelValue(mode, of);
                for (int c = 0; c < debugMode(mode).width; ++c)
                    values.push_back(static_cast<float>(value[c]));
            };
            for (const DebugMode* mode : drawn_) takeChannel(mode->number, pixel);
            if (request_.decoded) {
                const Pixel decoded = renderer.withDecoded(x, y, pixel);
                for (const auto& [mode, image] : picture_.decoded) takeChannel(mode, decoded);
            }
            values.push_back(static_cast<float>(pixel.shading.uncertainty + pixel.blended.uncertainty));
            const auto take = [&](const Image& image, std::initializer_list<double> numbers) {
                if (image.empty()) return;
                for (const double number : numbers) values.push_back(static_cast<float>(number));
            };
            take(picture_.shadow_edge, {pixel.edge_distance, pixel.sun_radiance, pixel.sun_irradiance});
            take(picture_.local_shadow_edge, {pixel.local_edge, pixel.local_radiance});
            EnvironmentCosts c = pixel.shading.costs;
            c += pixel.blended.costs;
            take(picture_.environment_costs, {c.diffuse[0], c.diffuse[1], c.diffuse[2], c.split[0],
                                              c.split[1], c.split[2], c.sampled, c.wider, c.lobe});
            take(picture_.surroundings, {pixel.shading.surroundings.all, pixel.shading.surroundings.hidden});
            take(picture_.blended, {pixel.hidden});
            take(picture_.unblended, {pixel.unblended.x, pixel.unblended.y, pixel.unblended.z});
        });
        values.front() = std::chrono::duration<float>(std::chrono::steady_clock::now() - start).count();
        return values;
    }

    void put(std::uint64_t tile, const std::vector<float>& values) {
        const float* next = values.data() + 1;  // after the seconds
        eachPixel(tile, [&](int x, int y) {
            for (const DebugMode* mode : drawn_) {
                Image& image = picture_.channels[mode->number];
                for (int c = 0; c < mode->width; ++c) image.at(x, y, c) = *next++;
            }
            for (auto& [mode, image] : picture_.decoded)
                for (int c = 0; c < image.components; ++c) image.at(x, y, c) = *next++;
            picture_.uncertainty.at(x, y) = *next++;
            for (Image* const image : besides(picture_))
                for (int c = 0; c < image->components; ++c) image->at(x, y, c) = *next++;
        });
    }

    const Request& request_;
    const int across_, down_;
    int floats_ = 0;  // floats per pixel; a tile has one more
    std::vector<const DebugMode*> drawn_;
    Picture picture_;
};

}  // namespace

std::vector<int> surfaceChannels() {
    std::vector<int> modes;
    for (const DebugMode& mode : debugModes())
        if (!isShaded(mode.number) && isMadeByReference(mode)) modes.push_back(mode.number);
    return modes;
}

PixelLight drawPixel(const Request& request, int x, int y) {
    const PixelRenderer renderer(request);
    const Pixel pixel = renderer.render(x, y);
    PixelLight result;
    const std::size_t place = static_cast<std::size_t>(y) * static_cast<std::size_t>(request.view.width) +
                              static_cast<std::size_t>(x);
    for (const DebugMode& mode : debugModes()) {
        if (!isMadeByReference(mode)) continue;
        glm::dvec3& value = result.channels[mode.number] = channelValue(mode.number, pixel);
        if (request.mode == ReferenceMode::scene || isShaded(mode.number)) continue;
        // Not shaded: copied from the capture.
        const Image& image = request.surfaces->at(mode.number);
        for (int c = 0; c < mode.width; ++c) value[c] = double{image.pixel(place)[c]};
    }
    result.uncertainty = pixel.shading.uncertainty + pixel.blended.uncertainty;
    result.unblended = request.blended && blendsSomewhere(request) ? pixel.unblended : pixel.lit;
    renderer.takeTerms(x, y, result);
    return result;
}

Picture draw(const Request& request) {
    return Drawing(request)();
}

}  // namespace diptych::reference
