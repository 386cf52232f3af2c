// SPDX-License-Identifier: MIT
#include "shared/transparent/read_images.h"

#include <utility>

namespace diptych {

std::shared_ptr<const DescriptorSets> readImages(Pass& pass, PassList& passes, const FrameInputs& inputs,
                                                 std::vector<ReadImage> images) {
    auto sets = std::make_shared<DescriptorSets>(blendedSet(inputs));
    for (const ReadImage& read : images) {
        if (read.part)
            pass.samples(read.image, inFragment, *read.part);
        else
            pass.samples(read.image, inFragment);
    }
    pass.prepare([&passes, images = std::move(images), sets, sampler = inputs.layouts.nearest.get()] {
        for (const auto& [binding, image, part] : images)
            sets->image(0, binding, part ? passes.view(image, *part) : passes.view(image), sampler,
                        VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    });
    return sets;
}

}  // namespace diptych
