// SPDX-License-Identifier: MIT
// Both paths' renderer for one scene at a time, on a device that can be replaced after a loss.
#pragma once

#include "compare/render/renderer.h"
#include "compare/run/progress.h"
#include "compare/viewer/drawing/request.h"
#include "shared/vulkan/device/device.h"

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace diptych::viewer {

std::vector<Channel> everyChannel();

// Options that render the channels, and lit, depth and IDs.
RenderOptions channelOptions(std::vector<Channel> channels);

// Settings of one path for images of this size. Throws std::runtime_error if it cannot render them.
Settings settingsOf(const Subject& subject, Path path, const Size& size);

class PairRenderer {
public:
    // `progress` may throw to cancel work; `finishing` is for work that always finishes.
    PairRenderer(DeviceOptions options, Progress& progress, Progress& finishing);

    bool isLoaded(const Subject& subject) const;
    // Reads the subject's scene; false if it is loaded. If it cannot be read, this throws and the previous
    // one stays.
    bool load(const Subject& subject);
    // Each does nothing and returns false if it was done before.
    bool startDevice();
    bool upload();  // the loaded scene
    void dropDevice();

    const std::shared_ptr<const Scene>& scene() const { return scene_; }
    const std::string& sceneError() const { return scene_error_; }  // why the last scene is not shown
    const Device* device() const { return device_ ? &*device_ : nullptr; }
    SceneViews& views() { return *views_; }
    Renderer& renderer() { return *renderer_; }

    // Deferred and forward+. Renders lit alone by the timed pipelines: nothing is compiled for it, and
    // little is read back.
    std::array<Frame, 2> drawLit(const Subject& subject, const Size& size);
    // A `passing` image always finishes.
    std::array<Frame, 2> drawChannels(const Subject& subject, const Size& size,
                                      const std::vector<Channel>& channels, bool passing);

private:
    void dropRenderer();

    const DeviceOptions options_;
    Progress &progress_, &finishing_;
    std::optional<Device> device_;
    std::shared_ptr<PipelineSet> pipelines_;
    std::shared_ptr<const Scene> scene_;
    std::string scene_error_;
    std::optional<Subject> loaded_;  // scene, reading and environment that were loaded, or failed to load
    std::unique_ptr<SceneViews> views_;
    std::unique_ptr<Renderer> renderer_;
};

}  // namespace diptych::viewer
