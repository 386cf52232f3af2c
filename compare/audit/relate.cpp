// SPDX-License-Identifier: MIT
#include "compare/audit/relate.h"

#include "compare/audit/relations.h"
#include "compare/metrics/channel.h"
#include "compare/metrics/pixel.h"
#include "compare/render/reference_frame.h"
#include "compare/verdict/encoding_bits.h"
#include "shared/contract/debug_mode.h"
#include "shared/scene/model/material_slots.h"
#include "shared/text/counted.h"
#include "shared/vulkan/device/device.h"

#include <fmt/format.h>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <utility>

namespace diptych::audit {

namespace {

// Roundings of a term of lit from the vertex on, without those of the sum: transform, interpolation,
// normalisation, D, V, F, attenuation, each of some ten operations.
constexpr double roundingsOfATerm = 128;
// Terms of lit beside those of its lights: emission, ambient light, the lightmap, the environment's diffuse
// and specular light, and haze. Two more for factors of the whole sum, such as transmittance.
constexpr double termsBesideLights = 8;
// Differences of positions one pixel apart, across and down. Each of the four positions rounds some seven
// times: three products, three sums and an interpolation.
constexpr double roundingsOfAFacet = 28;
// Chance that a filter's weight takes another of 256 steps between two texels: in two directions, in up to
// four maps of two levels each, with coordinates rounded by four operations.
constexpr double chancesOfATexel = 256.0 * 2 * 4 * 2 * 4;
constexpr double maxFiltered = 0.25;  // more than this is another fault
constexpr double roundoff = 0x1p-24;  // of one float32 operation

RenderOptions drawingRelated(bool packed = false) {
    RenderOptions options;
    options.channels.assign(relatedChannels().begin(), relatedChannels().end());
    if (packed) options.channels = {Channel::lit};
    options.requested = options.channels;
    options.through_gbuffer = packed;
    options.runs = 0;
    return options;
}

// Error bound of a channel's component decoded from the G-buffer; emission and a film's thickness: relative
// to the largest component.
std::map<Channel, double> packedBounds(const Settings& settings) {
    if (!hasGBuffer(settings.path)) return {};
    Requirements needs;
    needs.emission = true;
    needs.surface_layers = gpu::LAYER_CLEARCOAT | gpu::LAYER_SHEEN | gpu::LAYER_IRIDESCENCE;
    std::map<Channel, double> bounds;
    for (const Channel channel : relatedChannels())
        if (const auto field = storedField(channel, settings.gbuffer, needs))
            bounds[channel] = isAngle(debugMode(channel).error_kind) ? glm::radians(field->largestBound())
                                                                     : field->largestBound();
    return bounds;
}

// Pixels per radian of the image; an orthographic one as seen from the distance at which it is rendered.
double pixelsPerRadian(const Subject& subject) {
    const Camera& camera = subject.view.camera;
    if (!camera.orthographic) return subject.view.height / (2 * std::tan(camera.yfov / 2));
    return subject.farthest() * subject.view.height / (2 * camera.ymag);
}

double largestSide(const Scene& scene) {
    int side = 0;
    for (const TextureImage& image : scene.images) side = std::max({side, image.width, image.height});
    return side;
}

Settings settingsOfSeries(const Series& series, const Settings& settings) {
    const Settings applied = series.applied(settings);
    return isReference(series.path) ? referenceSettings(applied) : withoutReference(applied);
}

// Renderers to test: both paths with the original Settings, deferred with a float32 G-buffer, and last the
// reference.
ChosenSeries relatedSeries(const Subject& subject) {
    return chosenOf(
        {{drawn_paths[0], {}},
         {drawn_paths[1], {}},
         {Path::deferred, {{"gbuffer", "full"}}},
         {Path::reference, {{"reference-mode", "scene"}}}},
        [&](const Series& series) { return settingsOfSeries(series, subject.original.settings); });
}

}  // namespace

bool RelationResult::passes() const {
    return std::ranges::all_of(series, [](const SeriesResult& of) {
        return isReference(of.series.path) || !of.lacks.empty() || of.comparison.passes();
    });
}

RelationMeasurer::RelationMeasurer(Device& device, const Subject& subject,
                                   std::function<void(const std::string&)> onStep,
                                   std::shared_ptr<PipelineSet> pipelines)
    : device_(device),
      subject_(subject),
      on_step_(std::move(onStep)),
      pipelines_(pipelines ? std::move(pipelines) : makePipelineSet(device)),
      chosen_(relatedSeries(subject)) {}

void RelationMeasurer::draw(Drawn& drawn, const Case& of, std::span<const Settings> settings,
                            bool reference) {
    drawn.frames.resize(settings.size());
    drawn.failed.resize(settings.size());
    SceneViews views(of.scene);
    std::optional<Renderer> renderer;
    for (std::size_t i = 0; i < settings.size(); ++i) {
        const bool on_device = needsDevice(settings[i]);
        if (drawn.frames[i] || !drawn.failed[i].empty() || (!on_device && !reference)) continue;
        if (on_device && !renderer) renderer.emplace(device_, views, pipelines_);
        try {
            drawn.frames[i] =
                on_device ? renderer->draw(settings[i], drawingRelated())
                          : std::move(drawWithoutDevice(views, {settings[i]}, drawingRelated()).front());
        } catch (const std::exception& error) {
            drawn.failed[i] = error.what();
        }
    }
}

Image RelationMeasurer::packedLight(const Case& of, const PixelMap& map) {
    Settings settings = of.settings;
    settings.path = unencoded_path;
    SceneViews views(of.scene);
    Renderer renderer(device_, views, pipelines_);
    Frame frame = renderer.draw(withoutReference(settings), drawingRelated(true));
    const Image& through = frame.through_gbuffer.at(Channel::lit);
    Image& own = frame.channels.at(Channel::lit);
    Image change(own.width, own.height, 1);
    for (std::size_t i = 0; i < own.pixels(); ++i)
        *change.pixel(i) = static_cast<float>(
            metrics::distance(std::as_const(own).pixel(i), through.pixel(i), own.components));
    own = std::move(change);
    return std::move(mappedBack(frame, map).channels.at(Channel::lit));
}

Image RelationMeasurer::packedLight(const Related& related) {
    Image own;
    Image& original = related.own_base ? own : packed_light_;
    if (original.empty()) original = packedLight(related.base, {});
    Image sum = packedLight(related.changed, related.map);
    std::ranges::transform(sum.data, original.data, sum.data.begin(), std::plus());
    return sum;
}

RelationTolerance RelationMeasurer::toleranceOf(const Relation& relation, const Related& related,
                                                const Settings& settings) const {
    RelationTolerance tolerance;
    tolerance.equality = relation.equality;
    tolerance.reorders = relation.reorders;
    if (!relation.same_pipelines && !device_.profile().bit_exact) tolerance.ulps = gpuUlps;
    const double terms =
        static_cast<double>(std::max(related.base.scene.lights.size(), related.changed.scene.lights.size())) +
        termsBesideLights;
    // Both images may round in opposite directions.
    if (relation.equality == Equality::sums) tolerance.relative = 2 * terms * roundoff;
    if (relation.equality != Equality::rounding) return tolerance;
    tolerance.relative = 2 * (terms + roundingsOfATerm) * roundoff;
    for (const Material& material : related.base.scene.materials)
        tolerance.textured.push_back(std::ranges::any_of(
            materialSlots, [&](const MaterialSlot& slot) { return (material.*slot.texture).texture >= 0; }));
    if (isReference(settings.path)) return tolerance;
    tolerance.step = std::ldexp(2.0, -static_cast<int>(device_.limits().subPixelPrecisionBits));
    // One step across, one down, and one between two levels.
    tolerance.filter_step = std::ldexp(2.0, -static_cast<int>(device_.limits().subTexelPrecisionBits)) +
                            std::ldexp(1.0, -static_cast<int>(device_.limits().mipmapPrecisionBits));
    tolerance.facet = 2 * roundingsOfAFacet * roundoff * pixelsPerRadian(subject_);
    tolerance.filtered_fraction =
        std::min(maxFiltered, chancesOfATexel * largestSide(related.base.scene) * roundoff);
    tolerance.packed = packedBounds(settings);
    return tolerance;
}

std::uint64_t RelationMeasurer::tied() {
    if (tied_) return *tied_;
    tied_ = 0;
    const std::array orders{std::string("draws_reversed"), std::string("materials_permuted")};
    for (const Relation* order : relationsOf(orders)) {
        if (!order->lacks(subject_).empty()) continue;
        Related related{subject_.original, subject_.original};
        order->change(related, subject_);
        const std::array settings{settingsOfSeries({unencoded_path, {}}, subject_.original.settings)};
        Drawn original, changed;
        draw(original, related.base, settings, false);
        draw(changed, related.changed, settings, false);
        if (!original.frames[0] || !changed.frames[0]) continue;
        RelationTolerance tolerance;
        tolerance.reorders = true;
        const Frame back = mappedBack(*changed.frames[0], related.map);
        tied_ = std::max(*tied_, evaluate(*original.frames[0], back, tolerance).excluded);
    }
    return *tied_;
}

void RelationMeasurer::check(SeriesResult& of, std::size_t i, const Related& related, const Drawn& original,
                             const Drawn& changed) {
    Image packed;
    if (hasGBuffer(of.series.path) && !of.tolerance.packed.empty()) {
        packed = packedLight(related);
        of.tolerance.packed_light = &packed;
    }
    if (const auto& reference = original.frames.back(); reference && !reference->blended.empty())
        of.tolerance.blended = &reference->blended;
    of.comparison.failed = original.failed[i].empty() ? changed.failed[i] : original.failed[i];
    if (of.comparison.failed.empty()) {
        Frame back = mappedBack(*changed.frames[i], related.map);
        of.comparison = evaluate(*original.frames[i], back, of.tolerance);
        if (!of.comparison.passes()) {
            of.original = original.frames[i];
            of.changed = std::move(back);
        }
    }
    of.tolerance.packed_light = of.tolerance.blended = nullptr;
}

RelationResult RelationMeasurer::measure(const Relation& relation, const std::function<void(Case&)>& spoil) {
    RelationResult result;
    result.relation = &relation;
    result.lacks = relation.lacks(subject_);
    if (!result.lacks.empty()) return result;
    if (on_step_) on_step_(std::string(relation.name));
    Related related{subject_.original, subject_.original};
    relation.change(related, subject_);
    if (spoil) spoil(related.changed);
    std::vector<Settings> before, after;
    for (const Series& series : series_) {
        before.push_back(settingsOfSeries(series, related.base.settings));
        after.push_back(settingsOfSeries(series, related.changed.settings));
    }
    // The original images are rendered once, unless a relation has its own base.
    Drawn own, changed;
    Drawn& original = related.own_base ? own : original_;
    // The reference integrates an environment for a minute, where a path reads its maps. It decides
    // nothing here: it only shows whose fault a broken relation is, and which pixels blend.
    const bool dear = related.base.scene.environment.has_value();
    const bool blended = std::ranges::any_of(related.base.scene.materials, blends);
    draw(original, related.base, before, !dear || blended);
    draw(changed, related.changed, after, !dear);
    for (std::size_t i = 0; i < series_.size(); ++i) {
        SeriesResult& of = result.series.emplace_back();
        of.series = series_[i];
        if (relation.of_settings && effectiveSettings(before[i]) == effectiveSettings(after[i])) {
            of.lacks = fmt::format("{} does not read the changed input", nameOf(series_[i].path));
            continue;
        }
        if (dear && isReference(of.series.path)) {
            if (result.passes()) {
                of.lacks = "not drawn: both paths hold, and the reference is slow with an environment";
                continue;
            }
            draw(original, related.base, before, true);
            draw(changed, related.changed, after, true);
        }
        of.tolerance = toleranceOf(relation, related, after[i]);
        check(of, i, related, original, changed);
    }
    // Visibility among coinciding surfaces is arbitrary.
    if (relation.equality != Equality::rounding && !relation.reorders) return result;
    const bool many = std::ranges::any_of(result.series, [](const SeriesResult& of) {
        return of.comparison.excluded > of.comparison.max_excluded;
    });
    if (spoil || !many || tied() <= result.series.front().comparison.covered / 100) return result;
    result.lacks =
        fmt::format("{} show coinciding surfaces, where either may be visible", counted(tied(), "pixel"));
    result.series.clear();
    return result;
}

}  // namespace diptych::audit
