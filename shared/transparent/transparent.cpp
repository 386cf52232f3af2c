// SPDX-License-Identifier: MIT
#include "shared/transparent/transparent.h"

#include "shared/contract/debug_mode.h"
#include "shared/draw/pipeline_keys.h"
#include "shared/draw/pipeline_parts.h"
#include "shared/draw/record.h"
#include "shared/draw/resolve.h"
#include "shared/shadow/shadow_maps.h"
#include "shared/transparent/fragment_lists.h"
#include "shared/transparent/read_images.h"
#include "shared/transparent/transmission.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <memory>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

namespace diptych {

namespace {

constexpr VkFormat depthsFormat = VK_FORMAT_R32_SFLOAT, sumsFormat = VK_FORMAT_R32G32B32A32_SFLOAT;
constexpr const char* name = "transparent";  // of all passes, so that they are timed together

// Declares what shading of blended surfaces reads.
Pass& shades(Pass& pass, PassList& passes, const FrameInputs& inputs) {
    inputs.lists.read(passes, pass);
    inputs.shadow.read(pass);
    inputs.posing.read(passes, pass);
    return pass.takes(shadingMs(passes, inputs, {}));
}

PipelineKey composeKey(const FrameInputs& inputs, Shader fragment) {
    return {.vertex = Shader::full_screen_vert,
            .fragment = fragment,
            .variant = {},
            .input = NO_VERTICES,
            .colors = {inputs.lit_format},
            .blends = {Blend::through}};
}

ImageRef addImage(PassList& passes, const char* image, VkFormat format) {
    return passes.image({.name = image, .format = format, .life = Life::transient});
}

void addOver(PassList& passes, const FrameInputs& inputs, ImageRef depth, ImageRef lit) {
    shades(passes.draw(name).color(lit, Load::keep).depthTest(depth), passes, inputs)
        .record(recordBlended(inputs, [&](const DrawItem& item) { return blendedKey(inputs, item); }));
}

// Draws sums over all layers, then composites their mean over the image. With `moments`, an earlier pass
// draws moments that weight the sums.
void addSums(PassList& passes, const FrameInputs& inputs, ImageRef depth, ImageRef lit, bool moments) {
    const ImageRef depths = addImage(passes, "optical depth", depthsFormat);
    ImageRef powers{};
    if (moments) {
        powers = addImage(passes, "moments of optical depth", sumsFormat);
        inputs.posing.read(passes, passes.draw(name))
            .color(depths, Load::clear)
            .color(powers, Load::clear)
            .depthTest(depth)
            .record(recordBlended(
                inputs,
                [&](const DrawItem& item) {
                    PipelineKey key = opacityKey(inputs, item, Shader::transparency_moments_frag);
                    key.colors = {depthsFormat, sumsFormat};
                    key.blends = {Blend::add, Blend::add};
                    return key;
                },
                {}, inputs.blended));
    }
    const ImageRef sums = addImage(passes, "sums of blended surfaces", sumsFormat);
    Pass& shade = passes.draw(name).color(sums, Load::clear);
    std::shared_ptr<const DescriptorSets> read;
    if (moments)
        read = readImages(shade, passes, inputs,
                          {{gpu::BINDING_BLENDED_DEPTHS, depths}, {gpu::BINDING_BLENDED_MOMENTS, powers}});
    else
        shade.color(depths, Load::clear);
    shades(shade.depthTest(depth), passes, inputs)
        .record(recordBlended(
            inputs,
            [&](const DrawItem& item) {
                PipelineKey key = blendedKey(inputs, item);
                key.fragment =
                    moments ? Shader::forward_blended_moments_frag : Shader::forward_blended_weighted_frag;
                key.colors = {sumsFormat};
                key.blends = {Blend::add};
                if (!moments) {
                    key.colors.push_back(depthsFormat);
                    key.blends.push_back(Blend::add);
                }
                return key;
            },
            std::move(read), inputs.blended));
    Pass& compose = passes.draw(name).color(lit, Load::keep);
    compose.record(recordFullScreen(
        inputs, inputs.pipelines.get(composeKey(inputs, Shader::compose_sums_frag)),
        readImages(compose, passes, inputs,
                   {{gpu::BINDING_BLENDED_DEPTHS, depths}, {gpu::BINDING_BLENDED_SUMS, sums}}),
        inputs.blended));
}

// Finds the nearest fragments of each pixel by depth, shades them, and composites them, for part of the
// image's rows at a time.
void addLists(PassList& passes, const FrameInputs& inputs, ImageRef depth, ImageRef lit) {
    const FragmentLists& lists = *inputs.fragments;
    const auto bound = std::make_shared<DescriptorSets>(blendedSet(inputs));
    lists.bind(*bound);
    gpu::BlendedConstants constants = inputs.blended;
    constants.layers = lists.layers();
    constants.width = passes.width();
    constants.rows = lists.rows();
    for (; constants.first_row < passes.height(); constants.first_row += constants.rows) {
        lists.addClear(passes, constants.first_row == 0);
        Pass& keys = inputs.posing.read(passes, passes.draw(name)).depthTest(depth);
        lists.use(passes, keys);
        keys.record(recordBlended(
            inputs,
            [&](const DrawItem& item) { return opacityKey(inputs, item, Shader::transparency_keys_frag); },
            bound, constants));
        Pass& shade = passes.draw(name).depthTest(depth);
        lists.use(passes, shade);
        shades(shade, passes, inputs)
            .record(recordBlended(
                inputs,
                [&](const DrawItem& item) {
                    PipelineKey key = blendedKey(inputs, item);
                    key.fragment = Shader::forward_blended_list_frag;
                    key.colors = {};
                    key.blends = {};
                    return key;
                },
                bound, constants));
        Pass& compose = passes.draw(name).color(lit, Load::keep);
        lists.use(passes, compose);
        compose.record(recordFullScreen(
            inputs, inputs.pipelines.get(composeKey(inputs, Shader::compose_list_frag)), bound, constants));
    }
}

}  // namespace

gpu::BlendedConstants blendedRange(const DrawList& draws, const View& view) {
    ViewDepths range{std::numeric_limits<double>::infinity(), 0};
    for (const DrawItem& item : draws.blended())
        range = {std::min(range.nearest, item.depths.nearest),
                 std::max(range.farthest, item.depths.farthest)};
    gpu::BlendedConstants constants{};
    constants.nearest = static_cast<float>(std::max(range.nearest, view.camera.near));
    constants.farthest = static_cast<float>(std::max(range.farthest, view.camera.near));
    if (draws.blended().empty()) constants.nearest = constants.farthest = 1;
    return constants;
}

void checkLightsOfBlended(const FrameInputs& inputs) {
    const gpu::uint max = inputs.entries_per_draw;
    if (inputs.draws.transparent().empty() || inputs.longest_list <= max) return;
    throw std::runtime_error(fmt::format(
        "blended surfaces and glass: a light list has {} entries, but a draw on {} reads up to {}; use "
        "--assign clustered or tiled, --light-cutoff, or --transparency off",
        inputs.longest_list, inputs.device.info().name, max));
}

void addTransparent(PassList& passes, const FrameInputs& inputs, ImageRef depth, ImageRef lit) {
    depth = addTransmission(passes, inputs, depth, lit);
    if (inputs.draws.blended().empty()) return;
    switch (inputs.transparency) {
        case Transparency::sorted:
        case Transparency::unsorted:
        case Transparency::triangles:
            return addOver(passes, inputs, depth, lit);
        case Transparency::weighted:
            return addSums(passes, inputs, depth, lit, false);
        case Transparency::moments:
            return addSums(passes, inputs, depth, lit, true);
        case Transparency::list:
            return addLists(passes, inputs, depth, lit);
        case Transparency::off:
            return;
    }
}

void addTransparentCapture(PassList& passes, const FrameInputs& inputs, ImageRef depth,
                           std::vector<CapturedImage>& images) {
    const auto first = std::ranges::find(images, passes.size() - 1, &CapturedImage::pass) - images.begin();
    const auto findLit = [&] {
        return std::ranges::find(images.begin() + first, images.end(), Channel::lit, &CapturedImage::mode);
    };
    const auto lit = findLit();
    const bool shown = lit != images.end();
    const ImageRef drawn = shown ? lit->image : ImageRef{};
    addTransmissionCapture(passes, inputs, depth, drawn, images, static_cast<std::size_t>(first));
    addCaptureResolve(passes, inputs, images, static_cast<std::size_t>(first));
    if (!shown || inputs.draws.transparent().empty()) return;
    addTransparent(passes, inputs, depth, drawn);
    const auto opaque = findLit();
    CapturedImage blended = *opaque;
    blended.image = addResolve(passes, inputs, drawn, Life::transient);
    blended.pass = passes.size() - 1;
    opaque->before_blending = true;
    images.push_back(blended);
}

}  // namespace diptych
