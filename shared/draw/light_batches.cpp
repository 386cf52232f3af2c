// SPDX-License-Identifier: MIT
#include "shared/draw/light_batches.h"

#include "shared/contract/constants.h"

#include <algorithm>
#include <utility>

namespace diptych {

void LightBatch::read(Pass& pass) const {
    if (sums)
        for (const ImageRef image : images) pass.samples(image, inFragment);
}

LightBatch addEarlierBatches(PassList& passes, const FrameInputs& inputs, const AddBatch& add) {
    const gpu::uint packets = inputs.longest_list, most = gpu::MAX_PACKETS_PER_DRAW;
    if (packets <= most) return {};
    LightBatch batch{gpu::BATCH_FIRST, 0, most};
    while (batch.first + most < packets) {
        Pass& pass = passes.draw("shade earlier lights");
        batch.read(pass);
        const auto sum = [&](const char* name) {
            return passes.image({.name = name, .format = litFormat, .life = Life::transient});
        };
        const std::array<ImageRef, 2> images{sum("partial diffuse sum"), sum("partial specular sum")};
        for (const ImageRef image : images) pass.color(image, Load::clear);
        add(pass, batch);
        auto sums = std::make_shared<DescriptorSets>(inputs.device, inputs.layouts.partial_sums,
                                                     partialSumBindings(), 1);
        pass.prepare([&passes, sums, images, sampler = inputs.layouts.nearest.get()] {
            for (gpu::uint i = 0; i < images.size(); ++i)
                sums->image(0, i, passes.view(images[i]), sampler, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
        });
        batch = {gpu::BATCH_LATER, batch.end, std::min(batch.end + most, packets), images, std::move(sums)};
    }
    return batch;
}

}  // namespace diptych
