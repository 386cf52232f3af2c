// SPDX-License-Identifier: MIT
// Whether two images bound by a relation are as similar as it requires.
#pragma once

#include "compare/audit/relation.h"
#include "shared/frame/frame.h"

#include <cstddef>
#include <cstdint>
#include <map>
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
    double filtered_share = 0;
    // rounding: fraction of each pixel hidden by blended surfaces, W x H x 1; nullptr: nothing blends. No
    // channel contains their edges.
    const Image* blended = nullptr;
    // rounding: error bounds of a packed G-buffer in each image, by channel, in units of its components;
    // and their effect on lit of both (W x H x 1, W/(sr m^2); nullptr: none).
    std::map<Channel, double> packed;
    const Image* packed_light = nullptr;

    std::string inWords() const;
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
    std::vector<ChannelResult> channels;  // as relatedChannels(), those that both Frames have
    std::uint64_t covered = 0;            // pixels that show a surface in either image
    // Pixels excluded because they show another triangle (rounding: beside an edge; reorders: of equal
    // depth), and the largest permitted number.
    std::uint64_t aside = 0, most_aside = 0;
    // rounding: pixels of textured materials whose surface differs by a step of the filter, and the
    // largest permitted number. lit is not compared there.
    std::uint64_t filtered = 0, most_filtered = 0;
    std::string failed;  // why nothing was rendered
    // error / allowed at each pixel, W x H x 1: of lit, or of the worst channel if lit passes.
    Image used;

    bool passes() const;
    const ChannelResult* worst() const;  // channel that uses most of its tolerance; nullptr: none
};

// Maps the changed image back onto the original one.
Frame mappedBack(const Frame& changed, const PictureMap& map);

// `changed`: mapped back.
FrameResult evaluate(const Frame& given, const Frame& changed, const RelationTolerance& tolerance);

}  // namespace diptych::audit
