// SPDX-License-Identifier: MIT
// Renders the images of metamorphic relations, by both paths and the reference, and checks the relations.
#pragma once

#include "compare/audit/measure.h"
#include "compare/audit/relation.h"
#include "compare/audit/relation_result.h"
#include "shared/frame/frame.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace diptych::audit {

// One renderer's two images.
struct SeriesResult {
    Series series;      // also the reference's: mode scene, in double
    std::string lacks;  // why the relation does not apply; empty if it does
    FrameResult comparison;
    RelationTolerance tolerance;
    std::optional<Frame> given{}, changed{};  // only if broken: with lit, mapped back
};

// Likely cause of a broken relation, judged by the double-precision reference.
enum class Blame { none, ours_likely, driver_or_ours, relation };

struct RelationResult {
    const Relation* relation = nullptr;
    std::string lacks;  // why it does not apply to this scene; empty if it does
    std::vector<SeriesResult> series;

    bool passes() const;  // of the paths; the reference only shows the cause
    Blame blame(bool cpu) const;
};

// Renderers to test: both paths with the original Settings, deferred with a float32 G-buffer, and last the
// reference.
ChosenSeries relatedSeries(const Subject& subject);

class RelationMeasurer {
public:
    // `device` and `subject` must outlive it.
    RelationMeasurer(Device& device, const Subject& subject, std::function<void(const std::string&)> onStep,
                     std::shared_ptr<PipelineSet> pipelines = nullptr);

    // `spoil`: a fault injected into the changed case, for tests.
    RelationResult measure(const Relation& relation, const std::function<void(Case&)>& spoil = {});
    // Descriptions of omitted series.
    const std::vector<std::string>& leftOut() const { return chosen_.left_out; }

private:
    // Images of a case, one for each series. If a path rejects the case, `failed` has the message.
    struct Drawn {
        std::vector<std::optional<Frame>> frames;
        std::vector<std::string> failed;
    };
    // `reference`: also render series that need no device.
    Drawn draw(const Case& of, std::span<const Settings> settings, bool reference);
    // Adds the series that draw() omitted.
    static void addReference(Drawn& drawn, const Case& of, std::span<const Settings> settings);
    // Change of lit by the G-buffer's encoding, as forward+ shades it, W x H x 1: a case's, in place of
    // its lit; or the sum of both cases, in the base's pixels.
    Frame packedLight(const Case& of);
    Image packedLight(const Related& related);
    RelationTolerance toleranceOf(const Relation& relation, const Related& related,
                                  const Settings& settings) const;
    // Compares the images of series i within `of.tolerance`.
    void check(SeriesResult& of, std::size_t i, const Related& related, const Drawn& given,
               const Drawn& changed);

    Device& device_;
    const Subject& subject_;
    const std::function<void(const std::string&)> on_step_;
    const std::shared_ptr<PipelineSet> pipelines_;
    // Pixels of the original image where surfaces have equal depth, so that the drawing order decides
    // which is visible.
    std::uint64_t tied();

    const ChosenSeries chosen_;
    const std::vector<Series>& series_ = chosen_.series;
    std::optional<std::uint64_t> tied_;
    std::optional<Drawn> given_;  // the original subject
    Image packed_light_;          // of the original subject
};

}  // namespace diptych::audit
