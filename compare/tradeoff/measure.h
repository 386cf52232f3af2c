// SPDX-License-Identifier: MIT
#pragma once

#include "compare/experiment/prepared_pool.h"
#include "compare/experiment/references.h"
#include "compare/image/channel_image.h"
#include "compare/render/renderer.h"
#include "compare/tradeoff/tradeoff.h"

#include <chrono>
#include <span>
#include <vector>

namespace diptych::tradeoff {

struct MeasuredRow {
    TradeoffRow row;
    Image8 image, errors;  // of the first camera
};
// Renders and times the Settings from every camera of the reference frames: the first timing block. Reads
// `options`: runs, on_step, progress. `pool`: of the renderer.
MeasuredRow measureRow(Renderer& renderer, experiment::PreparedPool& pool, const Settings& settings,
                       const experiment::ReferenceFrames& references, const RenderOptions& options);

// The same for another renderer's images, one per reference frame; their background becomes the
// reference's. Its time is that of its whole command.
MeasuredRow measuredRow(std::vector<Frame> frames, const experiment::ReferenceFrames& references);

// Adds a timing block of `runs` frames per camera to each row, with the rows interleaved.
void timeAgain(experiment::PreparedPool& pool, std::span<TradeoffRow* const> rows,
               const experiment::ReferenceFrames& references, int runs, const Stage& progress);

// lit as an 8-bit image, at most as wide as a card of the page.
Image8 thumbnail(const Frame& frame, const Exposure& exposure);

}  // namespace diptych::tradeoff
