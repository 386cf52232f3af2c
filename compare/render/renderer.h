// SPDX-License-Identifier: MIT
// Renders Frames of a scene with Settings, on one device.
#pragma once

#include "compare/frames/render_options.h"
#include "compare/render/channel_shading.h"
#include "compare/render/light_terms.h"
#include "compare/render/prepared_frames.h"
#include "compare/render/timing.h"
#include "shared/frame/frame.h"
#include "shared/scene/scene_view.h"

#include <memory>
#include <span>
#include <vector>

namespace diptych::reference {
struct PixelLight;
}

namespace diptych {

class Device;

// Pipelines for any number of Renderers on one device, for any scenes; each is compiled once. The device
// must outlive it.
struct PipelineSet;
std::shared_ptr<PipelineSet> makePipelineSet(Device& device);

// Renders Frames of one scene on request. Uploads everything once, compiles every pipeline once, and makes
// each view of the scene once for all Frames. Device and scene or views must outlive it. Throws
// std::runtime_error with a one-line message.
class Renderer {
public:
    // `pipelines`: of the same device. Creates its own pipelines or views if not given.
    Renderer(Device& device, SceneViews& views, std::shared_ptr<PipelineSet> pipelines = nullptr);
    Renderer(Device& device, const Scene& scene, std::shared_ptr<PipelineSet> pipelines = nullptr);
    ~Renderer();
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    Frame draw(const Settings& settings, const RenderOptions& options);

    // Frames of deferred and forward+, with all their images in memory at once. Throws like draw().
    PreparedFrames prepare(std::span<const Settings> settings);
    // Times interleaved frames of the two paths, all prepared at once; `options`: runs, progress.
    std::vector<TimedFrame> time(std::span<const Settings> settings, const RenderOptions& options);
    // Lighting of channels under one Settings.
    ChannelShading shadeChannels(const Settings& settings, const SurfaceImages& images);
    // Contributions of single lights to a pixel of one of the two paths (light_terms.h).
    LightTerms lightTerms(const Settings& settings, bool environment);
    // One pixel of the reference, and each light's contribution.
    reference::PixelLight referencePixel(const Settings& settings, int x, int y);
    // Destroys one path's pipelines in all Renderers that share them. Prepared frames of that path must be
    // destroyed before.
    void clearPipelines(Path path);
    // checkHostMemory() for Frames to be rendered. Memory approved before is not requested again, because
    // Frames use it one after the other.
    void checkMemory(std::span<const Settings> settings, const RenderOptions& options);
    // Number of pipelines in all Renderers that share them.
    std::size_t pipelines() const;

private:
    Frame drawReference(const Settings& settings, const RenderOptions& options);
    Frame surfacesFor(const Settings& settings, const RenderOptions& options);

    struct State;
    std::unique_ptr<State> state_;
};

// One Frame per Settings, in order, with one Renderer.
std::vector<Frame> renderAll(Device& device, SceneViews& views, const std::vector<Settings>& settings,
                             const RenderOptions& options);
std::vector<Frame> renderAll(Device& device, const Scene& scene, const std::vector<Settings>& settings,
                             const RenderOptions& options);

// Cost of one Frame relative to rendering one frame; for progress lines.
double framesIn(const RenderOptions& options);

}  // namespace diptych
