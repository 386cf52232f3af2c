// SPDX-License-Identifier: MIT
// From a scene and Settings to Frames, on one device.
#pragma once

#include "compare/reference/reference.h"
#include "compare/render/channel_shading.h"
#include "compare/render/light_terms.h"
#include "compare/render/prepared_frames.h"
#include "compare/render/render_options.h"
#include "compare/render/timing.h"
#include "shared/frame/frame.h"
#include "shared/scene/scene_view.h"

#include <memory>
#include <span>
#include <vector>

namespace diptych {

class Device;

// Pipelines for any number of Renderers on one device, whatever their scenes: each is compiled once. The
// device outlives it.
struct PipelineSet;
std::shared_ptr<PipelineSet> makePipelineSet(Device& device);

// Draws Frames of one scene on request. Everything is uploaded once, every pipeline is compiled once, and
// each view of the scene is made once for all Frames. Device and scene or views must outlive it. Throws
// std::runtime_error: one line.
class Renderer {
public:
    // `pipelines`: of the same device; without them it has its own. Without views it has its own of the
    // scene.
    Renderer(Device& device, SceneViews& views, std::shared_ptr<PipelineSet> pipelines = nullptr);
    Renderer(Device& device, const Scene& scene, std::shared_ptr<PipelineSet> pipelines = nullptr);
    ~Renderer();
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    Frame draw(const Settings& settings, const RenderOptions& options);

    // Of the two paths; all their images at once. Throws std::runtime_error as draw() does.
    PreparedFrames prepare(std::span<const Settings> settings);
    // Times frames of the two paths, all at once and in turn; `options`: runs, progress.
    std::vector<TimedFrame> time(std::span<const Settings> settings, const RenderOptions& options);
    // Lighting of channels as one Settings has it.
    ChannelShading shadeChannels(const Settings& settings, const SurfaceImages& images);
    // What single lights add to a pixel of one of the two paths (light_terms.h).
    LightTerms lightTerms(const Settings& settings, bool environment);
    // One pixel of the reference, and what each light adds to it.
    reference::PixelLight referencePixel(const Settings& settings, int x, int y);
    // Destroys the pipelines of one path, of all Renderers that share them. Frames of it that are prepared
    // must be gone.
    void clearPipelines(Path path);
    // checkHostMemory() of Frames that will be drawn. What was granted once is not asked for again: it is
    // used by one Frame after the other.
    void checkMemory(std::span<const Settings> settings, const RenderOptions& options);
    // How many pipelines there are by now, of all Renderers that share them.
    std::size_t pipelines() const;

private:
    Frame drawReference(const Settings& settings, const RenderOptions& options);
    Frame surfacesFor(const Settings& settings, const RenderOptions& options);

    struct State;
    std::unique_ptr<State> state_;
};

// One Frame per Settings, in order, by one Renderer.
std::vector<Frame> renderAll(Device& device, SceneViews& views, const std::vector<Settings>& settings,
                             const RenderOptions& options);
std::vector<Frame> renderAll(Device& device, const Scene& scene, const std::vector<Settings>& settings,
                             const RenderOptions& options);

}  // namespace diptych
