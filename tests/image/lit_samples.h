// SPDX-License-Identifier: MIT
// lit of every sample of an image, before the resolve.
#pragma once

#include "compare/frames/frame_properties.h"
#include "compare/render/prepared_view.h"
#include "shared/vulkan/pipelines/descriptors.h"
#include "tests/image/probe_words.h"
#include "tests/image/scenes.h"

#include <array>
#include <utility>
#include <vector>

namespace diptych::tests {

// A scene rendered sample by sample.
class SampledScene {
public:
    explicit SampledScene(Scene drawn, Device& on = device(), std::shared_ptr<PipelineSet> set = pipelines())
        : scene(std::move(drawn)),
          device_(on),
          shared_(on, scene, std::move(set)),
          words_(probeWords("lit_sample.frag")) {}

    // One Image per sample: R, G, B.
    std::vector<Image> draw(const Settings& settings) {
        const SceneView seen = makeSceneView(scene, viewRequest(settings));
        PreparedFrame frame(device_, shared_, seen, settings);
        PassList& passes = frame.passes;
        constexpr std::array types{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER};
        const OwnedDescriptorSetLayout set_layout = makeSetLayout(device_, types);
        const std::array<VkDescriptorSetLayout, 1> set_layouts{set_layout};
        const OwnedPipelineLayout layout =
            makePipelineLayout(device_, set_layouts,
                               VkPushConstantRange{VK_SHADER_STAGE_FRAGMENT_BIT, 0, sizeof(std::uint32_t)});
        const ShaderModule read{"lit_sample.frag", words_};
        Pipelines reading(device_, layout, [&](const PipelineKey&) {
            return PipelineParts{&shaderModule(Shader::full_screen_vert), &read, {}, {}};
        });
        const Pipeline pipeline = reading.get(PipelineKey{.colors = {litFormat}});
        DescriptorSets sets(device_, set_layout, types, 1);
        const OwnedSampler sampler = makeNearestSampler(device_);
        const ImageRef drawn = frame.images.lit_samples;
        std::vector<ImageRef> ones;
        for (std::uint32_t sample = 0; sample < static_cast<std::uint32_t>(settings.msaa); ++sample) {
            ones.push_back(passes.image("lit of a sample", litFormat));
            passes.draw("read a sample")
                .samples(drawn, inFragment)
                .color(ones.back(), Load::clear)
                .prepare([&] {
                    sets.image(0, 0, passes.view(drawn), sampler, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
                })
                .record([&, sample](VkCommandBuffer commands) {
                    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
                    const VkDescriptorSet bound = sets[0];
                    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout, 0, 1, &bound,
                                            0, nullptr);
                    vkCmdPushConstants(commands, layout, VK_SHADER_STAGE_FRAGMENT_BIT, 0, sizeof sample,
                                       &sample);
                    vkCmdSetCullMode(commands, VK_CULL_MODE_NONE);
                    vkCmdSetFrontFace(commands, VK_FRONT_FACE_COUNTER_CLOCKWISE);
                    vkCmdDraw(commands, 3, 1, 0, 0);
                });
        }
        passes.run();
        std::vector<PassList::ReadBack> requests;
        for (const ImageRef one : ones) requests.push_back({one, 3});
        return readImages(passes, requests);
    }

    const Scene scene;

private:
    Device& device_;
    SharedResources shared_;
    std::vector<std::uint32_t> words_;
};

}  // namespace diptych::tests
