// SPDX-License-Identifier: MIT
#include "shared/shadow/sun_shadow.h"

#include "shared/contract/bindings.h"
#include "shared/draw/record.h"
#include "shared/shadow/receivers.h"
#include "shared/shadow/scene_bounds.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace diptych {

namespace {

CascadeRequest cascadeRequest(const Settings& settings) {
    return {.size = settings.shadow_size,
            .count = settings.shadow_cascades,
            .kernel = settings.shadow_kernel,
            .distance = double{settings.shadow_distance},
            .bias = double{settings.shadow_bias}};
}

ClipmapRequest clipmapRequest(const Settings& settings) {
    return {.size = settings.shadow_size,
            .page = settings.clipmap_page_size,
            .kernel = settings.shadow_kernel,
            .bias = double{settings.shadow_bias}};
}

// Default exponents: slightly below the formats' limits.
constexpr float exponent32 = 40.0f, exponent16 = 5.5f, negativeExponent = 5.0f;

// Largest width of --shadows pcss penumbras, as a divisor of the map's side.
constexpr int mapOfWidest = 32;

gpu::uint featureOf(Shadows shadows) {
    switch (shadows) {
        case Shadows::pcf:
            return gpu::SHADOWS_PCF;
        case Shadows::evsm:
            return gpu::SHADOWS_EVSM;
        case Shadows::evsm4:
            return gpu::SHADOWS_EVSM4;
        case Shadows::msm4:
            return gpu::SHADOWS_MSM4;
        case Shadows::pcss:
            return gpu::SHADOWS_PCSS;
        case Shadows::clipmap:
            return gpu::SHADOWS_CLIPMAP;
        case Shadows::off:
            break;
    }
    return gpu::SHADOWS_NONE;
}

// Throws std::runtime_error naming the exponent if it exceeds the limit of the available format.
MomentMaps::Request momentsOf(const Settings& settings, const Device& device) {
    MomentMaps::Request request{
        .format = momentFormat(settings.shadows, settings.evsm_precision, momentSupport(device)),
        .exponent = settings.evsm_exponent,
        .negative = settings.evsm_negative_exponent,
        .nearest = settings.evsm_depth == EvsmDepth::from_minus_one ? -1.0f : 0.0f};
    using namespace format_use;
    if (const auto lacks =
            device.support().lacks(request.format.format, sampled | filtered | stored | stored_unnamed))
        throw std::runtime_error(
            fmt::format("--shadows {}: {}: {}", settings.valueOf("shadows"), device.info().name, *lacks));
    request.variant.set(gpu::FEATURE_shadows, featureOf(settings.shadows))
        .set(gpu::FEATURE_shadow_kernel, static_cast<gpu::uint>(settings.shadow_kernel));
    const double largest = largestExponent(request.format.half);
    if (request.exponent == 0) request.exponent = request.format.half ? exponent16 : exponent32;
    if (request.negative == 0) request.negative = negativeExponent;
    for (const auto& [option, exponent] : {std::pair{"--evsm-exponent", request.exponent},
                                           std::pair{"--evsm-negative-exponent", request.negative}})
        if (double{exponent} > largest)
            throw std::runtime_error(fmt::format("{} {}: the limit of {}-bit floats is {:.2f}", option,
                                                 exponent, request.format.half ? 16 : 32,
                                                 std::floor(100 * largest) / 100));
    return request;
}

// From the filter's centre to a corner, plus one texel.
double filterRadius(double width) {
    return width * std::numbers::sqrt2 / 2 + 1;
}

// Whether visible geometry may lie in the cascade's view depths, by bounding boxes, with a margin for
// float32 rounding.
bool coversVisible(const CascadeArea& area, const DrawList& seen) {
    constexpr double margin = 1e-5;
    return std::ranges::any_of(seen.items, [&](const DrawItem& item) {
        return item.depths.nearest * (1 - margin) <= area.end &&
               item.depths.farthest * (1 + margin) >= area.begin;
    });
}

// Removes first and last cascades without visible receivers, and adds a note.
void leaveOutUnseen(Cascades& cascades, const DrawList& seen, std::vector<std::string>& notes) {
    const auto covers = [&](const CascadeArea& area) { return coversVisible(area, seen); };
    const auto first = std::ranges::find_if(cascades.areas, covers);
    const auto end = std::find_if(cascades.areas.rbegin(), cascades.areas.rend(), covers).base();
    const auto count = static_cast<std::size_t>(std::max<std::ptrdiff_t>(end - first, 0));
    if (count < cascades.areas.size())
        notes.push_back(
            fmt::format("shadow maps: {} of {} cascades are drawn; the others contain nothing visible", count,
                        cascades.areas.size()));
    cascades.areas = count > 0 ? std::vector(first, end) : std::vector<CascadeArea>{};
}

// Where a cascade blends into the next, the next one's filter is larger in world space. `widest`: filter
// width in each cascade, texels.
std::vector<ShadowFilterRadius> cascadeFilterRadii(const Cascades& cascades,
                                                   const std::function<double(double)>& widest) {
    std::vector<ShadowFilterRadius> radii;
    for (std::size_t i = 0; i < cascades.areas.size(); ++i) {
        const CascadeArea& area = cascades.areas[i];
        const bool last = i + 1 == cascades.areas.size();
        const double texels = filterRadius(widest(area.texel));
        radii.push_back({last ? area.end : cascades.areas[i + 1].begin, texels * area.texel, area.texel});
    }
    return radii;
}

VkRect2D rectangleOf(const ReceiverMask::Texels& texels) {
    return {{texels.x, texels.y},
            {static_cast<std::uint32_t>(texels.width), static_cast<std::uint32_t>(texels.height)}};
}

}  // namespace

SunShadow::SunShadow(Device& device, DescriptorSets& frame, const Settings& settings)
    : frame_(frame),
      settings_(settings),
      request_(cascadeRequest(settings)),
      filter_(featureOf(settings.shadows)),
      nearest_(makeNearestSampler(device)),
      linear_(makeLinearSampler(device)) {}

void SunShadow::setLight(Device& device, Uploader& uploader, const std::vector<glm::vec4>& texels) {
    light_ = makeBuffer<glm::vec4>(device, uploader, "shadow light", texels,
                                   VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT);
    uploader.flush();
    light_view_ = makeTexelView(device, "shadow light", light_, VK_FORMAT_R32G32B32A32_SFLOAT);
    frame_.texels(0, gpu::BINDING_SHADOW_LIGHT, light_view_);
}

void SunShadow::prepare(const FrameInputs& inputs, Uploader& uploader, ClipmapAtlases& atlases,
                        const Pose& pose, const View& view, const std::optional<CastingSun>& sun) {
    casts_ = sun && !inputs.draws.items.empty();
    if (!casts_) return;
    view_ = &view;
    uploader_ = &uploader;
    Device& device = inputs.device;
    const glm::dvec3 to_light = glm::normalize(glm::dvec3(inputs.lights.lights[sun->light].position));
    if (filter_ == gpu::SHADOWS_CLIPMAP) {
        clipmap_.emplace(
            inputs, uploader, atlases, pose,
            fitClipmap(view, boundsOf(pose, inputs.geometry), to_light, clipmapRequest(settings_)),
            settings_);
        Cascades none = cascadesOf(clipmap_->clipmap());
        for (const CascadeArea& level : none.areas)
            level_filter_radii_.push_back({std::numeric_limits<double>::infinity(),
                                           filterRadius(request_.kernel) * level.texel, level.texel});
        none.areas.clear();
        sun_ = gpuShadowLight(none, view, sun->light);
        setLight(device, uploader, clipmapTexels());
        return;
    }
    const Bounds bounds = boundsOf(pose, inputs.geometry);
    if (filter_ == gpu::SHADOWS_PCSS && sun->angle == 0) {
        filter_ = gpu::SHADOWS_PCF;
        notes_.emplace_back("--shadows pcss: the shadow-casting sun has no angular size, so pcf is used");
    }
    if (filter_ == gpu::SHADOWS_PCSS)
        request_.kernel = std::max(request_.kernel, request_.size / mapOfWidest);
    if (settings_.shadow_fit == ShadowFit::depth) fitToDepth(inputs, uploader, pose, view, bounds, to_light);
    Cascades cascades = fitCascades(view, bounds, to_light, request_);
    leaveOutUnseen(cascades, inputs.draws, notes_);
    addCascades(inputs, uploader, pose, view, cascades);
    if (maps_.empty()) cascades.areas.clear();
    gpu::ShadowLight light = gpuShadowLight(cascades, view, sun->light);
    if (!maps_.empty()) setFilter(light, cascades, sun->angle, device);
    const std::vector<gpu::Cascade> areas = gpuCascades(cascades, view.eye(), request_.bias);
    std::vector<glm::vec4> texels(gpu::SHADOW_LIGHT_TEXELS + areas.size());
    std::memcpy(texels.data(), &light, sizeof light);
    std::memcpy(texels.data() + gpu::SHADOW_LIGHT_TEXELS, areas.data(), areas.size() * sizeof(gpu::Cascade));
    setLight(device, uploader, texels);
}

// Leaves maps_ empty without casters.
void SunShadow::addCascades(const FrameInputs& inputs, Uploader& uploader, const Pose& pose, const View& view,
                            const Cascades& cascades) {
    const bool all = settings_.shadow_casters == ShadowCasters::all;
    const bool compares = !hasMoments(settings_.shadows);
    std::vector<VisibleBox> seen;
    if (!all && !cascades.areas.empty()) seen = visibleBoxes(pose, inputs.geometry, view);
    const auto side = static_cast<std::uint32_t>(request_.size);
    for (const CascadeArea& area : cascades.areas) {
        const ReceiverMask mask(cascades, area, view, seen, request_, compares);
        Map map{makeCasterList(pose, inputs.geometry, inputs.materials,
                               {.clip_from_world = cascades.clipFromWorld(area, request_.size, view.eye()),
                                .eye = view.eye(),
                                .matters = [&](const ClipBox& box) { return mask.reachedBy(box); },
                                .all = all}),
                {},
                all ? VkRect2D{{}, {side, side}} : rectangleOf(mask.read())};
        map.draws = makeBuffer<gpu::Draw>(inputs.device, uploader, "casters", map.casters.draws,
                                          VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
        maps_.push_back(std::move(map));
    }
    if (maps_.empty()) return;
    if (std::ranges::any_of(maps_, [](const Map& map) { return map.casters.triangles > 0; })) {
        details_.push_back(fmt::format("shadow maps, from near to far: {} triangles of {}",
                                       fmt::join(triangles(), ", "),
                                       all ? "all casters" : "casters whose shadow may be visible"));
        return;
    }
    notes_.emplace_back("shadow maps: none is drawn; nothing casts a shadow");
    maps_.clear();
}

void SunShadow::fitToDepth(const FrameInputs& inputs, Uploader& uploader, const Pose& pose, const View& view,
                           const Bounds& bounds, const glm::dvec3& to_light) {
    constexpr int steps = 8;
    depth_bounds_.emplace(inputs.device);
    request_.shown = shownDepths(inputs, pose, view);
    if (!request_.shown) {
        notes_.emplace_back("--shadow-fit depth: the image is empty, so cascades cover the whole view");
        return;
    }
    const double texel = fitCascades(view, bounds, to_light, request_).areas.front().texel;
    const DepthVariation varies = depthVariation(inputs, uploader, pose, view, texel, steps);
    notes_.push_back(fmt::format(
        "--shadow-fit depth: cascades cover the visible depths, {:.6g} to {:.6g} m; if the camera moves "
        "right in {} steps of a texel ({:.3g} m), these vary by {:.2g} % and {:.2g} % (standard deviation), "
        "and the shadow texels vary with them",
        request_.shown->near, request_.shown->far, steps, texel, 100 * varies.near, 100 * varies.far));
}

// Shading parameters other than the cascades.
void SunShadow::setFilter(gpu::ShadowLight& light, const Cascades& cascades, double angle, Device& device) {
    double penumbra = 0;  // largest possible, m
    if (hasMoments(settings_.shadows)) {
        moments_ = momentsOf(settings_, device);
        moment_maps_.emplace(device);
        light.exponent = moments_->exponent;
        light.nearest = moments_->nearest;
        light.bleed = settings_.evsm_bleed;
        light.min_variance = settings_.evsm_min_variance;
        light.negative = moments_->negative;
        light.moment_bias = static_cast<float>(moments_->format.bias);
        if (!moments_->format.because.empty()) notes_.push_back(moments_->format.because);
        if (settings_.shadows != Shadows::msm4)
            notes_.push_back(fmt::format("--shadows {}: exponent {:g}{} in {}-bit floats",
                                         settings_.valueOf("shadows"), moments_->exponent,
                                         settings_.shadows == Shadows::evsm4
                                             ? fmt::format(", negative exponent {:g},", moments_->negative)
                                             : "",
                                         moments_->format.half ? 16 : 32));
    }
    if (filter_ == gpu::SHADOWS_PCSS) {
        const double disc = std::tan(std::min(angle, 3.14) / 2);  // limited, because it is infinite at pi
        penumbra = 2 * disc * (cascades.near - cascades.far);
        light.disc = static_cast<float>(disc);
        light.widest = static_cast<float>(request_.kernel);
        const double drawn = request_.kernel * cascades.areas.front().texel;
        if (drawn < penumbra)
            notes_.push_back(
                fmt::format("--shadows pcss: penumbras are limited to {} texels ({:.3g} m in the first "
                            "cascade); the sun's disc can cause {:.3g} m here",
                            request_.kernel, drawn, penumbra));
    }
    const double min = settings_.shadow_kernel, max = request_.kernel;
    filter_radii_ =
        cascadeFilterRadii(cascades, [=](double texel) { return std::clamp(penumbra / texel, min, max); });
}

std::vector<glm::vec4> SunShadow::clipmapTexels() const {
    std::vector<glm::vec4> texels(gpu::SHADOW_LIGHT_TEXELS);
    std::memcpy(texels.data(), &sun_, sizeof sun_);
    const std::vector<glm::vec4> pages = clipmap_->texels(*view_, request_.bias);
    texels.insert(texels.end(), pages.begin(), pages.end());
    return texels;
}

void SunShadow::choosePages(const FrameInputs& inputs) {
    if (!clipmap_) return;
    clipmap_->prepare(inputs, *view_);
    const std::vector<glm::vec4> texels = clipmapTexels();
    uploader_->buffer(light_, std::as_bytes(std::span(texels)));
    uploader_->flush();
    frame_.image(0, gpu::BINDING_SHADOW_MAP, clipmap_->atlas(), nearest_,
                 VK_IMAGE_LAYOUT_DEPTH_READ_ONLY_OPTIMAL);
    for (std::string& note : clipmap_->notes()) notes_.push_back(std::move(note));
}

void SunShadow::specialise(Variant& variant) const {
    if (!casts_) return;
    // Without maps, shading only darkens surfaces that face away from the sun.
    variant.set(gpu::FEATURE_shadows, any() ? filter_ : gpu::SHADOWS_PCF)
        .set(gpu::FEATURE_shadow_kernel, static_cast<gpu::uint>(settings_.shadow_kernel))
        .set(gpu::FEATURE_shadow_cascades, static_cast<gpu::uint>(maps_.size()));
}

void SunShadow::addPasses(PassList& passes, const FrameInputs& inputs) {
    if (maps_.empty()) return;
    if (depth_bounds_) depth_bounds_->addPasses(passes, inputs);
    const auto side = static_cast<std::uint32_t>(request_.size);
    image_ = passes.image({.name = "shadow map",
                           .format = depthFormat,
                           .extent = {side, side},
                           .layers = static_cast<std::uint32_t>(maps_.size()),
                           .array = true});
    for (std::uint32_t layer = 0; layer < maps_.size(); ++layer)
        inputs.posing.read(passes, passes.draw("shadow maps"))
            .depth(image_, Load::clear, {.layer = layer})
            .record([read = maps_[layer].read,
                     draw = recordCasters(inputs, maps_[layer].casters, maps_[layer].draws.handle())](
                        VkCommandBuffer commands) {
                vkCmdSetScissor(commands, 0, 1, &read);
                draw(commands);
            });
    if (moments_)
        image_ = moment_maps_->addPasses(passes, inputs.pipelines, image_, side,
                                         static_cast<std::uint32_t>(maps_.size()), *moments_);
    frame_.image(
        0, gpu::BINDING_SHADOW_MAP, passes.view(image_), moments_ ? linear_ : nearest_,
        moments_ ? VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL : VK_IMAGE_LAYOUT_DEPTH_READ_ONLY_OPTIMAL);
}

void SunShadow::read(Pass& pass, VkPipelineStageFlags2 stages) const {
    if (image_.valid()) pass.samples(image_, stages);
}

void SunShadow::addMarks(PassList& passes, const FrameInputs& inputs, ImageRef depth) {
    if (clipmap_) clipmap_->addMarks(passes, inputs, depth);
}

std::vector<std::uint64_t> SunShadow::triangles() const {
    std::vector<std::uint64_t> counts;
    for (const Map& map : maps_) counts.push_back(map.casters.triangles);
    return counts;
}

std::uint64_t SunShadow::bytes() const {
    std::uint64_t sum =
        light_.size() + (clipmap_ ? clipmap_->bytes() : 0) + (depth_bounds_ ? depth_bounds_->bytes() : 0);
    for (const Map& map : maps_) sum += map.draws.size();
    return sum;
}

}  // namespace diptych
