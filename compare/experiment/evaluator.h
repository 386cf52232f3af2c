// SPDX-License-Identifier: MIT
// Draws Settings of a scene, evaluates their images and times them in turn.
#pragma once

#include "compare/experiment/prepared_pool.h"
#include "compare/experiment/references.h"
#include "compare/experiment/row.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

namespace diptych::experiment {

// Draws, evaluates and times Settings of a scene: on a device, or from recorded times.
class Evaluator {
public:
    Evaluator() = default;
    Evaluator(const Evaluator&) = delete;
    Evaluator& operator=(const Evaluator&) = delete;
    virtual ~Evaluator() = default;
    // Error and bytes, which do not change from run to run.
    virtual Measures evaluate(const Settings& settings) = 0;
    // Renders frames[order[i]] for each i; returns the times, ms.
    virtual std::vector<double> time(std::span<const Settings> frames,
                                     std::span<const std::size_t> order) = 0;
    // Passes of one frame, each timed alone, ms.
    virtual std::vector<PassTime> profile(const Settings& settings) = 0;
};

// Evaluates one scene over all cameras of the reference frames. Errors cover all pixels together, times
// are the mean, memory is the maximum; passes are of the first camera.
class SceneEvaluator final : public Evaluator {
public:
    // `metric`: the error that is wanted. The renderer and the references must outlive the object.
    SceneEvaluator(Renderer& renderer, const ReferenceFrames& references, Measure metric,
                   const RenderOptions& options)
        : renderer_(renderer), references_(references), metric_(metric), options_(options), pool_(renderer) {}

    Measures evaluate(const Settings& settings) override;
    std::vector<double> time(std::span<const Settings> frames, std::span<const std::size_t> order) override;
    // Drops the prepared frames, which own images.
    void release() {
        pool_.clear();
        evaluated_.clear();
    }
    std::vector<PassTime> profile(const Settings& settings) override;

private:
    std::size_t metricIndex() const { return metric_ - Measure::flip; }
    std::size_t cameras() const { return references_.frames.size(); }
    // Errors of one camera's image. FLIP results are cached by the image's hash.
    FrameErrors errorsOf(std::size_t camera, const Image& lit);

    Renderer& renderer_;
    const ReferenceFrames& references_;
    Measure metric_;
    RenderOptions options_;
    PreparedPool pool_;
    // Key: camera, image hash. Only FLIP: the other metrics store every pixel.
    std::map<std::pair<std::size_t, std::uint64_t>, FrameErrors> evaluated_;
};

}  // namespace diptych::experiment
