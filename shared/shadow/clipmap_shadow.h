// SPDX-License-Identifier: MIT
// Clipmap of one view: the pages that its image needs, and data for shading and marking.
#pragma once

#include "shared/frame/frame.h"
#include "shared/frame/settings.h"
#include "shared/shadow/clipmap_atlas.h"
#include "shared/vulkan/pipelines/descriptors.h"

#include <memory>
#include <string>
#include <vector>

namespace diptych {

class ClipmapShadow {
public:
    // `clipmap`: of the view. Throws std::runtime_error as ClipmapAtlas does.
    ClipmapShadow(const FrameInputs& inputs, Uploader& uploader, ClipmapAtlases& atlases, const Pose& pose,
                  Clipmap clipmap, const Settings& settings);

    const Clipmap& clipmap() const { return clipmap_; }
    VkImageView atlas() const { return atlas_->view(); }
    ClipmapAtlas& pages() { return *atlas_; }

    // Texels after ShadowLight. Pages have no slots before prepare().
    std::vector<glm::vec4> texels(const View& view, double bias) const;

    // Draws the view's depth, marks the pages that opaque and blended surfaces need, and assigns slots.
    // Both paths use these marks, whatever depth they have themselves. The frame's set must contain View
    // and texels(). `view`: the clipmap's.
    void prepare(const FrameInputs& inputs, const View& view);
    // Adds passes named "mark shadow pages": a frame's own marks of opaque surfaces, for the next frame.
    // Draws stale pages before the list first runs. Call it once per view.
    void addMarks(PassList& passes, const FrameInputs& inputs, ImageRef depth);

    const ResidentPages& residentPages() const { return resident_pages_; }
    ShadowPages counts() const;
    // Marks of the last run, a bit per ClipmapPage.
    std::vector<gpu::uint> readMarks() const;
    std::uint64_t bytes() const { return marks_.size(); }
    std::uint64_t imageBytes() const { return atlas_->bytes(); }
    std::vector<std::string> notes() const;

private:
    void addMarkPasses(PassList& passes, const FrameInputs& inputs, ImageRef depth, std::size_t set);

    Device& device_;
    Uploader& uploader_;
    const ClipmapAtlases& layouts_;
    const Pose& pose_;
    bool all_;  // draw all casters in each page
    Clipmap clipmap_;
    std::shared_ptr<ClipmapAtlas> atlas_;
    GpuBuffer marks_, marks_seen_;
    OwnedSampler sampler_;
    DescriptorSets sets_;  // of prepare() and of the frame
    ResidentPages resident_pages_;
    std::size_t cold_ = 0;  // number of pages that were stale in prepare()
};

}  // namespace diptych
