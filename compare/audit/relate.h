// SPDX-License-Identifier: MIT
// Renders the images of metamorphic relations, by both paths and the reference, and checks the relations.
#pragma once

#include "compare/audit/measure.h"
#include "compare/audit/relations.h"
#include "shared/frame/frame.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace diptych::audit {

// Channels that are compared.
std::span<const Channel> relatedChannels();

// Tolerances between two images, each derived from a known property.
struct RelationTolerance {
    Equality equality = Equality::bits;
    bool reorders = false;  // Relation::reorders
    // bits: ulps of a pixel's largest component. 0 if all pipelines round alike.
    int ulps = 0;
    // Relative tolerance of a component: of radiance for `sums`, of every channel for `rounding`.
    double relative = 0;
    // rounding: fraction of a pixel by which a device may move a vertex (its subpixel steps).
    double step = 0;
    // rounding: error of a triangle's normal, computed from positions of neighbouring pixels; radians.
    double facet = 0;
    // rounding: one step of a texture filter's weight, as a fraction of the range.
    double filter_step = 0;
    // Whether each material of the original scene has a texture; and the fraction of their pixels that may
    // be filtered with another step.
    std::vector<bool> textured;
    double filtered_fraction = 0;
    // rounding: fraction of each pixel hidden by blended surfaces, W x H x 1; nullptr: nothing blends. No
    // channel contains their edges.
    const Image* blended = nullptr;
    // rounding: error bounds of a packed G-buffer in each image, by channel, in units of its components;
    // and their effect on lit of both (W x H x 1, W/(sr m^2); nullptr: none).
    std::map<Channel, double> packed;
    const Image* packed_light = nullptr;

    std::string describe() const;
};

// Worst pixel of a channel: the one with the largest error relative to its tolerance.
struct ChannelResult {
    Channel mode = Channel::lit;
    double error = 0, allowed = 0;  // at that pixel, of the largest component (bits: ulps)
    double used = 0;                // error / allowed; infinite if no error is allowed
    int x = -1, y = -1;             // in the original image, from the top left; -1: no difference
    std::uint64_t beyond = 0;       // pixels out of tolerance
};

struct FrameResult {
    std::vector<ChannelResult> channels;  // those of relatedChannels() that both Frames have
    std::uint64_t covered = 0;            // pixels that show a surface in either image
    // Pixels excluded because they show another triangle (rounding: beside an edge; reorders: of equal
    // depth), and the largest permitted number.
    std::uint64_t excluded = 0, max_excluded = 0;
    // rounding: pixels of textured materials whose surface differs by a step of the filter, and the
    // largest permitted number. lit is not compared there.
    std::uint64_t filtered = 0, max_filtered = 0;
    std::string failed;  // why nothing was rendered
    // error / allowed at each pixel, W x H x 1: of lit, or of the worst channel if lit passes.
    Image used_by_pixel;

    bool passes() const;
    const ChannelResult* worst() const;  // channel that uses most of its tolerance; nullptr: none
    double used() const { return worst() ? worst()->used : 0; }
};

// Maps the changed image back onto the original one.
Frame mappedBack(const Frame& changed, const PixelMap& map);

// `changed`: mapped back.
FrameResult evaluate(const Frame& original, const Frame& changed, const RelationTolerance& tolerance);

// One renderer's two images.
struct SeriesResult {
    Series series;      // also the reference's: mode scene, in double
    std::string lacks;  // why the relation does not apply; empty if it does
    FrameResult comparison;
    RelationTolerance tolerance;
    std::optional<Frame> original{}, changed{};  // only if broken: with lit, mapped back
};

struct RelationResult {
    const Relation* relation = nullptr;
    std::string lacks;  // why it does not apply to this scene; empty if it does
    std::vector<SeriesResult> series;

    bool passes() const;  // of the paths; the reference only shows the cause
};

class RelationMeasurer {
public:
    // `device` and `subject` must outlive it.
    RelationMeasurer(Device& device, const Subject& subject, std::function<void(const std::string&)> onStep,
                     std::shared_ptr<PipelineSet> pipelines = nullptr);

    // `spoil`: a fault injected into the changed case, for tests.
    RelationResult measure(const Relation& relation, const std::function<void(Case&)>& spoil = {});
    // Descriptions of omitted series.
    const std::vector<std::string>& omitted() const { return chosen_.omitted; }

private:
    // Images of a case, one for each series. If a path rejects the case, `failed` has the message.
    struct Drawn {
        std::vector<std::optional<Frame>> frames;
        std::vector<std::string> failed;
    };
    // Adds the missing images; `reference`: also those of the reference, which needs no device.
    void draw(Drawn& drawn, const Case& of, std::span<const Settings> settings, bool reference);
    // Change of lit by the G-buffer's encoding, as forward+ shades it, W x H x 1: a case's, mapped back; or
    // the sum of both cases.
    Image packedLight(const Case& of, const PixelMap& map);
    Image packedLight(const Related& related);
    RelationTolerance toleranceOf(const Relation& relation, const Related& related,
                                  const Settings& settings) const;
    // Compares the images of series i within `of.tolerance`.
    void check(SeriesResult& of, std::size_t i, const Related& related, const Drawn& original,
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
    Drawn original_;      // the original subject
    Image packed_light_;  // of the original subject
};

}  // namespace diptych::audit
