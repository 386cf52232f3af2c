// SPDX-License-Identifier: MIT
// Draws a pushed case by either path and holds it against the reference.
#pragma once

#include "compare/audit/quantity.h"
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

// One line of a plot: a path, with Settings that differ from those that are given.
struct Series {
    Path path = Path::deferred;
    std::vector<Change> changes;

    Settings applied(Settings settings) const;
    std::string words() const;  // "deferred, gbuffer full"
};

// Series that each draw another picture, and in words what was left out of them because it does not.
struct ChosenSeries {
    std::vector<Series> series;
    std::vector<std::string> left_out;  // "forward_plus, gbuffer full: is drawn as forward_plus"

    // `settings`: the whole of them, as the series is drawn. Leaves out what has no meaning, and what draws
    // the same picture as a series that is there.
    void add(Series series, const Settings& settings);

private:
    std::vector<Settings> known_;
};

// The series of a quantity: both paths as they are given; deferred with a G-buffer of float32, which rounds
// no more than arithmetic does; and what the quantity names.
ChosenSeries seriesOf(const Quantity& quantity, const Subject& subject);

struct Outcome {
    // 99th percentiles, by nearest rank, of the relative errors (PixelError) of the pixels that show a
    // surface: at edges a path and the reference may see another surface through rounding alone.
    // `light`: of lit, against the reference's of the surfaces that forward+ captures in float32; of pictures
    // (Case::exposure) the difference of a component, as a part of white.
    // `depth`: of view depth, against rays that the reference traces in double.
    double light = 0, depth = 0;
    double flip = 0;                 // mean HDR-FLIP of the whole picture, against the former
    std::uint64_t misplaced = 0;     // pixels that show another material than the latter, or none
    std::uint64_t nonfinite = 0;     // pixels of lit that are NaN or infinite
    int worst_x = -1, worst_y = -1;  // the first that is no number, or else of the largest error of lit
    std::string failed;              // why nothing was drawn; then the errors are infinite
    double light_999 = 0;            // `light` of 99.9 % of the pixels; of what is measured now alone

    // The larger of both; infinite where a pixel is no number.
    double error() const {
        return nonfinite > 0 ? std::numeric_limits<double>::infinity() : std::max(light, depth);
    }
};

struct Step {
    double magnitude = 0;
    std::vector<Outcome> outcomes;  // as the series
    // Quantity::same_picture: the reference's own error() against its picture of the scene as it is, which is
    // the truth then: how far it could be trusted by itself.
    std::optional<double> reference_moved{};
    std::uint64_t covered = 0;  // pixels of the reference that show a surface
    std::string failed;         // why there is no reference
};

class Measurer {
public:
    // `device` and `subject` outlive it. Draws the reference of the subject as it is.
    Measurer(Device& device, const Subject& subject, std::function<void(const std::string&)> onStep);

    // What is wrong with the paths, for tests of what an audit finds: they draw another scene than the truth
    // is of, or their picture is another one. `channels`: what of it `picture` reads beside lit and depth.
    struct Fault {
        std::function<void(Case&)> scene{};
        std::function<void(const Case&, Frame&)> picture{};
        std::vector<int> channels{};
    };
    void plant(Fault fault) { fault_ = std::move(fault); }

    // Of the pixels of the truth of the subject as it is, which stand for whatever files it comes from.
    std::string fingerprint();
    Step measure(const Quantity& quantity, std::span<const Series> series, double magnitude);
    // The same of a case that is pushed already.
    Step measure(const Case& pushed, std::span<const Series> series);

private:
    // What a path is held against: lit of captured surfaces; depth and materials of traced rays.
    struct Truth {
        Frame lit, rays;
    };
    static Frame litOfSurfaces(Renderer& renderer, Settings settings);
    // Takes from the scene what does not decide where a surface is.
    static Frame tracedRays(Scene scene, Settings settings);
    // Of the subject as it is, in a picture of this size.
    const Truth& original(const Size& size);
    // `exposure`: Case::exposure.
    static Outcome outcomeOf(const Truth& truth, const Frame& lit, const Frame& rays, double exposure = 0);
    // What is drawn of a case: the truth of it, and a Frame of each series or why there is none.
    struct Drawn {
        Truth truth;
        std::vector<Frame> frames;
        std::vector<std::string> failed;
    };
    Drawn draw(const Case& pushed, std::span<const Series> series);
    Step measure(const Case& pushed, std::span<const Series> series, const Quantity* quantity,
                 double magnitude);

    Device& device_;
    const Subject& subject_;
    const std::function<void(const std::string&)> on_step_;
    const std::shared_ptr<PipelineSet> pipelines_;
    std::map<std::pair<int, int>, Truth> original_;  // by the picture's width and height
    std::optional<Drawn> pictures_;                  // of the quantity that changes pictures alone
    Fault fault_{};
};

}  // namespace diptych::audit
