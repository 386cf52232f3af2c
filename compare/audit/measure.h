// SPDX-License-Identifier: MIT
// Renders a modified case by either path and compares it with the reference.
#pragma once

#include "compare/audit/quantities.h"
#include "compare/experiment/row.h"
#include "compare/render/renderer.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace diptych::audit {

// One line of a plot: a path with changed Settings.
struct Series {
    Path path = Path::deferred;
    std::vector<Change> changes;

    Settings applied(Settings settings) const;
    std::string describe() const;  // "deferred, gbuffer full"
};

// Series that render different images, and descriptions of the omitted ones.
struct ChosenSeries {
    std::vector<Series> series;
    std::vector<std::string> omitted;  // "forward_plus, gbuffer full draws the same as forward_plus"
};

// Without series that have no meaning or render the same image as an earlier one.
ChosenSeries chosenOf(const std::vector<Series>& wanted,
                      const std::function<Settings(const Series&)>& settingsOf);

// Series of a quantity: both paths with the original Settings; deferred with a float32 G-buffer, which
// rounds no more than arithmetic does; and the quantity's variants.
ChosenSeries seriesOf(const Quantity& quantity, const Subject& subject);

using experiment::Measure;

// Errors are 99th percentiles (nearest rank) of relative errors (PixelError) over pixels that show a surface.
// At edges, rounding alone may make a path and the reference see different surfaces.
// light_p99: of lit, against the reference's shading of the surfaces that forward+ captures in float32. For
// 8-bit images (Case::exposure), the largest component difference as a fraction of white. flip: the same
// reference. depth_p99: of view depth, against rays that the reference traces in double. They are infinite
// if nothing was rendered.
// reference_moved: with Quantity::same_image, whose truth is then the image of the original scene.
// Measures how far the reference can be trusted.
struct Outcome : experiment::Row {
    int worst_x = -1, worst_y = -1;  // first non-finite pixel, or the one with the largest error of lit

    // The larger of both; infinite if a pixel is not finite.
    double error() const {
        return whole(Measure::nonfinite_pixels) > 0
                   ? std::numeric_limits<double>::infinity()
                   : std::max(measured[Measure::light_p99], measured[Measure::depth_p99]);
    }
};

struct Step {
    double magnitude = 0;
    std::vector<Outcome> outcomes;  // one for each series

    // Whether the reference shows a surface.
    bool isCovered() const { return outcomes.front().whole(Measure::compared_pixels) > 0; }
};

// Whether a blended surface (W x H x 1) is within this many pixels, or in the pixel; empty: nowhere.
bool isNearBlended(const Image& blended, std::size_t pixel, int radius);

class Measurer {
public:
    // `device` and `subject` must outlive it. Renders the reference of the original subject.
    Measurer(Device& device, const Subject& subject, std::function<void(const std::string&)> onStep);

    // An injected fault for tests: the paths render another scene than the truth, or their image is
    // changed. `channels`: channels that `image` reads, beside lit and depth.
    struct Fault {
        std::function<void(Case&)> scene{};
        std::function<void(const Case&, Frame&)> image{};
        std::vector<Channel> channels{};
    };
    void plant(Fault fault) { fault_ = std::move(fault); }

    // Hash of the pixels of the original subject's truth; represents all files that it comes from.
    std::string fingerprint();
    Step measure(const Quantity& quantity, std::span<const Series> series, double magnitude);
    // Measures an already modified case; by `quantity`, if any.
    Step measure(const Case& changed, std::span<const Series> series, const Quantity* quantity = nullptr,
                 double magnitude = 0);

private:
    // Ground truth for a path: lit of captured surfaces; depth and materials of traced rays.
    struct GroundTruth {
        Frame lit, rays;
    };
    static Frame litOfSurfaces(Renderer& renderer, Settings settings);
    // Removes from the scene what does not decide where a surface is.
    static Frame tracedRays(Scene scene, Settings settings);
    // Truth of the original subject at an image size.
    const GroundTruth& original(const Size& size);
    // `exposure`: Case::exposure.
    static Outcome outcomeOf(const GroundTruth& truth, const Frame& lit, const Frame& rays,
                             double exposure = 0);
    // Results for a case: its truth, and for each series a Frame or the reason why there is none.
    struct Drawn {
        GroundTruth truth;
        std::vector<Frame> frames;
        std::vector<std::string> failed;
    };
    Drawn draw(const Case& changed, std::span<const Series> series);

    Device& device_;
    const Subject& subject_;
    const std::function<void(const std::string&)> on_step_;
    const std::shared_ptr<PipelineSet> pipelines_;
    std::map<std::pair<int, int>, GroundTruth> original_;  // by image width and height
    Drawn images_;                                         // of a quantity that only changes images
    Fault fault_{};
};

}  // namespace diptych::audit
