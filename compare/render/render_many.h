// SPDX-License-Identifier: MIT
#pragma once

#include "compare/render/render_options.h"
#include "shared/frame/frame.h"
#include "shared/frame/settings.h"
#include "shared/scene/scene_view.h"

#include <cstddef>
#include <memory>
#include <vector>

namespace diptych {

class Device;
struct PipelineSet;  // renderer.h

// renderAll() of one scene after the other, which share pipelines: what one has compiled, which is most of
// the time that small pictures take on lavapipe, the next does not compile again. Beyond `pipelinesKept` of
// them, which may take 1.5 MB each there, those of both paths are let go once a scene is drawn.
inline constexpr std::size_t pipelinesKept = 256;
std::vector<Frame> renderAll(Device& device, SceneViews& views, const std::vector<Settings>& settings,
                             const RenderOptions& options, const std::shared_ptr<PipelineSet>& pipelines);

}  // namespace diptych
