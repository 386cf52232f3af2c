// SPDX-License-Identifier: MIT
// Draws what relations bind, by both paths and by the reference, and says whether they hold.
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

// One renderer's two pictures.
struct SeriesResult {
    Series series;      // the reference's, too: of mode scene, in double
    std::string lacks;  // why the relation says nothing of it; empty where it does
    FrameResult comparison;
    RelationTolerance tolerance;
    std::optional<Frame> given{}, changed{};  // of what is broken: with lit, mapped back
};

// Whose fault a broken relation is, by what the reference in double precision says of it.
enum class Blame { none, ours_likely, driver_or_ours, relation };

struct RelationResult {
    const Relation* relation = nullptr;
    std::string lacks;  // why it says nothing of this scene; empty where it does
    std::vector<SeriesResult> series;

    bool passes() const;  // of the paths; the reference only tells whose fault it is
    Blame blame(bool cpu) const;
};

// The renderers that are asked: both paths as given, deferred with a G-buffer of float32, and last the
// reference.
ChosenSeries relatedSeries(const Subject& subject);

class RelationMeasurer {
public:
    // `device` and `subject` outlive it.
    RelationMeasurer(Device& device, const Subject& subject, std::function<void(const std::string&)> onStep,
                     std::shared_ptr<PipelineSet> pipelines = nullptr);

    // `spoil`: a fault that is planted in the changed case, for tests of this room; without one as it is.
    RelationResult measure(const Relation& relation, const std::function<void(Case&)>& spoil = {});
    // Of the series, in words.
    const std::vector<std::string>& leftOut() const { return chosen_.left_out; }

private:
    // A case's pictures, as the series; without what a path refuses, whose words are in `failed`.
    struct Drawn {
        std::vector<std::optional<Frame>> frames;
        std::vector<std::string> failed;
    };
    // `reference`: also what needs no device.
    Drawn draw(const Case& of, std::span<const Settings> settings, bool reference = true);
    // What draw() left out.
    static void addReference(Drawn& drawn, const Case& of, std::span<const Settings> settings);
    // What the G-buffer's encoding changes in lit, as forward+ shades it, W x H x 1: of a case, in the place
    // of its lit; and the sum of both cases, as the base shows them.
    Frame packedLight(const Case& of);
    Image packedLight(const Related& related);
    RelationTolerance toleranceOf(const Relation& relation, const Related& related,
                                  const Settings& settings) const;

    Device& device_;
    const Subject& subject_;
    const std::function<void(const std::string&)> on_step_;
    const std::shared_ptr<PipelineSet> pipelines_;
    // Pixels of the given picture that show surfaces of one depth, either of which is seen where they are
    // drawn in another order.
    std::uint64_t tied();

    const ChosenSeries chosen_;
    const std::vector<Series>& series_ = chosen_.series;
    std::optional<std::uint64_t> tied_;
    std::optional<Drawn> given_;  // the subject as it is
    Image packed_light_;          // of the subject as it is
};

}  // namespace diptych::audit
