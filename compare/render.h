// SPDX-License-Identifier: MIT
// From a scene and Settings to Frames, on one device.
#pragma once

#include "compare/progress.h"
#include "shared/frame/frame.h"
#include "shared/scene/scene.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace diptych {

class Device;

struct RenderOptions {
    // Debug modes; a forward-only one is left out of a deferred Frame. Empty: it is timed, and nothing else.
    std::vector<int> channels;
    std::vector<int> asked;        // of these, Frame::asked; empty: all
    int runs = 5;                  // timed frames; 0: no times, no profile
    bool through_gbuffer = false;  // forward+: also what its shading makes of the G-buffer's encoding
    bool twice = false;            // every channel once more, for Frame::noise
    std::function<void(const std::string&)> said;  // called before each step with a word on it, for -v
    Stage progress;                                // of renderAll()
    // Where a reference keeps what is done of it, asked once for each; it stays there. Empty: nowhere.
    std::function<std::filesystem::path()> keep{};
};

// What making one Frame takes, in the time of drawing one frame: for a progress line.
double framesIn(const RenderOptions& options);

// Frames of one scene, ready to be drawn again and again and in any order: going from one to another uploads
// nothing and makes no pipeline, only what a frame itself makes (light lists) is made anew. It outlives
// neither its Renderer nor the scene.
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
    // Light lists of that frame that found no room.
    std::uint64_t overflowedLists(std::size_t i) const;
    // What is known without drawing: Settings, camera, lights, bytes, notes.
    const Frame& described(std::size_t i) const;

private:
    friend class Renderer;
    struct State;
    explicit PreparedFrames(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

// Frames of one scene, one after another as they are asked for: everything is uploaded once for all of them
// and every pipeline is compiled once. Device and scene outlive it. Throws std::runtime_error: one line.
class Renderer {
public:
    Renderer(Device& device, const Scene& scene);
    ~Renderer();
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    Frame draw(const Settings& settings, const RenderOptions& options);

    // Of the two paths; all their images at once. Throws std::runtime_error as draw() does.
    PreparedFrames prepare(std::span<const Settings> settings);
    // How many pipelines there are by now.
    std::size_t pipelines() const;

private:
    Frame drawReference(const Settings& settings, const RenderOptions& options);

    struct State;
    std::unique_ptr<State> state_;
};

// One Frame per Settings, in order, by one Renderer.
std::vector<Frame> renderAll(Device& device, const Scene& scene, const std::vector<Settings>& settings,
                             const RenderOptions& options);

// What a frame would be made of, without drawing it.
struct PathPlan {
    std::string path;
    std::vector<std::string> passes;
    unsigned bytes_per_pixel = 0;  // attachments that carry geometry: G-buffer and depth; without lit
    std::vector<std::string> notes;
};
std::vector<PathPlan> planPaths(Device& device, const Scene& scene, const std::vector<Settings>& settings);

struct View;
FrameCamera cameraOf(const View& view);
std::uint64_t nonfinitePixels(const Image& image);

// The lights that Settings put into a scene: its own, the rig's, or a sun where there are none and no
// environment.
std::vector<Light> litBy(const Scene& scene, const Pose& pose, const Settings& settings);

}  // namespace diptych
