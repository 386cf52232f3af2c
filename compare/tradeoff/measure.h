// SPDX-License-Identifier: MIT
#pragma once

#include "compare/metrics/channel.h"
#include "compare/metrics/flip.h"
#include "compare/picture/picture.h"
#include "compare/render/renderer.h"
#include "compare/tradeoff/row.h"
#include "shared/scene/requirements.h"

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace diptych::tradeoff {

// Errors of a Frame of the reference's size. `pixels`: relative error of each covered pixel.
struct FrameErrors {
    Errors errors{};
    std::vector<double> pixels;
    Image flip;  // all pixels
    double flip_sum = 0;
    std::uint64_t flip_pixels = 0;
};

// Errors of lit from one camera. Caches data of the reference. Not thread-safe.
class ErrorsAgainst {
public:
    explicit ErrorsAgainst(const Frame& reference);
    ErrorsAgainst(const ErrorsAgainst&) = delete;
    ErrorsAgainst& operator=(const ErrorsAgainst&) = delete;

    FrameErrors operator()(const Image& lit) const;
    // Inputs of one metric of errorFigures for ErrorsOfCameras: flip_sum and flip_pixels, or `pixels`.
    FrameErrors forFigure(std::size_t figure, const Image& lit) const;
    // Frees FLIP's data of the reference, about 256 MiB at most. It is recomputed on demand.
    void release() const { flip_.reset(); }

private:
    std::vector<double> pixelsOf(const Image& lit) const;
    // Replaces uncovered pixels by NaN, so that FLIP's filters ignore them.
    Image covered(const Image& lit) const;
    const HdrFlipAgainst& flip() const;

    const Coverage coverage_;
    const Image reference_;  // all pixels
    const Image covered_;
    const PixelError relative_;
    mutable std::optional<HdrFlipAgainst> flip_;
};

// The reference frames of a sweep.
struct ReferenceFrames {
    std::vector<Frame> frames;                                 // one per camera
    std::vector<std::shared_ptr<const ErrorsAgainst>> errors;  // one per camera
    Exposure exposure;                                         // for all images
};

// `shadows`: also renders channels that evaluate shadows, if shadows are on.
ReferenceFrames drawReferenceFrames(Renderer& renderer, const Settings& given,
                                    const std::vector<std::string>& cameras, const PictureChoice& choice,
                                    const RenderOptions& options, bool shadows = true);

// RMSE and 99th percentile (nearest rank) of relative errors.
struct RelativeErrors {
    double rmse = 0, p99 = 0;
};
RelativeErrors relativeErrors(std::vector<double> errors);

// Adds the reference frames' notes, and light that the rows' paths do not support. The latter is part of
// their errors. Skips lines that `notes` has already.
void addNotes(std::vector<std::string>& notes, const ReferenceFrames& references,
              std::span<const Settings> rows, const Requirements& needs);

// Errors over several cameras; all pixels have equal weight.
class ErrorsOfCameras {
public:
    void add(const FrameErrors& camera);
    Errors errors() const;

private:
    std::vector<double> pixels_;
    double flip_sum_ = 0, flip_pixels_ = 0;
};

struct MeasuredRow {
    TradeoffRow row;
    Image8 picture, errors;  // of the first camera
};
// Renders and times the Settings from every camera of the reference frames: the first timing block. Reads
// `options`: runs, on_step, progress.
MeasuredRow measureRow(Renderer& renderer, const Settings& settings, const ReferenceFrames& references,
                       const RenderOptions& options);

// The same for another renderer's images, one per reference frame; their background becomes the
// reference's. Its time is that of its whole command.
MeasuredRow measuredRow(std::vector<Frame> frames, const ReferenceFrames& references);

// Adds a timing block of `options.runs` frames per camera to each row, with the rows interleaved.
void timeAgain(Renderer& renderer, std::span<TradeoffRow* const> rows, const ReferenceFrames& references,
               const RenderOptions& options);

// lit as an 8-bit image, at most as wide as a card of the page.
Image8 thumbnail(const Frame& frame, const Exposure& exposure);

}  // namespace diptych::tradeoff
