// SPDX-License-Identifier: MIT
// --shadow-fit depth: range of visible view depths, computed on the GPU (Lauritzen, Salvi and Lefohn 2010,
// "Sample Distribution Shadow Maps").
#pragma once

#include "shared/draw/frame_inputs.h"
#include "shared/scene/view.h"
#include "shared/shadow/cascades.h"
#include "shared/vulkan/passes/pass_list.h"
#include "shared/vulkan/pipelines/descriptors.h"

#include <optional>

namespace diptych {

// A depth pass and its reduction.
class DepthBounds {
public:
    explicit DepthBounds(Device& device);

    // Adds passes named "shadow depth bounds", which draw the depth of the opaque items of `inputs` at the
    // list's size.
    void addPasses(PassList& passes, const FrameInputs& inputs);
    // Result of the last completed run; nothing if the image is empty. `view`: of the run's inputs.
    std::optional<DepthRange> range(const View& view) const;

    std::uint64_t bytes() const { return bounds_.size() + seen_.size(); }

private:
    OwnedDescriptorSetLayout layout_;
    OwnedPipelineLayout pipeline_layout_;
    OwnedSampler sampler_;
    DescriptorSets sets_;
    GpuBuffer bounds_, seen_;
};

// Draws and waits; includes blended surfaces. `inputs`: of `pose` and `view`.
std::optional<DepthRange> shownDepths(const FrameInputs& inputs, const Pose& pose, const View& view);

// Variation of the visible depths while the camera moves right in `steps` steps of `step` m: standard
// deviation over mean. 0 if fewer than two images show anything.
struct DepthVariation {
    double near = 0, far = 0;
};
// `inputs`: of `view`.
DepthVariation depthVariation(const FrameInputs& inputs, Uploader& uploader, const Pose& pose,
                              const View& view, double step, int steps);

}  // namespace diptych
