// SPDX-License-Identifier: MIT
// Explains a difference of lit between two Frames by ablation. A surface channel, a Setting or the
// residual is taken from the baseline, all else from the test, and the image is relit. The residual is the
// part of lit that relighting a Frame's own channels does not reproduce, such as MSAA edges. Each cause is
// credited with how much nearer lit comes to the baseline's. Contributions are Shapley values (shapley.h)
// over the whole image and at each pixel.
#pragma once

#include "compare/explain/explanation.h"
#include "compare/render/renderer.h"
#include "compare/run/progress.h"
#include "shared/frame/frame.h"
#include "shared/scene/model/scene.h"

#include <vector>

namespace diptych {

// Channels of a Frame that explain() needs. A Frame may lack those of layers (layerOf()), which are then 0.
std::vector<Channel> explainedChannels();

// `baseline`, `test`: of one view of the renderer's scene, with these channels. Throws std::runtime_error,
// one line, otherwise.
Explanation explain(Device& device, Renderer& renderer, const Scene& scene, const Frame& baseline,
                    const Frame& test, const Stage& progress = {});

}  // namespace diptych
