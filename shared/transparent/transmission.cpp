// SPDX-License-Identifier: MIT
#include "shared/transparent/transmission.h"

#include "shared/contract/debug_mode.h"
#include "shared/draw/pipeline_keys.h"
#include "shared/draw/pipeline_parts.h"
#include "shared/draw/record.h"
#include "shared/draw/resolve.h"
#include "shared/shadow/shadow_maps.h"
#include "shared/transparent/read_images.h"

#include <algorithm>
#include <array>
#include <bit>

namespace diptych {

namespace {

constexpr const char* passName = "transmission";  // of all passes, so that they are timed together

// Channels that glass draws over the values of opaque surfaces.
constexpr std::array drawnOver{Channel::transmission,      Channel::transmission_thickness,
                               Channel::attenuation_color, Channel::attenuation_distance,
                               Channel::dispersion,        Channel::lit_transmission};

// The mip chain of `lit`; without rough surfaces, which alone read the others, its first level.
ImageRef addBackdrop(PassList& passes, const FrameInputs& inputs, ImageRef lit) {
    const ImageRef opaque = addResolve(passes, inputs, lit, Life::transient, passName);
    const std::uint32_t levels =
        inputs.blurred_backdrop
            ? static_cast<std::uint32_t>(std::bit_width(std::max(passes.width(), passes.height())))
            : 1;
    const ImageRef backdrop =
        passes.image({.name = "backdrop", .format = litFormat, .levels = levels, .life = Life::transient});
    const Pipeline pipeline = inputs.pipelines.get(PipelineKey{.vertex = Shader::full_screen_vert,
                                                               .fragment = Shader::backdrop_frag,
                                                               .variant = {},
                                                               .input = NO_VERTICES,
                                                               .colors = {litFormat}});
    for (std::uint32_t level = 0; level < levels; ++level) {
        Pass& pass = passes.draw(passName).color(backdrop, Load::clear, {}, {.level = level});
        const ReadImage before = level == 0
                                     ? ReadImage{gpu::BINDING_BACKDROP, opaque}
                                     : ReadImage{gpu::BINDING_BACKDROP, backdrop, Part{.level = level - 1}};
        gpu::BlendedConstants size{};
        size.width = std::max(passes.width() >> level, 1u);
        size.rows = std::max(passes.height() >> level, 1u);
        pass.record(recordFullScreen(inputs, pipeline, readImages(pass, passes, inputs, {before}), size));
    }
    return backdrop;
}

// A copy of `depth` that the surfaces may write: captures still test against opaque surfaces.
ImageRef addDepth(PassList& passes, const FrameInputs& inputs, ImageRef depth) {
    ImageDeclaration declaration = inputs.depth.image("depth with transmission", inputs.samples);
    declaration.usage |= VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    declaration.life = Life::transient;
    const ImageRef copy = passes.image(declaration);
    passes.copy(passName)
        .uses(depth, access::copiedFromImage, {})
        .uses(copy, access::copiedToImage, {}, true)
        .record([&passes, depth, copy](VkCommandBuffer commands) {
            const VkImageSubresourceLayers layers{VK_IMAGE_ASPECT_DEPTH_BIT, 0, 0, 1};
            const VkImageCopy whole{layers, {}, layers, {}, {passes.width(), passes.height(), 1}};
            vkCmdCopyImage(commands, passes.handle(depth), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                           passes.handle(copy), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &whole);
        });
    return copy;
}

void addDraws(Pass& pass, PassList& passes, const FrameInputs& inputs, ImageRef backdrop,
              const KeyOf& keyOf) {
    inputs.lists.read(passes, pass);
    inputs.shadow.read(pass);
    readGeometry(passes, pass, inputs).takes(shadingMs(passes, inputs, {}));
    // Channels of the surfaces themselves do not read it.
    const auto read =
        backdrop.valid() ? readImages(pass, passes, inputs, {{gpu::BINDING_BACKDROP, backdrop}}) : nullptr;
    pass.record(recordDraws(inputs, inputs.draws.transmissive(), keyOf, {}, read));
}

}  // namespace

ImageRef addTransmission(PassList& passes, const FrameInputs& inputs, ImageRef depth, ImageRef lit) {
    if (inputs.draws.transmissive().empty()) return depth;
    const ImageRef backdrop = addBackdrop(passes, inputs, lit), with = addDepth(passes, inputs, depth);
    Pass& pass = passes.draw(passName).color(lit, Load::keep).depth(with, Load::keep);
    addDraws(pass, passes, inputs, backdrop, [&](const DrawItem& item) {
        PipelineKey key = forwardKey(inputs, item, {});
        key.depth_write = true;
        return key;
    });
    return with;
}

void addTransmissionCapture(PassList& passes, const FrameInputs& inputs, ImageRef depth, ImageRef lit,
                            std::vector<CapturedImage>& images, std::size_t first) {
    if (inputs.draws.transmissive().empty()) return;
    std::vector<CapturedImage*> drawn;
    CaptureGroup group;
    for (std::size_t i = first; i < images.size(); ++i)
        if (std::ranges::count(drawnOver, images[i].mode) > 0) drawn.push_back(&images[i]);
    if (drawn.empty()) return;
    const ImageRef backdrop = lit.valid() ? addBackdrop(passes, inputs, lit) : ImageRef{};
    const ImageRef with = addDepth(passes, inputs, depth);
    Pass& pass = passes.draw("capture transmission").depth(with, Load::keep);
    ImageRef last;
    for (CapturedImage* image : drawn) {
        image->pass = passes.size() - 1;
        if (image->image.index == last.index) continue;
        last = image->image;
        pass.color(last, Load::keep);
        group.images |= 1u << captureIndex(image->mode).image;
        group.formats.push_back(passes.format(last));
    }
    addDraws(pass, passes, inputs, backdrop, [&](const DrawItem& item) {
        PipelineKey key = forwardCaptureKey(inputs, item, group, {});
        key.depth_write = true;
        return key;
    });
    std::stable_sort(images.begin() + static_cast<std::ptrdiff_t>(first), images.end(),
                     [](const CapturedImage& a, const CapturedImage& b) { return a.pass < b.pass; });
}

}  // namespace diptych
