// SPDX-License-Identifier: MIT
#include "shared/draw/resolve.h"

#include "shared/contract/debug_mode.h"
#include "shared/contract/samples.h"
#include "shared/draw/pipeline_parts.h"
#include "shared/draw/record.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

namespace diptych {

namespace {

struct SampleReader {
    Shader fragment;
    std::string name;
    int sample = 0;
};

// A full-screen pass that reads `sources` at the first bindings of SET_GBUFFER and writes as many targets.
void addReading(PassList& passes, const FrameInputs& inputs, const SampleReader& reader,
                const std::vector<ImageRef>& sources, const std::vector<ImageRef>& targets) {
    Pass& pass = passes.draw(reader.name);
    std::vector<VkFormat> formats;
    for (const ImageRef target : targets) {
        pass.color(target, Load::clear);
        formats.push_back(passes.format(target));
    }
    const auto sets = std::make_shared<DescriptorSets>(blendedSet(inputs));
    for (const ImageRef source : sources) pass.samples(source, inFragment);
    pass.prepare([&passes, sources, sets, sampler = inputs.layouts.nearest.get()] {
        // Missing sources are never read; the first one keeps their bindings valid.
        for (gpu::uint i = 0; i < gpu::GBUFFER_ATTACHMENTS; ++i)
            sets->image(0, i, passes.view(sources[i < sources.size() ? i : 0]), sampler,
                        VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    });
    Variant variant = inputs.variant.only(featuresReadBy(gpu::PASS_SAMPLES));
    variant.set(gpu::FEATURE_captures, ((1u << sources.size()) - 1) | static_cast<gpu::uint>(reader.sample)
                                                                          << gpu::SAMPLE_IMAGES);
    const Pipeline pipeline = inputs.pipelines.get(PipelineKey{
        .vertex = Shader::full_screen_vert,
        .fragment = reader.fragment,
        .variant = variant,
        .input = NO_VERTICES,
        .colors = formats,
    });
    pass.record(recordFullScreen(inputs, pipeline, sets, gpu::BlendedConstants{}));
}

}  // namespace

void checkSamples(const FrameInputs& inputs) {
    if (inputs.samples == VK_SAMPLE_COUNT_1_BIT) return;
    const auto samples = static_cast<int>(inputs.samples);
    const Device& device = inputs.device;
    const auto fail = [&](const std::string& why) {
        throw std::runtime_error(fmt::format("--msaa {}: {} {}", samples, device.info().name, why));
    };
    if (device.limits().standardSampleLocations != VK_TRUE)
        fail("has no standard sample locations; use --msaa 1");
    std::vector<VkFormat> formats{inputs.lit_format, depthFormat};
    for (const VkFormat format : inputs.gbuffer.formats)
        if (format != VK_FORMAT_UNDEFINED) formats.push_back(format);
    for (const VkFormat format : formats) {
        const VkImageUsageFlags attachment = format == depthFormat
                                                 ? VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT
                                                 : VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
        if ((device.support().sampleCounts(format, attachment | VK_IMAGE_USAGE_SAMPLED_BIT) &
             inputs.samples) == 0)
            fail(fmt::format("does not support {} attachments with this number of samples; use --msaa {}",
                             nameOf(format), samples > 4 ? 4 : 1));
    }
    const gpu::uint max = inputs.entries_per_draw;
    if (inputs.longest_list > max)
        fail(
            fmt::format("reads up to {} light list entries per draw, but a list has {}; use --assign "
                        "clustered or tiled, or --light-cutoff",
                        max, inputs.longest_list));
}

ImageRef addResolve(PassList& passes, const FrameInputs& inputs, ImageRef lit, Life life, const char* name) {
    if (inputs.samples == VK_SAMPLE_COUNT_1_BIT) return lit;
    const ImageRef resolved = passes.image(
        {.name = "lit", .format = inputs.lit_format, .usage = VK_IMAGE_USAGE_TRANSFER_SRC_BIT, .life = life});
    addReading(passes, inputs, {Shader::sample_resolve_frag, name}, {lit}, {resolved});
    return resolved;
}

std::size_t maxCaptured(const FrameInputs& inputs) {
    return inputs.samples == VK_SAMPLE_COUNT_1_BIT ? gpu::MAX_COLOR_ATTACHMENTS
                                                   : gpu::MAX_COLOR_ATTACHMENTS / 2;
}

void addCaptureResolve(PassList& passes, const FrameInputs& inputs, std::vector<CapturedImage>& images,
                       std::size_t first) {
    if (inputs.samples == VK_SAMPLE_COUNT_1_BIT) return;
    const std::vector<CapturedImage> group(images.begin() + static_cast<std::ptrdiff_t>(first), images.end());
    images.resize(first);
    // One sample of each channel, or what the shader makes of all.
    const auto read = [&](const auto& isRead, const SampleReader& reader) {
        std::vector<ImageRef> sources, targets;
        for (CapturedImage image : group) {
            if (!isRead(image)) continue;
            if (sources.empty() || sources.back().index != image.image.index) {
                sources.push_back(image.image);
                targets.push_back(passes.image({.name = reader.name,
                                                .format = passes.format(image.image),
                                                .usage = VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                                                .life = Life::transient}));
            }
            image.image = targets.back();
            image.pass = passes.size();
            image.sample = reader.sample;
            images.push_back(image);
        }
        if (!sources.empty()) addReading(passes, inputs, reader, sources, targets);
    };
    const auto isLit = [](const CapturedImage& image) { return image.mode == Channel::lit; };
    // A background's samples have no count.
    const auto isCount = [](const CapturedImage& image) { return image.mode == Channel::shaded_samples; };
    for (int sample = 0; sample < static_cast<int>(inputs.samples); ++sample)
        read(
            [&](const CapturedImage& image) {
                return !isLit(image) && !isCount(image) && (sample == 0 || image.every_sample);
            },
            {Shader::sample_one_frag, fmt::format("sample {}", sample), sample});
    read(isCount, {Shader::sample_max_frag, "most of samples"});
    for (CapturedImage image : group) {
        if (!isLit(image)) continue;
        image.image = addResolve(passes, inputs, image.image, Life::transient);
        image.pass = passes.size() - 1;
        images.push_back(image);
    }
}

}  // namespace diptych
