// SPDX-License-Identifier: MIT
#include "compare/explain/pixel_breakdown.h"

#include "compare/explain/frame_images.h"
#include "compare/frames/frame_properties.h"
#include "compare/metrics/channel.h"
#include "compare/metrics/pixel.h"
#include "compare/reference/pixel.h"
#include "compare/verdict/channel_diff.h"
#include "compare/verdict/encoding_use.h"
#include "shared/contract/debug_mode.h"
#include "shared/frame/debug_modes.h"
#include "shared/frame/supported_channels.h"
#include "shared/scene/lights/lights_json.h"
#include "shared/scene/lights/shadow_casters.h"
#include "shared/text/one_line.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

namespace diptych {

namespace {

using Values = std::array<glm::dvec3, 3>;  // baseline, test, reference

// Every channel but those of layers that the scene does not have.
RenderOptions drawingOf(const Requirements& needs, const Stage& progress) {
    RenderOptions drawing;
    for (const DebugMode& mode : debugModes())
        if (mayShow(mode.channel, needs.layers)) drawing.channels.push_back(mode.channel);
    drawing.runs = 0;
    drawing.through_gbuffer = true;
    drawing.progress = progress;
    return drawing;
}

Coverage pixelAlone(Coverage coverage, std::size_t pixel) {
    const std::uint8_t covered = coverage.covered.at(pixel);
    std::ranges::fill(coverage.covered, std::uint8_t{0});
    coverage.count = coverage.covered[pixel] = covered;
    return coverage;
}

class BreakdownBuilder {
public:
    BreakdownBuilder(Renderer& renderer, SceneViews& views, const PixelQuery& query)
        : renderer_(renderer),
          query_(query),
          scene_(views.scene()),
          view_(views.at(viewRequest(query.baseline))),
          frames_{renderer.draw(query.baseline, drawingOf(view_.needs, query.progress.part(0, 0.3))),
                  renderer.draw(query.test, drawingOf(view_.needs, query.progress.part(0.3, 0.6)))},
          pixel_(frames_[0].channels.at(Channel::lit).offset(query.x, query.y) / 3),
          covered_(coverage(frames_[0], frames_[1])),
          this_one_(pixelAlone(covered_, pixel_)),
          pair_{.baseline = frames_[0],
                .test = frames_[1],
                .needs = view_.needs,
                .coverage = covered_,
                .cpu = query.device.bitExact(),
                .light_differs = query.light_differs} {
        query.progress.at(0.6, "reference: the pixel");
        reference_ = renderer.referencePixel(query.reference, query.x, query.y);
        const DebugMode& lit = debugMode(Channel::lit);
        lit_floor_ =
            PixelError(lit.error_kind, lit.kind, frames_[0].channels.at(lit.channel), covered_).floor();
    }

    PixelBreakdown build() {
        breakdown_.scene = frames_[0].scene;
        breakdown_.camera = frames_[0].camera.name;
        breakdown_.x = query_.x;
        breakdown_.y = query_.y;
        breakdown_.settings = {query_.baseline, query_.test};
        breakdown_.mode = query_.reference.reference_mode;
        breakdown_.names = {frames_[0].name, frames_[1].name};
        findSurface();
        const Values blended = blendedOver();
        breakdown_.blended = largest(blended[0]) > 0 || largest(blended[1]) > 0;
        for (const Channel mode : pixelSteps()) takeStep(debugMode(mode));
        takeProperties();
        if (breakdown_.shown) takeTerms();
        return std::move(breakdown_);
    }

private:
    // Components of a channel; empty if the path lacks it.
    PixelValue valueOf(std::size_t side, Channel mode) const {
        const Image* const image = findChannel(frames_.at(side), mode);
        if (!image) return {};
        const float* const p = image->pixel(pixel_);
        return {p, p + image->components};
    }
    // Value of a channel that both paths have.
    glm::dvec3 colorOf(std::size_t side, Channel mode) const {
        return colorAt(frames_.at(side).channels.at(mode), pixel_);
    }
    Values valuesOf(Channel mode) const {
        return {colorOf(0, mode), colorOf(1, mode), reference_.channels.at(mode)};
    }

    void findSurface() {
        for (std::size_t side = 0; side < 2 && !breakdown_.shown; ++side) {
            const int id = static_cast<int>(valueOf(side, Channel::material_id).at(0));
            if (id < 0) continue;
            breakdown_.shown = true;
            breakdown_.material = id;
            if (static_cast<std::size_t>(id) < scene_.materials.size())
                breakdown_.material_name = oneLine(scene_.materials[static_cast<std::size_t>(id)].name);
            breakdown_.position = view_.view.eye() + colorOf(side, Channel::position);
        }
    }

    Tolerance toleranceOf(const DebugMode& mode) const {
        if (const Rule* const rule = ruleFor(query_.rules, mode.name)) {
            const std::optional<double> max = boundOn(rule->fail, "max");
            return {max.value_or(std::numeric_limits<double>::infinity()),
                    max ? rule->because
                        : rule->origin + " sets no limit for a single pixel: " + conditionText(rule->fail)};
        }
        if (isInformative(mode, pair_)) return informativeTolerance(pair_);
        FramePair here{frames_[0], frames_[1], view_.needs, this_one_, query_.device.bitExact()};
        Tolerance tolerance = derivedTolerance(mode, here);
        if (const auto use = encodingUse(mode, here)) tolerance.max = use->max;
        return tolerance;
    }

    void takeStep(const DebugMode& mode) {
        PixelStep step;
        step.mode = &mode;
        const std::array images{findChannel(frames_[0], mode.channel), findChannel(frames_[1], mode.channel)};
        if (!images[0] && !images[1]) return;
        for (std::size_t side = 0; side < 2; ++side) step.values.at(side) = valueOf(side, mode.channel);
        if (const auto found = reference_.channels.find(mode.channel); found != reference_.channels.end())
            for (int c = 0; c < mode.width; ++c) step.values[2].push_back(found->second[c]);
        if (step.isCompared()) {
            const PixelError error(mode.error_kind, mode.kind, *images[0], covered_);
            step.difference = error(images[1]->pixel(pixel_), images[0]->pixel(pixel_));
            step.differs = unequalPixels(onePixel(*images[0], pixel_), onePixel(*images[1], pixel_),
                                         pair_.cpu ? 0 : gpuUlps) > 0;
            step.tolerance = toleranceOf(mode);
            step.explained = encodingExplains(mode, pair_, pixel_);
            const bool evaluated = ruleFor(query_.rules, mode.name) == nullptr && !isInformative(mode, pair_);
            step.beyond = !(step.difference <= step.tolerance.max) || (evaluated && step.explained == false);
        } else {
            const Settings& lacking = images[0] ? query_.test : query_.baseline;
            step.tolerance.because = unsupportedReason(lacking, mode);
            if (step.tolerance.because.empty())
                step.tolerance.because = std::string(nameOf(lacking.path)) + " does not have it";
        }
        breakdown_.steps.push_back(std::move(step));
    }

    void takeProperties() {
        const std::vector<std::size_t> casters =
            query_.baseline.shadows == Shadows::off
                ? std::vector<std::size_t>{}
                : castingLights(view_.lights, query_.baseline.shadow_lights);
        for (std::size_t i = 0; i < view_.lights.size(); ++i) {
            const Light& light = view_.lights[i];
            breakdown_.lights.push_back({.name = oneLine(light.name),
                                         .kind = nameOf(light.kind),
                                         .distance = light.kind == LightKind::directional
                                                         ? std::numeric_limits<double>::infinity()
                                                         : glm::distance(light.position, breakdown_.position),
                                         .range = double{light.range},
                                         .casts = std::ranges::find(casters, i) != casters.end()});
        }
    }

    // Whether the reference has light from it here, or a path may evaluate it.
    bool mayMatter(std::size_t light) const {
        return sentBy(light) > 0 || std::ranges::any_of(breakdown_.lists, [&](const auto& list) {
                   return !list || std::ranges::binary_search(*list, light);
               });
    }
    // Light in the reference, largest component; 0 if it sees background.
    double sentBy(std::size_t light) const {
        return light < reference_.lights.size() ? reference_.lights[light].reflected.size() : 0;
    }

    // Lights by importance at the pixel: by their light in the reference, then listed ones, then all
    // others by distance.
    std::vector<std::size_t> byImportance() const {
        std::vector<std::size_t> order(view_.lights.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        const auto key = [&](std::size_t i) {
            return std::tuple(-sentBy(i), !mayMatter(i), breakdown_.lights[i].distance);
        };
        std::ranges::stable_sort(order, {}, key);
        return order;
    }

    PixelTerm& add(PixelTerm::Kind kind, const Values& values, double uncertainty = 0) {
        PixelTerm& term = breakdown_.terms.emplace_back(
            PixelTerm{.kind = kind, .values = values, .uncertainty = uncertainty});
        const double difference = largest(values[1] - values[0]);
        if (difference > 0) term.difference = difference / std::max(largest(values[0]), lit_floor_);
        const bool evaluated = kind != PixelTerm::Kind::sum && kind != PixelTerm::Kind::residual;
        const double rounding =
            pair_.cpu ? 0 : gpuUlps * 0x1p-23 * std::max(largest(values[0]), largest(values[1]));
        term.differs = evaluated && !(difference <= rounding);
        return term;
    }

    // Adds a term of lights; the reference has them unless it sees background.
    void addLights(PixelTerm::Kind kind, std::vector<std::size_t> lights, Values values) {
        double uncertainty = 0;
        const bool known = !reference_.lights.empty();
        if (known)
            for (const std::size_t light : lights) {
                values[2] += reference_.lights[light].all();
                uncertainty += reference_.lights[light].uncertainty;
            }
        PixelTerm& term = add(kind, values, uncertainty);
        term.lights = std::move(lights);
        term.has_reference = known;
    }

    void takeLists(std::array<LightTerms, 2>& alone) {
        for (std::size_t side = 0; side < 2; ++side) {
            const float depth = frames_.at(side).channels.at(Channel::depth).pixel(pixel_)[0];
            std::optional<std::vector<std::size_t>> list = alone.at(side).listAt(query_.x, query_.y, depth);
            // The list is only valid if its length equals the pixel's own light count.
            if (list && static_cast<double>(list->size()) == valueOf(side, Channel::light_count).at(0))
                breakdown_.lists.at(side) = std::move(list);
        }
    }

    glm::dvec3 lightOf(LightTerms& terms, std::span<const std::size_t> shining) const {
        const std::array<double, 3> light = terms.at(shining, query_.x, query_.y);
        return {light[0], light[1], light[2]};
    }

    void takeLightTerms(std::array<LightTerms, 2>& alone) {
        const auto take = [&](PixelTerm::Kind kind, std::vector<std::size_t> lights) {
            Values values{};
            for (std::size_t side = 0; side < 2; ++side) values.at(side) = lightOf(alone.at(side), lights);
            addLights(kind, std::move(lights), values);
        };
        const std::vector<std::size_t> order = byImportance();
        breakdown_.drawn_alone = std::min(static_cast<std::size_t>(std::ranges::count_if(
                                              order, [&](std::size_t i) { return mayMatter(i); })),
                                          lightsDrawnAlone);
        for (std::size_t i = 0; i < breakdown_.drawn_alone; ++i) {
            query_.progress.at(
                0.65 + 0.35 * static_cast<double>(i) / static_cast<double>(breakdown_.drawn_alone),
                "render one light");
            take(PixelTerm::Kind::light, {order[i]});
        }
        if (breakdown_.drawn_alone < order.size()) {
            std::vector<std::size_t> others(
                order.begin() + static_cast<std::ptrdiff_t>(breakdown_.drawn_alone), order.end());
            std::ranges::sort(others);
            take(PixelTerm::Kind::other_lights, std::move(others));
        }
    }

    // Per-object lights are also in harmonics, which combine all of them, so no light can be rendered
    // alone.
    static bool isByObject(const Settings& settings) { return settings.assign == Assignment::per_object; }

    // Adds the reflected light minus the environment's as one term for all lights.
    void takeLightsTogether(const Values& environment) {
        Values values{};
        for (std::size_t side = 0; side < 2; ++side)
            values.at(side) = colorOf(side, Channel::lit_diffuse) + colorOf(side, Channel::lit_specular) -
                              environment.at(side);
        std::vector<std::size_t> all(view_.lights.size());
        std::iota(all.begin(), all.end(), std::size_t{0});
        addLights(PixelTerm::Kind::other_lights, std::move(all), values);
    }

    void takeTerms() {
        std::array<LightTerms, 2> alone{renderer_.lightTerms(query_.baseline, false),
                                        renderer_.lightTerms(query_.test, false)};
        takeLists(alone);
        const bool together = isByObject(query_.baseline) || isByObject(query_.test);
        if (!together) takeLightTerms(alone);
        Values environment{};
        if (view_.environment && query_.baseline.ibl_intensity > 0) {
            for (std::size_t side = 0; side < 2; ++side) {
                const Settings& settings = side == 0 ? query_.baseline : query_.test;
                LightTerms with = renderer_.lightTerms(settings, true);
                environment.at(side) = lightOf(with, {});
                // Subtracts the harmonics, which black lights do not darken.
                if (isByObject(settings)) environment.at(side) -= lightOf(alone.at(side), {});
            }
            const reference::Shading& rest = reference_.without_lights;
            environment[2] = rest.reflected.sum();
            add(PixelTerm::Kind::environment, environment, rest.uncertainty);
        }
        if (together && !view_.lights.empty()) takeLightsTogether(environment);
        const auto takeUnless = [&](double nothing, PixelTerm::Kind kind, const Values& values) {
            if (values != Values{glm::dvec3(nothing), glm::dvec3(nothing), glm::dvec3(nothing)})
                add(kind, values);
        };
        takeUnless(0, PixelTerm::Kind::ambient, valuesOf(Channel::lit_ambient));
        takeUnless(0, PixelTerm::Kind::emission, valuesOf(Channel::emission));
        takeUnless(1, PixelTerm::Kind::transmittance, valuesOf(Channel::transmittance));
        takeUnless(0, PixelTerm::Kind::haze, valuesOf(Channel::lit_haze));
        takeUnless(0, PixelTerm::Kind::blended, blendedOver());
        takeSum();
    }

    // Change of lit by blended surfaces.
    Values blendedOver() const {
        if (frames_[0].unblended.empty() || frames_[1].unblended.empty()) return {};
        Values values = valuesOf(Channel::lit);
        for (std::size_t side = 0; side < 2; ++side)
            values.at(side) -= colorAt(frames_.at(side).unblended, pixel_);
        values[2] -= reference_.unblended;
        return values;
    }

    void takeSum() {
        Values sums{};
        std::array<double, 3> sizes{};  // of the summands
        for (const PixelTerm& term : breakdown_.terms)
            for (std::size_t side = 0; side < 3; ++side) {
                const glm::dvec3& value = term.values.at(side);
                if (term.kind == PixelTerm::Kind::transmittance) {
                    sums.at(side) *= value;
                } else {
                    sums.at(side) += value;
                    sizes.at(side) += largest(value);
                }
            }
        const Values lit = valuesOf(Channel::lit);
        add(PixelTerm::Kind::sum, sums);
        add(PixelTerm::Kind::lit, lit, reference_.uncertainty);
        add(PixelTerm::Kind::residual, {lit[0] - sums[0], lit[1] - sums[1], lit[2] - sums[2]});
        // Each addition, one for each evaluated light and a few more, rounds a sum no larger than all
        // summands together.
        for (std::size_t side = 0; side < 2; ++side)
            breakdown_.residual_rounding.at(side) =
                (valueOf(side, Channel::light_count).at(0) + 8) * 0x1p-23 * sizes.at(side);
        breakdown_.residual_rounding[2] = std::max(2 * reference_.uncertainty, 1e-9 * sizes[2]);
    }

    Renderer& renderer_;
    const PixelQuery& query_;
    const Scene& scene_;
    const SceneView& view_;
    const std::array<Frame, 2> frames_;  // baseline, test
    const std::size_t pixel_;
    const Coverage covered_, this_one_;  // pixels with a surface; only this pixel
    const FramePair pair_;
    reference::PixelLight reference_;
    double lit_floor_ = 0;
    PixelBreakdown breakdown_;
};

}  // namespace

double largest(const glm::dvec3& value) {
    return std::max({std::abs(value.x), std::abs(value.y), std::abs(value.z)});
}

bool isAfterTerms(Channel mode) {
    return isLit(mode) || isOfHaze(mode);
}

std::span<const Channel> pixelSteps() {
    static const std::vector<Channel> steps = [] {
        std::vector<Channel> modes;
        for (const DebugMode& mode : debugModes()) modes.push_back(mode.channel);
        std::ranges::sort(modes, {}, [](Channel mode) { return debugMode(mode).step; });
        return modes;
    }();
    return steps;
}

std::pair<const PixelStep*, const PixelTerm*> PixelBreakdown::first() const {
    for (const PixelStep& step : steps)
        if (step.differs && !isAfterTerms(step.mode->channel)) return {&step, nullptr};
    for (const PixelTerm& term : terms)
        if (term.differs && term.kind != PixelTerm::Kind::lit) return {nullptr, &term};
    for (const PixelStep& step : steps)
        if (step.differs) return {&step, nullptr};
    return {};
}

PixelBreakdown pixelBreakdown(Renderer& renderer, SceneViews& views, const PixelQuery& query) {
    return BreakdownBuilder(renderer, views, query).build();
}

}  // namespace diptych
