// SPDX-License-Identifier: MIT
// Culls meshlets and triangles of an instance that a view cannot show. Culled triangles cover no sample
// under any device's rounding, so images stay bitwise identical (shared/draw/README.md, "What cannot
// show"). All comparisons have a margin; NaN compares false and keeps the triangle.
#ifndef MESHLET_CULLING_GLSL
#define MESHLET_CULLING_GLSL

#include "shaders/lib/contract.glsl"
#include "shared/contract/meshlet_culling.h"

// The view's render target, from CullingConstants.
struct CulledImage {
    vec2 half_size;   // pixels
    uint samples;     // per pixel
    float position_error;  // pixels
    float snap;       // pixels
};

// Error margins of the clip-plane distances, by pairs of planes: w + x and w - x, w + y and w - y, w - z.
// Both terms of each contribute.
vec3 slackOf(const CulledItem item) { return item.error.xyz + vec3(item.error.w); }

// Whether an object-space box is entirely outside one clip plane, by its largest plane distance.
// item.error bounds the products of two shaders; one shader's products and this sum round no more often.
bool isBeyondView(const CulledItem item, const vec3 low, const vec3 high) {
    mat4 rows = transpose(item.clip_from_object);
    vec3 slack = slackOf(item), middle = 0.5 * (low + high), half_extent = 0.5 * (high - low);
    vec4 sides[6] = vec4[6](rows[3] + rows[0], rows[3] - rows[0], rows[3] + rows[1], rows[3] - rows[1],
                            rows[3] - rows[2], rows[2]);
    float slacks[6] = float[6](slack.x, slack.x, slack.y, slack.y, slack.z, item.error.z);
    bool beyond = false;
    for (int i = 0; i < 6; ++i)
        beyond = beyond ||
                 dot(sides[i], vec4(middle, 1.0)) + dot(abs(sides[i].xyz), half_extent) < -slacks[i];
    return beyond;
}

// Location of sample i from the pixel's upper left corner, pixels.
vec2 culledSampleLocation(const uint samples, const uint i) {
    uint low = samples == 4u ? SAMPLE_LOCATIONS_4 : SAMPLE_LOCATIONS_8_LOW;
    uint location = (i < 4u ? low : SAMPLE_LOCATIONS_8_HIGH) >> (8u * (i & 3u));
    return samples == 1u ? vec2(0.5) : vec2(location & 15u, location >> 4 & 15u) / 16.0;
}

// Edge function from a to b, both relative to a sample; positive inside after `turn`. Also its change from
// one sample to the next, across and down.
vec3 edgeSide(const float turn, const vec2 a, const vec2 b) {
    return turn * vec3(a.x * b.y - a.y * b.x, a.y - b.y, b.x - a.x);
}

// A triangle's corners in clip space, by component.
struct ClipTriangle {
    vec3 x, y, z, w;
};

// Whether all corners are outside one clip plane.
bool isBeyondView(const CulledItem item, const ClipTriangle t) {
    vec3 slack = slackOf(item);
    return all(lessThan(t.w + t.x, vec3(-slack.x))) || all(lessThan(t.w - t.x, vec3(-slack.x))) ||
           all(lessThan(t.w + t.y, vec3(-slack.y))) || all(lessThan(t.w - t.y, vec3(-slack.y))) ||
           all(lessThan(t.w - t.z, vec3(-slack.z))) || all(lessThan(t.z, vec3(-item.error.z)));
}

// Whether all corners are inside all clip planes, so that the triangle is not clipped.
bool isWithinView(const CulledItem item, const ClipTriangle t) {
    vec3 slack = slackOf(item);
    return all(greaterThanEqual(t.w - abs(t.x), vec3(slack.x))) &&
           all(greaterThanEqual(t.w - abs(t.y), vec3(slack.y))) &&
           all(greaterThanEqual(t.w - t.z, vec3(slack.z))) &&
           all(greaterThanEqual(t.z, vec3(item.error.z))) && all(greaterThan(t.w, vec3(item.error.w)));
}

// A triangle in pixels, with the error of its corners.
struct PixelTriangle {
    vec2 p, q, r;    // corners
    vec2 low, high;  // contain all corners with their errors
    float wide;      // largest distance of a rasterised corner from its own
    float half_perimeter;  // width plus height of the box
    float turn;      // 1: front faces have a positive area; -1: a negative one
    bool either;     // both faces show
};

// Rasterised corners are within `off` pixels of these, across and down. x / w is at most 1; the errors
// of x and of w both count, divided by the smallest possible w. Rounding of pixel coordinates and the
// rasteriser's snapping add to it.
PixelTriangle inPixels(const CulledItem item, const CulledImage image, const ClipTriangle t) {
    PixelTriangle c;
    float nearest = min(t.w.x, min(t.w.y, t.w.z)) - item.error.w;
    vec2 far = image.half_size * slackOf(item).xy / nearest;
    float off = image.snap + image.position_error + max(far.x, far.y);
    c.wide = 1.4143 * off;
    vec3 across = t.x / t.w * image.half_size.x + image.half_size.x,
         down = t.y / t.w * image.half_size.y + image.half_size.y;
    c.p = vec2(across.x, down.x), c.q = vec2(across.y, down.y), c.r = vec2(across.z, down.z);
    c.low = min(c.p, min(c.q, c.r)) - off, c.high = max(c.p, max(c.q, c.r)) + off;
    c.half_perimeter = c.high.x - c.low.x + c.high.y - c.low.y;
    c.turn = (item.sides & CULLED_MIRRORED) != 0u ? 1.0 : -1.0;
    c.either = (item.sides & CULLED_BOTH_SIDES) != 0u;
    return c;
}

// glTF's front faces are counter-clockwise, a negative area here because y points down. Corners that
// are each off by `wide` change the doubled area by at most wide * perimeter + 3 wide^2. The box's
// perimeter bounds the triangle's. The last term is float32 rounding of the area.
bool facesAway(const PixelTriangle t) {
    vec2 to_second = t.q - t.p, to_third = t.r - t.p;
    float one = to_second.x * to_third.y, other = to_second.y * to_third.x;
    float uncertain = 1.01 * t.wide * (2.0 * t.half_perimeter + 3.0 * t.wide) +
                      5e-7 * (abs(one) + abs(other));
    return !t.either && t.turn * (one - other) < -uncertain;
}

// For triangles of a few pixels: whether a sample is inside all edges. Moving a corner changes the
// doubled area by the move times the distance of the other points, which are in the box. The margin
// includes float32 rounding. No branch depends on a sample's result, because all cost the same.
bool coversSample(const PixelTriangle t, const uint samples) {
    const int few = 6;
    float margin = 1.01 * t.wide * (2.0 * t.half_perimeter + t.wide);
    bool covers = false;
    uint sample_index = 0u;
    do {
        vec2 location = culledSampleLocation(samples, sample_index);
        vec2 at = ceil(t.low - location);
        vec2 count = max(floor(t.high - location) - at + 1.0, vec2(0.0));
        bool large = count.x * count.y > float(few);
        covers = covers || large;
        at += location;
        vec3 pq = edgeSide(t.turn, t.p - at, t.q - at), qr = edgeSide(t.turn, t.q - at, t.r - at),
             rp = edgeSide(t.turn, t.r - at, t.p - at);
        for (int i = 0; i < few; ++i) {
            float v = count.x > 0.0 ? floor((float(i) + 0.5) / count.x) : 0.0;
            vec3 from = vec3(1.0, float(i) - v * count.x, v);
            vec3 sides = vec3(dot(pq, from), dot(qr, from), dot(rp, from));
            bool inside = all(greaterThanEqual(sides, vec3(-margin))) ||
                          (t.either && all(lessThanEqual(sides, vec3(margin))));
            covers = covers || (inside && float(i) < count.x * count.y);
        }
    } while (++sample_index < samples);
    return covers;
}

// Whether a triangle may cover a sample of its draw; corners in object space, m.
bool mayShow(const CulledItem item, const CulledImage image, const vec3 first, const vec3 second,
             const vec3 third) {
    vec4 a = item.clip_from_object * vec4(first, 1.0), b = item.clip_from_object * vec4(second, 1.0),
         c = item.clip_from_object * vec4(third, 1.0);
    ClipTriangle clip = ClipTriangle(vec3(a.x, b.x, c.x), vec3(a.y, b.y, c.y), vec3(a.z, b.z, c.z),
                                     vec3(a.w, b.w, c.w));
    if (isBeyondView(item, clip)) return false;
    // Clipping moves corners, so clipped triangles are kept.
    if (!isWithinView(item, clip)) return true;
    PixelTriangle triangle = inPixels(item, image, clip);
    if (facesAway(triangle)) return false;
    return coversSample(triangle, image.samples);
}

#endif
