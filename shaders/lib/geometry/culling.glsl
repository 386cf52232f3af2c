// SPDX-License-Identifier: MIT
// Culls meshlets and triangles of an instance that a view cannot show. Culled triangles cover no sample
// under any device's rounding, so images stay bitwise identical (shared/draw/README.md, "What cannot
// show"). All comparisons have a margin; NaN compares false and keeps the triangle.
#ifndef CULLING_GLSL
#define CULLING_GLSL

#include "shaders/lib/contract.glsl"
#include "shared/contract/culling.h"

// The view's render target, from CullingConstants.
struct CulledPicture {
    vec2 half_size;   // pixels
    uint samples;     // per pixel
    float place_off;  // pixels
    float snap;       // pixels
};

// Error margins of the clip-plane distances, by pairs of planes: w + x and w - x, w + y and w - y, w - z.
// Both terms of each contribute.
vec3 slackOf(CulledItem item) { return item.error.xyz + vec3(item.error.w); }

// Whether an object-space box is entirely outside one clip plane, by its largest plane distance.
// item.error bounds the products of two shaders; one shader's products and this sum round no more often.
bool isBeyondView(CulledItem item, vec3 low, vec3 high) {
    mat4 rows = transpose(item.clip_from_object);
    vec3 slack = slackOf(item), middle = 0.5 * (low + high), reach = 0.5 * (high - low);
    vec4 sides[6] = vec4[6](rows[3] + rows[0], rows[3] - rows[0], rows[3] + rows[1], rows[3] - rows[1],
                            rows[3] - rows[2], rows[2]);
    float slacks[6] = float[6](slack.x, slack.x, slack.y, slack.y, slack.z, item.error.z);
    bool beyond = false;
    for (int i = 0; i < 6; ++i)
        beyond = beyond ||
                 dot(sides[i], vec4(middle, 1.0)) + dot(abs(sides[i].xyz), reach) < -slacks[i];
    return beyond;
}

// Location of sample i from the pixel's upper left corner, pixels.
vec2 culledSamplePlace(uint samples, uint i) {
    uint low = samples == 4u ? SAMPLE_PLACES_4 : SAMPLE_PLACES_8_LOW;
    uint place = (i < 4u ? low : SAMPLE_PLACES_8_HIGH) >> (8u * (i & 3u));
    return samples == 1u ? vec2(0.5) : vec2(place & 15u, place >> 4 & 15u) / 16.0;
}

// Edge function from a to b, both relative to a sample; positive inside after `turn`. Also its change from
// one sample to the next, across and down.
vec3 edgeSide(float turn, vec2 a, vec2 b) {
    return turn * vec3(a.x * b.y - a.y * b.x, a.y - b.y, b.x - a.x);
}

// Whether a triangle may cover a sample of its draw; corners in object space, m.
bool mayShow(CulledItem item, CulledPicture picture, vec3 first, vec3 second, vec3 third) {
    vec4 a = item.clip_from_object * vec4(first, 1.0), b = item.clip_from_object * vec4(second, 1.0),
         c = item.clip_from_object * vec4(third, 1.0);
    vec3 x = vec3(a.x, b.x, c.x), y = vec3(a.y, b.y, c.y), z = vec3(a.z, b.z, c.z), w = vec3(a.w, b.w, c.w);
    vec3 slack = slackOf(item);
    if (all(lessThan(w + x, vec3(-slack.x))) || all(lessThan(w - x, vec3(-slack.x))) ||
        all(lessThan(w + y, vec3(-slack.y))) || all(lessThan(w - y, vec3(-slack.y))) ||
        all(lessThan(w - z, vec3(-slack.z))) || all(lessThan(z, vec3(-item.error.z))))
        return false;
    // Clipping moves corners, so clipped triangles are kept.
    if (!(all(greaterThanEqual(w - abs(x), vec3(slack.x))) &&
          all(greaterThanEqual(w - abs(y), vec3(slack.y))) &&
          all(greaterThanEqual(w - z, vec3(slack.z))) && all(greaterThanEqual(z, vec3(item.error.z))) &&
          all(greaterThan(w, vec3(item.error.w)))))
        return true;

    // Rasterised corners are within `off` pixels of these, across and down. x / w is at most 1; the errors
    // of x and of w both count, divided by the smallest possible w. Rounding of pixel coordinates and the
    // rasteriser's snapping add to it.
    float nearest = min(w.x, min(w.y, w.z)) - item.error.w;
    vec2 far = picture.half_size * slack.xy / nearest;
    float off = picture.snap + picture.place_off + max(far.x, far.y), wide = 1.4143 * off;
    vec3 across = x / w * picture.half_size.x + picture.half_size.x,
         down = y / w * picture.half_size.y + picture.half_size.y;
    vec2 p = vec2(across.x, down.x), q = vec2(across.y, down.y), r = vec2(across.z, down.z);
    vec2 low = min(p, min(q, r)) - off, high = max(p, max(q, r)) + off;
    float reach = high.x - low.x + high.y - low.y;

    // glTF's front faces are counter-clockwise, a negative area here because y points down. Corners that
    // are each off by `wide` change the doubled area by at most wide * perimeter + 3 wide^2. The box's
    // perimeter bounds the triangle's. The last term is float32 rounding of the area.
    bool either = (item.sides & CULLED_BOTH_SIDES) != 0u;
    float turn = (item.sides & CULLED_MIRRORED) != 0u ? 1.0 : -1.0;
    vec2 to_second = q - p, to_third = r - p;
    float one = to_second.x * to_third.y, other = to_second.y * to_third.x;
    float uncertain = 1.01 * wide * (2.0 * reach + 3.0 * wide) + 5e-7 * (abs(one) + abs(other));
    if (!either && turn * (one - other) < -uncertain) return false;

    // For triangles of a few pixels: whether a sample is inside all edges. Moving a corner changes the
    // doubled area by the move times the distance of the other points, which are in the box. The margin
    // includes float32 rounding. No branch depends on a sample's result, because all cost the same.
    const int few = 6;
    float margin = 1.01 * wide * (2.0 * reach + wide);
    bool covers = false;
    uint sample_number = 0u;
    do {
        vec2 place = culledSamplePlace(picture.samples, sample_number);
        vec2 at = ceil(low - place);
        vec2 count = max(floor(high - place) - at + 1.0, vec2(0.0));
        bool large = count.x * count.y > float(few);
        covers = covers || large;
        at += place;
        vec3 pq = edgeSide(turn, p - at, q - at), qr = edgeSide(turn, q - at, r - at),
             rp = edgeSide(turn, r - at, p - at);
        for (int i = 0; i < few; ++i) {
            float v = count.x > 0.0 ? floor((float(i) + 0.5) / count.x) : 0.0;
            vec3 from = vec3(1.0, float(i) - v * count.x, v);
            vec3 sides = vec3(dot(pq, from), dot(qr, from), dot(rp, from));
            bool inside = all(greaterThanEqual(sides, vec3(-margin))) ||
                          (either && all(lessThanEqual(sides, vec3(margin))));
            covers = covers || (inside && float(i) < count.x * count.y);
        }
    } while (++sample_number < picture.samples);
    return covers;
}

#endif
