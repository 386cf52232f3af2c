// SPDX-License-Identifier: MIT
#include "compare/explain/pixel_breakdown.h"

#include "compare/frames/frame_facts.h"
#include "compare/metrics/channel.h"
#include "compare/metrics/pixel.h"
#include "compare/reference/pixel.h"
#include "compare/verdict/channel_diff.h"
#include "compare/verdict/encoding_use.h"
#include "shared/contract/debug_mode.h"
#include "shared/frame/debug_modes.h"
#include "shared/frame/made_channels.h"
#include "shared/scene/lights/casters.h"
#include "shared/scene/lights/lights_json.h"
#include "shared/text/one_line.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

namespace diptych {

namespace {

using Rgb3 = std::array<double, 3>;

constexpr std::array<std::pair<PixelTerm::Kind, std::string_view>, 11> kindNames{
    {{PixelTerm::Kind::light, "light"},
     {PixelTerm::Kind::other_lights, "other_lights"},
     {PixelTerm::Kind::environment, "environment"},
     {PixelTerm::Kind::ambient, "ambient"},
     {PixelTerm::Kind::emission, "emission"},
     {PixelTerm::Kind::transmittance, "transmittance"},
     {PixelTerm::Kind::haze, "haze"},
     {PixelTerm::Kind::blended, "blended"},
     {PixelTerm::Kind::sum, "sum"},
     {PixelTerm::Kind::lit, "lit"},
     {PixelTerm::Kind::residual, "residual"}}};

Rgb3 rgb(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}
Rgb3 plus(Rgb3 a, const Rgb3& b, double factor = 1) {
    for (std::size_t c = 0; c < 3; ++c) a.at(c) += factor * b.at(c);
    return a;
}
double largest(const Rgb3& a) {
    return std::max({std::abs(a[0]), std::abs(a[1]), std::abs(a[2])});
}

const Image* imageOf(const Frame& frame, Channel mode) {
    const auto found = frame.channels.find(mode);
    return found == frame.channels.end() ? nullptr : &found->second;
}

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

Coverage pixelAlone(Coverage coverage, const PixelQuery& query) {
    const std::size_t pixel =
        static_cast<std::size_t>(query.y) * static_cast<std::size_t>(query.baseline.size.width) +
        static_cast<std::size_t>(query.x);
    for (std::size_t i = 0; i < coverage.covered.size(); ++i) coverage.covered[i] &= i == pixel ? 1 : 0;
    coverage.count = coverage.covered.at(pixel) ? 1 : 0;
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
          covered_(coverage(frames_[0], frames_[1])),
          this_one_(pixelAlone(covered_, query)),
          pair_{frames_[0], frames_[1], view_.needs, covered_, query.device.bitExact(),
                nullptr,    nullptr,    nullptr,     nullptr,  query.light_differs},
          pixel_(static_cast<std::size_t>(query.y) * static_cast<std::size_t>(query.baseline.size.width) +
                 static_cast<std::size_t>(query.x)) {
        query.progress.at(0.6, "reference: the pixel");
        reference_ = renderer.referencePixel(query.reference, query.x, query.y);
        lit_floor_ = floorOf(debugMode(Channel::lit));
    }

    PixelBreakdown build() {
        breakdown_.scene = frames_[0].scene;
        breakdown_.camera = frames_[0].camera.name;
        breakdown_.x = query_.x;
        breakdown_.y = query_.y;
        breakdown_.size = query_.baseline.size;
        breakdown_.settings = {query_.baseline, query_.test};
        breakdown_.mode = query_.reference.reference_mode;
        breakdown_.names = {frames_[0].name, frames_[1].name};
        findSurface();
        const std::array<Rgb3, 3> blended = blendedOver();
        breakdown_.blended = largest(blended[0]) > 0 || largest(blended[1]) > 0;
        for (const Channel mode : pixelSteps()) takeStep(debugMode(mode));
        takeFacts();
        if (breakdown_.shown) takeTerms();
        return std::move(breakdown_);
    }

private:
    PixelValue valueOf(const Frame& frame, const DebugMode& mode) const {
        const Image* const image = imageOf(frame, mode.channel);
        if (!image) return {};
        const float* const p = image->pixel(pixel_);
        return {p, p + image->components};
    }
    // Value of a channel that both paths have.
    Rgb3 colorOf(std::size_t side, Channel mode) const {
        const float* const p = frames_.at(side).channels.at(mode).pixel(pixel_);
        return {double{p[0]}, double{p[1]}, double{p[2]}};
    }
    Rgb3 referenceOf(Channel mode) const { return rgb(reference_.channels.at(mode)); }
    double floorOf(const DebugMode& mode) const {
        return PixelError(mode.metric, mode.kind, frames_[0].channels.at(mode.channel), covered_).floor();
    }

    void findSurface() {
        for (const Frame& frame : frames_) {
            const int id = static_cast<int>(valueOf(frame, debugMode(Channel::material_id)).at(0));
            if (id < 0) continue;
            breakdown_.shown = true;
            breakdown_.material = id;
            if (static_cast<std::size_t>(id) < scene_.materials.size())
                breakdown_.material_name = oneLine(scene_.materials[static_cast<std::size_t>(id)].name);
            const PixelValue place = valueOf(frame, debugMode(Channel::position));
            const glm::dvec3 eye = view_.view.eye();
            breakdown_.position = {eye.x + place.at(0), eye.y + place.at(1), eye.z + place.at(2)};
            return;
        }
    }

    // Whether they differ by more than rounding.
    bool differs(const Image& a, const Image& b) const {
        return unequalPixels(a, b, pair_.cpu ? 0 : gpuUlps) > 0;
    }

    Tolerance toleranceOf(const DebugMode& mode) const {
        if (const Rule* const rule = ruleFor(query_.rules, mode.name)) {
            const std::optional<double> most = boundOn(rule->fail, "max");
            return {most.value_or(std::numeric_limits<double>::infinity()),
                    most ? rule->because
                         : rule->origin + " sets no limit for a single pixel: " + conditionText(rule->fail)};
        }
        if (isInformative(mode, pair_)) return informativeTolerance(pair_);
        FramePair here{frames_[0], frames_[1], view_.needs, this_one_, query_.device.bitExact()};
        Tolerance tolerance = derivedTolerance(mode, here);
        if (const auto use = encodingUse(mode, here)) tolerance.max = use->most;
        return tolerance;
    }

    void takeStep(const DebugMode& mode) {
        PixelStep step;
        step.mode = &mode;
        const std::array images{imageOf(frames_[0], mode.channel), imageOf(frames_[1], mode.channel)};
        if (!images[0] && !images[1]) return;
        for (std::size_t side = 0; side < 2; ++side) step.values.at(side) = valueOf(frames_.at(side), mode);
        if (const auto found = reference_.channels.find(mode.channel); found != reference_.channels.end())
            for (int c = 0; c < mode.width; ++c) step.reference.push_back(found->second[c]);
        if (!step.isCompared()) {
            const Path lacking = frames_.at(images[0] ? 1 : 0).settings.path;
            step.tolerance.because = notMadeBecause(frames_.at(images[0] ? 1 : 0).settings, mode);
            if (step.tolerance.because.empty())
                step.tolerance.because = std::string(nameOf(lacking)) + " does not have it";
            breakdown_.steps.push_back(std::move(step));
            return;
        }
        const PixelError error(mode.metric, mode.kind, *images[0], covered_);
        step.difference = error(images[1]->pixel(pixel_), images[0]->pixel(pixel_));
        step.differs = differs(onePixel(*images[0], pixel_), onePixel(*images[1], pixel_));
        step.tolerance = toleranceOf(mode);
        step.explained = encodingExplains(mode, pair_, pixel_);
        const bool judged = ruleFor(query_.rules, mode.name) == nullptr && !isInformative(mode, pair_);
        step.beyond = !(step.difference <= step.tolerance.max) || (judged && step.explained == false);
        breakdown_.steps.push_back(std::move(step));
    }

    void takeFacts() {
        const std::vector<std::size_t> casters =
            query_.baseline.shadows == Shadows::off
                ? std::vector<std::size_t>{}
                : castingLights(view_.lights, query_.baseline.shadow_lights);
        for (std::size_t i = 0; i < view_.lights.size(); ++i) {
            const Light& light = view_.lights[i];
            const glm::dvec3 place(breakdown_.position[0], breakdown_.position[1], breakdown_.position[2]);
            breakdown_.lights.push_back({.name = oneLine(light.name),
                                         .kind = nameOf(light.kind),
                                         .distance = light.kind == LightKind::directional
                                                         ? std::numeric_limits<double>::infinity()
                                                         : glm::distance(light.position, place),
                                         .range = double{light.range},
                                         .casts = std::ranges::find(casters, i) != casters.end()});
        }
    }

    // Whether the reference has light from it here, or a path may evaluate it.
    bool mayMatter(std::size_t light) const {
        return sentBy(light) > 0 || !breakdown_.lists_known[0] || !breakdown_.lists_known[1] ||
               breakdown_.lights[light].listed[0] || breakdown_.lights[light].listed[1];
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

    // Adds a term of both paths and the reference, which may lack it.
    PixelTerm& add(PixelTerm::Kind kind, std::vector<std::size_t> lights, const std::array<Rgb3, 2>& values,
                   const std::optional<Rgb3>& reference, double uncertainty = 0) {
        PixelTerm term{.kind = kind,
                       .lights = std::move(lights),
                       .values = values,
                       .reference = reference,
                       .uncertainty = uncertainty};
        const Rgb3 apart = plus(values[1], values[0], -1);
        if (largest(apart) > 0) term.difference = largest(apart) / std::max(largest(values[0]), lit_floor_);
        const bool judged = kind != PixelTerm::Kind::sum && kind != PixelTerm::Kind::residual;
        const double rounding =
            pair_.cpu ? 0 : gpuUlps * 0x1p-23 * std::max(largest(values[0]), largest(values[1]));
        term.differs = judged && !(largest(apart) <= rounding);
        breakdown_.terms.push_back(std::move(term));
        return breakdown_.terms.back();
    }

    void takeLists(std::array<LightTerms, 2>& alone) {
        for (std::size_t side = 0; side < 2; ++side) {
            const float depth = frames_.at(side).channels.at(Channel::depth).pixel(pixel_)[0];
            const std::optional<std::vector<std::size_t>> list =
                alone.at(side).listAt(query_.x, query_.y, depth);
            const double count = valueOf(frames_.at(side), debugMode(Channel::light_count)).at(0);
            // The list is only valid if its length equals the pixel's own light count.
            if (!list || static_cast<double>(list->size()) != count) continue;
            breakdown_.lists_known.at(side) = true;
            for (const std::size_t light : *list) breakdown_.lights[light].listed.at(side) = true;
        }
    }

    void takeLightTerms(std::array<LightTerms, 2>& alone) {
        const auto both = [&](std::span<const std::size_t> shining) {
            return std::array{alone[0].at(shining, query_.x, query_.y),
                              alone[1].at(shining, query_.x, query_.y)};
        };
        const auto reference = [&](std::span<const std::size_t> lights, double& uncertainty) {
            Rgb3 sum{};
            for (const std::size_t i : lights) {
                if (i >= reference_.lights.size()) return std::optional<Rgb3>();
                sum = plus(sum, rgb(reference_.lights[i].all()));
                uncertainty += reference_.lights[i].uncertainty;
            }
            return std::optional(sum);
        };
        const auto take = [&](PixelTerm::Kind kind, std::vector<std::size_t> lights) {
            const std::array<Rgb3, 2> values = both(lights);
            double uncertainty = 0;
            const std::optional<Rgb3> truth = reference(lights, uncertainty);
            add(kind, std::move(lights), values, truth, uncertainty);
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
    void takeLightsTogether(const std::array<Rgb3, 2>& environment) {
        std::array<Rgb3, 2> values{};
        for (std::size_t side = 0; side < 2; ++side)
            values.at(side) =
                plus(plus(colorOf(side, Channel::lit_diffuse), colorOf(side, Channel::lit_specular)),
                     environment.at(side), -1);
        std::vector<std::size_t> all(view_.lights.size());
        std::iota(all.begin(), all.end(), std::size_t{0});
        std::optional<Rgb3> truth = Rgb3{};
        double uncertainty = 0;
        for (const std::size_t i : all)
            if (truth && i < reference_.lights.size()) {
                truth = plus(*truth, rgb(reference_.lights[i].all()));
                uncertainty += reference_.lights[i].uncertainty;
            } else {
                truth.reset();
            }
        add(PixelTerm::Kind::other_lights, std::move(all), values, truth, uncertainty);
    }

    void takeTerms() {
        std::array<LightTerms, 2> alone{renderer_.lightTerms(query_.baseline, false),
                                        renderer_.lightTerms(query_.test, false)};
        takeLists(alone);
        const bool together = isByObject(query_.baseline) || isByObject(query_.test);
        if (!together) takeLightTerms(alone);
        std::array<Rgb3, 2> environment{};
        const auto both = [&](Channel mode) { return std::array{colorOf(0, mode), colorOf(1, mode)}; };
        const reference::Shading& rest = reference_.without_lights;
        if (view_.environment && query_.baseline.ibl_intensity > 0) {
            for (std::size_t side = 0; side < 2; ++side) {
                const Settings& settings = side == 0 ? query_.baseline : query_.test;
                LightTerms with = renderer_.lightTerms(settings, true);
                environment.at(side) = with.at({}, query_.x, query_.y);
                // Subtracts the harmonics, which black lights do not darken.
                if (isByObject(settings))
                    environment.at(side) =
                        plus(environment.at(side), alone.at(side).at({}, query_.x, query_.y), -1);
            }
            add(PixelTerm::Kind::environment, {}, environment, rgb(rest.reflected.sum()), rest.uncertainty);
        }
        if (together && !view_.lights.empty()) takeLightsTogether(environment);
        const auto takeChannel = [&](PixelTerm::Kind kind, Channel mode, const Rgb3& nothing) {
            const std::array<Rgb3, 2> values = both(mode);
            const Rgb3 reference = referenceOf(mode);
            if (values[0] != nothing || values[1] != nothing || reference != nothing)
                add(kind, {}, values, reference);
        };
        takeChannel(PixelTerm::Kind::ambient, Channel::lit_ambient, {});
        takeChannel(PixelTerm::Kind::emission, Channel::emission, {});
        takeChannel(PixelTerm::Kind::transmittance, Channel::transmittance, {1, 1, 1});
        takeChannel(PixelTerm::Kind::haze, Channel::lit_haze, {});
        takeBlended();
        takeSum();
    }

    // Change of lit by blended surfaces: baseline, test and reference.
    std::array<Rgb3, 3> blendedOver() const {
        if (frames_[0].unblended.empty() || frames_[1].unblended.empty()) return {};
        std::array<Rgb3, 3> values{};
        for (std::size_t side = 0; side < 2; ++side) {
            const float* const before = frames_.at(side).unblended.pixel(pixel_);
            values.at(side) = plus(colorOf(side, Channel::lit),
                                   {double{before[0]}, double{before[1]}, double{before[2]}}, -1);
        }
        values[2] = plus(referenceOf(Channel::lit), rgb(reference_.unblended), -1);
        return values;
    }

    void takeBlended() {
        const auto [baseline, test, reference] = blendedOver();
        if (largest(baseline) > 0 || largest(test) > 0 || largest(reference) > 0)
            add(PixelTerm::Kind::blended, {}, {baseline, test}, reference);
    }

    void takeSum() {
        std::array<Rgb3, 3> sums{};
        std::array<double, 3> sizes{};  // of the summands
        for (const PixelTerm& term : breakdown_.terms)
            for (std::size_t side = 0; side < 3; ++side) {
                const Rgb3 value = side < 2 ? term.values.at(side) : term.reference.value_or(Rgb3{});
                if (term.kind == PixelTerm::Kind::transmittance) {
                    for (std::size_t c = 0; c < 3; ++c) sums.at(side).at(c) *= value.at(c);
                } else {
                    sums.at(side) = plus(sums.at(side), value);
                    sizes.at(side) += largest(value);
                }
            }
        const std::array lit{colorOf(0, Channel::lit), colorOf(1, Channel::lit)};
        const Rgb3 truth = referenceOf(Channel::lit);
        add(PixelTerm::Kind::sum, {}, {sums[0], sums[1]}, sums[2]);
        add(PixelTerm::Kind::lit, {}, lit, truth, reference_.uncertainty);
        add(PixelTerm::Kind::residual, {}, {plus(lit[0], sums[0], -1), plus(lit[1], sums[1], -1)},
            plus(truth, sums[2], -1));
        // Each addition, one for each evaluated light and a few more, rounds a sum no larger than all
        // summands together.
        for (std::size_t side = 0; side < 2; ++side) {
            const PixelValue lights = valueOf(frames_.at(side), debugMode(Channel::light_count));
            breakdown_.residual_rounding.at(side) = (lights.at(0) + 8) * 0x1p-23 * sizes.at(side);
        }
        breakdown_.residual_rounding[2] = std::max(2 * reference_.uncertainty, 1e-9 * sizes[2]);
    }

    Renderer& renderer_;
    const PixelQuery& query_;
    const Scene& scene_;
    const SceneView& view_;
    const std::array<Frame, 2> frames_;  // baseline, test
    const Coverage covered_, this_one_;  // pixels with a surface; only this pixel
    const FramePair pair_;
    const std::size_t pixel_;
    reference::PixelLight reference_;
    double lit_floor_ = 0;
    PixelBreakdown breakdown_;
};

}  // namespace

std::string_view nameOf(PixelTerm::Kind kind) {
    for (const auto& [of, name] : kindNames)
        if (of == kind) return name;
    return "?";
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

PixelBreakdown::First PixelBreakdown::first() const {
    for (const PixelStep& step : steps)
        if (step.differs && !isAfterTerms(step.mode->channel)) return {&step, nullptr};
    for (const PixelTerm& term : terms)
        if (term.differs && term.kind != PixelTerm::Kind::lit) return {nullptr, &term};
    for (const PixelStep& step : steps)
        if (step.differs) return {&step, nullptr};
    return {};
}

std::size_t PixelBreakdown::differing() const {
    return static_cast<std::size_t>(std::ranges::count_if(steps, &PixelStep::differs));
}

PixelBreakdown pixelBreakdown(Renderer& renderer, SceneViews& views, const PixelQuery& query) {
    return BreakdownBuilder(renderer, views, query).build();
}

}  // namespace diptych
