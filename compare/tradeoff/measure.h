// SPDX-License-Identifier: MIT
#pragma once

#include "compare/metrics/channel.h"
#include "compare/picture/picture.h"
#include "compare/render/renderer.h"
#include "compare/tradeoff/row.h"

#include <string>
#include <vector>

namespace diptych::tradeoff {

// What all rows of a sweep are measured against.
struct ReferenceFrames {
    std::vector<Frame> frames;  // one a camera
    Exposure exposure;          // of every picture
};

ReferenceFrames drawReferenceFrames(Renderer& renderer, const Settings& given,
                                    const std::vector<std::string>& cameras, const PictureChoice& choice,
                                    const RenderOptions& options);

// RMSE and 99th percentile (nearest rank) of relative errors, each a pixel's.
struct RelativeErrors {
    double rmse = 0, p99 = 0;
};
RelativeErrors relativeErrors(std::vector<double> errors);

// Errors of a Frame that is as large as its reference; `pixels` gets each covered pixel's relative error.
struct FrameErrors {
    Errors errors{};
    std::vector<double> pixels;
    Image flip;  // of every pixel
    double flip_sum = 0;
    std::uint64_t flip_pixels = 0;
};
FrameErrors errorsOf(const Frame& reference, const Frame& frame);

struct MeasuredRow {
    TradeoffRow row;
    Image8 picture, errors;  // of the first camera
};
// Draws and times the Settings from every camera of the reference frames: a first visit. `options`: runs,
// on_step, progress.
MeasuredRow measureRow(Renderer& renderer, const Settings& settings, const ReferenceFrames& references,
                       const RenderOptions& options);

// One visit more, of `options.runs` frames.
void timeAgain(Renderer& renderer, TradeoffRow& row, const ReferenceFrames& references,
               const RenderOptions& options);

// lit as the pages show it, not wider than a card.
Image8 thumbnail(const Frame& frame, const Exposure& exposure);

}  // namespace diptych::tradeoff
