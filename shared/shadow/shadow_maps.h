// SPDX-License-Identifier: MIT
// All shadows of one view, as the paths use them.
#pragma once

#include "shared/shadow/local_shadows.h"
#include "shared/shadow/sun_shadow.h"

#include <string>
#include <vector>

namespace diptych {

class ShadowMaps {
public:
    // Parameters as of SunShadow and LocalShadows.
    ShadowMaps(Device& device, Uploader& uploader, const ShadowedView& scene, DescriptorSets& frame,
               const Settings& settings)
        : sun(device, frame, settings), local(device, uploader, scene, frame, settings) {}

    void specialise(Variant& variant) const {
        sun.specialise(variant);
        local.specialise(variant);
    }
    // As SunShadow::prepare() and choosePages(): prepare() comes first, choosePages() once `inputs` are
    // complete.
    void prepare(const FrameInputs& inputs, Uploader& uploader, ClipmapAtlases& atlases, const Pose& pose,
                 const View& view, const std::optional<CastingSun>& casting) {
        sun.prepare(inputs, uploader, atlases, pose, view, casting);
    }
    void choosePages(const FrameInputs& inputs) { sun.choosePages(inputs); }
    // Adds passes before the first that samples the maps.
    void addPasses(PassList& passes, const FrameInputs& inputs) {
        sun.addPasses(passes, inputs);
        local.addPasses(passes, inputs);
    }
    // Declares that these shaders of the pass sample the maps.
    void read(Pass& pass, VkPipelineStageFlags2 stages = inFragment) const {
        sun.read(pass, stages);
        local.read(pass, stages);
    }
    // Adds passes after the one that draws `depth`.
    void addMarks(PassList& passes, const FrameInputs& inputs, ImageRef depth) {
        sun.addMarks(passes, inputs, depth);
    }
    // Buffers alone; maps belong to the pass list.
    std::uint64_t bytes() const { return sun.bytes() + local.bytes(); }
    // Images that do not belong to the pass list.
    std::uint64_t imageBytes() const { return sun.imageBytes(); }
    std::vector<std::string> notes() const {
        std::vector<std::string> all = sun.notes();
        all.insert(all.end(), local.notes().begin(), local.notes().end());
        return all;
    }

    SunShadow sun;
    LocalShadows local;
};

}  // namespace diptych
