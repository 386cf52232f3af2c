// SPDX-License-Identifier: MIT
// The clipmap of one view: which pages its picture needs, and what shading and marking read.
#pragma once

#include "shared/frame/frame.h"
#include "shared/frame/settings.h"
#include "shared/shadow/clipmap_atlas.h"
#include "shared/vulkan/descriptors.h"

#include <memory>
#include <string>
#include <vector>

namespace diptych {

class ClipmapShadow {
public:
    // Throws std::runtime_error as ClipmapAtlas does.
    ClipmapShadow(Device& device, Uploader& uploader, ClipmapAtlases& atlases, const Pose& pose,
                  const Geometry& geometry, const View& view, const glm::dvec3& to_light,
                  const Settings& settings);

    const Clipmap& clipmap() const { return clipmap_; }
    VkImageView atlas() const { return atlas_->view(); }
    ClipmapAtlas& pages() { return *atlas_; }

    // What follows ShadowLight in the shaders' texels. Pages have no slots before prepare().
    std::vector<glm::vec4> texels(const View& view, double bias) const;

    // Draws the depth of what the view shows, marks the pages that it needs and those of what is blended, and
    // gives them slots. Both paths are served by these marks, whatever depth they have themselves. Frame's
    // set must hold View and texels(). `view`: of the constructor.
    void prepare(const FrameInputs& inputs, const View& view);
    // A frame's own marks of what is opaque, which the next frame's pages would be chosen by: passes named
    // "mark shadow pages".
    // Before the list runs for the first time, pages that are not drawn yet are. Once a view.
    void addMarks(PassList& passes, const FrameInputs& inputs, ImageRef depth);

    const ServedPages& served() const { return served_; }
    ShadowPages counts() const;
    // The marks that a run left, a bit for each ClipmapPage.
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
    bool all_;  // casters are drawn, not those that a page needs
    VkExtent2D extent_;
    Clipmap clipmap_;
    std::shared_ptr<ClipmapAtlas> atlas_;
    GpuBuffer marks_, marks_seen_;
    OwnedSampler sampler_;
    DescriptorSets sets_;  // of prepare() and of the frame
    ServedPages served_;
    std::size_t cold_ = 0;  // pages that were not there when they were chosen
};

}  // namespace diptych
