// SPDX-License-Identifier: MIT
// Shadow of the sun on the GPU: its maps, their passes, and data for shading.
#pragma once

#include "shared/draw/draw_list.h"
#include "shared/draw/frame_inputs.h"
#include "shared/frame/frame.h"
#include "shared/frame/settings.h"
#include "shared/shadow/cascades.h"
#include "shared/shadow/clipmap_shadow.h"
#include "shared/shadow/depth_bounds.h"
#include "shared/shadow/moments.h"
#include "shared/vulkan/passes/pass_list.h"
#include "shared/vulkan/pipelines/descriptors.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace diptych {

// The casting sun: its index among the directional lights, and the angular diameter of its disc, rad.
struct CastingSun {
    gpu::uint light = 0;
    double angle = 0;
};

// Shadow of one view's sun, the brightest directional light. Adds no pass if shadows are off, or without a
// casting light, casters or visible geometry.
class SunShadow {
public:
    // `frame`: SET_FRAME, in which it writes its bindings.
    SunShadow(Device& device, DescriptorSets& frame, const Settings& settings);
    SunShadow(const SunShadow&) = delete;
    SunShadow& operator=(const SunShadow&) = delete;

    // Call it once, before the following. Fits the cascades; --shadow-fit depth draws the view's depth for
    // that.
    void prepare(const FrameInputs& inputs, Uploader& uploader, ClipmapAtlases& atlases, const Pose& pose,
                 const View& view, const std::optional<CastingSun>& sun);
    // Call it once `inputs` are complete. Assigns the clipmap's pages by visibility.
    void choosePages(const FrameInputs& inputs);

    bool any() const { return !maps_.empty() || clipmap_; }
    void specialise(Variant& variant) const;  // shadows, shadow_kernel, shadow_cascades

    // Adds passes named "shadow maps" before the first that samples them, and binds the maps, images of
    // the list.
    void addPasses(PassList& passes, const FrameInputs& inputs);
    // Declares that shaders of the pass sample the maps.
    void read(Pass& pass, VkPipelineStageFlags2 stages = inFragment) const;
    // Marks the clipmap pages that the image needs, after its depth is drawn.
    void addMarks(PassList& passes, const FrameInputs& inputs, ImageRef depth);

    std::uint64_t bytes() const;  // of buffers; the maps belong to the pass list
    // Images that do not belong to the pass list.
    std::uint64_t imageBytes() const { return clipmap_ ? clipmap_->imageBytes() : 0; }
    // Filter radius by view depth.
    const std::vector<ShadowFilterRadius>& filterRadii() const { return filter_radii_; }
    // Filter radius by resident clipmap level.
    const std::vector<ShadowFilterRadius>& levelFilterRadii() const { return level_filter_radii_; }
    ShadowPages pages() const { return clipmap_ ? clipmap_->counts() : ShadowPages{}; }
    ClipmapShadow* clipmap() { return clipmap_ ? &*clipmap_ : nullptr; }
    // --shadow-fit depth: view depths that cascades cover.
    const std::optional<DepthRange>& shown() const { return request_.shown; }
    // Number of triangles drawn into each map.
    std::vector<std::uint64_t> triangles() const;
    // Text for people: the casting light, and which maps are drawn.
    const std::vector<std::string>& notes() const { return notes_; }
    // Details for every scene: triangles per map.
    const std::vector<std::string>& details() const { return details_; }

private:
    struct Map {
        DrawList casters;
        GpuBuffer draws;
        VkRect2D read;  // area that shading may sample; drawing is limited to it
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
    std::optional<MomentMaps::Request> moments_;  // --shadows evsm, evsm4, msm4
    std::optional<MomentMaps> moment_maps_;
    std::optional<DepthBounds> depth_bounds_;  // --shadow-fit depth
    bool casts_ = false;                       // the sun casts shadows: surfaces facing away are dark even
                                               // without casters
    std::vector<Map> maps_;  // one per cascade that visible receivers may sample; empty without casters
    std::vector<ShadowFilterRadius> filter_radii_;
    std::optional<ClipmapShadow> clipmap_;
    gpu::ShadowLight sun_{};  // for the clipmap
    const View* view_ = nullptr;
    Uploader* uploader_ = nullptr;
    std::vector<ShadowFilterRadius> level_filter_radii_;
    std::vector<std::string> notes_, details_;
    GpuBuffer light_;
    OwnedBufferView light_view_;
    OwnedSampler nearest_, linear_;
    ImageRef image_;  // depth or moments that shading samples
};

}  // namespace diptych
