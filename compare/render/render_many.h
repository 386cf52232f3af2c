// SPDX-License-Identifier: MIT
#pragma once

#include "compare/frames/render_options.h"
#include "shared/frame/frame.h"
#include "shared/frame/settings.h"
#include "shared/scene/scene_view.h"

#include <memory>
#include <vector>

namespace diptych {

class Device;
struct PipelineSet;  // renderer.h

// renderAll() for one scene after the other with shared pipelines. Compiling dominates the time of small
// images on lavapipe, so later scenes reuse pipelines.
std::vector<Frame> renderAll(Device& device, SceneViews& views, const std::vector<Settings>& settings,
                             const RenderOptions& options, const std::shared_ptr<PipelineSet>& pipelines);

}  // namespace diptych
