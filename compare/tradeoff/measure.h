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

// Errors of a Frame that is as large as its reference; `pixels` gets each covered pixel's relative error.
struct FrameErrors {
    Errors errors{};
    std::vector<double> pixels;
    Image flip;  // of every pixel
    double flip_sum = 0;
    std::uint64_t flip_pixels = 0;
};

// Errors of lit from one camera against its reference's. What is of the reference alone is made once; not
// for several threads at a time.
class ErrorsAgainst {
public:
    explicit ErrorsAgainst(const Frame& reference);
    ErrorsAgainst(const ErrorsAgainst&) = delete;
    ErrorsAgainst& operator=(const ErrorsAgainst&) = delete;

    FrameErrors operator()(const Image& lit) const;
    // What one of errorFigures needs of several cameras' errors: either flip_sum and flip_pixels or `pixels`.
    FrameErrors forFigure(std::size_t figure, const Image& lit) const;
    // Lets go of what FLIP keeps of the reference, some 256 MiB at most; it is made anew where it is needed.
    void release() const { flip_.reset(); }

private:
    std::vector<double> pixelsOf(const Image& lit) const;
    // Without what is not covered, which FLIP's filters would read beside what is.
    Image covered(const Image& lit) const;
    const HdrFlipAgainst& flip() const;

    const Coverage coverage_;
    const Image reference_;  // of every pixel
    const Image covered_;
    const PixelError relative_;
    mutable std::optional<HdrFlipAgainst> flip_;
};

// The reference frames with which all rows of a sweep are compared.
struct ReferenceFrames {
    std::vector<Frame> frames;                                 // one per camera
    std::vector<std::shared_ptr<const ErrorsAgainst>> errors;  // of each
    Exposure exposure;                                         // of every picture
};

// `shadows`: what shadows are judged by is drawn, too, where they cast.
ReferenceFrames drawReferenceFrames(Renderer& renderer, const Settings& given,
                                    const std::vector<std::string>& cameras, const PictureChoice& choice,
                                    const RenderOptions& options, bool shadows = true);

// RMSE and 99th percentile (nearest rank) of the pixels' relative errors.
struct RelativeErrors {
    double rmse = 0, p99 = 0;
};
RelativeErrors relativeErrors(std::vector<double> errors);

// Adds what the reference frames say and what of the scene's light the rows' paths leave out, which is part
// of their errors; a line that is among `notes` is not said again.
void addNotes(std::vector<std::string>& notes, const ReferenceFrames& references,
              std::span<const Settings> rows, const Requirements& needs);

// Errors over several cameras, all of whose pixels count alike.
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
// Draws and times the Settings from every camera of the reference frames: a first visit. `options`: runs,
// on_step, progress.
MeasuredRow measureRow(Renderer& renderer, const Settings& settings, const ReferenceFrames& references,
                       const RenderOptions& options);

// The same of another renderer's pictures, one for each of the reference frames, whose background they show.
// Their time is that in which each was made.
MeasuredRow measuredRow(std::vector<Frame> frames, const ReferenceFrames& references);

// Times `options.runs` more frames of the rows from every camera, the rows in turn: one more visit of each.
void timeAgain(Renderer& renderer, std::span<TradeoffRow* const> rows, const ReferenceFrames& references,
               const RenderOptions& options);

// The picture of lit as the page shows it, at most as wide as a card.
Image8 thumbnail(const Frame& frame, const Exposure& exposure);

}  // namespace diptych::tradeoff
