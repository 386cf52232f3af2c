// SPDX-License-Identifier: MIT
// Why lit of two Frames differs. The experiment is to swap: a channel of the surface, a Setting, or what the
// lighting of a Frame's own channels leaves of its lit (the rest: edges of several samples a pixel; nothing
// where pixels have one) is taken from the baseline, all else from the test, the picture is shaded again, and
// what counts is how much nearer lit has come to the baseline's. Shares are Shapley values (shapley.h) of
// that, over the whole picture and at each pixel.
#pragma once

#include "compare/explain/explanation.h"
#include "compare/render/renderer.h"
#include "compare/run/progress.h"
#include "shared/frame/frame.h"
#include "shared/scene/model/scene.h"

#include <vector>

namespace diptych {

// Channels that explain() needs of a Frame.
std::vector<int> explainedChannels();

// `baseline`, `test`: of one view of the renderer's scene, with these channels. Throws std::runtime_error,
// one line, where they are not.
Explanation explain(Device& device, Renderer& renderer, const Scene& scene, const Frame& baseline,
                    const Frame& test, const Stage& progress = {});

}  // namespace diptych
