// SPDX-License-Identifier: MIT
// Whether two pictures that a relation binds are as alike as it says.
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

// The channels that are compared.
std::span<const int> relatedChannels();

// What a picture may differ by, and from which fact that follows.
struct RelationTolerance {
    Equality equality = Equality::bits;
    bool reorders = false;  // Relation::reorders
    // bits: units in the last place of a pixel's largest component. 0 where all pipelines round alike.
    int ulps = 0;
    // A part of a component: of radiance for `sums`, of every channel for `rounding`.
    double relative = 0;
    // rounding: the part of a pixel by which a device may place a vertex elsewhere (its steps below a pixel).
    double step = 0;
    // rounding: of a triangle's normal, which is made of places of neighbouring pixels; radians.
    double facet = 0;
    // rounding: a step of a texture filter's weight, a part of the whole range.
    double filter_step = 0;
    // By material of the given scene, whether it has a texture; and the share of their pixels that may be
    // filtered by another step.
    std::vector<bool> textured;
    double filtered_share = 0;
    // rounding: W x H x 1, the share of each pixel that blended surfaces hide; nullptr: nothing blends. Their
    // edges are in no channel.
    const Image* blended = nullptr;
    // rounding: what a packed G-buffer may change in each picture, by channel, in units of its components;
    // and what it changes in lit of both (W x H x 1, W/(sr m^2); nullptr: nothing).
    std::map<int, double> packed;
    const Image* packed_light = nullptr;

    std::string inWords() const;
};

// By channel the worst pixel: the largest error as a part of what is allowed there.
struct ChannelResult {
    int mode = 0;
    double error = 0, allowed = 0;  // there, of the largest component (bits: ULP)
    double used = 0;                // error / allowed; infinite where nothing is allowed
    int x = -1, y = -1;             // of the given picture, from the top left; -1: no difference
    std::uint64_t beyond = 0;       // pixels whose error is not allowed
};

struct FrameResult {
    std::vector<ChannelResult> channels;  // as relatedChannels(), those that both Frames have
    std::uint64_t covered = 0;            // pixels that show a surface in either picture
    // Pixels that are set aside, because they show another triangle (rounding: beside an edge; reorders: of
    // the same depth), and the most that may be.
    std::uint64_t aside = 0, most_aside = 0;
    // rounding: pixels of textured materials whose surface differs by a step of the filter, where lit is not
    // compared, and the most that may be.
    std::uint64_t filtered = 0, most_filtered = 0;
    std::string failed;  // why nothing was drawn
    // Of lit, or of the worst channel where lit holds: error / allowed at each pixel, W x H x 1.
    Image used;

    bool passes() const;
    const ChannelResult* worst() const;  // the channel that uses most of what is allowed; nullptr: none
};

// The changed picture as the given one would be.
Frame mappedBack(const Frame& changed, const PictureMap& map);

// `changed`: mapped back.
FrameResult evaluate(const Frame& given, const Frame& changed, const RelationTolerance& tolerance);

}  // namespace diptych::audit
