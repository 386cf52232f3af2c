// SPDX-License-Identifier: MIT
// From a scene and Settings to Frames, on one device.
#pragma once

#include "compare/render/render_options.h"
#include "shared/frame/frame.h"
#include "shared/scene/scene_view.h"

#include <memory>
#include <span>
#include <vector>

namespace diptych {

class Device;

// Frames of one scene that can be drawn repeatedly and in any order. Switching between them uploads nothing
// and makes no pipeline; only what each frame makes itself (light lists) is made again. The Renderer and the
// scene must outlive it.
class PreparedFrames {
public:
    PreparedFrames(PreparedFrames&&) noexcept;
    ~PreparedFrames();

    std::size_t size() const;
    // One whole frame, ms, as FrameTime has it. The first one of each may take longer: drivers compile then.
    double draw(std::size_t i);
    // Each pass timed by itself, over another frame.
    std::vector<PassTime> profile(std::size_t i);
    // lit of the frame drawn last, W x H x 3.
    Image lit(std::size_t i);
    // The number of light lists of that frame that overflowed.
    std::uint64_t overflowedLists(std::size_t i) const;
    // The Frame as far as it is known without drawing: Settings, camera, lights, bytes, notes.
    const Frame& described(std::size_t i) const;

private:
    friend class Renderer;
    struct State;
    explicit PreparedFrames(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

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
    // Destroys all pipelines, of all Renderers that share them, before what needs others is drawn. Frames
    // that are prepared must be gone.
    void clearPipelines();
    // How many pipelines there are by now, of all Renderers that share them.
    std::size_t pipelines() const;

private:
    Frame drawReference(const Settings& settings, const RenderOptions& options);

    struct State;
    std::unique_ptr<State> state_;
};

// One Frame per Settings, in order, by one Renderer.
std::vector<Frame> renderAll(Device& device, SceneViews& views, const std::vector<Settings>& settings,
                             const RenderOptions& options);
std::vector<Frame> renderAll(Device& device, const Scene& scene, const std::vector<Settings>& settings,
                             const RenderOptions& options);

}  // namespace diptych
