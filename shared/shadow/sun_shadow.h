// SPDX-License-Identifier: MIT
// The shadow of the sun on the device: its maps, what is drawn into them, and what shading reads.
#pragma once

#include "shared/draw/draw_list.h"
#include "shared/draw/frame_inputs.h"
#include "shared/frame/frame.h"
#include "shared/frame/settings.h"
#include "shared/shadow/cascades.h"
#include "shared/shadow/clipmap_shadow.h"
#include "shared/shadow/depth_bounds.h"
#include "shared/shadow/moments.h"
#include "shared/vulkan/descriptors.h"
#include "shared/vulkan/pass_list.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace diptych {

// The light that casts: its number among the directional ones, and the angle of its disc, rad.
struct CastingSun {
    gpu::uint light = 0;
    double angle = 0;
};

// Everything that one view of a scene needs for the shadow of its brightest directional light. Where the
// Settings ask for none, or no light casts, or nothing is there to cast or to be seen, it has no pass.
class SunShadow {
public:
    // `frame`: the sets of SET_FRAME, to which it writes its bindings.
    SunShadow(Device& device, DescriptorSets& frame, const Settings& settings);
    SunShadow(const SunShadow&) = delete;
    SunShadow& operator=(const SunShadow&) = delete;

    // Once, before all that follows: lays the cascades, for which --shadow-fit depth draws what `inputs`
    // shows of `view`.
    void prepare(const FrameInputs& inputs, Uploader& uploader, ClipmapAtlases& atlases, const Pose& pose,
                 const View& view, const std::optional<CastingSun>& sun);
    // Once `inputs` are complete: chooses the clipmap's pages by what the view shows.
    void choosePages(const FrameInputs& inputs);

    bool any() const { return !maps_.empty() || clipmap_; }
    void specialise(Variant& variant) const;  // shadows, shadow_kernel, shadow_cascades

    // Passes named "shadow maps", before the first that reads them. Binds the maps, which are the list's.
    void addPasses(PassList& passes, const FrameInputs& inputs);
    // Declares that the pass's fragment shaders read the maps.
    void read(Pass& pass, VkPipelineStageFlags2 stages = inFragment) const;
    // Marks the clipmap's pages that the picture needs, once its depth is drawn.
    void addMarks(PassList& passes, const FrameInputs& inputs, ImageRef depth);

    std::uint64_t bytes() const;  // of buffers; the maps are the pass list's
    std::uint64_t imageBytes() const {
        return clipmap_ ? clipmap_->imageBytes() : 0;
    }  // that are not its own
    // How far the filter reaches, by view depth.
    const std::vector<ShadowReach>& reach() const { return reach_; }
    // The same by the clipmap's level that serves.
    const std::vector<ShadowReach>& levelReach() const { return level_reach_; }
    ShadowPages pages() const { return clipmap_ ? clipmap_->counts() : ShadowPages{}; }
    ClipmapShadow* clipmap() { return clipmap_ ? &*clipmap_ : nullptr; }
    // Of --shadow-fit depth: the view depths that cascades serve.
    const std::optional<DepthRange>& shown() const { return request_.shown; }
    // That are drawn into each map.
    std::vector<std::uint64_t> triangles() const;
    // In words, for people: which light casts, what was drawn and what was not.
    const std::vector<std::string>& notes() const { return notes_; }
    // What any scene has: the triangles of each map.
    const std::vector<std::string>& details() const { return details_; }

private:
    struct Map {
        DrawList casters;
        GpuBuffer draws;
        VkRect2D read;  // what shading may read of it: nothing else is drawn
    };
    void setLight(Device& device, Uploader& uploader, const std::vector<glm::vec4>& texels);
    void addCascades(const FrameInputs& inputs, Uploader& uploader, const Pose& pose, const View& view,
                     const Cascades& cascades);
    void fitToDepth(const FrameInputs& inputs, Uploader& uploader, const Pose& pose, const View& view,
                    const Bounds& bounds, const glm::dvec3& to_light);
    std::vector<glm::vec4> clipmapTexels() const;
    void setFilter(gpu::ShadowLight& light, const Cascades& cascades, double angle, Device& device);

    DescriptorSets& frame_;
    const Settings settings_;
    CascadeRequest request_;
    gpu::uint filter_;                            // SHADOWS_*
    std::optional<MomentMaps::Request> moments_;  // of --shadows evsm, evsm4, msm4
    std::optional<MomentMaps> moment_maps_;
    std::optional<DepthBounds> depth_bounds_;  // of --shadow-fit depth
    bool casts_ = false;                       // the sun does: what is turned from it is dark, whatever casts
    std::vector<Map> maps_;  // one for each cascade that something seen may read; none where nothing casts
    std::vector<ShadowReach> reach_;
    std::optional<ClipmapShadow> clipmap_;
    gpu::ShadowLight sun_{};  // of the clipmap
    const View* view_ = nullptr;
    Uploader* uploader_ = nullptr;
    std::vector<ShadowReach> level_reach_;
    std::vector<std::string> notes_, details_;
    GpuBuffer light_;
    OwnedBufferView light_view_;
    OwnedSampler nearest_, linear_;
    ImageRef image_;  // that shading reads: depth or moments
};

}  // namespace diptych
