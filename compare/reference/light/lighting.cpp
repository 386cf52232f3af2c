// SPDX-License-Identifier: MIT
#include "compare/reference/light/lighting.h"

#include "compare/reference/light/punctual.h"
#include "compare/reference/scattering/adaptive_sampling.h"
#include "compare/reference/scattering/ambient.h"
#include "compare/reference/scattering/lobe_sampler.h"
#include "compare/reference/scattering/microsurface.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace diptych::reference {
namespace {

// The radiance reflected from one point of a patch, times the solid angle of its area element.
Reflected through(const Brdf& brdf, const Patch::Point& point) {
    const double square = glm::dot(point.position, point.position);
    if (!(square > 0) || point.area == 0) return {};
    const glm::dvec3 to_light = point.position / std::sqrt(square);
    return brdf(to_light) * (std::max(-glm::dot(point.normal, to_light), 0.0) * point.area / square);
}

// Whether quadrature may miss the specular lobe in a cell. Splits while the cell is wider than the lobe at
// the mirror direction; turning the light by an angle turns the half vector by that angle over 2 v.h. Also
// splits cells that cover a large angle: in a light that extends far away, the near part is a small part
// of the cell and gives most of the light.
Split mayHideLobe(const Brdf& brdf, const Patch& patch, const Cell& cell) {
    const auto direction = [&](double u, double v) { return glm::normalize(patch.at(u, v).position); };
    const double u = (cell.u0 + cell.u1) / 2, v = (cell.v0 + cell.v1) / 2;
    const glm::dvec3 middle = direction(u, v);
    const auto from = [&](double at_u, double at_v) { return glm::length(direction(at_u, at_v) - middle); };
    double radius = 0;
    for (const double at_u : {cell.u0, cell.u1})
        for (const double at_v : {cell.v0, cell.v1}) radius = std::max(radius, from(at_u, at_v));
    const bool u_is_wider =
        std::max(from(cell.u0, v), from(cell.u1, v)) >= std::max(from(u, cell.v0), from(u, cell.v1));
    const auto split = [&](bool wanted) { return !wanted ? Split::none : u_is_wider ? Split::u : Split::v; };
    if (radius > 0.5) return split(true);
    if (glm::dot(brdf.normal(), middle) < -radius) return Split::none;  // behind, where the lobe is diffuse
    const glm::dvec3 sum = middle + brdf.toViewer();
    const double length = glm::length(sum);
    if (!(length > 1e-9)) return split(radius > 0.1);
    const glm::dvec3 half = sum / length;
    const double angle = radius / (2 * std::max(glm::dot(brdf.toViewer(), half), 0.05));
    // Sine of the angle between half vector and normal; in an anisotropic lobe, across the lobe.
    const Widths& widths = brdf.widths();
    const double sine = widths.isotropic() ? glm::length(glm::cross(brdf.normal(), half))
                                           : std::abs(glm::dot(widths.y, half));
    return split(angle > std::max(widths.across, sine - angle));
}

// Random stream of a surface's random walks; no light has this index.
constexpr std::uint64_t betweenStream = ~std::uint64_t{1};
// Streams of the environment's errors and of occlusion.
constexpr std::uint64_t costsStream = ~std::uint64_t{2}, surroundingsStream = ~std::uint64_t{3};
// Streams of a clear coat's and of a sheen's lights.
constexpr std::uint64_t coatStream = ~std::uint64_t{4}, sheenStream = ~std::uint64_t{5};

constexpr double infinity = std::numeric_limits<double>::infinity();

struct Leaves {
    const Patch* patch;
    std::vector<Leaf> leaves;
};

// Estimates the visible part of an integral whose unshadowed value F is known, from evenly distributed
// points in each leaf. Two estimators are unbiased for a point with value f and visibility V: f V, exact
// in full shadow, and F - f (1 - V), exact in full light. A few pilot samples choose one.
class Shaded {
public:
    Shaded(const Brdf& brdf, const std::vector<Leaves>& leaves, bool far, const Visibility& visible)
        : brdf_(brdf), leaves_(leaves), far_(far), visible_(visible) {}

    // Takes one point in each leaf: element `index` of a low-discrepancy sequence, shifted by `seed`.
    // `seen` counts the visible points.
    Reflected estimate(std::uint64_t seed, std::uint64_t index, bool mostly_visible,
                       std::size_t& seen) const {
        Reflected sum;
        std::uint64_t leaf_index = 0;
        for (const Leaves& part : leaves_)
            for (const Leaf& leaf : part.leaves) {
                Random random(streamOf(seed, ++leaf_index));
                const double u = random();
                const glm::dvec2 at = evenly(index, {u, random()});
                const Cell& c = leaf.cell;
                const Patch::Point point =
                    part.patch->at(c.u0 + (c.u1 - c.u0) * at.x, c.v0 + (c.v1 - c.v0) * at.y);
                const double distance = glm::length(point.position);
                const bool lit =
                    distance > 0 && visible_(point.position / distance, far_ ? infinity : distance);
                seen += lit;
                const Reflected here = through(brdf_, point) * c.area();
                if (mostly_visible)
                    sum += lit ? leaf.value : leaf.value - here;
                else if (lit)
                    sum += here;
            }
        return sum;
    }
    std::size_t leafCount() const {
        std::size_t count = 0;
        for (const Leaves& part : leaves_) count += part.leaves.size();
        return count;
    }
    double largestLeaf() const {
        double largest = 0;
        for (const Leaves& part : leaves_)
            for (const Leaf& leaf : part.leaves) largest = std::max(largest, leaf.value.size());
        return largest;
    }

private:
    const Brdf& brdf_;
    const std::vector<Leaves>& leaves_;
    bool far_;
    const Visibility& visible_;
};

}  // namespace

Lighting::Lighting(const LightingInputs& inputs)
    : ambient_(inputs.ambient),
      shadowed_environment_(inputs.shadowed_environment),
      multiscatter_(inputs.multiscatter),
      falloff_(inputs.falloff) {
    for (std::size_t i = 0; i < inputs.lights.size(); ++i) {
        const Light& light = inputs.lights[i];
        const bool casts = std::ranges::find(inputs.casters, i) != inputs.casters.end();
        if (glm::dvec3(light.color) * double{light.intensity} == glm::dvec3(0)) continue;
        if (isArea(light.kind) || (light.kind == LightKind::directional && light.angle > 0))
            emitters_.push_back({emitterOf(light, inputs.eye), casts});
        else
            punctual_.push_back({light, light.position - inputs.eye, casts});
    }
    if (inputs.environment)
        environment_.emplace(*inputs.environment, inputs.environment_factor, inputs.environment_rotation);
    if (environment_ && environment_->black()) environment_.reset();
}

void Lighting::takeCosts() {
    if (environment_ && multiscatter_ != Multiscatter::walk && !shadowed_environment_)
        approximation_.emplace(*environment_);
}

Shading Lighting::operator()(const Surface& surface, const Visibility& visible, std::uint64_t seed) const {
    const Shading base = underCoat(surface, visible, seed);
    if (!(surface.clearcoat > 0)) return base;
    const double weight = coatWeight(surface);
    Shading coat = layer(coatOf(surface), Multiscatter::off, visible, streamOf(seed, coatStream)) * weight;
    coat.clearcoat = coat.reflected.specular + coat.ambient;
    coat.rounding.z = coat.rounding.y;
    coat += base * (1 - weight);
    return coat;
}

Shading Lighting::underCoat(const Surface& surface, const Visibility& visible, std::uint64_t seed) const {
    if (!hasSheen(surface)) return layer(surface, multiscatter_, visible, seed);
    Shading all = layer(sheenOf(surface), Multiscatter::off, visible, streamOf(seed, sheenStream));
    all.sheen = all.reflected.specular + all.ambient;
    all.rounding.w = all.rounding.y;
    all += layer(underSheen(surface), multiscatter_, visible, seed) * sheenAlbedoScaling(surface);
    return all;
}

Reflected Lighting::reflectance(const Surface& surface, const glm::dvec3& to_light) const {
    const Surface under = underSheen(surface);
    Reflected base =
        Brdf(under, compensationOf(under, multiscatter_))(to_light) * sheenAlbedoScaling(surface);
    if (hasSheen(surface)) base += Brdf(sheenOf(surface))(to_light);
    if (!(surface.clearcoat > 0)) return base;
    const double weight = coatWeight(surface);
    return base * (1 - weight) + Brdf(coatOf(surface))(to_light) * weight;
}

Shading Lighting::layer(const Surface& surface, Multiscatter multiscatter, const Visibility& visible,
                        std::uint64_t seed) const {
    const Compensation compensation = compensationOf(surface, multiscatter);
    const Brdf brdf(surface, compensation);
    Shading sum;
    for (const Punctual& p : punctual_) {
        const Incident light = incident(p.light, p.position, surface.position, falloff_);
        const Reflected reflected = brdf(light.to_light) * light.irradiance;
        if (reflected.size() > 0 && (!p.casts || !visible || visible(light.to_light, light.distance))) {
            sum.reflected += reflected;
            const glm::dvec2 of = brdf.rounding(light.to_light, light.angle_error) + light.rounding;
            const Reflected lobe{.specular = reflected.specular};
            sum.rounding += glm::dvec4((reflected - lobe).size() * of.x, lobe.size() * of.y, 0, 0);
        }
        // Keeps NaN visible.
        if (std::isnan(reflected.size())) sum.reflected += reflected;
    }
    for (std::size_t i = 0; i < emitters_.size(); ++i)
        sum += fromEmitter(emitters_[i].emitter, surface.position, brdf,
                           emitters_[i].casts ? visible : Visibility{}, streamOf(seed, i + 1));
    if (environment_) {
        const Estimated sky =
            fromEnvironment(brdf, surface.lightmapped, shadowed_environment_ ? visible : Visibility{}, seed);
        Shading shading{sky.value, sky.uncertainty};
        if (approximation_)
            shading.costs =
                approximation_->costs(surface, compensation, sky.value, streamOf(seed, costsStream));
        if (surface.lightmapped) shading.costs.diffuse = {};  // the paths do not approximate it either
        shading.environment = sky.value;
        sum += shading * surface.occlusion;
    }
    if (takes_surroundings_ && visible && (environment_ || ambient_ != glm::dvec3(0)))
        sum.surroundings = surroundingsOf(brdf, environment_ ? &*environment_ : nullptr, surface.lightmapped,
                                          ambient_, visible, streamOf(seed, surroundingsStream)) *
                           surface.occlusion;
    // A lightmap has no directions: its irradiance is taken as uniform, and only the diffuse base reflects
    // it.
    if (ambient_ + surface.lightmap != glm::dvec3(0))
        sum.ambient = diffuseAlbedo(surface, compensation) * (ambient_ + surface.lightmap);
    if (ambient_ != glm::dvec3(0) && brdf.transmits())
        sum.from_behind = diffuseAlbedo(behind(surface), compensation) * ambient_;
    sum.ambient += sum.from_behind;
    const glm::dvec3 base = sum.ambient;
    if (ambient_ != glm::dvec3(0)) sum.ambient += specularAlbedo(surface, compensation) * ambient_;
    if (multiscatter == Multiscatter::walk) {
        const MoreReflections more = between(surface, visible, sum.all(), streamOf(seed, betweenStream));
        sum += more.shading;
        for (Reflected* const part : {&sum.reflected, &sum.environment}) {
            part->diffuse *= more.base;
            part->transmitted *= more.base;
        }
        sum.ambient -= base * (1.0 - more.base);
        sum.from_behind *= more.base;
    }
    sum.ambient *= surface.occlusion;
    sum.from_behind = sum.from_behind * surface.occlusion + sum.reflected.transmitted;
    return sum;
}

struct Lighting::Shining {
    std::vector<Patch> patches;
    glm::dvec3 radiance;
    bool casts, far;

    // Adds the light of one random point of each patch.
    void add(Random& random, const Visibility& visible, const Between::Add& add) const {
        for (const Patch& patch : patches) {
            const double u = random();
            const Patch::Point point = patch.at(u, random());
            const double distance = glm::length(point.position);
            if (!(distance > 0) || !(point.area > 0)) continue;
            const glm::dvec3 to_light = point.position / distance;
            const double angle =
                std::max(-glm::dot(point.normal, to_light), 0.0) * point.area / (distance * distance);
            if (!casts || !visible || visible(to_light, far ? infinity : distance))
                add(to_light, radiance * angle);
        }
    }
};

std::vector<Incident> Lighting::incidentOn(const Surface& surface, const Visibility& visible) const {
    std::vector<Incident> lights;
    for (const Punctual& p : punctual_) {
        const Incident light = incident(p.light, p.position, surface.position, falloff_);
        if (glm::dot(light.to_light, surface.normal) > 0 && light.irradiance != glm::dvec3(0) &&
            (!p.casts || !visible || visible(light.to_light, light.distance)))
            lights.push_back(light);
    }
    return lights;
}

std::vector<Lighting::Shining> Lighting::shiningOn(const Surface& surface) const {
    std::vector<Shining> shining;
    for (const auto& [emitter, casts] : emitters_) {
        const glm::dvec3 centre = emitter.far ? emitter.centre : emitter.centre - surface.position;
        const double window = rangeWindow(glm::length(centre), emitter.range, falloff_.window);
        if (window > 0)
            shining.push_back({visiblePatches(emitter, centre, surface.normal), emitter.radiance * window,
                               casts, emitter.far});
    }
    return shining;
}

Lighting::MoreReflections Lighting::between(const Surface& surface, const Visibility& visible,
                                            const glm::dvec3& single, std::uint64_t seed) const {
    // All paths share one visibility test per punctual light.
    const std::vector<Incident> directions = incidentOn(surface, visible);
    const std::vector<Shining> shining = shiningOn(surface);
    const Between paths(surface);
    const double fraction = paths.fraction();
    glm::dvec3 layer(0), sky(0);
    std::size_t walked = 0;
    const auto estimate = [&](std::size_t round, std::uint64_t index) {
        Random random(streamOf(streamOf(seed, round), index));
        const Between::Path path = paths.path(random, [&](const Between::Add& add) {
            for (const Incident& light : directions) add(light.to_light, light.irradiance);
            for (const Shining& light : shining) light.add(random, visible, add);
        });
        layer += path.layer * fraction;
        ++walked;
        // Stores the ambient part in `diffuse`.
        Reflected sum{path.weight * ambient_, path.direct};
        if (environment_ && (!shadowed_environment_ || !visible || visible(path.direction, infinity)))
            sum.specular += path.weight * environment_->radiance(path.direction) * surface.occlusion;
        sky += (sum.specular - path.direct) * fraction;
        return sum * fraction;
    };
    Estimated more{};
    const double whole = std::max({single.r, single.g, single.b});
    // Few paths meet a second facet, so each may use few samples.
    if (fraction > Between::minFraction)
        more = sampleUntilConfident(estimate, 1, fraction > 0.05 ? 8 : 1, whole, 0);
    if (walked > 0) {
        layer /= static_cast<double>(walked);
        sky /= static_cast<double>(walked);
    }
    Surface dielectric = surface;
    dielectric.metallic = 0;
    if (surface.metallic < 1) layer += specularAlbedo(dielectric);
    return {{{glm::dvec3(0), more.value.specular},
             more.uncertainty,
             more.value.diffuse,
             {},
             {},
             {glm::dvec3(0), sky}},
            1.0 - lostToLayer(surface.base_layer, layer)};
}

Shading Lighting::fromEmitter(const Emitter& emitter, const glm::dvec3& location, const Brdf& brdf,
                              const Visibility& visible, std::uint64_t seed) const {
    const glm::dvec3 centre = emitter.far ? emitter.centre : emitter.centre - location;
    const double window = rangeWindow(glm::length(centre), emitter.range, falloff_.window);
    if (!(window > 0)) return {};
    std::vector<Patch> patches = visiblePatches(emitter, centre, brdf.normal());
    if (brdf.transmits())
        for (const Patch& patch : visiblePatches(emitter, centre, -brdf.normal())) patches.push_back(patch);
    std::vector<Leaves> leaves;
    Integral whole;
    for (const Patch& patch : patches) {
        leaves.push_back({&patch, {}});
        const auto integrand = [&](double u, double v) { return through(brdf, patch.at(u, v)); };
        const auto mustSplit = [&](const Cell& cell) { return mayHideLobe(brdf, patch, cell); };
        const Integral part =
            Quadrature(integrand, mustSplit, quadratureError, visible ? &leaves.back().leaves : nullptr)();
        whole.value += part.value;
        whole.error += part.error;
    }
    const glm::dvec3 radiance = emitter.radiance * window;
    const double brightest = std::max({radiance.r, radiance.g, radiance.b});
    if (!visible || !(whole.value.size() > 0)) return {whole.value * radiance, whole.error * brightest, {}};

    const Shaded shaded(brdf, leaves, emitter.far, visible);
    const std::size_t leaf_count = shaded.leafCount();
    std::size_t seen = 0, ignored = 0;
    constexpr std::uint64_t pilot = 2;
    for (std::uint64_t i = 0; i < pilot; ++i) shaded.estimate(~seed, i, false, seen);
    const bool mostly_visible = 2 * seen > pilot * leaf_count;
    const Estimated estimated = sampleUntilConfident(
        [&](std::size_t round, std::uint64_t index) {
            return shaded.estimate(streamOf(seed, round), index, mostly_visible, ignored);
        },
        leaf_count, std::max<std::uint64_t>(1, 8 / leaf_count), whole.value.size(), shaded.largestLeaf());
    return {estimated.value * radiance, (estimated.uncertainty + whole.error) * brightest, {}};
}

// Combines two sampling techniques by the balance heuristic (Veach and Guibas 1995, "Optimally Combining
// Sampling Techniques for Monte Carlo Rendering"): bright blocks of the map that the surface reflects, and
// the specular lobe, which may be narrower than a block.
Estimated Lighting::fromEnvironment(const Brdf& brdf, bool lobeOnly, const Visibility& visible,
                                    std::uint64_t seed) const {
    const LobeSampler lobes(brdf);
    const EnvironmentLight::Sampler bright(*environment_, [&](const glm::dvec3& middle, double reach) {
        // If the horizon or a lobe crosses a block, other directions may reflect more than its middle.
        const double n_dot_l = glm::dot(brdf.normal(), middle),
                     cosine = std::max((brdf.transmits() ? std::abs(n_dot_l) : n_dot_l) + reach, 0.0);
        return brdf(middle).size() + 0.02 * cosine;
    });
    const auto value = [&](const glm::dvec3& l) -> Reflected {
        Reflected f = brdf(l);
        if (lobeOnly) f.diffuse = glm::dvec3(0);
        if (!(f.size() > 0) || (visible && !visible(l, infinity))) return {};
        return f * environment_->radiance(l) * (1 / (lobes.density(l) + bright.density(l)));
    };
    std::array<std::array<glm::dvec2, 2>, 8> shifts;
    Random random(streamOf(seed, 0));
    for (auto& round : shifts)
        for (glm::dvec2& shift : round) {
            const double u = random();
            shift = {u, random()};
        }
    return sampleUntilConfident(
        [&](std::size_t round, std::uint64_t index) {
            const auto& shift = shifts[round];
            Reflected sum = value(lobes(evenly(index, shift[0])));
            if (bright.all() > 0) sum += value(bright(evenly(index, shift[1])));
            return sum;
        },
        2, 8, 0, 0);
}

}  // namespace diptych::reference
