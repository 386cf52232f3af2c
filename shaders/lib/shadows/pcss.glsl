// SPDX-License-Identifier: MIT
// Percentage-closer soft shadows (Fernando 2005). The directional light is a disc, so the penumbra widens
// with the blocker's distance. First a search finds blockers within the cone from the receiver to the
// disc. Then comparisons are filtered over the cone's width at the blockers' mean distance. Both read 2 x
// 2 texel blocks in a square grid: every texel up to SOFT_BLOCKS blocks across, evenly spread blocks
// beyond.
#ifndef PCSS_GLSL
#define PCSS_GLSL

#include "shaders/lib/math/loop.glsl"

const float SOFT_BLOCKS = 8.0;

// Blocks that cover all texels partly within width / 2 of `middle`.
struct Blocks {
    vec2 first;  // texel
    float step;  // texels
    uint side;   // blocks
};
Blocks blocksAround(const vec2 middle, const float width) {
    float texels = ceil(width) + 1.0, side = min(ceil(0.5 * texels), SOFT_BLOCKS);
    return Blocks(floor(middle - 0.5 * width), max(texels / side, 2.0), uint(side));
}
// The lower corner of a block, and its depths in textureGather's order.
vec2 cornerOf(const Blocks b, const uint x, const uint y) { return floor(b.first + b.step * vec2(x, y)); }
vec4 depthsOf(const vec2 corner, const uint layer) {
    float size = float(textureSize(shadow_map, 0).x);
    return textureGather(shadow_map, vec3((corner + 1.0) / size, float(layer)));
}
const vec2 GATHERED[4] = vec2[](vec2(0.5, 1.5), vec2(1.5, 1.5), vec2(1.5, 0.5), vec2(0.5, 0.5));

// Mean and smallest distance of blockers in front of the receiver, in the map's depth; 0 without any.
// `cone`: radius in texels at a depth of 1. Texels up to the triangle's own plane are not blockers.
vec2 blockerDistance(const ReceiverPlane r, const uint layer, const float cone, const float widest) {
    Blocks blocks = blocksAround(r.texel, clamp(2.0 * cone * (1.0 - r.depth), 1.0, widest));
    float sum = 0.0, count = 0.0, smallest = 1.0;
    uvec2 rows = uvec2(0, blocks.side);
    EACH(rows) {
        uvec2 columns = uvec2(0, blocks.side);
        EACH(columns) {
            vec2 corner = cornerOf(blocks, columns.x, rows.x);
            vec4 stored = depthsOf(corner, layer);
            for (int i = 0; i < 4; ++i) {
                vec2 offset = corner + GATHERED[i] - r.texel;
                float nearer = stored[i] - r.depth;
                bool blocks_disc = nearer > max(dot(r.slope, offset), 0.0) &&
                                   lengthOf(offset) < cone * nearer + 0.5;
                sum += blocks_disc ? nearer : 0.0;
                count += blocks_disc ? 1.0 : 0.0;
                smallest = blocks_disc ? min(smallest, nearer) : smallest;
            }
            NEXT(columns);
        }
        NEXT(rows);
    }
    return count > 0.0 ? vec2(sum / count, smallest) : vec2(0.0);
}

// Filters over a disc `width` texels wide around the receiver; texels at the rim count in part.
float pcfDiscVisibility(const ReceiverPlane r, const uint layer, const float width) {
    Blocks blocks = blocksAround(r.texel, width);
    float lit = 0.0, area = 0.0;
    uvec2 rows = uvec2(0, blocks.side);
    EACH(rows) {
        uvec2 columns = uvec2(0, blocks.side);
        EACH(columns) {
            vec2 corner = cornerOf(blocks, columns.x, rows.x);
            vec4 stored = depthsOf(corner, layer);
            for (int i = 0; i < 4; ++i) {
                vec2 texel = corner + GATHERED[i];
                float weight = clamp(0.5 * width + 0.5 - lengthOf(texel - r.texel), 0.0, 1.0);
                weight *= texelWeight(r, texel);
                lit += weight * compareWithPlaneBias(r, stored[i], texel);
                area += weight;
            }
            NEXT(columns);
        }
        NEXT(rows);
    }
    return area > 0.0 ? lit / area : 1.0;
}

// `r`: for the smallest width, feature_shadow_kernel. In a wide filter the plane may rise halfway to the
// nearest blocker; where it is steeper the filter is narrower.
float pcssVisibility(const Surface s, const ShadowLight light, const Cascade cascade, const ReceiverPlane r,
                     const uint layer) {
    float texels = cascade.texels_per_metre / light.depth_scale, cone = light.disc * texels;
    vec2 blocker = blockerDistance(r, layer, cone, light.widest);
    float max_bias = max(r.max_bias, 0.5 * blocker.y), steepest = 2.0 * max_bias / lengthOf(r.slope) - 1.0;
    float width = max(min(min(2.0 * cone * blocker.x, light.widest), steepest), float(feature_shadow_kernel));
    ReceiverPlane soft = sunReceiverPlane(s, light, cascade, max_bias * texels);
    return pcfDiscVisibility(soft, layer, width);
}

#endif
